//! `plan --barrier`: proofs that there is no path, checked by a program that shares nothing with the lab; and what is
//! answered with them.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::collision::Scene;
use motion_lab::geometry::Footprint;
use motion_lab::prelude::*;
use serde_json::{Value, json as value};

use super::certificates::peer;
use crate::cli::{Run, SHUT, json, run_in};

/// An arm between two posts, each hard by its first link.
const POSTS: &str = r#"World(version: 1, name: "posts", bounds: (min: (-3, -3), max: (3, 3)), obstacles: [
    (name: "up", shape: Disc(center: (0, 0.5), radius: 0.1)),
    (name: "down", shape: Disc(center: (0, -0.5), radius: 0.1)),
    (name: "far", shape: Disc(center: (2.8, 2.8), radius: 0.1))])"#;

/// A court with walls of every shape, and a passage of this width in metres.
fn court(passage: f64) -> String {
    format!(
        r#"World(version: 1, name: "court", bounds: (min: (-3, -2), max: (5, 4)), obstacles: [
        (name: "west", shape: Box(min: (-1.5, -1), max: (-1, 3))),
        (name: "south", shape: Rounded(points: [(-1.25, -1), (2.5, -1.25)], radius: 0.3)),
        (name: "east", shape: Polygon([(2.25, -1.5), (3, -1.25), (2.75, 3), (2, 2.75)])),
        (name: "north", shape: Box(min: (-1.5, 2.75), max: ({}, 3.25))),
        (name: "north east", shape: Box(min: (1, 2.75), max: (3, 3.25)))])"#,
        1.0 - passage
    )
}

/// A yard with a wall across it, which has a gap of this width in metres.
fn yard(gap: f64) -> String {
    format!(
        r#"World(version: 1, name: "yard", bounds: (min: (0, 0), max: (20, 8)), obstacles: [
        (name: "south", shape: Box(min: (9.5, 0), max: (10.5, {}))),
        (name: "north", shape: Box(min: (9.5, {}), max: (10.5, 8)))])"#,
        4.0 - 0.5 * gap,
        4.0 + 0.5 * gap
    )
}

fn plan(folder: &Path, world: &str, arguments: &[&str]) -> Run {
    fs::write(folder.join("world.ron"), world).unwrap();
    run_in(folder, &[&["plan", "--world", "world.ron"], arguments].concat())
}

const OUT_OF_THE_COURT: [&str; 6] = ["--robot", "rusty", "--from", "0.5,0.5", "--to", "-2,-1"];
const THROUGH_THE_YARD: [&str; 6] = ["--robot", "hitch", "--from", "3,4,0", "--to", "14,4,0"];
const PAST_THE_POSTS: [&str; 6] = ["--robot", "reach", "--from", "0,0", "--to", "3.1,0.2"];

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// The barrier that is written, after its exit code and its words.
fn barrier(folder: &Path, world: &str, arguments: &[&str]) -> Value {
    let said = plan(folder, world, &[arguments, &["--barrier", "proof.json"]].concat()).failed(7);
    let barrier = json(&fs::read_to_string(folder.join("proof.json")).unwrap());
    let count = barrier["cells"].as_array().unwrap().len();
    assert!(said.contains(&format!("wrote proof.json: {count} cells part the start from the goal")), "{said}");
    assert!(said.contains("no path: the goal can't be reached: ") && !said.contains("--barrier"), "{said}");
    assert_eq!((&barrier["version"], &barrier["kind"]), (&value!(1), &value!("barrier")));
    barrier
}

