//! Output files: whole, or as they were.

use std::fs;
use std::process::Command;

use super::{run, run_in};

const OLDER: &[u8] = b"an older file";

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
    // a pipe of our own: a fault here must not cost the machine its /dev/null
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let error = run(&["record", "--ticks", "5", "-o", pipe.to_str().unwrap()]).failed(1);
    assert!(error.contains("pipe: it can't be written") && error.contains("not a file"), "{error}");
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
}

/// The limit on file sizes makes a write fail in the middle, as a full disk does.
#[cfg(unix)]
#[test]
fn a_write_that_fails_half_way_leaves_the_older_file() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("run.mcap");
    fs::write(&output, OLDER).unwrap();
    let script = format!(
        "trap '' XFSZ; ulimit -f 64; exec {} record --ticks 1200 -o run.mcap",
        env!("CARGO_BIN_EXE_motion-lab")
    );
    let run = Command::new("sh").arg("-c").arg(script).current_dir(folder.path()).output().unwrap();
    let error = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(1), "{error}");
    assert!(error.contains("run.mcap: it can't be written"), "{error}");
    assert_eq!(fs::read(&output).unwrap(), OLDER);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file is left");
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
    let ended = super::command(&["world", "list"]).stdout(full).output().unwrap();
    assert_eq!(ended.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&ended.stderr).contains("standard output"));
}
