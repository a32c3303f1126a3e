//! `plan`: paths, their files, scripts and recorded runs; what has none; planners compared.

use std::fs;

use motion_lab::collision::Scene;
use motion_lab::geometry::Footprint;
use motion_lab::num::{cos, sin};
use motion_lab::picture::{Rgb, Role, Theme};
use motion_lab::prelude::*;

use crate::cli::{SHUT, json, run, run_in};

const ROUND_THE_POST: [&str; 7] = ["plan", "--robot", "reach", "--from", "2.0,0", "--to", "3.1,0"];

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// The arm's two links by sine and cosine, as bare segments with a radius.
fn links(q: &[f64]) -> Footprint {
    let elbow = Point2::new(cos(q[0]), sin(q[0]));
    let tip = Point2::new(elbow.x + cos(q[0] + q[1]), elbow.y + sin(q[0] + q[1]));
    Footprint::capsules([Segment::new(Point2::origin(), elbow), Segment::new(elbow, tip)], 0.03)
}

#[test]
fn a_path_goes_to_a_file_a_script_a_picture_and_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["-o", "path.json", "--growth", "--script", "out.ron", "--record", "run.mcap", "--svg", "path.svg"];
    let said = run_in(folder.path(), &[&ROUND_THE_POST[..], &files, &["--seed", "7"]].concat());
    for line in ["rrt-connect at seed 7: reach in Workbench", "clearance  0.", "played ", "recorded   0 contacts"] {
        assert!(said.out.contains(line), "{line}: {} {}", said.out, said.err);
    }
    for file in ["path.json", "out.ron", "run.mcap", "path.svg"] {
        assert!(said.err.contains(&format!("wrote {file}")), "{}", said.err);
    }
    let path = json(&fs::read_to_string(folder.path().join("path.json")).unwrap());
    assert_eq!((path["version"].as_u64(), path["robot"]["kind"].as_str()), (Some(1), Some("reach")));
    let legs = path["legs"].as_array().unwrap();
    assert_eq!((numbers(&legs[0]["from"]), numbers(&legs[legs.len() - 1]["to"])), (vec![2.0, 0.0], vec![3.1, 0.0]));
    // every leg is free where one looks, joins the next, and is proven from 0 to 1
    let scene = Scene::workbench();
    let clearance = path["clearance"].as_f64().unwrap();
    for (i, leg) in legs.iter().enumerate() {
        let (from, to) = (numbers(&leg["from"]), numbers(&leg["to"]));
        assert!(i == 0 || numbers(&legs[i - 1]["to"]) == from, "leg {i}");
        let steps = leg["steps"].as_array().unwrap();
        assert_eq!(numbers(&steps[0])[0], 0.0);
        assert_eq!(numbers(&steps[steps.len() - 1])[1], 1.0);
        for k in 0..=50 {
            let s = f64::from(k) / 50.0;
            // the legs are short: none crosses half a turn
            let turn = |a: f64, b: f64| a + s * motion_lab::num::wrap(b - a);
            let distance = scene.distance(&links(&[turn(from[0], to[0]), turn(from[1], to[1])]));
            assert!(distance >= clearance - 1e-9, "leg {i} at {s}: {distance}");
        }
    }
    let (nodes, edges) = (path["growth"]["nodes"].as_array().unwrap(), path["growth"]["edges"].as_array().unwrap());
    assert!(nodes.len() > legs.len() && !edges.is_empty());
    run_in(folder.path(), &["verify", "run.mcap"]).done();
    // for programs the same is one object, with the run's digest
    let again = ["--record", "again.mcap", "--seed", "7", "--json"];
    let answer = json(&run_in(folder.path(), &[&ROUND_THE_POST[..], &again].concat()).done());
    let digest = answer["digest"].as_str().unwrap();
    assert!(said.out.contains(&format!("digest {digest}")), "{digest} {}", said.out);
    assert!(said.out.contains(&format!("played     {} ticks", answer["ticks"])), "{answer} {}", said.out);
    assert_eq!(answer["contacts"], 0);
    run_in(folder.path(), &["script", "check", "out.ron", "--world", "workbench"]).done();
    let again = run_in(folder.path(), &["script", "print", "run.mcap"]).done();
    assert_eq!(again, fs::read_to_string(folder.path().join("out.ron")).unwrap());
    let svg = fs::read_to_string(folder.path().join("path.svg")).unwrap();
    assert!(svg.contains("the post") && svg.contains("the path") && svg.contains("what the planner has grown"));
}

