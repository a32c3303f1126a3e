//! Many logs at once: none is an input, and what is refused is refused before the first is written.

use std::fs::{self, File};
use std::path::Path;

use super::loss::{contents, folder};
use crate::cli::{Run, command, ended, run_in};

/// Records seeds of the world or script `input` into logs of this name.
fn record(at: &Path, seeds: &str, input: &str, output: &str) -> Run {
    let option = if input.ends_with("drive.mcap") { "--script" } else { "--world" };
    run_in(at, &["record", option, input, "--ticks", "2", "--seeds", seeds, "-o", output])
}

/// Fails unless the run was refused with this message, and wrote nothing into these folders.
#[track_caller]
fn refused(ended: Run, said: &str, before: &[(&Path, Vec<(String, Vec<u8>)>)]) {
    assert_eq!(ended.out, "");
    let error = ended.failed(2);
    assert!(error.contains(said), "{said}: {error}");
    for (folder, before) in before {
        assert!(contents(folder) == *before, "{said}: {} has changed", folder.display());
    }
}

#[test]
fn seeds_of_which_one_would_write_over_an_input_are_refused_before_the_first_is_recorded() {
    let folder = folder();
    let at = folder.path();
    let copies =
        ["2.mcap", "3.mcap.partial", "02.mcap", "run10.mcap", "run1-1.mcap", "n/2/log.mcap", "n/18446744073709551614"];
    for deep in ["n/0", "n/1", "n/2"] {
        fs::create_dir_all(at.join(deep)).unwrap();
    }
    for copy in copies {
        fs::copy(at.join("wb.ron"), at.join(copy)).unwrap();
    }
    fs::copy(at.join("drive.ron"), at.join("1drive.mcap")).unwrap();
    fs::copy(at.join("wb.ron"), at.join("linked.ron")).unwrap();
    fs::hard_link(at.join("linked.ron"), at.join("hard-3.mcap")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("linked.ron", at.join("soft-3.mcap")).unwrap();
    let inner = ["n", "n/0", "n/1", "n/2"].map(|deep| at.join(deep));
    let all = || std::iter::once(at).chain(inner.iter().map(|deep| &**deep)).map(|deep| (deep, contents(deep)));
    let before: Vec<_> = all().collect();
    let absolute = at.join("{seed}.mcap").display().to_string();
    for (seeds, input, output, log) in [
        ("0..4", "2.mcap", "{seed}.mcap", "2.mcap"),
        ("0..4", "2.mcap", "./n/../{seed}.mcap", "./n/../2.mcap"),
        ("0..4", "n/../2.mcap", &absolute, "2.mcap"),
        ("0..18446744073709551615", "2.mcap", "{seed}.mcap", "2.mcap"),
        ("0..4", "3.mcap.partial", "{seed}.mcap", "3.mcap.partial"),
        ("0..4", "02.mcap", "0{seed}.mcap", "02.mcap"),
        ("0..4", "run10.mcap", "run{seed}0.mcap", "run10.mcap"),
        ("7..11", "run10.mcap", "run{seed}.mcap", "run10.mcap"),
        ("0..4", "run1-1.mcap", "run{seed}-{seed}.mcap", "run1-1.mcap"),
        ("0..4", "n/2/log.mcap", "n/{seed}/log.mcap", "n/2/log.mcap"),
        ("18446744073709551600..18446744073709551615", "n/18446744073709551614", "n/{seed}", "n/18446744073709551614"),
        ("0..4", "1drive.mcap", "{seed}drive.mcap", "1drive.mcap"),
        ("0..4", "linked.ron", "hard-{seed}.mcap", "hard-3.mcap"),
        #[cfg(unix)]
        ("0..4", "linked.ron", "soft-{seed}.mcap", "soft-3.mcap"),
    ] {
        let said = format!("{log}: this output is the same file as the input {input}");
        refused(record(at, seeds, input, output), &said, &before);
    }
    // standard streams are files as well
    let streams = || command(&["record", "--world", "-", "--ticks", "2", "--seeds", "0..4", "-o", "{seed}.mcap"]);
    let from = ended(streams().current_dir(at).stdin(File::open(at.join("2.mcap")).unwrap()).output().unwrap());
    refused(from, "2.mcap: this output is the same file as the input standard input", &before);
    let appended = fs::OpenOptions::new().append(true).open(at.join("2.mcap")).unwrap();
    let mut onto = command(&["record", "--ticks", "2", "--seeds", "0..4", "-o", "{seed}.mcap"]);
    let onto = ended(onto.current_dir(at).stdout(appended).output().unwrap());
    refused(onto, "2.mcap: it is named twice, also as standard output", &before);
    // an input that is no log of these seeds is read
    for (seeds, input, output) in
        [("0..2", "2.mcap", "{seed}.mcap"), ("0..4", "02.mcap", "x{seed}.mcap"), ("3..4", "02.mcap", "0{seed}.mcap")]
    {
        record(at, seeds, input, output).done();
    }
}

#[cfg(unix)]
#[test]
fn two_seeds_never_have_one_log_by_links_of_files_or_folders() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for deep in ["a/2", "b/1", "c"] {
        fs::create_dir_all(at.join(deep)).unwrap();
    }
    symlink("2", at.join("a/1")).unwrap();
    symlink("1", at.join("b/2")).unwrap();
    symlink("2.mcap", at.join("c/1.mcap")).unwrap();
    symlink("3.mcap", at.join("c/4.mcap")).unwrap();
    let record = |seeds: &str, output: &str| {
        run_in(at, &["record", "--ticks", "2", "--seeds", seeds, "--threads", "1", "-o", output])
    };
    for (seeds, output, twice) in [
        ("1..3", "a/{seed}/run.mcap", "a/2/run.mcap: it is named twice, also as a/1/run.mcap"),
        ("1..3", "b/{seed}/run.mcap", "b/2/run.mcap: it is named twice, also as b/1/run.mcap"),
        ("1..3", "c/{seed}.mcap", "c/2.mcap: it is named twice, also as c/1.mcap"),
        ("3..5", "c/{seed}.mcap", "c/4.mcap: it is named twice, also as c/3.mcap"),
    ] {
        let error = record(seeds, output).failed(2);
        assert!(error.contains(twice), "{error}");
    }
    // a link to a file of no other seed is written there
    record("3..4", "c/{seed}.mcap").done();
    record("1..2", "c/{seed}.mcap").done();
    assert!(at.join("c/1.mcap").is_symlink() && at.join("c/2.mcap").is_file());
}

