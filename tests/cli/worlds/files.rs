//! Output files are written whole, or stay as they were.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::cli::{run, run_in};

const OLDER: &[u8] = b"an older file";

/// A recording of days of simulated time, returned once its file has grown. It does not end before a signal.
pub fn long_recording(folder: &Path, output: &str) -> Child {
    let mut child = crate::cli::command(&["record", "--ticks", "4000000", "--no-sensor", "-o", output])
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let size = || fs::read_dir(folder).unwrap().filter_map(|e| Some(e.ok()?.metadata().ok()?.len())).sum::<u64>();
    for _ in 0..600 {
        if size() > 100_000 {
            return child;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    panic!("nothing was recorded in half a minute");
}

#[test]
fn an_output_that_cannot_be_is_1_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    fs::create_dir(path("folder")).unwrap();
    for (output, reason) in [("missing/run.mcap", "Make its folder first"), ("folder", "director")] {
        let error = run(&["record", "--ticks", "5", "-o", &path(output)]).failed(1);
        assert!(error.contains(&path(output)) && error.contains(reason), "{error}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "the folder alone");
    assert_eq!(fs::read_dir(path("folder")).unwrap().count(), 0);
}

#[cfg(unix)]
#[test]
fn a_device_or_a_pipe_is_not_replaced_by_a_file() {
    use std::os::unix::fs::FileTypeExt;
    // a pipe of our own, so that a fault here does not cost the machine its /dev/null
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let error = run(&["record", "--ticks", "5", "-o", pipe.to_str().unwrap()]).failed(1);
    assert!(error.contains("pipe: it can't be written") && error.contains("not a file"), "{error}");
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
}

/// Records a minute with a file size limit of 32 kB, so that a write fails in the middle, as on a full disk.
#[cfg(unix)]
fn recorded_on_a_full_disk(folder: &Path) -> String {
    let script = format!(
        "trap '' XFSZ; ulimit -f 64; exec {} record --ticks 1200 --no-sensor -o run.mcap",
        env!("CARGO_BIN_EXE_motion-lab")
    );
    let run = Command::new("sh").arg("-c").arg(script).current_dir(folder).output().unwrap();
    let error = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(1), "{error}");
    assert!(error.contains("run.mcap: it can't be written"), "{error}");
    error
}

#[cfg(unix)]
#[test]
fn a_full_disk_keeps_what_it_took_and_the_older_file() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("run.mcap");
    let error = recorded_on_a_full_disk(folder.path());
    assert!(!error.contains("older file"), "there was none: {error}");
    assert!(error.contains("go on with: motion-lab record --resume run.mcap.partial"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file is left");
    // 32 kB hold more than a second of ticks without scans; resumed from there, the run gives the same bytes
    let info = run_in(folder.path(), &["info", "--json", "run.mcap.partial"]);
    assert_eq!(info.code, Some(5));
    let recorded: u64 = serde_json::from_str::<serde_json::Value>(&info.out).unwrap()["recorded"].as_u64().unwrap();
    assert!(recorded > 20, "{recorded}");
    run_in(folder.path(), &["record", "--resume", "run.mcap.partial"]).done();
    run_in(folder.path(), &["record", "--ticks", "1200", "--no-sensor", "-o", "whole.mcap"]).done();
    assert!(fs::read(&output).unwrap() == fs::read(folder.path().join("whole.mcap")).unwrap());

    fs::remove_file(folder.path().join("whole.mcap")).unwrap();
    // a kept part is not replaced by a shorter one when the disk is full sooner
    run_in(folder.path(), &["record", "--ticks", "1200", "--no-sensor", "-o", "b.mcap", "--stop-after", "600"])
        .failed(75);
    let before = fs::read(folder.path().join("b.mcap.partial")).unwrap();
    let script =
        format!("trap '' XFSZ; ulimit -f 64; exec {} record --resume b.mcap.partial", env!("CARGO_BIN_EXE_motion-lab"));
    let run = Command::new("sh").arg("-c").arg(script).current_dir(folder.path()).output().unwrap();
    assert_eq!(run.status.code(), Some(1), "{}", String::from_utf8_lossy(&run.stderr));
    assert_eq!(fs::read(folder.path().join("b.mcap.partial")).unwrap(), before);
    fs::remove_file(folder.path().join("b.mcap.partial")).unwrap();

    fs::write(&output, OLDER).unwrap();
    let error = recorded_on_a_full_disk(folder.path());
    assert!(error.contains("The older file of that name is as it was."), "{error}");
    assert_eq!(fs::read(&output).unwrap(), OLDER);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "the older file and what was kept");
}

/// Root may write to a read-only folder. Run as root, the test uses /proc instead.
#[cfg(unix)]
#[test]
fn a_folder_that_is_read_only_is_named_and_no_temporary_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
    let output = if fs::write(folder.path().join("x"), b"").is_ok() {
        // a file system that takes no new files
        "/proc/run.mcap".to_owned()
    } else {
        folder.path().join("run.mcap").to_str().unwrap().to_owned()
    };
    let error = run(&["record", "--ticks", "5", "-o", &output]).failed(1);
    assert!(error.contains(&format!("{output}: it can't be written: ")), "{error}");
    assert!(!error.contains(".partial") && !error.contains("older file"), "{error}");
}

/// Recordings stopped at a tick whose last bytes the file system does not take.
#[cfg(unix)]
#[test]
fn stopping_at_a_full_disk_keeps_what_it_took() {
    let folder = tempfile::tempdir().unwrap();
    let stop = |tick: u32| {
        let script = format!(
            "trap '' XFSZ; ulimit -f 64; exec {} record --ticks 1200 --no-sensor -o run.mcap --stop-after {tick}",
            env!("CARGO_BIN_EXE_motion-lab")
        );
        Command::new("sh").arg("-c").arg(script).current_dir(folder.path()).output().unwrap().status.code()
    };
    let mut full = 0;
    for tick in 20..160 {
        let code = stop(tick);
        assert!(code == Some(75) || code == Some(1), "{tick}: {code:?}");
        full += u32::from(code == Some(1));
        assert!(folder.path().join("run.mcap.partial").exists(), "{tick}: {code:?}");
        fs::remove_file(folder.path().join("run.mcap.partial")).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
    assert!(full > 10, "{full} met the end of the disk");
}

#[cfg(unix)]
#[test]
fn a_recording_that_can_not_be_named_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let child = long_recording(folder.path(), "run.mcap");
    fs::create_dir(folder.path().join("run.mcap.partial")).unwrap();
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let ended = child.wait_with_output().unwrap();
    let error = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(1), "{error}");
    let (_, left) = error.lines().find_map(|line| line.split_once("what was written is in ")).unwrap();
    let info = run_in(folder.path(), &["info", "--json", left]);
    assert_eq!(info.code, Some(5), "{left}: {}", info.err);
}

