//! A kind of robot that the program does not know: what it does anyway, and what it says to do.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::prelude::Seed;

use super::{run, run_in};
use crate::examples::custom_robot::{config, record};

/// A folder with a log and a world file that name the kind `x-train`.
fn with_trains() -> (tempfile::TempDir, PathBuf, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let [log, world] = ["train.mcap", "lot.ron"].map(|name| folder.path().join(name));
    let mut file = fs::File::create(&log).unwrap();
    record(Seed(8)).unwrap().write_mcap(&mut file).unwrap();
    fs::write(&world, config().worlds[0].to_ron()).unwrap();
    (folder, log, world)
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Fails unless the message names the kind, and says what to do about it.
#[track_caller]
fn says_what_to_do(message: &str) {
    for part in
        ["\"x-train\"", "`RobotPlugin`", "the program that made it", "custom_robot.rs", "rusty, reach, reach3, hitch"]
    {
        assert!(message.contains(part), "{part}: {message}");
    }
    assert!(!message.contains("--robot") && !message.contains("panicked"), "{message}");
}

#[test]
fn what_needs_the_robot_says_who_has_it() {
    let (folder, log, world) = with_trains();
    for arguments in [
        &["verify", text(&log)][..],
        &["verify", "--json", text(&log)],
        &["replay", text(&log)],
        &["replay", text(&log), "-o", "again.mcap"],
        &["export", text(&log), "--format", "svg"],
        &["export", text(&log), "--format", "png", "-o", "run.png"],
        &["export", text(&log), "--format", "gif", "-o", "run.gif"],
        &["export", text(&log), "--format", "foxglove", "-o", "run.mcap"],
        &["capture", "--widget", "dashboard", "--log", text(&log), "-o", "lab.svg"],
        &["record", "--world", text(&world), "-o", "new.mcap"],
        &["record", "--world", text(&world), "--seeds", "1..3"],
    ] {
        let message = run_in(folder.path(), arguments).failed(3);
        says_what_to_do(&message);
        assert!(message.contains("\"Train\""), "the robot is named: {message}");
    }
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|f| f.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "no output is left behind: {left:?}");
}

#[test]
fn what_does_not_need_the_robot_is_done() {
    let (_folder, log, world) = with_trains();
    assert_eq!(run(&["export", text(&log), "--format", "csv"]).done().lines().count(), 1202);
    assert_eq!(run(&["export", text(&log), "--format", "jsonl"]).done().lines().count(), 1201);
    assert!(run(&["info", text(&log)]).done().contains("Train"));
    // the world is right, as far as it can be checked
    let checked = run(&["world", "check", text(&world)]);
    says_what_to_do(&checked.err);
    assert!(checked.err.contains("not checked") && checked.done().contains("robots: Train"));
    let built_in = run(&["world", "show", "lot"]).done();
    fs::write(&world, built_in).unwrap();
    let checked = run(&["world", "check", text(&world)]);
    assert!(checked.err.is_empty(), "{}", checked.err);
}