#[test]
fn a_barrier_says_robot_world_ends_and_what_blocks_each_cell() {
    let folder = tempfile::tempdir().unwrap();
    let found = barrier(folder.path(), &court(0.0), &OUT_OF_THE_COURT);
    assert_eq!(found["world"]["bounds"], value!([[-3.0, -2.0], [5.0, 4.0]]));
    assert_eq!((&found["start"], &found["goal"]), (&value!([0.5, 0.5]), &value!([-2.0, -1.0])));
    assert_eq!(found["axes"], value!([{"name": "x", "wraps": false}, {"name": "y", "wraps": false}]));
    // a rover is planned larger by the tube
    let radius = found["robot"]["radius"].as_f64().unwrap();
    let own = RUSTY.body_radius;
    assert!(found["robot"]["kind"] == "rusty" && (radius - own - 0.02).abs() < 1e-15 && found["tube"] == 0.02);
    let scene = Scene::of_world(&World::parse("court.ron", &court(0.0)).unwrap());
    for cell in found["cells"].as_array().unwrap() {
        let middle = numbers(&cell["middle"]);
        let touched = scene.touched(&Footprint::disc(Point2::new(middle[0], middle[1]), radius));
        let id = touched.iter().find(|id| value!(id.0) == cell["obstacle"]).unwrap_or_else(|| panic!("{cell}"));
        assert_eq!(cell["name"].as_str(), scene.obstacle_name(*id));
        assert!(cell["part"] == 0 && cell["depth"].as_f64() > cell["bound"].as_f64(), "{cell}");
    }
    // the picture says how many cells there are
    plan(
        folder.path(),
        &court(0.0),
        &[&OUT_OF_THE_COURT[..], &["--svg", "barrier.svg", "--barrier", "b.json"]].concat(),
    );
    let picture = fs::read_to_string(folder.path().join("barrier.svg")).unwrap();
    let count = found["cells"].as_array().unwrap().len();
    assert!(picture.contains(&format!("no path: {count} cells proven blocked part the two")), "no caption");
    // without the tube the rover is itself, and its proof another
    let plain = barrier(folder.path(), &court(0.0), &[&OUT_OF_THE_COURT[..], &["--tube", "0"]].concat());
    assert_eq!((plain["robot"]["radius"].as_f64(), &plain["tube"]), (Some(own), &value!(0.0)));
    // an arm's angles wrap, it has no tube, and what no cell names is left out
    let posts = barrier(folder.path(), POSTS, &PAST_THE_POSTS);
    assert_eq!(posts["axes"], value!([{"name": "th1", "wraps": true}, {"name": "th2", "wraps": true}]));
    assert_eq!((&posts["tube"], &posts["robot"]["lengths"]), (&value!(0.0), &value!([1.0, 1.0])));
    let named: Vec<&str> =
        posts["world"]["obstacles"].as_array().unwrap().iter().map(|o| o["name"].as_str().unwrap()).collect();
    assert_eq!(named, ["up", "down"]);
    // a clearance that is to be kept makes the obstacles larger
    let wide = barrier(folder.path(), POSTS, &[&PAST_THE_POSTS[..], &["--clearance", "0.05"]].concat());
    let radius = wide["world"]["obstacles"][0]["radius"].as_f64().unwrap();
    assert!((radius - 0.15).abs() < 1e-12 && wide["clearance"] == 0.05, "{radius}");
}

#[test]
fn barriers_are_accepted_by_a_peer_which_refuses_forgeries() {
    let folder = tempfile::tempdir().unwrap();
    let shut = ["--robot", "R", "--to", "3,1"];
    let tasks = [(SHUT, &shut[..]), (&court(0.0), &OUT_OF_THE_COURT), (POSTS, &PAST_THE_POSTS)];
    let mut files: Vec<PathBuf> = Vec::new();
    for (number, (world, arguments)) in tasks.into_iter().enumerate() {
        barrier(folder.path(), world, arguments);
        files.push(folder.path().join(format!("{number}.json")));
        fs::rename(folder.path().join("proof.json"), &files[number]).unwrap();
    }
    for (script, lines) in [("barrier.py", files.len()), ("tamper_barrier.py", 1)] {
        let Some(output) = peer(script, &files) else { continue };
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
        let ending = if lines == 1 { " of 3 barriers refused" } else { ": no path is proven by " };
        assert!(said.lines().count() == lines && said.lines().all(|line| line.contains(ending)), "{said}");
        let forged: usize = said.split(' ').next().and_then(|count| count.parse().ok()).unwrap_or(usize::MAX);
        assert!(forged >= 120, "{said}");
    }
}

