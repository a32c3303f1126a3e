//! A minute of driving by hand, recorded in one process and verified in another.

use std::path::Path;

use super::{json, run, run_in};

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scripts/driving.ron");

#[test]
fn a_minute_of_manual_driving_verifies_in_another_process() {
    let folder = tempfile::tempdir().unwrap();
    let recorded = json(&run_in(folder.path(), &["record", "--script", SCRIPT, "--json", "-o", "driving.mcap"]).done());
    let file = folder.path().join("driving.mcap");
    let verified = run(&["verify", file.to_str().unwrap()]).done();
    assert_eq!(
        verified,
        format!("1200 of 1200 ticks bit-identical\ndigest {}\n", recorded["digest"].as_str().unwrap())
    );

    // the run does what the script says
    let robot = |name: &str| recorded["robots"].as_array().unwrap().iter().find(|r| r["name"] == name).unwrap().clone();
    for (name, refused) in [("Rusty", 1), ("Reach", 2), ("Hitch", 2)] {
        assert!(robot(name)["contacts"].as_u64().unwrap() >= 1, "{name} hits something");
        assert_eq!(robot(name)["refusals"], refused, "{name}");
    }
    assert_eq!(robot("Hitch")["configuration"].as_array().unwrap().len(), 4, "the trailer is on at the end");
    let info = json(&run(&["info", "--json", file.to_str().unwrap()]).done());
    assert_eq!(info["digest"], recorded["digest"]);
    assert_eq!(info["robots"], recorded["robots"]);
    assert!(info["script_events"].as_u64().unwrap() > 40);
}

#[test]
fn the_script_makes_the_difference() {
    let digest = |arguments: &[&str]| {
        json(&run(&[&["record", "--json", "--ticks", "100"], arguments].concat()).done())["digest"].clone()
    };
    assert_ne!(digest(&[]), digest(&["--script", SCRIPT]));
    assert_eq!(digest(&["--script", SCRIPT]), digest(&["--script", SCRIPT]));
    assert!(Path::new(SCRIPT).is_file());
}
