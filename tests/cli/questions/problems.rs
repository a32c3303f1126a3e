//! Problem files: listed, planned one by one, compared, and told to OMPL's tools.

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::Stdio;

use motion_lab::worlds::World;

use crate::cli::{command, json, run_in};

/// Two pairs in the Workbench, mazes, one of them closed, and a lot.
const PROBLEMS: &str = "Problems(
    version: 1,
    sets: [
        Paired(name: \"post\", world: \"workbench\", robot: \"Reach\", starts: [[2, 0], [2.4, 0]],
            goals: [[3.1, 0], [\"90deg\", 1]]),
        Generated(of: Maze(columns: 3, rows: 3), count: 2, seed: 4),
        Generated(name: \"shut\", of: Maze(columns: 3, rows: 3, closed: true), count: 1),
        Generated(of: Parking(trailer: true), count: 1),
        Crossed(name: \"rooms\", world: \"rooms.ron\", robot: \"rusty\", starts: [[1.5, 5.75]], goals: [[4, 2], [1.7, 5.75]]),
    ],
)";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("sub/all.ron"), PROBLEMS).unwrap();
    run_in(folder.path(), &["world", "show", "apartment", "-o", "sub/rooms.ron"]).done();
    folder
}

#[test]
fn a_files_problems_are_listed_with_what_is_known_of_them() {
    let folder = folder();
    let listed = run_in(folder.path(), &["problems", "sub/all.ron"]).done();
    let lines: Vec<&str> = listed.lines().collect();
    assert_eq!(lines.len(), 8, "{listed}");
    assert_eq!(lines[0], "1  post  Reach in Workbench, from 2,0 to 3.1,0");
    assert!(lines[2].starts_with("3  maze  Rusty in maze 1 of seed 4, from 0.5,0.5,"), "{listed}");
    assert!(lines[2].ends_with(": there is a path") && lines[4].ends_with(": there is no path"), "{listed}");
    assert_eq!(lines[6], "7  rooms  Rusty in Apartment, from 1.5,5.75,0 to 4,2,0");
    let told = run_in(folder.path(), &["problems", "sub/all.ron", "--json"]).done();
    let told: Vec<_> = told.lines().map(json).collect();
    assert_eq!((told.len(), &told[1]["goal"][1]), (8, &1.0.into()));
    assert_eq!(told[1]["goal"][0].as_f64().unwrap(), std::f64::consts::FRAC_PI_2);
    assert_eq!((&told[4]["known"], &told[4]["set"], &told[4]["problem"]), (&"none".into(), &"shut".into(), &5.into()));
    assert!(told[5].get("known").is_none() && told[5]["start"].as_array().unwrap().len() == 4);
    // numbers stay where only some are asked for
    let cars = run_in(folder.path(), &["problems", "sub/all.ron", "--robot", "hitch"]).done();
    assert!(cars.starts_with("6  parking  Hitch in parking 1 of seed 1, ") && cars.lines().count() == 1, "{cars}");
    let one = run_in(folder.path(), &["problems", "sub/all.ron", "--problem", "7"]).done();
    assert_eq!(one.trim_end(), lines[6]);
}

#[test]
fn a_list_of_millions_ends_where_nobody_reads_on() {
    let folder = tempfile::tempdir().unwrap();
    let many = "Problems(version: 1, sets: [Generated(of: Maze(columns: 2, rows: 2), count: 10000000)])";
    fs::write(folder.path().join("many.ron"), many).unwrap();
    let mut child =
        command(&["problems", "many.ron"]).current_dir(folder.path()).stdout(Stdio::piped()).spawn().unwrap();
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
    assert!(first.starts_with("1  maze  Rusty in maze 1 of seed 1"), "{first}");
    // the reader is gone
    let begun = std::time::Instant::now();
    while child.try_wait().unwrap().is_none() {
        assert!(begun.elapsed().as_secs() < 60, "it goes on for nobody");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
}

#[test]
fn the_world_of_a_problem_is_a_world_file_by_which_the_same_path_is_planned() {
    let folder = folder();
    let at = folder.path();
    for (number, robot) in [("4", "Rusty"), ("6", "Hitch"), ("1", "Reach"), ("7", "Rusty")] {
        let written = run_in(at, &["problems", "sub/all.ron", "--problem", number, "-o", "one.ron"]);
        assert_eq!(written.code, Some(0), "{}", written.err);
        assert!(written.err.contains(&format!("Plan it: motion-lab plan --world one.ron --robot {robot} --to ")));
        let world = World::parse("one.ron", &fs::read_to_string(at.join("one.ron")).unwrap()).unwrap();
        let line = json(&run_in(at, &["problems", "sub/all.ron", "--problem", number, "--json"]).done());
        let goal: Vec<f64> = line["goal"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        match world.place("goal") {
            Some(place) => assert_eq!([place.pose.x, place.pose.y, place.pose.theta], goal[..3]),
            None => assert_eq!(robot, "Reach", "an arm's goal is no place"),
        }
        let [resident] = &world.robots[..] else { panic!("{:?}", world.robots) };
        let start: Vec<f64> = line["start"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        assert_eq!((resident.name.as_str(), &resident.start), (robot, &start));
        let to = goal.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let by_file = run_in(at, &["plan", "--world", "one.ron", "--robot", robot, "--to", &to, "-o", "a.json"]);
        by_file.done();
        run_in(at, &["plan", "--problems", "sub/all.ron", "--problem", number, "-o", "b.json", "--svg", "b.svg"])
            .done();
        let [a, b] = ["a.json", "b.json"].map(|file| json(&fs::read_to_string(at.join(file)).unwrap()));
        assert_eq!((&a["legs"], &a["corners"]), (&b["legs"], &b["corners"]), "{number}");
        assert!(a["legs"].as_array().is_some_and(|legs| !legs.is_empty()), "{a}");
        assert!(fs::read_to_string(at.join("b.svg")).unwrap().contains(robot));
    }
    // what is known to have none has none
    let arguments = ["plan", "--problems", "sub/all.ron", "--problem", "5", "--planner", "cell-decomposition"];
    run_in(at, &arguments).failed(7);
}

fn compared(at: &Path, robot: &str, more: &[&str]) -> String {
    let arguments = ["plan", "--compare", "rrt-connect,prm", "--problems", "sub/all.ron", "--robot", robot];
    run_in(at, &[&arguments[..], more].concat()).done()
}

#[test]
fn planners_are_compared_by_a_files_problems_set_by_set() {
    let folder = folder();
    let at = folder.path();
    let table = compared(at, "rusty", &["--iterations", "3000", "--csv", "rows.csv"]);
    let counts: Vec<Vec<&str>> = table.lines().skip(1).take(6).map(|line| line.split("  ").collect()).collect();
    let counts: Vec<Vec<&str>> = counts
        .into_iter()
        .map(|line| line.into_iter().map(str::trim).filter(|cell| !cell.is_empty()).collect())
        .collect();
    let told: Vec<[&str; 3]> = counts.iter().map(|line| [line[0], line[1], line[2]]).collect();
    let of = |set, solved| [[set, "rrt-connect", solved], [set, "prm", solved]];
    assert_eq!(told, [of("maze", "2 of 2"), of("shut", "0 of 1"), of("rooms", "2 of 2")].concat());
    let rows = fs::read_to_string(at.join("rows.csv")).unwrap();
    assert!(rows.lines().next().unwrap().ends_with(",start,goal,problem,set,known,bucket,optimal_m"), "{rows}");
    let ends: Vec<&str> = rows.lines().skip(1).take(5).map(|line| line.rsplit_once('"').unwrap().1).collect();
    assert_eq!(ends, [",3,maze,path,,", ",4,maze,path,,", ",5,shut,none,,", ",7,rooms,,,", ",8,rooms,,,"]);
    let medians = json(&compared(at, "reach", &["--json", "--seeds", "0..3"]));
    // one of the two begins in the post, and one set needs no name
    assert_eq!((&medians[0]["solved"], &medians[0]["attempts"]), (&3.into(), &6.into()));
    assert!(medians[0].get("set").is_none(), "{medians}");
}

#[test]
fn logs_for_ompl_are_one_for_each_problem() {
    let folder = folder();
    let at = folder.path();
    compared(at, "Rusty", &["--iterations", "500", "--seeds", "2..4", "--ompl", "all.log"]);
    let mut names: Vec<String> =
        fs::read_dir(at).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["all.3.log", "all.4.log", "all.5.log", "all.7.log", "all.8.log", "sub"]);
    let log = fs::read_to_string(at.join("all.4.log")).unwrap();
    let lines: Vec<&str> = log.lines().collect();
    assert_eq!(lines[1..5], ["Experiment maze_4", "Running on unknown", "Starting at unknown", "<<<|"]);
    assert!(lines.contains(&"2 is the random seed") && lines.contains(&"2 runs per planner"), "{log}");
    let version = lines[0].strip_prefix("motion-lab version ").unwrap();
    assert_eq!(run_in(at, &["--version"]).done().trim(), format!("motion-lab {version}"));
    // a single problem's log is the file that is named, and goes to standard output too
    let plain = ["plan", "--compare", "rrt", "--robot", "reach", "--from", "2,0", "--to", "2,0.3", "--seeds", "0..1"];
    let to_output = run_in(at, &[&plain[..], &["--ompl", "-"]].concat()).done();
    assert!(to_output.starts_with("motion-lab version ") && to_output.ends_with("; \n.\n"), "{to_output}");
    let refused =
        run_in(at, &["plan", "--compare", "prm", "--problems", "sub/all.ron", "--robot", "rusty", "--ompl", "-"]);
    assert!(refused.failed(2).contains("standard output"));
}

#[test]
fn a_command_line_that_a_problem_file_does_not_fit_is_refused_in_words() {
    let folder = folder();
    let refused = |more: &[&str], code: i32| run_in(folder.path(), more).failed(code);
    let compare = ["plan", "--compare", "prm", "--problems", "sub/all.ron"];
    let said = refused(&compare, 2);
    assert!(said.contains("several kinds of robot: reach, rusty, hitch") && said.contains("--robot"), "{said}");
    let said = refused(&[&compare[..], &["--robot", "reach3"]].concat(), 2);
    assert!(
        said.contains("no problem is for \"reach3\"") && said.contains("Reach, Rusty, Hitch, reach, rusty, hitch"),
        "{said}"
    );
    let said = refused(&[&compare[..], &["--robot", "hitch"]].concat(), 2);
    assert!(said.contains("prm") && said.contains("hybrid-a-star"), "{said}");
    let said = refused(&[&compare[..], &["--world", "lot"]].concat(), 2);
    assert!(said.contains("a problem file names its worlds"), "{said}");
    let said = refused(&["plan", "--problems", "sub/all.ron", "--problem", "9"], 2);
    assert!(said.contains("no problem has the number 9"), "{said}");
    let said = refused(&["plan", "--problems", "sub/all.ron", "--problem", "2"], 4);
    assert!(said.contains("the start would overlap the post"), "{said}");
    let said = refused(&["plan", "--compare", "prm", "--to", "1,1"], 2);
    assert!(said.contains("--robot"), "{said}");
    let said = refused(&["problems", "sub/all.ron", "--problem", "0"], 2);
    assert!(said.contains("no problem has the number 0"), "{said}");
    fs::write(folder.path().join("sub/bad.ron"), PROBLEMS.replace("rooms.ron", "romms.ron")).unwrap();
    let said = refused(&["problems", "sub/bad.ron"], 3);
    assert!(said.contains("sub/bad.ron:9:39: romms.ron: no built-in world has this name"), "{said}");
    fs::write(folder.path().join("sub/bad.ron"), PROBLEMS.replace("count: 2", "count: 0")).unwrap();
    let said = refused(&["problems", "sub/bad.ron"], 3);
    assert!(said.contains("sub/bad.ron:6:9: sets[1] \"maze\": it has no problem"), "{said}");
}
