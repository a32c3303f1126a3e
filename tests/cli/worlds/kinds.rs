//! A kind of robot that the program does not know: what it does anyway, and what it says to do.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::prelude::Seed;

use crate::cli::{run, run_in};
use crate::lab::examples::custom_robot::{config, record};

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
fn grading_says_who_has_the_robot() {
    let (folder, _, _) = with_trains();
    let exam = |world: &str, robot: &str, goal: &str| {
        let zeros = goal.split(',').map(|_| "1").collect::<Vec<_>>().join(", ");
        let text = format!(
            "Assignment(version: 1, world: {world:?}, robot: {robot:?}, goal: (at: [{goal}], within: [{zeros}]),\n\
             limits: (ticks: 9), seeds: [1])"
        );
        fs::write(folder.path().join("exam.ron"), text).unwrap();
    };
    exam("lot.ron", "Train", "9, 1.9, 0, 0, 0");
    let message = run_in(folder.path(), &["grade", "exam.ron", "train.mcap"]).failed(3);
    says_what_to_do(&message);
    assert!(message.contains("exam.ron:1:1: start: ") && message.contains("\"Train\""), "{message}");
    // a submission with a train, where the lab's car is asked for
    exam("lot", "Hitch", "11, 2.5, 0");
    let graded = run_in(folder.path(), &["grade", "--json", "exam.ron", "train.mcap"]);
    assert_eq!(graded.code, Some(4), "{}", graded.err);
    let row = crate::cli::json(&graded.out);
    assert!(row["refused"].as_str().unwrap().contains("there is no kind \"x-train\""), "{row}");
    assert!(graded.err.contains("train.mcap: ") && graded.err.contains("`RobotPlugin`"), "{}", graded.err);
    // any other mistake has the advice it had
    exam("lot", "Train", "7, 2.5, 0");
    let message = run_in(folder.path(), &["grade", "exam.ron", "train.mcap"]).failed(3);
    assert!(message.contains("Correct it there") && !message.contains("RobotPlugin"), "{message}");
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
