//! A minute of driving by hand, recorded in one process and verified in another.

use std::path::Path;

use crate::cli::{json, run, run_in};

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

#[test]
fn refused_inputs_are_counted_and_the_first_one_explained() {
    let folder = tempfile::tempdir().unwrap();
    let counted = run_in(folder.path(), &["record", "--script", SCRIPT]);
    assert_eq!(counted.code, Some(0));
    let said = "5 inputs of the script were refused, the first at tick 230: robot \"Reach\" refused Teleport: it would touch \
                the block there";
    assert!(counted.err.contains(said), "{}", counted.err);
    let none = run_in(folder.path(), &["record", "--script", SCRIPT, "--ticks", "229"]);
    assert!(none.code == Some(0) && !none.err.contains("refused"), "{}", none.err);

    // what no arm takes is known before the run
    let strict = ["record", "--script", SCRIPT, "--strict", "-o", "driving.mcap"];
    let error = run_in(folder.path(), &strict).failed(3);
    assert!(
        error.contains("driving.ron:29: events[25]: tick 260: robot \"Reach\" is a reach and takes no Drive"),
        "{error}"
    );
    // what touches the block is known in the run
    let text =
        std::fs::read_to_string(SCRIPT).unwrap().replace("(tick: 260, robot: \"Reach\", input: Drive(10, 10)),", "");
    std::fs::write(folder.path().join("some.ron"), text).unwrap();
    let error = run_in(folder.path(), &["record", "--script", "some.ron", "--strict", "-o", "driving.mcap"]).failed(3);
    assert!(error.contains("tick 230: robot \"Reach\" refused Teleport: it would touch the block"), "{error}");
    let many = ["record", "--script", "some.ron", "--strict", "--seeds", "3..6", "--ticks", "230"];
    assert!(run_in(folder.path(), &many).failed(3).contains("seed 3, tick 230: "));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing was written");
    let early = ["record", "--script", "some.ron", "--strict", "--ticks", "229", "-o", "driving.mcap"];
    run_in(folder.path(), &early).done();

    let seeds = ["record", "--script", "some.ron", "--seeds", "3..6", "--ticks", "230"];
    let many = run_in(folder.path(), &seeds);
    assert_eq!((many.code, many.out.lines().count()), (Some(0), 3), "{}", many.err);
    assert!(
        many.err.contains("in 3 runs 3 inputs of the script were refused, the first at tick 230: "),
        "{}",
        many.err
    );
}

#[test]
fn paranoid_runs_each_tick_twice_and_then_records_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let plain = ["record", "--script", SCRIPT, "--ticks", "240", "--json"];
    let twice = run_in(folder.path(), &[&plain[..], &["--paranoid"]].concat());
    assert_eq!(twice.code, Some(0), "{}", twice.err);
    assert!(twice.err.contains("240 ticks, each run twice: the same to the last bit"), "{}", twice.err);
    assert_eq!(twice.out, run_in(folder.path(), &plain).done());
    run_in(folder.path(), &["record", "--paranoid", "--seeds", "1..3"]).failed(2);
}