#[test]
fn a_trailer_is_parked_and_recorded_and_the_run_verifies() {
    let folder = tempfile::tempdir().unwrap();
    let ends = ["--from", "6.5,2.5,0,0", "--to", "6.75,7,-1.5707963267948966,-1.5707963267948966"];
    let said =
        run_in(folder.path(), &[&["plan", "--robot", "hitch"][..], &ends, &["--record", "parked.mcap"]].concat());
    let out = said.done();
    assert!(out.contains("hybrid-a-star") && out.contains("at most 0.000 mm off the path"), "{out}");
    run_in(folder.path(), &["verify", "parked.mcap"]).done();
    let info = run_in(folder.path(), &["replay", "parked.mcap", "--json"]).done();
    let robot = &json(info.lines().last().unwrap())["robots"][0];
    let q = numbers(&robot["configuration"]);
    assert!((q[0] - 6.75).abs() < 0.1 && (q[1] - 7.0).abs() < 0.1 && robot["contacts"] == 0, "{robot}");
}

#[test]
fn a_rover_follows_its_path_at_any_seed() {
    let folder = tempfile::tempdir().unwrap();
    for seed in ["1", "2"] {
        let to = ["plan", "--robot", "Rusty", "--to", "4.5,2", "--seed", seed, "--record", "run.mcap", "--quiet"];
        let out = run_in(folder.path(), &to).done();
        assert!(out.contains("recorded   0 contacts"), "{out}");
        run_in(folder.path(), &["verify", "run.mcap"]).done();
    }
}

#[test]
fn a_path_by_cells_is_played_by_rover_and_arm() {
    let folder = tempfile::tempdir().unwrap();
    let by_cells = ["plan", "--planner", "cell-decomposition", "--record", "run.mcap", "--quiet"];
    let bent = ["--world", "workbench", "--robot", "reach3", "--from", "2,0,0.2", "--to", "3.1,0.2,0.3"];
    for ends in [&["--robot", "Rusty", "--to", "4.5,2"][..], &ROUND_THE_POST[1..], &bent] {
        let out = run_in(folder.path(), &[&by_cells[..], ends].concat()).done();
        assert!(out.contains("recorded   0 contacts") && out.contains(" s, at most "), "{out}");
        run_in(folder.path(), &["verify", "run.mcap"]).done();
        // a number of ticks of a 20th of a second has two decimals at most
        let seconds = out.split(" ticks, ").nth(1).and_then(|rest| rest.split(" s,").next()).unwrap();
        assert!(seconds.split('.').nth(1).is_none_or(|decimals| decimals.len() <= 2), "{seconds}");
    }
    // a car's chart is no road
    let car = run(&["plan", "--planner", "cell-decomposition", "--robot", "Hitch", "--to", "9,2.5,0"]);
    assert!(car.code == Some(4) && car.err.contains("do not say how a car drives there"), "{} {}", car.out, car.err);
}

/// The pictures of a film: how long each is shown, hundredths of a second, and how many of its pixels have the path's
/// colour.
fn film(file: &std::path::Path) -> Vec<(u16, usize)> {
    let bytes = fs::read(file).unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).unwrap();
    let Rgb(path) = Theme::Light.palette().colour(Role::Path);
    let mut pictures = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let of_path = frame.buffer.chunks(4).filter(|pixel| pixel[..3] == path).count();
        pictures.push((frame.delay, of_path));
    }
    pictures
}

