//! Ctrl-C: no command leaves a hidden file, and what was finished is kept.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::cli::{Run, command, ended, run_in};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Starts the program, and interrupts it `times` as soon as `begun` says so.
fn interrupted(at: &Path, line: &str, times: usize, mut begun: impl FnMut() -> bool) -> Run {
    let arguments: Vec<&str> = line.split(' ').collect();
    let mut program = command(&arguments);
    let child = program.current_dir(at).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begin = Instant::now();
    while !begun() {
        assert!(begin.elapsed() < Duration::from_secs(100), "{line} has not begun");
        std::thread::sleep(Duration::from_millis(5));
    }
    for _ in 0..times {
        // the second may come after its end
        let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).stderr(Stdio::null()).status().unwrap();
    }
    ended(child.wait_with_output().unwrap())
}

fn is_hidden(name: &str) -> bool {
    name.starts_with('.')
}

#[test]
fn a_command_that_is_ended_leaves_no_hidden_file() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run_in(at, &["record", "--ticks", "1200", "-o", "run.mcap"]).done();
    fs::write(at.join("old.gif"), "old").unwrap();
    for line in [
        "export run.mcap --every 1 -o film.gif",
        "export run.mcap --every 1 -o old.gif",
        "export run.mcap --format rerun -o viewer.mcap",
        "capture --widget dashboard --run run.mcap --every 1 -o film.gif",
    ] {
        let before = names(at);
        let ended = interrupted(at, line, 1, || names(at).iter().any(|name| is_hidden(name)));
        assert_eq!((ended.code, ended.err.as_str(), names(at)), (Some(130), "", before), "{line}");
    }
    assert_eq!(fs::read_to_string(at.join("old.gif")).unwrap(), "old");
}

#[test]
fn a_recording_that_is_ended_twice_is_kept_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let record = "record --world lot --seconds 100000 -o long.mcap";
    let size = || fs::read_dir(at).unwrap().map(|entry| entry.unwrap().metadata().unwrap().len()).sum::<u64>();
    let ended = interrupted(at, record, 2, || size() > 100_000);
    assert!([Some(75), Some(130)].contains(&ended.code), "{:?}: {}", ended.code, ended.err);
    assert_eq!(names(at), ["long.mcap.partial"]);
    let kept = run_in(at, &["script", "print", "long.mcap.partial"]);
    assert_eq!(kept.code, Some(5), "its script can be read: {}", kept.err);
}

#[test]
fn a_search_for_a_smaller_run_that_is_ended_keeps_the_best_so_far() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run_in(at, &["record", "--ticks", "30", "-o", "run.mcap"]).done();
    fs::write(at.join("check"), "#!/bin/sh\necho tried >> seen\nsleep 0.1\n").unwrap();
    fs::set_permissions(at.join("check"), fs::Permissions::from_mode(0o755)).unwrap();
    let seen = || fs::read_to_string(at.join("seen")).map_or(0, |text| text.lines().count());
    let ended = interrupted(at, "shrink run.mcap --exec ./check<{} --jobs 1", 1, || seen() > 4);
    assert_eq!(ended.code, Some(75), "{}", ended.err);
    assert!(ended.err.contains("less may show it too") && ended.out.contains("worlds"), "{}", ended.err);
    assert_eq!(names(at), ["check", "run.mcap", "run.shrunk.mcap", "seen"]);
    run_in(at, &["verify", "run.shrunk.mcap"]).done();
    let size = |name: &str| fs::metadata(at.join(name)).unwrap().len();
    assert!(size("run.shrunk.mcap") < size("run.mcap") && seen() < 20, "{} tries", seen());
}

#[test]
fn a_comparison_that_is_ended_keeps_the_attempts_that_it_finished() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let problem = "plan --robot reach --from 2.0,0 --to 3.1,0 --compare rrt-connect --seeds 0..1000000 --csv rows.csv";
    let begin = Instant::now();
    let ended = interrupted(at, problem, 1, || begin.elapsed() > Duration::from_secs(3));
    assert_eq!(ended.code, Some(75), "{}", ended.err);
    let rows = fs::read_to_string(at.join("rows.csv")).unwrap();
    let attempts = rows.lines().count() - 1;
    assert!(
        attempts > 0 && ended.err.contains(&format!("stopped after {attempts} of 1000000 attempts")),
        "{}",
        ended.err
    );
    assert!(ended.out.contains(&format!("{attempts} of {attempts}")), "{}", ended.out);
    assert_eq!(names(at), ["rows.csv"]);
}
