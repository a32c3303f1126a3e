//! `replay`: a run to its end again, from its seed and script alone.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::run::Log;

use crate::cli::{json, run, run_in, sealed};

fn recording(folder: &Path) -> PathBuf {
    let file = folder.join("run.mcap");
    run(&["record", "--ticks", "30", "-o", file.to_str().unwrap()]).done();
    file
}

#[test]
fn a_replay_ends_where_the_recording_does_and_writes_the_same_log() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let recorded = run(&["record", "--ticks", "30"]).done();
    let replayed = run_in(folder.path(), &["replay", "run.mcap", "-o", "again.mcap"]);
    assert_eq!(replayed.err, "motion-lab: wrote again.mcap\n", "no progress bar where there is no terminal");
    assert_eq!(replayed.done(), format!("{recorded}30 of 30 ticks bit-identical\n"));
    assert_eq!(fs::read(folder.path().join("again.mcap")).unwrap(), fs::read(&file).unwrap(), "byte for byte");
    let report = json(&run(&["replay", "--json", file.to_str().unwrap()]).done());
    assert_eq!((&report["ticks"], &report["sealed"], &report["identical"]), (&30.into(), &30.into(), &30.into()));
    assert!(report["divergence"].is_null() && recorded.contains(report["digest"].as_str().unwrap()));
}

#[test]
fn a_cut_recording_is_replayed_to_its_end_and_it_is_5() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let bytes = fs::read(&file).unwrap();
    fs::write(&file, &bytes[..bytes.len() * 2 / 3]).unwrap();
    let replayed = run_in(folder.path(), &["replay", "run.mcap", "-o", "whole.mcap"]);
    assert_eq!(replayed.code, Some(5), "{}", replayed.err);
    assert!(replayed.err.contains("run.mcap: the log is cut off after byte "), "{}", replayed.err);
    let last = replayed.out.lines().last().unwrap();
    let words: Vec<&str> = last.split(' ').collect();
    assert!(words[0] == words[2] && last.ends_with("sealed ticks bit-identical; the run has 30"), "{last}");
    assert_eq!(fs::read(folder.path().join("whole.mcap")).unwrap(), bytes);
}

#[test]
fn a_forged_recording_is_4_and_diff_finds_it_in_the_replayed_log() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path());
    let mut log = Log::read_mcap(&fs::read(&file).unwrap()).unwrap().log;
    let theta = &mut log.frames_mut()[9].robots[2].configuration[2];
    *theta = theta.next_down();
    fs::write(&file, sealed(&log)).unwrap();
    let replayed = run_in(folder.path(), &["replay", "run.mcap", "-o", "true.mcap"]);
    assert_eq!(replayed.code, Some(4), "{}", replayed.err);
    assert!(replayed.out.contains("\ntick 10, robot 2, configuration[2]: expected "), "{}", replayed.out);
    assert!(replayed.out.ends_with("\n9 of 30 ticks bit-identical\n"), "{}", replayed.out);
    run_in(folder.path(), &["verify", "true.mcap"]).done();
    let output = run_in(folder.path(), &["diff", "run.mcap", "true.mcap"]);
    assert!(
        output.code == Some(4) && output.out.starts_with("tick 10, robot 2 (Hitch), configuration[2]: "),
        "{}",
        output.out
    );
}

#[test]
fn what_cannot_be_replayed_or_written_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    recording(folder.path());
    let error = run(&["replay", "nowhere.mcap"]).failed(3);
    assert!(error.contains("nowhere.mcap: there is no such file") && error.lines().count() >= 2, "{error}");
    let error = run_in(folder.path(), &["replay", "run.mcap", "-o", "nowhere/run.mcap"]).failed(1);
    assert!(error.contains("Make its folder first"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