#[test]
fn a_sweep_of_which_a_log_would_be_its_study_is_refused_before_its_first_row() {
    let folder = folder();
    let at = folder.path();
    let logs = at.join("parts/logs");
    fs::create_dir_all(&logs).unwrap();
    for name in ["1.mcap", "1.mcap.partial", "2.mcap"] {
        fs::copy(at.join("study.ron"), logs.join(name)).unwrap();
    }
    let before = [at.join("parts"), logs.clone()].map(|folder| (folder.clone(), contents(&folder)));
    let before: Vec<_> = before.iter().map(|(folder, held)| (&**folder, held.clone())).collect();
    for study in ["1.mcap", "1.mcap.partial"] {
        let study = format!("parts/logs/{study}");
        let said = format!("{study}: this output is the same file as the input {study}");
        refused(run_in(at, &["sweep", &study, "-o", "parts", "--keep", "all"]), &said, &before);
    }
    // a study of two rows writes no third log
    run_in(at, &["sweep", "parts/logs/2.mcap", "-o", "parts", "--keep", "all"]).done();
}

#[cfg(unix)]
#[test]
fn a_sweep_writes_no_log_through_a_link_to_another_rows() {
    let folder = folder();
    let at = folder.path();
    let logs = at.join("parts/logs");
    fs::create_dir_all(&logs).unwrap();
    std::os::unix::fs::symlink("0.mcap", logs.join("1.mcap")).unwrap();
    let sweep = || run_in(at, &["sweep", "study.ron", "-o", "parts", "--keep", "all", "--jobs", "1"]);
    let error = sweep().failed(2);
    assert!(error.contains("parts/logs/1.mcap: it is a link, which may be another row's log"), "{error}");
    fs::remove_file(logs.join("1.mcap")).unwrap();
    sweep().done();
    for log in ["0.mcap", "1.mcap"] {
        run_in(&logs, &["verify", log]).done();
    }
    assert_ne!(fs::read(logs.join("0.mcap")).unwrap(), fs::read(logs.join("1.mcap")).unwrap());
}