#[cfg(unix)]
#[test]
fn what_a_killed_recording_left_is_named_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = long_recording(folder.path(), "long.mcap");
    // while the process runs, its file is not reported as left over
    let beside = ["record", "--ticks", "5", "-o", "short.mcap"];
    let output = run_in(folder.path(), &beside);
    assert!(!output.err.contains("killed"), "{}", output.err);
    child.kill().unwrap();
    child.wait().unwrap();
    let output = run_in(folder.path(), &beside);
    let line =
        output.err.lines().find(|line| line.contains("was left by a process that was killed")).unwrap().to_owned();
    let (_, left) = line.split_once("go on with: motion-lab record --resume ").unwrap();
    assert!(left.contains(".long.mcap."), "{line}");
    // whole seconds are written to the file; the kill may cut the write under way, between any two of its pages
    let info = run_in(folder.path(), &["info", "--json", left]);
    let recorded = serde_json::from_str::<serde_json::Value>(&info.out).unwrap()["recorded"].as_u64().unwrap();
    assert!(recorded > 0, "{recorded}");
    // a file that may be newer is not replaced, and neither is one that a process is writing
    fs::write(folder.path().join("long.mcap"), OLDER).unwrap();
    let refused = run_in(folder.path(), &["record", "--resume", left]).failed(2);
    assert!(refused.contains("long.mcap: there is a file of this name"), "{refused}");
    fs::remove_file(folder.path().join("long.mcap")).unwrap();
    let writing = fs::File::open(folder.path().join(left)).unwrap();
    writing.lock().unwrap();
    let refused = run_in(folder.path(), &["record", "--resume", left]).failed(3);
    assert!(refused.contains("another process is writing it"), "{refused}");
    drop(writing);
    // two more ticks show that it goes on under its final name
    let stop = (recorded + 2).to_string();
    let stopped = run_in(folder.path(), &["record", "--resume", left, "--stop-after", &stop]).failed(75);
    assert!(
        stopped.contains("go on with: motion-lab record --resume ") && stopped.contains("long.mcap.partial"),
        "{stopped}"
    );
    assert!(folder.path().join("long.mcap.partial").exists());
}

#[test]
fn an_older_file_is_replaced_at_once_and_keeps_its_permissions() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("run.mcap");
    fs::write(&output, OLDER).unwrap();
    #[cfg(unix)]
    fs::set_permissions(&output, std::os::unix::fs::PermissionsExt::from_mode(0o640)).unwrap();
    run_in(folder.path(), &["record", "--ticks", "5", "-o", "run.mcap"]).done();
    run(&["verify", output.to_str().unwrap()]).done();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        assert_eq!(fs::metadata(&output).unwrap().permissions().mode() & 0o777, 0o640);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_1() {
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let ended = crate::cli::command(&["world", "list"]).stdout(full).output().unwrap();
    assert_eq!(ended.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&ended.stderr).contains("standard output"));
}