#[test]
fn a_film_shows_every_iteration_and_ends_with_the_path() {
    let folder = tempfile::tempdir().unwrap();
    let gif = ["--gif", "growth.gif", "--width", "640", "--seed", "7", "--json"];
    let answer = json(&run_in(folder.path(), &[&ROUND_THE_POST[..], &gif].concat()).done());
    let iterations = answer["effort"]["iterations"].as_u64().unwrap() as usize;
    let pictures = film(&folder.path().join("growth.gif"));
    assert!(iterations > 5 && pictures.len() == iterations, "{iterations}: {}", pictures.len());
    // the last stays for two seconds
    assert!(pictures[0].0 < 200 && pictures[iterations - 1].0 == 200, "{pictures:?}");
    let (growing, found) = pictures.split_at(iterations - 1);
    // few colours may take a pixel for the path's
    let most = growing.iter().map(|(_, of_path)| *of_path).max().unwrap();
    assert!(found.iter().all(|(_, of_path)| *of_path > 100 + most), "{growing:?} {found:?}");
    // without a path the growth is filmed too
    let trap = ["plan", "--planner", "potential-field", "--robot", "rusty", "--from", "1.5,5.75", "--to", "9.75,6.25"];
    let none = run_in(folder.path(), &[&trap[..], &["--gif", "trap.gif", "--width", "480"]].concat());
    assert!(none.code == Some(4) && none.err.contains("wrote trap.gif"), "{}", none.err);
    let pictures = film(&folder.path().join("trap.gif"));
    assert!(pictures.len() > 10, "{pictures:?}");
}

#[test]
fn what_has_no_path_is_said_and_is_code_4() {
    let none = |arguments: &[&str]| run(&[&["plan"][..], arguments].concat()).failed(4);
    let in_the_block = none(&["--robot", "reach", "--from", "0.785,0.785", "--to", "3.1,0"]);
    assert!(in_the_block.contains("no path: the start would overlap the block"), "{in_the_block}");
    let in_a_wall = none(&["--robot", "rusty", "--to", "4.5,4.75"]);
    assert!(in_a_wall.contains("the goal would overlap"), "{in_a_wall}");
    let outside = none(&["--robot", "rusty", "--from", "2.25,6.25", "--to", "-3,6", "--iterations", "300"]);
    assert!(outside.starts_with("motion-lab: no path: the goal (-3, 6) lies outside the world"), "{outside}");
    // the far side of a wall: free, and out of reach
    let folder = tempfile::tempdir().unwrap();
    let shut = folder.path().join("shut.ron");
    fs::write(&shut, SHUT).unwrap();
    let behind = ["--world", shut.to_str().unwrap(), "--robot", "R", "--to", "3,1"];
    let beyond = none(&[&behind[..], &["--iterations", "300"]].concat());
    assert!(beyond.starts_with("motion-lab: no path within the bound on iterations: 300 iterations"), "{beyond}");
    assert!(beyond.contains("allow more --iterations"), "{beyond}");
    let as_json = run(&[&["plan"], &behind[..], &["--iterations", "30", "--json"]].concat());
    let answer = json(&as_json.out);
    assert_eq!((as_json.code, &answer["solved"]), (Some(4), &false.into()));
    assert_eq!(answer["effort"]["iterations"], 30);
}

#[test]
fn a_wrong_command_line_is_code_2() {
    let wrong = |arguments: &[&str]| run(&[&["plan"][..], arguments].concat()).failed(2);
    for (arguments, reason) in [
        (&["--robot", "reach", "--to", "1"][..], "--to: "),
        (&["--robot", "nobody", "--to", "1,2"], "no robot is called"),
        (&["--robot", "hitch", "--to", "6.75,7,-1.57", "--planner", "rrt-connect"], "which no car can drive"),
        (&["--robot", "reach", "--to", "3.1,0", "--planner", "hybrid-a-star"], "for a car only"),
        (&["--robot", "hitch", "--from", "6.5,2.5,0", "--to", "6.75,7,-1.57,-1.57"], "has a trailer's heading"),
        (&["--robot", "rusty", "--to", "4.5,2", "--tube", "2"], "--tube 2"),
        (&["--robot", "choset", "--from", "2,0", "--to", "2.1,0", "--script", "x.ron"], "lives in no world"),
    ] {
        let error = wrong(arguments);
        assert!(error.contains(reason) && error.lines().count() >= 2, "{error}");
    }
}

