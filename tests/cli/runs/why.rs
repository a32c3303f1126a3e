//! `why`: until when contacts could have been avoided, and the way out as a log and a script.

use std::fs;
use std::path::Path;

use crate::cli::{json, run, run_in};

const SCRIPT: &str = r#"Script(version: 1, events: [
    (tick: 1, robot: "Rusty", input: Drive(128, 0)),
    (tick: 1, robot: "Hitch", input: Drive(128, 20)),
])"#;

/// A folder with a run of 100 ticks in which all three robots touch something.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("drive.ron"), SCRIPT).unwrap();
    run_in(folder.path(), &["record", "--script", "drive.ron", "--ticks", "100", "-o", "run.mcap"]).done();
    folder
}

fn contacts(folder: &Path, log: &str, robot: &str) -> u64 {
    let stats = json(&run_in(folder, &["stats", "--json", log]).done());
    let robots = stats["robots"].as_array().unwrap();
    robots.iter().find(|r| r["name"] == robot).unwrap()["contacts"].as_u64().unwrap()
}

#[test]
fn a_contact_has_two_last_chances_and_a_way_out_that_verifies() {
    let folder = folder();
    let at = folder.path();
    let said = run_in(at, &["why", "run.mcap", "--robot", "Hitch"]).done();
    let one = json(&run_in(at, &["why", "run.mcap", "--robot", "Hitch", "--contact", "1", "--json"]).done());
    let (tick, stop, last) =
        (&one["tick"], &one["stopping"]["last_chance"], one["going_on"]["last_chance"].as_u64().unwrap());
    assert_eq!(tick, stop, "a car stops within a tick");
    assert!(last < tick.as_u64().unwrap(), "{one}");
    assert!(said.starts_with(&format!("Hitch, contact 1: meets the east curb at tick {tick} ")), "{said}");
    assert!(said.contains(&format!("\n  by going on: until tick {last} (")) && said.lines().count() == 3, "{said}");

    let line = ["why", "run.mcap", "--robot", "Hitch", "--contact", "1", "-o", "saved.mcap", "--script", "saved.ron"];
    assert_eq!(run_in(at, &line).done(), said);
    assert_eq!((contacts(at, "run.mcap", "Hitch"), contacts(at, "saved.mcap", "Hitch")), (1, 0));
    let until = one["going_on"]["free_until"].as_u64().unwrap();
    let verified = run_in(at, &["verify", "saved.mcap"]).done();
    assert!(verified.starts_with(&format!("{until} of {until} ticks bit-identical")), "{verified}");
    // the script gives the same run, and all but the car have theirs
    let again = ["record", "--script", "saved.ron", "--ticks", &until.to_string(), "--json", "-o", "again.mcap"];
    run_in(at, &again).done();
    assert_eq!(fs::read(at.join("again.mcap")).unwrap(), fs::read(at.join("saved.mcap")).unwrap());
    let script = fs::read_to_string(at.join("saved.ron")).unwrap();
    assert!(script.contains(r#"(tick: 1, robot: "Rusty", input: Drive(128, 0))"#), "{script}");
    let [channel, turn] = [0, 1].map(|k| one["going_on"]["channels"][0][1][k].as_i64().unwrap());
    assert_eq!(channel, 128, "it keeps its speed");
    assert!(
        script.contains(&format!(r#"(tick: {last}, robot: "Hitch", input: Drive({channel}, {turn}))"#)),
        "{script}"
    );
}

#[test]
fn all_contacts_of_a_run_come_in_their_order_and_an_arm_goes_round() {
    let folder = folder();
    let said = run_in(folder.path(), &["why", "run.mcap", "--json"]).done();
    let all: Vec<serde_json::Value> = said.lines().map(json).collect();
    let ticks: Vec<u64> = all.iter().map(|one| one["tick"].as_u64().unwrap()).collect();
    assert!(ticks.is_sorted() && ticks.len() >= 3, "{said}");
    for robot in ["Rusty", "Reach", "Hitch"] {
        let own = all.iter().filter(|one| one["robot"] == robot).count() as u64;
        assert_eq!(own, contacts(folder.path(), "run.mcap", robot), "{robot}");
    }
    let arm = all.iter().find(|one| one["robot"] == "Reach").unwrap();
    assert_eq!((&arm["meets"], &arm["stopping"]["last_chance"]), (&"the post".into(), &arm["tick"]));
    assert!(arm["going_on"]["path_rad"].as_f64().unwrap() > 0.0, "{arm}");
}

#[test]
fn what_cannot_be_asked_is_refused_and_a_run_without_contacts_is_said() {
    let folder = folder();
    let at = folder.path();
    let refused = |line: &[&str], code: i32| run_in(at, &[&["why", "run.mcap"], line].concat()).failed(code);
    assert!(refused(&["--robot", "hitch"], 2).contains("Did you mean \"Hitch\"?"));
    assert!(refused(&["--robot", "Hitch", "--contact", "2"], 2).contains("It has Hitch 1."));
    assert!(refused(&["--turns", "200"], 2).contains("channel 200"));
    assert!(refused(&["--every", "0.12"], 2).contains("not a whole number of ticks"));
    assert!(refused(&["--switches", "3", "--every", "0.05"], 2).contains("branches from one tick: at most 1000000"));
    assert!(refused(&["-o", "way.mcap"], 2).contains("-o and --script are for one"));
    let too_late = ["--robot", "Hitch", "--speeds", "128", "--turns", "0", "--back", "0.5", "-o", "way.mcap"];
    let said = run_in(at, &[&["why", "run.mcap"], &too_late[..8]].concat()).done();
    assert!(
        said.contains("by going on: too late from tick 74 on, of 11 branches tried; --back looks farther back"),
        "{said}"
    );
    // where it can't go on it can stop, and that is written
    assert_eq!(run_in(at, &[&["why", "run.mcap"], &too_late[..]].concat()).done(), said);
    assert_eq!(contacts(at, "way.mcap", "Hitch"), 0);
    // an arm that begins in the block has no way out of it
    let touching =
        ["record", "--world", "workbench", "--place", "Reach=0,1.5708", "--ticks", "20", "-o", "touching.mcap"];
    run_in(at, &touching).done();
    let none = run_in(at, &["why", "touching.mcap", "-o", "none.mcap"]);
    assert!(none.code == Some(4) && none.err.contains("there is no way out") && !at.join("none.mcap").exists());
    assert!(none.out.contains("by stopping: too late from tick 1 on, of 1 branch tried; the run begins there"));
    let further = ["--robot", "Hitch", "--speeds", "128", "--turns=-1,0,-1", "--switches", "0", "--back", "30"];
    let said = run_in(at, &[&["why", "run.mcap"], &further[..]].concat()).done();
    assert!(said.contains("too late from tick 1 on, of 168 branches tried; the run begins there"), "{said}");
    let crossed = run_in(at, &["why", "run.mcap", "--robot", "Hitch", "--turns", "-64,64", "--switches", "0"]).done();
    assert!(crossed.contains("by going on: "), "a list may begin with a minus sign");
    assert!(run_in(at, &["why", "none.mcap"]).failed(3).contains("none.mcap"));
    let quiet = run_in(at, &["record", "--world", "lot", "--ticks", "20", "-o", "quiet.mcap"]);
    quiet.done();
    let none = run_in(at, &["why", "quiet.mcap"]);
    assert!(none.code == Some(0) && none.err.contains("no contact in 20 ticks"), "{}", none.err);
    let piped = run(&["why", "--help"]).done();
    assert!(piped.contains("exact over this set"));
}
