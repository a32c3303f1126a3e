//! Logs of digests by the program: recorded, verified, replayed, resumed, and refused where frames are needed.

use std::fs;
use std::path::Path;

use crate::cli::{json, run};
use oracle::fixtures::grid;

fn name(folder: &Path, file: &str) -> String {
    folder.join(file).to_str().unwrap().to_owned()
}

#[test]
fn a_digest_log_is_recorded_verified_told_and_made_full() {
    let folder = tempfile::tempdir().unwrap();
    let [digests, full, again, drawing] =
        ["d.mcap", "f.mcap", "again.mcap", "d.svg"].map(|file| name(folder.path(), file));
    let recorded = run(&["record", "--ticks", "50", "--log", "digest", "-o", &digests]);
    assert!(!recorded.err.contains("frames"), "nothing is said of what was asked for: {}", recorded.err);
    let out = recorded.done();
    assert_eq!(run(&["record", "--ticks", "50", "-o", &full]).done(), out, "the same run");
    assert!(fs::metadata(&full).unwrap().len() > 10 * fs::metadata(&digests).unwrap().len());

    let verified = json(&run(&["verify", "--json", &digests]).done());
    assert_eq!((&verified["identical"], &verified["sealed"], &verified["ticks"]), (&50.into(), &50.into(), &50.into()));
    let digest = verified["digest"].as_str().unwrap();
    assert!(out.contains(digest) && run(&["verify", &digests]).done().contains("50 of 50 ticks bit-identical"));

    let info = run(&["info", &digests]).done();
    for line in ["seed     2005", "ticks    50 of 50 (2.50 s)", "log      a digest of each second", digest] {
        assert!(info.contains(line), "{line} is missing from\n{info}");
    }
    let told = json(&run(&["info", "--json", &digests]).done());
    assert_eq!((&told["log"], &told["digest"], &told["recorded"]), (&"digest".into(), &digest.into(), &50.into()));
    assert!(json(&run(&["info", "--json", &full]).done()).get("log").is_none());

    // the frames can be made from it
    assert!(run(&["replay", &digests, "--log", "full", "-o", &again]).done().contains("50 of 50 ticks bit-identical"));
    assert_eq!(fs::read(&again).unwrap(), fs::read(&full).unwrap());
    run(&["replay", &digests, "-o", &again]).done();
    assert_eq!(fs::read(&again).unwrap(), fs::read(&digests).unwrap(), "of the same kind unless asked otherwise");
    assert!(run(&["script", "print", &digests]).done().contains("events"));
    for arguments in [
        &["export", &digests, "--format", "csv"][..],
        &["diff", &digests, &full],
        &["capture", "--widget", "dashboard", "--log", &digests, "-o", &drawing],
    ] {
        let error = run(arguments).failed(3);
        assert!(error.contains("d.mcap: this is a digest log, which holds no frames"), "{arguments:?}: {error}");
        assert!(error.contains("replay") && error.contains("--log full -o"), "{arguments:?}: {error}");
    }
}

#[test]
fn a_digest_log_that_stopped_or_was_cut_is_verified_so_far_and_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, stopped] = ["whole.mcap", "stopped.mcap"].map(|file| name(folder.path(), file));
    let record = ["record", "--ticks", "90", "--world", "lot", "--log", "digest", "-o"];
    run(&[&record[..], &[&whole]].concat()).done();
    let ended = run(&[&record[..], &[&stopped, "--stop-after", "47"]].concat());
    assert_eq!(ended.code, Some(75), "{}", ended.err);
    let partial = format!("{stopped}.partial");
    let verified = run(&["verify", "--json", &partial]);
    assert_eq!(verified.code, Some(5));
    assert!(verified.err.contains("the digests of 47 of 90 ticks are whole"), "{}", verified.err);
    assert_eq!(json(&verified.out)["identical"], 47);
    assert_eq!(run(&["info", &partial]).code, Some(5));
    run(&["record", "--resume", &partial]).done();
    assert_eq!(fs::read(&stopped).unwrap(), fs::read(&whole).unwrap());
    // a changed bit is said
    let mut bytes = fs::read(&whole).unwrap();
    let at = bytes.len() / 2;
    bytes[at] ^= 4;
    fs::write(&whole, bytes).unwrap();
    let error = run(&["verify", &whole]);
    assert!([Some(3), Some(5)].contains(&error.code) && error.err.contains("has been changed"), "{}", error.err);
}

#[test]
fn above_a_hundred_robots_a_log_keeps_digests_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let [world, log] = ["world.ron", "log.mcap"].map(|file| name(folder.path(), file));
    let record = |robots: usize, more: &[&str]| {
        fs::write(&world, grid(robots, 20)).unwrap();
        let recorded = run(&[&["record", "--world", &world, "--ticks", "1", "--no-sensor"], more].concat());
        let said = recorded.err.clone();
        recorded.done();
        said
    };
    let is_digest = || json(&run(&["info", "--json", &log]).done())["log"] == "digest";
    let said = record(101, &["-o", &log]);
    assert!(said.contains("101 robots: the log keeps a digest of each second and no frames; --log full"), "{said}");
    assert!(is_digest());
    assert!(!record(101, &["-o", &log, "--log", "full"]).contains("digest"));
    assert!(!is_digest());
    assert!(!record(100, &["-o", &log]).contains("digest"));
    assert!(!is_digest());
    assert!(!record(101, &[]).contains("frames"), "no log, nothing to say");
}
