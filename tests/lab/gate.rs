//! The scripts of the gate fail when a program that they run fails.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Command, Output};

/// Writes a shell program into this folder.
fn program(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    fs::write(&path, format!("#!/bin/sh\n{text}\n")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
}

/// Runs `benches/instructions` with this valgrind, which never starts the program to count.
fn counted(valgrind: &str) -> Output {
    let folder = tempfile::tempdir().unwrap();
    program(folder.path(), "valgrind", valgrind);
    program(folder.path(), "count", "exit 0");
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    Command::new(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/instructions"))
        .env("PATH", path)
        .env("MOTION_LAB_COUNT", folder.path().join("count"))
        .output()
        .unwrap()
}

/// A valgrind that reports, for every kernel, `share` percent of the recorded number of instructions. After its options
/// come the program, the kernel and the times: `$3`, `$4`, `$5`.
fn valgrind(share: u32) -> String {
    let kept = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/instructions.txt");
    format!(
        "kept=$(sed -n \"s/^$4 //p\" {kept}); echo \"==1== Collected : $((1000000 + $5 * kept * {share} / 100))\" >&2"
    )
}

#[test]
fn counts_within_the_margin_pass_and_beyond_it_fail() {
    let said = |o: &Output| String::from_utf8_lossy(&o.stderr).into_owned();
    for share in [50, 100, 102] {
        let output = counted(&valgrind(share));
        assert!(output.status.success(), "{share} %: {}", said(&output));
        let lines = String::from_utf8_lossy(&output.stdout).into_owned();
        let kernels = lines.lines().filter(|line| line.contains(" instructions, kept ")).count();
        // four of 36 need AVX2
        let right = if lines.contains("not counted here: scans with AVX2") { 32 } else { 36 };
        assert_eq!(kernels, right, "a line for each kernel: {lines}");
    }
    let worse = counted(&valgrind(103));
    assert!(worse.status.code() == Some(1) && said(&worse).contains("edge takes over 2 % more"), "{}", said(&worse));
}

#[test]
fn a_count_that_fails_fails_the_counts() {
    for (valgrind, reason) in [
        ("echo 'cannot run' >&2; exit 1", "cannot run"),
        ("exit 0", "valgrind counted nothing"),
        ("echo '==1== Collected : 5' >&2", "no more instructions"),
        ("[ $4 = tick ] && exit 1; echo \"==1== Collected : $5\" >&2", "failed at tick"),
    ] {
        let output = counted(valgrind);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(1) && said.contains(reason), "{reason}: {:?} {said}", output.status);
    }
}

/// Runs `tests/all/determinism` with a cargo that builds nothing, and with programs that print these lines for runs:
/// the debug build's, and the optimised one's. The optimised program's ticks differ from the third on.
fn compared(debug: &str, release: &str) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path();
    program(target, "cargo", "exit 0");
    program(target, "faketime", "exit 1");
    for (build, lines, ticks) in [("debug", debug, "01234"), ("release", release, "01534")] {
        fs::create_dir(target.join(build)).unwrap();
        let names = lines.lines().map(|line| line.split(' ').next().unwrap()).collect::<Vec<_>>().join("\\tx\\n");
        let ticks = ticks.chars().map(|c| c.to_string().repeat(32)).collect::<Vec<_>>().join("\\n");
        let text = format!(
            "case $1 in runs) printf '%s\\n' '{lines}' ;; ticks) printf '{ticks}\\n' ;; shrink) echo \"shrunk by: $5\" ;; \
             parts) printf '{names}\\tx\\n' ;; esac"
        );
        program(&target.join(build), "determinism", &text);
    }
    Command::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all/determinism"))
        .args(["--seeds", "1", "release"])
        .env("PATH", format!("{}:{}", target.display(), std::env::var("PATH").unwrap()))
        .env("CARGO_TARGET_DIR", target)
        .env_remove("MOTION_LAB_BUILD")
        .output()
        .unwrap()
}

#[test]
fn builds_that_differ_are_named_with_run_and_tick_and_shrunk() {
    let released = include_str!("../determinism/released.txt");
    let pinned = released.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let [_, run, digest] = line.split(' ').collect::<Vec<_>>()[..] else { panic!("{line}") };
        format!("{run} 9 {digest} all-{run}\n")
    });
    let pinned: String = pinned.collect();
    assert!(pinned.lines().count() >= 5, "{pinned}");
    let said = |output: &Output| String::from_utf8_lossy(&output.stdout).into_owned();

    let runs = format!("{pinned}swarm-1 4 a b");
    let same = compared(&runs, &runs);
    assert!(
        same.status.success() && said(&same).contains("1 configurations compared with the debug build, 0 failures")
    );

    let differing = compared(&runs, &format!("{pinned}swarm-1 4 a c"));
    assert_eq!(differing.status.code(), Some(1));
    for part in [
        "release: 1 runs differ, first swarm-1\n",
        "release, swarm-1: the first tick that differs is 2\n",
        "/release/determinism digests\n",
        "1 configurations compared with the debug build, 1 failures",
    ] {
        assert!(said(&differing).contains(part), "{part}: {}", said(&differing));
    }

    // both builds agree, and no longer with what was released
    let changed = runs.replace("pin-tour 9 f7", "pin-tour 9 07");
    let changed = compared(&changed, &changed);
    assert_eq!(changed.status.code(), Some(1));
    assert!(said(&changed).contains("pin-tour no longer gives f7"), "{}", said(&changed));
}