#[test]
fn barriers_of_an_arm_of_three_links_and_of_a_car_without_its_trailer_are_accepted_by_a_peer() {
    let folder = tempfile::tempdir().unwrap();
    let towing = ["--robot", "hitch", "--from", "5,4,0,0", "--to", "14,4,0,0"];
    let arm = ["--robot", "reach3", "--from", "0,0.4,-0.2", "--to", "3.1,0.2,0.3"];
    let car = barrier(folder.path(), &yard(0.5), &towing);
    fs::rename(folder.path().join("proof.json"), folder.path().join("car.json")).unwrap();
    let axis = |name: &str, wraps: bool| value!({"name": name, "wraps": wraps});
    assert_eq!(car["axes"], value!([axis("x", false), axis("y", false), axis("theta", true)]));
    assert_eq!((&car["start"], &car["goal"]), (&value!([5.0, 4.0, 0.0]), &value!([14.0, 4.0, 0.0])));
    let body = &car["robot"]["body"];
    assert_eq!((&car["robot"]["trailer"], &body["length"], &body["width"]), (&Value::Null, &value!(3.9), &value!(1.7)));
    let thick = POSTS.replace("0.5), radius: 0.1", "0.3), radius: 0.15");
    let reach = barrier(folder.path(), &thick, &arm);
    assert_eq!(reach["axes"], value!([axis("th1", true), axis("th2", true), axis("th3", true)]));
    let files = ["car.json", "proof.json"].map(|name| folder.path().join(name)).to_vec();
    let Some(output) = peer("barrier.py", &files) else { return };
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.lines().count() == 2 && said.lines().all(|line| line.contains(": no path is proven by ")), "{said}");
}

#[test]
fn the_answer_is_a_path_none_or_undecided() {
    let folder = tempfile::tempdir().unwrap();
    let by_cells = ["--planner", "cell-decomposition", "--json"];
    // the rover with its tube is 0.26 m wide; the court's finest cells have sides of 0.0625 m and 0.046875 m
    for (passage, code, answer, solved) in
        [(0.6, 0, "path", true), (0.1, 7, "none", false), (0.27, 4, "undecided", false)]
    {
        let ended = plan(folder.path(), &court(passage), &[&OUT_OF_THE_COURT[..], &by_cells].concat());
        let said = json(&ended.out);
        assert_eq!((ended.code, &said["answer"]), (Some(code), &value!(answer)), "{passage}: {said}");
        assert_eq!(said["solved"], solved, "{passage}: {said}");
    }
    // the proof is about the robot that is planned for, and says so; cells prove it whoever answers the planner
    let reason = |more: &[&str]| {
        let ended = plan(folder.path(), &court(0.1), &[&OUT_OF_THE_COURT[..], &by_cells, more].concat());
        let said = json(&ended.out);
        assert_eq!((ended.code, said.get("proven")), (Some(7), None), "{said}");
        said["reason"].as_str().unwrap().split_once("world's bounds").unwrap().1.to_owned()
    };
    assert_eq!(reason(&[]), ", for the robot larger by 0.02 m (--tube)");
    assert_eq!(reason(&["--tube", "0"]), "");
    let both = ", for the robot larger by 0.01 m (--tube) and 0.05 m (--clearance)";
    assert_eq!(reason(&["--tube", "0.01", "--clearance", "0.05"]), both);
    assert_eq!(reason(&["--tube", "0", "--checker", "parry"]), "");
    let undecided = plan(folder.path(), &court(0.27), &[&OUT_OF_THE_COURT[..], &by_cells[..2]].concat()).failed(4);
    let words = "motion-lab: undecided: cells of 0.0625 by 0.046875 m are proven neither free nor blocked\n\
                 There may be one: try another --planner.\n";
    assert_eq!(undecided, words);
    // another planner that finds none has proven nothing, nor has one that did not begin
    let trees = [&OUT_OF_THE_COURT[..], &["--iterations", "50", "--json"]].concat();
    let ended = plan(folder.path(), &court(0.0), &trees);
    assert_eq!((ended.code, &json(&ended.out)["answer"]), (Some(4), &value!("undecided")));
    let in_a_wall = ["--robot", "rusty", "--from", "0.5,0.5", "--to", "-1.25,1", "--json"];
    let ended = plan(folder.path(), &court(0.0), &[&in_a_wall[..], &by_cells[..2]].concat());
    assert_eq!((ended.code, &json(&ended.out)["answer"]), (Some(4), &value!("undecided")));
}

