//! `verify` and `info`: whole, cut, changed and forged files.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::run::Log;

use crate::cli::{json, run, run_in, sealed};

fn recording(folder: &Path, ticks: &str) -> PathBuf {
    let file = folder.join("run.mcap");
    run(&["record", "--ticks", ticks, "-o", file.to_str().unwrap()]).done();
    file
}

#[test]
fn a_whole_recording_is_identical() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path(), "30");
    let verified = json(&run(&["verify", "--json", file.to_str().unwrap()]).done());
    assert_eq!((&verified["identical"], &verified["ticks"]), (&30.into(), &30.into()));
    assert!(verified["divergence"].is_null());
    let info = run(&["info", file.to_str().unwrap()]).done();
    for line in ["seed     2005", "ticks    30 of 30 (1.50 s)", "  Apartment", "script   0 events", "Rusty  x "] {
        assert!(info.contains(line), "{line} is missing from\n{info}");
    }
    assert!(info.contains(verified["digest"].as_str().unwrap()));
}

#[test]
fn a_cut_file_is_5_and_its_sealed_beginning_is_verified() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path(), "30");
    let bytes = fs::read(&file).unwrap();
    fs::write(&file, &bytes[..bytes.len() * 2 / 3]).unwrap();
    let verified = run(&["verify", "--json", file.to_str().unwrap()]);
    assert_eq!(verified.code, Some(5));
    assert!(verified.err.contains("run.mcap: the log is cut off after byte "), "{}", verified.err);
    let verdict = json(&verified.out);
    let sealed = verdict["sealed"].as_u64().unwrap();
    assert!((1..30).contains(&sealed) && verdict["identical"] == sealed && verdict["ticks"] == 30, "{verdict}");
    // resumed, the file is whole again
    let whole = folder.path().join("whole.mcap");
    run(&["record", "--resume", file.to_str().unwrap(), "-o", whole.to_str().unwrap()]).done();
    assert_eq!(fs::read(whole).unwrap(), bytes);
}

#[test]
fn a_file_that_is_no_log_is_3() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path(), "5");
    let bytes = fs::read(&file).unwrap();
    for (wrong, reason) in [
        (&b"hello"[..], "not a run log"),
        (&b""[..], "nothing can be recovered"),
        (&bytes[..100], "nothing can be recovered"),
    ] {
        fs::write(&file, wrong).unwrap();
        for command in ["verify", "info"] {
            let error = run(&[command, file.to_str().unwrap()]).failed(3);
            assert!(error.contains("run.mcap: ") && error.contains(reason), "{error}");
        }
    }
}

#[test]
fn a_forged_recording_is_4_and_the_first_difference_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = recording(folder.path(), "30");
    let log = Log::read_mcap(&fs::read(&file).unwrap()).unwrap().log;
    // the same file with one bit of one coordinate changed, and right seals
    let mut forged = log.clone();
    let x = &mut forged.frames_mut()[16].robots[1].configuration[0];
    *x = f64::from_bits(x.to_bits() ^ 1);
    fs::write(&file, sealed(&forged)).unwrap();
    let verified = run(&["verify", file.to_str().unwrap()]);
    assert_eq!(verified.code, Some(4), "{}", verified.err);
    let lines: Vec<&str> = verified.out.lines().collect();
    assert!(
        lines[0].starts_with("tick 17, robot 1, configuration[0]: expected ") && lines[0].ends_with("1 ulp apart"),
        "{}",
        lines[0]
    );
    assert_eq!(lines[1], "16 of 30 ticks bit-identical");
    // a forged file can't be resumed either
    let output = folder.path().join("out.mcap");
    run(&["record", "--resume", file.to_str().unwrap(), "-o", output.to_str().unwrap()]).failed(4);
    assert!(!output.exists());
}

/// A file that is no log is refused by its first bytes, even a file without an end.
#[cfg(unix)]
#[test]
fn a_file_without_an_end_is_not_read_to_it() {
    for command in ["info", "verify", "replay"] {
        let error = run(&[command, "/dev/zero"]).failed(3);
        assert!(error.contains("/dev/zero: ") && !error.contains("too large"), "{command}: {error}");
    }
}