/// Every planner finds its way, or says why it is none for this robot; each path is as long as the straight line at
/// least, and none is much shorter than the visibility graph's.
#[test]
fn every_planner_is_there_by_its_name() {
    let from_to = ["--robot", "rusty", "--from", "1.5,5.75", "--to", "9.75,6.25"];
    let of_any = ["rrt-connect", "rrt", "rrt-star", "informed-rrt-star", "prm", "a-star", "dijkstra"];
    let names =
        [&of_any[..], &["visibility-graph", "tangent-graph", "bug1", "bug1-sensor", "bug2", "cell-decomposition"]]
            .concat();
    let straight = motion_lab::num::hypot(9.75 - 1.5, 0.5);
    let length = |name: &str| {
        let found = json(&run(&[&["plan", "--planner", name], &from_to[..], &["--json"]].concat()).done());
        assert_eq!(found["planner"], name);
        assert!(found["clearance"].as_f64().unwrap() > 0.0, "{found}");
        found["length"].as_f64().unwrap()
    };
    let lengths: Vec<f64> = names.iter().map(|name| length(name)).collect();
    let shortest = lengths[7];
    for (name, length) in names.iter().zip(&lengths) {
        assert!(*length > straight && *length >= 0.97 * shortest, "{name}: {length}, {shortest}");
    }
    // the rooms are joined by doors, so a field that only pulls straight on ends in a minimum
    let field = run(&[&["plan", "--planner", "potential-field"], &from_to[..]].concat());
    assert!(field.code == Some(4) && field.err.contains("local minimum"), "{} {}", field.out, field.err);
    // the arm is no disc
    let arm = run(&["plan", "--planner", "bug1", "--robot", "reach", "--from", "2,0", "--to", "3.1,0"]);
    assert!(arm.code == Some(4) && arm.err.contains("discs"), "{} {}", arm.out, arm.err);
    // and no car drives a straight line of the chart
    let car = run(&["plan", "--planner", "rrt", "--robot", "hitch", "--to", "6.75,7,-1.57"]);
    assert!(car.code == Some(2) && car.err.contains("hybrid-a-star"), "{}", car.err);
}

