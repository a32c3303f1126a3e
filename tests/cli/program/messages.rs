//! What is said of a name, a number or a place that is nearly right.

use std::fs;

use crate::cli::{run, run_in};

#[test]
fn a_name_that_is_nearly_one_gets_the_one_that_was_meant() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run_in(at, &["record", "--world", "apartment", "--ticks", "2", "-o", "run.mcap"]).done();
    let script = |change: &str| {
        format!("Script(version: 2, events: [], changes: [(tick: 1, world: \"Apartment\", change: {change})])")
    };
    fs::write(at.join("door.ron"), script("Close(\"Door a\")")).unwrap();
    fs::write(at.join("thing.ron"), script("Remove(\"As bed\")")).unwrap();
    let study = |what: &str| format!("Sweep(version: 1, worlds: [\"eyes.ron\"], ticks: 1, {what})");
    let world = run(&["world", "show", "lot"]).done();
    let start = "start: [6.5, 2.5, 0.0]";
    assert!(world.contains(start), "{world}");
    let eyes = world.replace(start, &format!("{start}, sensors: [(name: \"ahead\", rays: 3, range: 4)]"));
    fs::write(at.join("eyes.ron"), eyes).unwrap();
    fs::write(at.join("sensor.ron"), study("axes: [(vary: \"Hitch.sensors.Ahed.rays\", over: Values([2]))]")).unwrap();
    fs::write(at.join("robot.ron"), study("robots: [\"hitch\"], axes: []")).unwrap();
    for (arguments, meant) in [
        (&["record", "--world", "Apartment"][..], "\"apartment\""),
        (&["record", "--world", "aparment"], "\"apartment\""),
        (&["world", "show", "LOT"], "\"lot\""),
        (&["query", "scan", "1,2", "--world", "workbnech"], "\"workbench\""),
        (&["record", "--robot", "Rusti"], "\"Rusty\""),
        (&["record", "--robot", "RUSTY"], "\"Rusty\""),
        (&["record", "--place", "rusty=1,2,0"], "\"Rusty\""),
        (&["query", "distance", "--robot", "raech", "1,2"], "\"reach\""),
        (&["plot", "run.mcap", "--what", "speed", "--robot", "rusty", "-o", "a.svg"], "\"Rusty\""),
        (&["script", "check", "door.ron", "--world", "apartment"], "\"door A\""),
        (&["script", "check", "thing.ron", "--world", "apartment"], "\"A's bed\""),
        (&["sweep", "sensor.ron", "--check"], "\"Hitch.sensors.ahead.rays\""),
        (&["sweep", "robot.ron", "--check"], "\"Hitch\""),
    ] {
        let ended = run_in(at, arguments);
        let said = format!("{}{}", ended.out, ended.err);
        let is_said = ["Did", "did"].iter().any(|did| said.contains(&format!("{did} you mean {meant}?")));
        assert!(is_said, "{arguments:?}: {said}");
    }
    for (planner, meant) in [("RRT", "rrt"), ("Rrt-Conect", "rrt-connect"), ("astar", "a-star")] {
        let error = run(&["plan", "--robot", "rusty", "--to", "4.5,2", "--planner", planner]).failed(2);
        assert!(error.contains(&format!("a similar value exists: '{meant}'")), "{planner}: {error}");
    }
    // a name that is none gets no other one
    let error = run(&["record", "--world", "cathedral"]).failed(3);
    assert!(!error.contains("Did you mean"), "{error}");
}

#[test]
fn a_missing_folder_a_minus_sign_and_a_count_of_one_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run_in(at, &["record", "--ticks", "2", "-o", "run.mcap"]).done();
    let error = run_in(at, &["export", "run.mcap", "-o", "nodir/x.csv"]).failed(1);
    assert!(error.contains("nodir/x.csv: it can't be written: there is no folder nodir\n"), "{error}");
    for (option, value, said) in [
        ("--seconds", "-5", "--seconds -5: not a whole number of ticks"),
        ("--ticks", "-1", "invalid value '-1' for '--ticks"),
        ("--seed", "-3", "invalid value '-3' for '--seed"),
        ("--range", "-1", "range"),
    ] {
        let error = run(&["record", option, value]).failed(2);
        assert!(error.contains(said) && !error.contains("unexpected argument"), "{option}: {error}");
    }
    let error = run(&["plan", "--robot", "Rusty", "--to", "4.5"]).failed(2);
    assert!(error.contains("--to: 1 number: a rusty has two: x, y; or three: x, y, theta"), "{error}");
    fs::write(at.join("study.ron"), "Sweep(version: 1, worlds: [\"lot\"], ticks: 1, axes: [])").unwrap();
    let ran = run_in(at, &["sweep", "study.ron", "-o", "parts"]).done();
    assert!(ran.starts_with("1 run, 1 of them made now"), "{ran}");
    assert!(run_in(at, &["sweep", "merge", "parts"]).done().starts_with("1 row, 0 failed"));
    assert!(run_in(at, &["sweep", "study.ron", "--check"]).err.contains("1 run, varying nothing"));
}