/// A log may come through a pipe, which can be read only once.
#[cfg(unix)]
#[test]
fn a_log_through_a_pipe_is_read_whole() {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &["record", "--ticks", "20", "-o", "run.mcap"]).done();
    let pipe = folder.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let (from, to) = (folder.path().join("run.mcap"), pipe.clone());
    let writer = std::thread::spawn(move || std::fs::write(to, std::fs::read(from).unwrap()));
    assert!(run(&["verify", pipe.to_str().unwrap()]).done().starts_with("20 of 20 ticks"));
    writer.join().unwrap().unwrap();
}

/// Whoever changed a log is not told how to make it look whole.
#[test]
fn a_changed_log_is_not_to_be_resumed_and_a_cut_one_is() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run_in(at, &["record", "--ticks", "20", "-o", "run.mcap"]).done();
    let bytes = fs::read(at.join("run.mcap")).unwrap();
    let commands: [&[&str]; 4] = [
        &["verify", "other.mcap"],
        &["info", "other.mcap"],
        &["stats", "other.mcap"],
        &["diff", "other.mcap", "run.mcap"],
    ];
    // a length among them, which leads beyond the end of the file: wherever a byte was changed
    let mut changed = 0;
    for place in (bytes.len() / 2..bytes.len()).step_by(397) {
        let mut other = bytes.clone();
        other[place] ^= 0x80;
        fs::write(at.join("other.mcap"), other).unwrap();
        let verified = run_in(at, commands[0]);
        assert!(verified.code != Some(0) && !verified.err.contains("--resume"), "byte {place}: {}", verified.err);
        changed += u32::from(verified.err.contains("the log has been changed after byte"));
    }
    assert!(changed > 20, "{changed}");
    for command in commands {
        let said = run_in(at, command);
        assert!(said.err.contains("ask for the log as it was recorded"), "{command:?}: {}", said.err);
        assert!(!said.err.contains("--resume"), "{command:?}: {}", said.err);
    }
    fs::write(at.join("other.mcap"), &bytes[..bytes.len() * 2 / 3]).unwrap();
    for command in &commands[..3] {
        let said = run_in(at, command);
        assert!(said.err.contains("`motion-lab record --resume` makes it whole"), "{command:?}: {}", said.err);
    }
}

#[test]
fn another_file_of_the_lab_is_called_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let plan = ["plan", "--robot", "reach", "--from", "2.0,0", "--to", "2.0,0.3", "-o", "path.json"];
    run_in(at, &plan).done();
    let study = "Sweep(version: 1, worlds: [\"lot\"], ticks: 2, axes: [(vary: \"seed\", over: Range(0, 2))])";
    fs::write(at.join("study.ron"), study).unwrap();
    run_in(at, &["sweep", "study.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.parquet"]).done();
    run_in(at, &["world", "show", "lot", "-o", "lot.ron"]).done();
    fs::write(at.join("other.json"), "{\"legs\": 3}").unwrap();
    for (file, what, next) in [
        ("path.json", "this is a path, not a run log", "motion-lab plan --record"),
        ("all.parquet", "this is a table, not a run log", "motion-lab sweep verify all.parquet"),
        ("parts/part-1-of-1.sweep", "this is a part of a sweep", "motion-lab sweep verify parts/part-1-of-1.sweep"),
        ("lot.ron", "a world or a script is, not a run log", "motion-lab world check lot.ron"),
        ("other.json", "this is not a run log", "Name a file that `motion-lab record -o` wrote"),
    ] {
        for command in ["verify", "info", "replay"] {
            let refused = run_in(at, &[command, file]).failed(3);
            assert!(refused.contains(&format!("{file}: ")) && refused.contains(what), "{command}: {refused}");
            assert!(refused.contains(next), "{command}: {refused}");
        }
    }
}
