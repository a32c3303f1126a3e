//! The program with a planner of one's own: `examples/own_program.rs`, by running it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::cli::sweep::planner::rows as table_rows;
use crate::cli::{Run, ended, json, run};

/// The example, which `cargo test` builds with the tests.
fn program() -> PathBuf {
    let tests = std::env::current_exe().unwrap();
    let name = format!("own_program{}", std::env::consts::EXE_SUFFIX);
    let program = tests.parent().and_then(Path::parent).unwrap().join("examples").join(name);
    assert!(program.is_file(), "it is not there: cargo build --example own_program");
    program
}

fn own(folder: &Path, arguments: &[&str]) -> Run {
    ended(Command::new(program()).args(arguments).current_dir(folder).env_remove("COLUMNS").output().unwrap())
}

const POST: [&str; 6] = ["--robot", "reach", "--from", "2.0,0", "--to", "2.2,1.9"];

#[test]
fn a_planner_of_ones_own_plans_draws_and_is_listed_as_the_labs_are() {
    let folder = tempfile::tempdir().unwrap();
    let plan = [&["plan", "--planner", "detour", "-o", "path.json", "--gif", "grown.gif"], &POST[..]].concat();
    let said = own(folder.path(), &plan).done();
    assert!(said.contains("detour"), "{said}");
    // over one sample: start, it, and the goal
    let path = json(&fs::read_to_string(folder.path().join("path.json")).unwrap());
    let legs = path["legs"].as_array().unwrap();
    assert_eq!((path["planner"].as_str(), legs.len()), (Some("detour"), 2), "{path}");
    assert_eq!((&legs[0]["from"], &legs[1]["to"]), (&path["start"], &path["goal"]));
    assert!(legs.iter().all(|leg| !leg["steps"].as_array().unwrap().is_empty()), "both are proven: {path}");
    assert!(path["clearance"].as_f64().unwrap() > 0.001, "it draws samples, and keeps the usual margin: {path}");
    let film = fs::read(folder.path().join("grown.gif")).unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(film.as_slice()).unwrap();
    let mut pictures = 0;
    while decoder.read_next_frame().unwrap().is_some() {
        pictures += 1;
    }
    let iterations = path["effort"]["iterations"].as_u64().unwrap();
    assert_eq!(pictures, iterations.min(72), "a picture for each iteration");
    // whoever plays it needs no planner
    own(folder.path(), &[&plan[..], &["--record", "played.mcap"]].concat()).done();
    let log = folder.path().join("played.mcap");
    run(&["verify", log.to_str().unwrap()]).done();
    // it is in the help and in what a shell completes, in nobody else's
    for (arguments, has) in [(["plan", "--help"], "- detour"), (["completions", "bash"], "detour")] {
        assert!(own(folder.path(), &arguments).done().contains(has), "{arguments:?}");
        assert!(!run(&arguments).done().contains("detour"), "{arguments:?}");
    }
    let refused = run(&plan).failed(2);
    assert!(refused.contains("'detour'") && refused.contains("hybrid-a-star"), "{refused}");
    let refused = own(folder.path(), &["plan", "--planner", "detuor", "--robot", "reach", "--to", "3.1,0"]).failed(2);
    assert!(refused.contains("'detour'"), "{refused}");
    let refused = own(folder.path(), &["plan", "--planner", "detour", "--robot", "hitch", "--to", "6,6,0"]).failed(2);
    assert!(refused.contains("detour: it is not made for this robot"), "{refused}");
}

#[test]
fn a_planner_of_ones_own_is_compared_and_swept() {
    let folder = tempfile::tempdir().unwrap();
    let tables = ["--seeds", "0..3", "--csv", "rows.csv", "--costs", "costs.csv"];
    let compare = [&["plan", "--compare", "detour,rrt-connect"], &POST[..], &tables].concat();
    let table = own(folder.path(), &compare).done();
    assert_eq!(table.lines().filter(|line| line.contains("3 of 3")).count(), 2, "{table}");
    let rows = fs::read_to_string(folder.path().join("rows.csv")).unwrap();
    let planners: Vec<&str> = rows.lines().skip(1).map(|row| row.split(',').next().unwrap()).collect();
    assert_eq!(planners, ["detour", "detour", "detour", "rrt-connect", "rrt-connect", "rrt-connect"]);
    let costs = fs::read_to_string(folder.path().join("costs.csv")).unwrap();
    assert_eq!(costs.lines().next(), Some("planner,seed,iterations,length_rad"));
    assert_eq!(costs.lines().count(), 7, "one path each: {costs}");
    let parquet = [&compare[..9], &["--seeds", "0..2", "--csv", "rows.parquet"]].concat();
    own(folder.path(), &parquet).done();
    assert!(fs::read(folder.path().join("rows.parquet")).unwrap().starts_with(b"PAR1"));
    let study = r#"Sweep(version: 1, worlds: ["workbench"], ticks: 600, planner: (name: "detour"),
        goal: (robot: "Reach", at: [2.2, 1.9], within: [0.001, 0.001]),
        axes: [
            (vary: "planner", over: Names(["detour", "rrt-connect"])),
            (vary: "seed", over: Range(0, 2)),
            (vary: "Reach.start", over: Starts([[2, 0]])),
        ])"#;
    fs::write(folder.path().join("study.ron"), study).unwrap();
    own(folder.path(), &["sweep", "study.ron", "-o", "parts"]).done();
    own(folder.path(), &["sweep", "merge", "parts", "-o", "all.csv"]).done();
    let swept = fs::read_to_string(folder.path().join("all.csv")).unwrap();
    let swept = table_rows(&swept);
    assert_eq!(swept.len(), 4);
    let alike = |n: usize, m: usize| {
        // a row of the sweep is the attempt of the comparison
        let compared: Vec<&str> = rows.lines().nth(1 + n).unwrap().split(',').collect();
        let row = &swept[m];
        assert_eq!((row("planner"), row("seed"), row("solved")), (compared[0].into(), compared[1].into(), "1".into()));
        assert_eq!((row("iterations"), row("planned_path_rad")), (compared[4].into(), compared[8].into()));
    };
    alike(0, 0);
    alike(1, 1);
    alike(3, 2);
    alike(4, 3);
    // nobody else's program knows it
    let study = folder.path().join("study.ron");
    let refused = run(&["sweep", study.to_str().unwrap(), "-o", "/nowhere/parts"]).failed(3);
    assert!(refused.contains("study.ron:1:") && refused.contains("there is no planner \"detour\""), "{refused}");
}
