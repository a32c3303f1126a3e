//! `diff`: two logs that are equal, differ in one bit, are of different runs, or are not whole.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::run::{Log, Recorded};

use crate::cli::{json, run, sealed};

fn recording(folder: &Path, name: &str, more: &[&str]) -> PathBuf {
    let file = folder.join(name);
    run(&[&["record", "--ticks", "30", "-o", file.to_str().unwrap()], more].concat()).done();
    file
}

/// The log in `file`, changed in memory and written by the crate's own writer, so that its seals are right.
fn changed(file: &Path, change: impl FnOnce(&mut Log)) -> PathBuf {
    let mut log = Log::read_mcap(&fs::read(file).unwrap()).unwrap().log;
    change(&mut log);
    let changed = file.with_extension("changed.mcap");
    fs::write(&changed, sealed(&log)).unwrap();
    changed
}

fn diff(more: &[&str], a: &Path, b: &Path) -> crate::cli::Run {
    run(&[&["diff", a.to_str().unwrap(), b.to_str().unwrap()], more].concat())
}

#[test]
fn equal_logs_are_0() {
    let folder = tempfile::tempdir().unwrap();
    let a = recording(folder.path(), "a.mcap", &[]);
    let b = recording(folder.path(), "b.mcap", &[]);
    assert_eq!(diff(&[], &a, &b).done(), "30 ticks, equal to the last bit\n");
    let report = json(&diff(&["--json"], &a, &b).done());
    assert_eq!((&report["equal"], &report["ticks"], &report["differing_ticks"]), (&true.into(), &30.into(), &0.into()));
    assert!(report["divergence"].is_null() && report["setup"].as_array().unwrap().is_empty());
}

#[test]
fn one_planted_ulp_is_found_in_its_tick_and_field() {
    let folder = tempfile::tempdir().unwrap();
    let a = recording(folder.path(), "a.mcap", &[]);
    let mut values = (0.0, 0.0);
    let b = changed(&a, |log| {
        let range = &mut log.frames_mut()[11].scans[0].ranges_mut()[77];
        values = (*range, range.next_up());
        *range = values.1;
    });
    let found = diff(&[], &a, &b);
    assert_eq!(found.code, Some(4), "{}", found.err);
    let (x, y) = values;
    let expected = format!(
        "tick 12, robot 0 (Rusty), ranges[77]: {x:?} ({:#018x}) in A, {y:?} ({:#018x}) in B, 1 ulp apart\n\
         1 of 30 ticks differ\n",
        x.to_bits(),
        y.to_bits()
    );
    assert_eq!(found.out, expected);
    let output = diff(&["--json"], &b, &a);
    assert_eq!(output.code, Some(4));
    let report = json(&output.out);
    let value = &report["divergence"];
    assert_eq!((&value["tick"], &value["robot"], &value["name"]), (&12.into(), &0.into(), &"Rusty".into()));
    assert_eq!((&value["field"], &value["ulps"]), (&"ranges[77]".into(), &1.into()));
    assert_eq!(value["a"].as_f64().unwrap().to_bits(), y.to_bits(), "A is the first of the two");
    assert_eq!(value["b_bits"], format!("{:#018x}", x.to_bits()));
    assert_eq!((&report["equal"], &report["differing_ticks"]), (&false.into(), &1.into()));
}