#[test]
fn planners_are_compared_in_a_table_and_in_rows() {
    let folder = tempfile::tempdir().unwrap();
    let more = ["--compare", "rrt-connect", "--seeds", "3..8", "--csv", "rows.csv"];
    let table = run_in(folder.path(), &[&ROUND_THE_POST[..], &more].concat()).done();
    assert!(table.contains("rrt-connect") && table.contains("5 of 5"), "{table}");
    let rows = fs::read_to_string(folder.path().join("rows.csv")).unwrap();
    let lines: Vec<&str> = rows.lines().collect();
    assert_eq!(lines.len(), 6);
    let counts = "iterations,samples,edges,free";
    let path = "length_rad,clearance_m,clearance_asked_m,reason,failure_kind,robot,world,start,goal";
    assert_eq!(lines[0], format!("planner,seed,solved,time_s,{counts},{path}"));
    for (line, seed) in lines[1..].iter().zip(3..8) {
        assert!(line.ends_with(",reach,Workbench,\"2,0\",\"3.1,0\""), "{line}");
        assert!(line.starts_with(&format!("rrt-connect,{seed},true,")), "{line}");
        // the same path as that of `plan` at this seed
        let single = run(&[&ROUND_THE_POST[..], &["--seed", &seed.to_string(), "--json"]].concat()).done();
        let (single, cells) = (json(&single), line.split(',').collect::<Vec<_>>());
        assert_eq!(cells[8].parse::<f64>().unwrap(), single["length"].as_f64().unwrap());
        assert_eq!(cells[6].parse::<u64>().unwrap(), single["effort"]["edges"].as_u64().unwrap());
    }
    // one that is named twice is asked once
    let more = ["--compare", "rrt,rrt", "--seeds", "3..5", "--json"];
    let table = json(&run_in(folder.path(), &[&ROUND_THE_POST[..], &more].concat()).done());
    assert_eq!((table.as_array().unwrap().len(), &table[0]["attempts"]), (1, &2.into()));
    // an end in contact is an answer for programs too
    let more = ["plan", "--robot", "reach", "--from", "0.785,0.785", "--to", "3.1,0", "--compare", "rrt", "--json"];
    let none = run(&more);
    assert_eq!((none.code, &json(&none.out)["solved"]), (Some(4), &false.into()), "{}", none.out);
    // what is not alike is said, and what makes it so
    let kept = |more: &[&str]| {
        let compare = ["--compare", "rrt,a-star", "--seeds", "0..1", "--csv", "kept.csv"];
        let table = run_in(folder.path(), &[&ROUND_THE_POST[..], &compare, more].concat()).done();
        let rows = fs::read_to_string(folder.path().join("kept.csv")).unwrap();
        let kept: Vec<String> = rows.lines().map(|row| row.split(',').nth(10).unwrap().to_owned()).collect();
        (table, kept)
    };
    let (table, column) = kept(&[]);
    assert!(table.contains("the same from obstacles: 0 m by a-star; 0.001 m by rrt; --clearance is one"), "{table}");
    assert_eq!(column, ["clearance_asked_m", "0.001", "0"]);
    let (table, column) = kept(&["--clearance", "0.002"]);
    assert!(
        table.ends_with("all were asked to keep 0.002 m from obstacles\n") && !table.contains("not all"),
        "{table}"
    );
    assert_eq!(column, ["clearance_asked_m", "0.002", "0.002"]);
    // a planner of discs has no path for an arm, and the others go on
    let more = ["--compare", "bug2,prm,rrt", "--seeds", "1..3"];
    let table = run_in(folder.path(), &[&ROUND_THE_POST[..], &more].concat()).done();
    let line = |planner: &str| table.lines().find(|line| line.starts_with(planner)).unwrap().to_owned();
    assert!(line("bug2").contains("0 of 2") && line("prm").contains("2 of 2"), "{table}");
    assert!(line("rrt ").contains("2 of 2"), "{table}");
    let shut = folder.path().join("shut.ron");
    fs::write(&shut, SHUT).unwrap();
    let none = ["plan", "--world", shut.to_str().unwrap(), "--robot", "R", "--to", "3,1", "--iterations", "20"];
    let none = run(&[&none[..], &["--compare", "rrt-connect", "--seeds", "0..2"]].concat());
    assert!(none.code == Some(4) && none.out.contains("0 of 2"), "{} {}", none.out, none.err);
}

#[test]
fn rrt_star_shortens_its_path_as_long_as_it_is_let() {
    let by = |planner: &str, more: &[&str]| {
        let arguments =
            ["plan", "--json", "--planner", planner, "--robot", "Rusty", "--from", "3,5.5", "--to", "9.75,6.25"];
        let answer = json(&run(&[&arguments[..], more].concat()).done());
        (answer["length"].as_f64().unwrap(), answer["effort"]["iterations"].as_u64().unwrap())
    };
    let length = |more: &[&str]| by("rrt-star", more);
    let (first, few, many) = (length(&[]), length(&["--iterations", "1500"]), length(&["--iterations", "4000"]));
    assert!(first.1 < 1500 && few.1 == 1500 && many.1 == 4000, "{first:?} {few:?} {many:?}");
    assert!(first.0 > few.0 && few.0 > many.0, "{first:?} {few:?} {many:?}");
    // never shorter than the straight line: sqrt(6.75^2 + 0.75^2)
    assert!(many.0 > 6.791, "{many:?}");
    // one that is informed draws where a shorter path may lead, and no other samples
    let informed = by("informed-rrt-star", &["--iterations", "1500"]);
    assert!(informed.0 < few.0 && informed.0 > 6.791 && informed.1 == 1500, "{informed:?} {few:?}");
}

#[test]
fn a_rover_that_is_there_has_no_way_to_go() {
    for planner in ["rrt", "rrt-connect", "rrt-star", "a-star", "visibility-graph", "tangent-graph", "bug2"] {
        let answer = json(
            &run(&["plan", "--json", "--planner", planner, "--robot", "Rusty", "--from", "3,5.5", "--to", "3,5.5"])
                .done(),
        );
        assert_eq!((&answer["solved"], answer["length"].as_f64()), (&true.into(), Some(0.0)), "{planner}: {answer}");
        assert_eq!(answer["legs"], 0, "{planner}: {answer}");
    }
}
