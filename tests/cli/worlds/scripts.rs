//! `script`: checked, printed and made from tables.

use std::fs;

use crate::cli::{json, run_in};

const DRIVE: &str = "Script(version: 1, events: [\n  (tick: 4, robot: \"Rusty\", input: Drive(128, -3)),\n\
                     (robot: \"Hitch\", tick: 9, input: Release)])";
const CANONICAL: &str = "Script(\n    version: 1,\n    events: [\n        (tick: 4, robot: \"Rusty\", input: Drive(128, -3)),\n\
                         \u{20}       (tick: 9, robot: \"Hitch\", input: Release),\n    ],\n)\n";

#[test]
fn scripts_are_checked_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("drive.ron"), DRIVE).unwrap();
    fs::write(folder.path().join("idle.ron"), "Script(version: 1, events: [])").unwrap();
    fs::write(folder.path().join("wrong.ron"), DRIVE.replace("-3", "-300")).unwrap();
    let checked = run_in(folder.path(), &["script", "check", "drive.ron", "idle.ron"]).done();
    assert_eq!(checked, "drive.ron: 2 events, ticks 4 to 9, robots: Rusty, Hitch\nidle.ron: no events\n");
    let wrong = run_in(folder.path(), &["script", "check", "wrong.ron", "nowhere.ron", "drive.ron", "--json"]);
    assert_eq!(wrong.code, Some(3));
    for reason in ["wrong.ron:2: events[0]: channel -300", "nowhere.ron: there is no such file"] {
        assert!(wrong.err.contains(reason), "{}", wrong.err);
    }
    let report = json(&wrong.out);
    assert_eq!((&report["source"], &report["events"], &report["last"]), (&"drive.ron".into(), &2.into(), &9.into()));
    // the robots of a world
    let worlds = ["script", "check", "drive.ron", "--world", "apartment", "--world", "lot"];
    run_in(folder.path(), &worlds).done();
    let error = run_in(folder.path(), &worlds[..5]).failed(3);
    assert!(
        error.contains("drive.ron:3: events[1]: there is no robot \"Hitch\"") && error.contains("are Rusty"),
        "{error}"
    );
}

#[test]
fn a_script_is_printed_from_a_file_and_from_a_log() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("drive.txt"), DRIVE).unwrap();
    assert_eq!(run_in(folder.path(), &["script", "print", "drive.txt"]).done(), CANONICAL);
    run_in(folder.path(), &["record", "--ticks", "12", "--script", "drive.txt", "-o", "run.mcap"]).done();
    assert_eq!(run_in(folder.path(), &["script", "print", "run.mcap"]).done(), CANONICAL);
    let bytes = fs::read(folder.path().join("run.mcap")).unwrap();
    fs::write(folder.path().join("run.mcap"), &bytes[..bytes.len() - 5]).unwrap();
    let cut = run_in(folder.path(), &["script", "print", "run.mcap"]);
    assert_eq!((cut.code, cut.out.as_str()), (Some(5), CANONICAL));
    fs::write(folder.path().join("drive.txt"), "Script(").unwrap();
    for wrong in ["drive.txt", "nowhere.ron", "."] {
        let error = run_in(folder.path(), &["script", "print", wrong]).failed(3);
        assert!(error.contains(wrong) && error.lines().count() >= 2, "{error}");
    }
}

#[test]
fn a_table_of_a_spreadsheet_is_converted_and_one_without_events_says_so() {
    let folder = tempfile::tempdir().unwrap();
    for table in [
        "tick,robot,input,values\r4,Rusty,Drive,128,-3\r9,Hitch,Release\r",
        "\u{feff}tick;robot;input;values\r\n4,0;Rusty;Drive;128,0;-3;\r\n9;Hitch;Release;;\r\n",
    ] {
        fs::write(folder.path().join("drive.csv"), table).unwrap();
        let output = run_in(folder.path(), &["script", "convert", "drive.csv"]);
        assert_eq!(output.err, "");
        assert_eq!(output.done(), CANONICAL);
    }
    for empty in ["", "tick,robot,input\r", "# 1,Rusty,Release\n;;;\n"] {
        fs::write(folder.path().join("drive.csv"), empty).unwrap();
        let output = run_in(folder.path(), &["script", "convert", "drive.csv"]);
        assert!(output.err.contains("drive.csv: no events: the script is empty"), "{}", output.err);
        output.done();
    }
}