#[test]
fn where_nothing_is_proven_no_barrier_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("proof.json"), "an older file").unwrap();
    let to_proof = [&OUT_OF_THE_COURT[..], &["--barrier", "proof.json"]].concat();
    for (passage, code, why) in [(0.6, 0, "there is a path"), (0.27, 4, "cells prove nothing")] {
        let ended = plan(at, &court(passage), &to_proof);
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        let said = format!("proof.json: no barrier was written, since {why}");
        assert!(ended.err.contains(&said), "{}", ended.err);
    }
    for (more, reason) in [
        (&["--planner", "rrt-connect"][..], "--barrier: rrt-connect proves no barrier"),
        (&["--checker", "parry"], "--barrier rests on proofs, and parry proves nothing"),
        (&["--compare", "cell-decomposition,rrt"], "cannot be used with"),
    ] {
        let error = plan(at, &court(0.0), &[&to_proof[..], more].concat()).failed(2);
        assert!(error.contains(reason) && error.lines().count() >= 2, "{error}");
    }
    // cells that join the ends give a car no path, and no barrier
    let ended = plan(at, &yard(3.0), &[&THROUGH_THE_YARD[..], &["--barrier", "proof.json"]].concat());
    assert_eq!(ended.code, Some(4), "{}", ended.err);
    assert!(ended.err.contains("cells proven free join the start to the goal"), "{}", ended.err);
    assert_eq!(fs::read_to_string(at.join("proof.json")).unwrap(), "an older file");
}

#[test]
fn what_to_move_is_the_least_that_lets_a_path_through() {
    let folder = tempfile::tempdir().unwrap();
    let ask = |world: &str, more: &[&str]| {
        plan(folder.path(), world, &[&["--robot", "R", "--to", "3,1", "--what-blocks"], more].concat())
    };
    assert!(ask(SHUT, &[]).failed(7).ends_with("what blocks: there is a path if you take away \"between\"\n"));
    // a second wall and a shut door behind the first: three things, and no two of them
    let third = SHUT.replace("(2, 4)])]", "(2, 4)]), (name: \"behind\", points: [(2.4, 0), (2.4, 4)])]");
    let world = third.replace(
        "robots:",
        "obstacles: [(name: \"low\", shape: Box(min: (2.6, 0), max: (2.7, 1.5))), (name: \"high\", shape: Box(min: (2.6, 2.5), max: (2.7, 4)))],
         doors: [(name: \"gate\", hinge: (2.65, 1.5), end: (2.65, 2.5), open: false)], robots:",
    );
    let said = ask(&world, &[]).failed(7);
    let end = "there is a path if you open \"gate\" and take away \"behind\", \"between\"; no fewer will do\n";
    assert!(said.ends_with(end), "{said}");
    let ended = ask(&world, &["--json"]);
    let blockers = &json(&ended.out)["blockers"];
    let names: Vec<_> =
        blockers["things"].as_array().unwrap().iter().map(|thing| (&thing["kind"], &thing["name"])).collect();
    let [door, wall] = [value!("door"), value!("wall")];
    let expected = [(&door, &value!("gate")), (&wall, &value!("behind")), (&wall, &value!("between"))];
    assert_eq!((ended.code, &names[..], &blockers["least"]), (Some(7), &expected[..], &value!(true)), "{blockers}");
    assert!(blockers["tried"].as_u64().unwrap() >= 4 && blockers.get("doors").is_none(), "{blockers}");
    // where there is a path nothing is said of it
    assert!(!ask(&SHUT.replace("(2, 4)]", "(2, 2)]"), &["--json"]).done().contains("blockers"));
    for (more, reason) in [
        (["--planner", "rrt-connect"], "--what-blocks: rrt-connect proves no barrier"),
        (["--checker", "parry"], "--what-blocks rests on proofs, and parry proves nothing"),
    ] {
        assert!(ask(SHUT, &more).failed(2).contains(reason));
    }
}
