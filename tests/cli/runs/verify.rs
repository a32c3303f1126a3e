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