/// A car with two sensors of its own, and a rover with the run's and one of its own.
const SENSORS: &str = "World(version: 1, name: \"room\", bounds: (min: (-5, -5), max: (5, 5)),
    walls: [(name: \"wall\", points: [(-5, -5), (5, -5), (5, 5), (-5, 5)], closed: true)], robots: [
    (name: \"rover\", kind: \"rusty\", start: [-2, 0, 1], sensors: [(name: \"aft\", rays: 3, range: 9)]),
    (name: \"car\", kind: \"hitch\", start: [1, 0.5, 0], sensors: [
        (name: \"left\", rays: 3, range: 9), (name: \"ahead\", rays: 2, range: 9)])])";

#[test]
fn of_several_scans_the_one_that_differs_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let world = folder.path().join("room.ron");
    fs::write(&world, SENSORS).unwrap();
    let a = recording(folder.path(), "a.mcap", &["--world", world.to_str().unwrap(), "--rays", "4"]);
    let planted = |scan: usize| changed(&a, |log| log.frames_mut()[4].scans[scan].ranges_mut()[1] += 0.5);
    for (scan, number, sensor, words) in [
        (0, 1, "", "robot 0 (rover), the run's sensor, ranges[1]: "),
        (1, 2, "aft", "robot 0 (rover), sensor \"aft\", ranges[1]: "),
        (2, 1, "ahead", "robot 1 (car), sensor \"ahead\", ranges[1]: "),
        (3, 2, "left", "robot 1 (car), sensor \"left\", ranges[1]: "),
    ] {
        let b = planted(scan);
        let found = diff(&[], &a, &b);
        assert!(found.code == Some(4) && found.out.starts_with(&format!("tick 5, {words}")), "{}", found.out);
        let report = json(&diff(&["--json"], &a, &b).out);
        let value = &report["divergence"];
        assert_eq!(
            (&value["scan"], &value["sensor"], &value["field"]),
            (&number.into(), &sensor.into(), &"ranges[1]".into())
        );
        // the commands that simulate the run again say the same
        for command in ["verify", "replay"] {
            let output = run(&[command, b.to_str().unwrap()]);
            assert_eq!(output.code, Some(4));
            assert!(output.out.contains(&format!("tick 5, {words}expected ")), "{command}: {}", output.out);
        }
    }
    // where the value is in no scan nothing is said of one
    let report = json(&diff(&["--json"], &a, &changed(&a, |log| log.frames_mut()[4].robots[0].contacts += 1)).out);
    assert!(report["divergence"].get("scan").is_none() && report["divergence"].get("sensor").is_none(), "{report}");
}

#[test]
fn the_initial_state_is_compared_too() {
    let folder = tempfile::tempdir().unwrap();
    let a = recording(folder.path(), "a.mcap", &[]);
    let b = changed(&a, |log| {
        let Recorded::Frames { initial, .. } = &mut log.recorded else { panic!("no frames") };
        initial.robots[2].contacts += 1;
    });
    let found = diff(&[], &a, &b);
    assert_eq!(found.code, Some(4));
    let expected = "tick 0, robot 2 (Hitch), contacts: 0 (0x0000000000000000) in A, 1 (0x0000000000000001) in B\n";
    assert!(found.out.starts_with(expected), "{}", found.out);
}

#[test]
fn what_determines_a_run_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("drive.ron");
    fs::write(&script, "Script(version: 1, events: [(tick: 40, robot: \"Rusty\", input: Drive(9, 0))])").unwrap();
    let a = recording(folder.path(), "a.mcap", &["--world", "lot"]);
    for (more, line) in [
        (&["--world", "lot", "--seed", "7"][..], "seed: 2005 in A, 7 in B"),
        (&["--world", "lot", "--rays", "12"], "sensor: 360 rays, 4.0 m in A, 12 rays, 4.0 m in B"),
        (&["--world", "workbench"], "world 0, line 3: name: \"Lot\", in A, name: \"Workbench\", in B"),
        (&["--world", "lot", "--world", "apartment"], "worlds: 1 in A, 2 in B"),
        (
            &["--world", "lot", "--world", "apartment", "--script", script.to_str().unwrap()],
            "script, line 4: ], in A, (tick: 40, robot: \"Rusty\", input: Drive(9, 0)), in B",
        ),
    ] {
        let b = recording(folder.path(), "b.mcap", more);
        let found = diff(&[], &a, &b);
        assert_eq!(found.code, Some(4), "{}", found.err);
        assert!(found.out.lines().any(|l| l == line), "{line} is missing from\n{}", found.out);
    }
    let shorter = folder.path().join("b.mcap");
    run(&["record", "--ticks", "20", "--world", "lot", "-o", shorter.to_str().unwrap()]).done();
    let found = diff(&[], &a, &shorter);
    assert_eq!(found.code, Some(4));
    assert!(found.out.starts_with("ticks: 30 in A, 20 in B\ntick 21, frames.len: "), "{}", found.out);
    assert!(found.out.ends_with("0 of 20 ticks differ\n"), "{}", found.out);
}

#[test]
fn a_cut_log_equal_as_far_as_it_is_sealed_is_5() {
    let folder = tempfile::tempdir().unwrap();
    let a = recording(folder.path(), "a.mcap", &[]);
    let bytes = fs::read(&a).unwrap();
    let cut = folder.path().join("cut.mcap");
    fs::write(&cut, &bytes[..bytes.len() * 2 / 3]).unwrap();
    let found = diff(&["--json"], &cut, &a);
    assert_eq!(found.code, Some(5), "{}", found.err);
    assert!(found.err.contains("cut.mcap: the log is cut off after byte "), "{}", found.err);
    let report = json(&found.out);
    assert!(report["equal"] == true && (1..30).contains(&report["ticks"].as_u64().unwrap()), "{report}");
    // a difference in sealed ticks is reported first
    let b = changed(&a, |log| log.frames_mut()[0].robots[0].flash += 1);
    assert_eq!(diff(&[], &cut, &b).code, Some(4));
    // the second file is missing
    let error = diff(&[], &a, &folder.path().join("nowhere.mcap")).failed(3);
    assert!(error.contains("nowhere.mcap: there is no such file"), "{error}");
}
