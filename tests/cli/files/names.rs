//! Names and seeds in files for other programs: none is lost, misread or shared.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::cli::{json, run_in};

/// A world whose robots have names that other programs could take for something else.
const NAMES: &str = r#"World(version: 1, name: "a/b", bounds: (min: (0, 0), max: (10, 10)),
    walls: [(name: "border", points: [(0, 0), (10, 0), (10, 10), (0, 10)], closed: true)],
    robots: [
        (name: "A", kind: "rusty", start: [1, 1, 0], sensors: [(name: "B", rays: 3, range: 4)]),
        (name: "A/B", kind: "rusty", start: [2, 2, 0]),
        (name: "A%2FB", kind: "rusty", start: [3, 3, 0]),
        (name: "=1+1", kind: "rusty", start: [4, 4, 0]),
        (name: "-1", kind: "rusty", start: [5, 5, 0]),
        (name: "x;y", kind: "rusty", start: [6, 6, 0]),
    ])"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("names.ron"), NAMES).unwrap();
    folder
}

/// The topics of a file for viewers, each with the number of its messages.
fn topics(path: &Path) -> Vec<(String, u64)> {
    let bytes = fs::read(path).unwrap();
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    let counts = &summary.stats.as_ref().unwrap().channel_message_counts;
    let topic = |(id, channel): (&u16, &std::sync::Arc<mcap::Channel<'_>>)| {
        (channel.topic.clone(), counts.get(id).copied().unwrap_or(0))
    };
    summary.channels.iter().map(topic).collect()
}

/// Before, the sensor "B" of the robot "A" and the run's sensor of the robot "A/B" were one topic.
#[test]
fn no_two_robots_or_sensors_share_a_topic() {
    let folder = folder();
    let at = folder.path();
    run_in(at, &["record", "--world", "names.ron", "--ticks", "4", "-o", "run.mcap"]).done();
    for format in ["foxglove", "rerun"] {
        run_in(at, &["export", "run.mcap", "--format", format, "-o", "viewer.mcap"]).done();
        let topics = topics(&at.join("viewer.mcap"));
        let scans: BTreeSet<&(String, u64)> =
            topics.iter().filter(|(name, _)| name.starts_with("/viewer/scan/")).collect();
        // each once a tick, tick 0 too
        let named =
            ["A", "A/B", "A%2FB", "A%252FB", "=1+1", "-1", "x;y"].map(|name| (format!("/viewer/scan/{name}"), 5));
        assert_eq!(scans, named.iter().collect(), "{format}");
        assert_eq!(scans.len(), 7);
    }
}

#[test]
fn a_name_that_begins_as_a_formula_is_text_in_every_table() {
    let folder = folder();
    let at = folder.path();
    run_in(at, &["record", "--world", "names.ron", "--ticks", "1", "-o", "run.mcap"]).done();
    let table = run_in(at, &["export", "run.mcap", "--format", "csv"]).done();
    let robots: Vec<&str> = table.lines().skip(1).take(6).map(|line| line.split(',').nth(3).unwrap()).collect();
    assert_eq!(robots, ["A", "A/B", "A%2FB", "'=1+1", "'-1", "\"x;y\""]);
    // in JSON a name is as it is
    let line = run_in(at, &["export", "run.mcap", "--format", "jsonl"]).done();
    assert_eq!(json(line.lines().next().unwrap())["robots"][3]["name"], "=1+1");
    // in the headings and the cells of a sweep, where numbers below zero stay numbers
    let study = r#"Sweep(version: 1, worlds: ["names.ron"], ticks: 1, robots: ["=1+1"],
        axes: [(vary: "=1+1.start.theta", over: Values([-0.5, 200]))])"#;
    fs::write(at.join("study.ron"), study).unwrap();
    run_in(at, &["sweep", "study.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    let listed = run_in(at, &["sweep", "study.ron", "--check"]).done();
    for table in [fs::read_to_string(at.join("all.csv")).unwrap(), listed] {
        let lines: Vec<&str> = table.lines().collect();
        assert!(lines[0].contains(",'=1+1.start.theta_rad,") && !lines[0].contains(",=1"), "{}", lines[0]);
        assert!(lines[1].contains(",-0.5,"), "{}", lines[1]);
    }
    // the part is read back as it was
    assert_eq!(run_in(at, &["sweep", "reproduce", "all.parquet", "--row", "0", "-o", "0.mcap"]).code, Some(0));
    let problem = ["plan", "--world", "names.ron", "--robot", "=1+1", "--to", "4.5,4", "--compare", "rrt"];
    let rows = run_in(at, &[&problem[..], &["--seeds", "0..1", "--csv", "-"]].concat()).out;
    assert!(rows.lines().nth(1).unwrap().ends_with(",'=1+1,a/b,\"4,4,0\",\"4.5,4,0\""), "{rows}");
}

/// 2^53 + 1 is the least whole number that is no double; 2^53 is one.
#[test]
fn a_seed_that_no_double_is_is_a_text_in_json_and_read_again() {
    let folder = folder();
    let at = folder.path();
    let plan = ["plan", "--robot", "reach", "--from", "2,0", "--to", "2.1,0", "--json", "-o", "path.json", "--seed"];
    let record = ["record", "--world", "lot", "--ticks", "1", "--json", "-o", "run.mcap", "--seed"];
    for (seed, written) in [
        ("9007199254740992", serde_json::json!(9_007_199_254_740_992_u64)),
        ("9007199254740993", "9007199254740993".into()),
        ("18446744073709551615", "18446744073709551615".into()),
    ] {
        let of = |arguments: &[&str]| json(run_in(at, arguments).done().lines().next().unwrap())["seed"].clone();
        assert_eq!(of(&[&record[..], &[seed]].concat()), written);
        for command in ["info", "stats", "replay"] {
            assert_eq!(of(&[command, "--json", "run.mcap"]), written, "{command}");
        }
        assert_eq!(of(&[&plan[..], &[seed]].concat()), written);
        let path = fs::read_to_string(at.join("path.json")).unwrap();
        assert_eq!(json(&path)["seed"], written);
        // the window's reader takes it
        let read = motion_lab::plans::PathFile::read(&path).unwrap();
        assert_eq!(json(&read.to_json().unwrap())["seed"], written);
    }
    let exam = "Assignment(version: 1, world: \"lot\", robot: \"Hitch\", goal: (at: [9.5, 2.5, 0], within: [0.1, 0.1, 0.1]), \
                limits: (ticks: 2), seeds: [9007199254740993])";
    fs::write(at.join("exam.ron"), exam).unwrap();
    fs::write(at.join("wait.ron"), "Script(version: 1, events: [])").unwrap();
    let graded = run_in(at, &["grade", "--json", "exam.ron", "wait.ron"]).out;
    assert_eq!(json(&graded)["attempts"][0]["seed"], "9007199254740993");
}