#[test]
fn a_table_is_converted_and_drives_the_same_run() {
    let folder = tempfile::tempdir().unwrap();
    let table = "tick,robot,input,first,second\n4,Rusty,Drive,128,-3\n9,Hitch,Release,,\n";
    fs::write(folder.path().join("drive.csv"), table).unwrap();
    assert_eq!(run_in(folder.path(), &["script", "convert", "drive.csv"]).done(), CANONICAL);
    for command in [&["script", "check"][..], &["record", "--script"]] {
        let error = run_in(folder.path(), &[command, &["drive.csv"]].concat()).failed(3);
        assert!(error.contains("motion-lab script convert drive.csv"), "{error}");
    }
    run_in(folder.path(), &["script", "convert", "drive.csv", "-o", "drive.ron"]).done();
    assert_eq!(fs::read_to_string(folder.path().join("drive.ron")).unwrap(), CANONICAL);
    run_in(folder.path(), &["record", "--ticks", "12", "--script", "drive.ron"]).done();
    for (wrong, reason) in
        [("128,-3", "drive.csv:2:15: channel 129"), ("9,H", "drive.csv:3:1: tick 2 comes after tick 4")]
    {
        let changed = table.replace(wrong, if wrong == "9,H" { "2,H" } else { "129,-3" });
        fs::write(folder.path().join("drive.csv"), changed).unwrap();
        let error = run_in(folder.path(), &["script", "convert", "drive.csv", "-o", "other.ron"]).failed(3);
        assert!(error.contains(reason) && error.lines().count() >= 2, "{error}");
    }
    assert!(!folder.path().join("other.ron").exists());
    fs::write(folder.path().join("drive.csv"), table).unwrap();
    let error = run_in(folder.path(), &["script", "convert", "drive.csv", "-o", "nowhere/drive.ron"]).failed(1);
    assert!(error.contains("Make its folder first"), "{error}");
}

#[test]
fn an_input_that_a_robot_never_takes_is_refused_against_its_world_alone() {
    let folder = tempfile::tempdir().unwrap();
    for (robot, world, input, cell, reason) in [
        (
            "Rusty",
            "apartment",
            "MoveTo([0, 0, 0])",
            "MoveTo,0,0,0",
            "is a rusty and takes no MoveTo: it takes Drive, Teleport and Release",
        ),
        (
            "Rusty",
            "apartment",
            "SetTrailer(true)",
            "SetTrailer,on",
            "is a rusty and takes no SetTrailer: it takes Drive, Teleport and Release",
        ),
        (
            "Reach",
            "workbench",
            "Drive(1, 1)",
            "Drive,1,1",
            "is a reach and takes no Drive: it takes MoveTo, Teleport and Release",
        ),
        (
            "Hitch",
            "lot",
            "MoveTo([0, 0, 0])",
            "MoveTo,0,0,0",
            "is a hitch and takes no MoveTo: it takes Drive, Teleport, SetTrailer and Release",
        ),
        ("Hitch", "lot", "Teleport([0, 0])", "Teleport,0,0", "has 2 coordinates: a hitch has 3 or 4"),
    ] {
        let text = format!("Script(version: 1, events: [\n\n(tick: 4, robot: \"{robot}\", input: {input})])");
        fs::write(folder.path().join("s.ron"), text).unwrap();
        run_in(folder.path(), &["script", "check", "s.ron"]).done();
        let error = run_in(folder.path(), &["script", "check", "s.ron", "--world", world]).failed(3);
        assert!(
            error.contains("s.ron:3: events[0]: tick 4: ") && error.contains(robot) && error.contains(reason),
            "{error}"
        );
        // the same from a table
        fs::write(folder.path().join("s.csv"), format!("tick,robot,input\n4,{robot},{cell}\n")).unwrap();
        run_in(folder.path(), &["script", "convert", "s.csv"]).done();
        let error = run_in(folder.path(), &["script", "convert", "s.csv", "--world", world]).failed(3);
        assert!(error.contains("s.csv:2:") && error.contains(reason), "{error}");
    }
}
