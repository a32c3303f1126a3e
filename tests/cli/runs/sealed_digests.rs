//! The run's digest in the end of a full log: what no frame tells is compared with it, and with `--expect`.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use motion_lab::run::{Digest, Log};
use motion_lab::sensors::RangeSensor;
use motion_lab::tour::TourConfig;
use xxhash_rust::xxh3::xxh3_128;

use crate::cli::{json, run, run_in, sealed};

/// A log of 20 ticks of the Lot, and its digest.
fn recorded(folder: &Path) -> (Log, Digest) {
    let out = run_in(folder, &["record", "--world", "lot", "--ticks", "20", "-o", "run.mcap"]).done();
    let log = Log::read_mcap(&fs::read(folder.join("run.mcap")).unwrap()).unwrap().log;
    let digest = log.digest().unwrap();
    assert!(out.contains(&format!("digest {digest}")));
    (log, digest)
}

const EXAM: &str = r#"Assignment(version: 1, world: "lot", robot: "Hitch",
    goal: (at: [7.5, 2.5, 0, 0], within: [0.1, 0.1, 0.1, 0.1]), limits: (ticks: 20), seeds: [1])"#;

/// A change of a run that changes no frame of it.
type Change = fn(&mut TourConfig);

const CHANGES: [(&str, Change); 5] = [
    ("the run's range", |c| c.sensor = Some(RangeSensor { n_rays: 360, max_range: 99.0 })),
    ("the world's name", |c| c.worlds[0].name = "Yard".into()),
    ("the bounds", |c| c.worlds[0].bounds.max.x += 1.0),
    ("marks", |c| c.worlds[0].marks.clear()),
    ("places", |c| c.worlds[0].places.clear()),
];

/// The log with its settings changed. Nobody scans in the Lot, so it holds whatever the sensor is.
fn forged(log: &Log, change: Change) -> Log {
    let mut forged = log.clone();
    change(Arc::make_mut(&mut forged.recipe.config));
    assert!(forged.digest() != log.digest());
    forged
}

/// CRC-32 by its definition: the polynomial 0xedb88320, reflected.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _: u32| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}

/// The file with another digest in its end, and right seals and checksums.
fn sealing(file: &[u8], digest: Digest) -> Vec<u8> {
    // the record 0x82 of 16 bytes, the seal of 32, then the end of the data with its checksum
    let head = [&[0x82][..], &16_u64.to_le_bytes()].concat();
    let at = file.windows(9).rposition(|bytes| bytes == head).unwrap() + 9;
    let (seal, end) = (at + 16, at + 16 + 9 + 32);
    let mut file = file.to_vec();
    file[at..seal].copy_from_slice(&digest.0.to_le_bytes());
    let hash = xxh3_128(&file[..seal]);
    file[end - 16..end].copy_from_slice(&hash.to_le_bytes());
    let crc = crc32(&file[..end]);
    file[end + 9..end + 13].copy_from_slice(&crc.to_le_bytes());
    file
}

#[test]
fn a_log_whose_settings_were_changed_is_refused_by_the_digest_in_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let (log, digest) = recorded(folder.path());
    assert_eq!(sealing(&sealed(&log), digest), sealed(&log));
    for (what, change) in CHANGES {
        let forged = forged(&log, change);
        fs::write(folder.path().join("forged.mcap"), sealing(&sealed(&forged), digest)).unwrap();
        let verified = run_in(folder.path(), &["verify", "forged.mcap"]);
        assert_eq!(verified.code, Some(4), "{what}: {}", verified.out);
        let held = forged.digest().unwrap();
        let said = format!("the run digest is {held}, and the log's end seals {digest}: no frame differs from its run");
        assert!(verified.out.starts_with(&said), "{what}: {}", verified.out);
        assert!(verified.out.contains("20 of 20 ticks bit-identical\n"), "{what}: {}", verified.out);
        let report = json(&run_in(folder.path(), &["verify", "--json", "forged.mcap"]).out);
        assert_eq!((&report["identical"], &report["sealed_digest"]), (&20.into(), &digest.to_string().into()));
        assert!(report["divergence"].as_str().unwrap().starts_with(&said), "{what}: {report}");
        // a log of another world would be refused all the same: what counts is that it is called forged
        fs::write(folder.path().join("exam.ron"), EXAM).unwrap();
        let graded = json(&run_in(folder.path(), &["grade", "--json", "exam.ron", "forged.mcap"]).out);
        assert_eq!((&graded["forged_at"], &graded["points"]), (&0.into(), &0.0.into()), "{what}: {graded}");
        assert!(graded["refused"].as_str().unwrap().contains("was changed after it was recorded"), "{what}: {graded}");
        // nothing else takes it, nor makes an honest one of it
        for command in [&["info", "forged.mcap"][..], &["stats", "forged.mcap"], &["record", "--resume", "forged.mcap"]]
        {
            let error = run_in(folder.path(), command).failed(3);
            assert!(error.contains("forged.mcap: the log was changed after it was recorded"), "{what}: {error}");
        }
    }
}

#[test]
fn a_forged_frame_is_named_before_the_digest() {
    let folder = tempfile::tempdir().unwrap();
    let (mut log, digest) = recorded(folder.path());
    log.frames_mut()[16].robots[0].contacts += 1;
    fs::write(folder.path().join("forged.mcap"), sealing(&sealed(&log), digest)).unwrap();
    let verified = run_in(folder.path(), &["verify", "forged.mcap"]);
    assert_eq!(verified.code, Some(4));
    assert!(verified.out.starts_with("tick 17, robot 0, contacts: "), "{}", verified.out);
    fs::write(folder.path().join("exam.ron"), EXAM).unwrap();
    let graded = json(&run_in(folder.path(), &["grade", "--json", "exam.ron", "forged.mcap"]).out);
    assert_eq!(graded["forged_at"], 17, "{graded}");
}

#[test]
fn whoever_seals_a_digest_anew_is_found_by_the_one_that_is_expected() {
    let folder = tempfile::tempdir().unwrap();
    let (log, digest) = recorded(folder.path());
    let digest = digest.to_string();
    let verify = |file: &str, more: &[&str]| run_in(folder.path(), &[&["verify", file][..], more].concat());
    verify("run.mcap", &["--expect", &digest]).done();
    verify("run.mcap", &["--expect", &digest.to_uppercase()]).done();
    let zeros = "0".repeat(32);
    verify("run.mcap", &["--expect", &zeros, "--expect", &digest]).done();
    for (what, change) in CHANGES {
        let forged = forged(&log, change);
        fs::write(folder.path().join("forged.mcap"), sealed(&forged)).unwrap();
        let held = forged.digest().unwrap();
        assert!(verify("forged.mcap", &[]).done().contains(&held.to_string()), "{what}");
        let refused = verify("forged.mcap", &["--expect", &digest]);
        assert_eq!(refused.code, Some(4), "{what}");
        assert!(refused.out.starts_with(&format!("the run digest is {held}, expected {digest}: ")), "{}", refused.out);
    }
    for wrong in ["", "12", &digest[1..], &format!("{digest}0")] {
        let error = verify("run.mcap", &["--expect", wrong]).failed(2);
        assert!(error.contains("a digest has 32 hexadecimal digits"), "{error}");
    }
    // a digest log has its digest, too, and one that ends early has not that of its whole run
    let stopped =
        &["record", "--world", "lot", "--ticks", "20", "--log", "digest", "-o", "d.mcap", "--stop-after", "9"];
    assert_eq!(run_in(folder.path(), stopped).code, Some(75));
    let partial = verify("d.mcap.partial", &["--expect", &digest]);
    assert_eq!(partial.code, Some(4));
    // nobody is said to have changed it
    assert!(
        partial.out.starts_with("the log is not whole: its digest cannot be the expected one\n"),
        "{}",
        partial.out
    );
    run_in(folder.path(), &["record", "--resume", "d.mcap.partial"]).done();
    verify("d.mcap", &["--expect", &digest]).done();
}

#[test]
fn a_log_of_before_is_identical_as_far_as_its_frames_tell() {
    let sample = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/samples/format_2.mcap");
    let verified = run(&["verify", sample]);
    assert!(verified.err.contains("--expect"), "{}", verified.err);
    let out = verified.done();
    assert!(out.starts_with("12 of 12 ticks bit-identical, as far as its frames tell\n"), "{out}");
    assert!(json(&run(&["verify", "--json", sample]).done())["sealed_digest"].is_null());
    assert!(run(&["info", sample]).done().contains("which its end does not seal"));
    let expected = run(&["verify", "--expect", "b35e9308ac36b5165806ac0b317ebd7a", sample]).done();
    assert!(expected.starts_with("12 of 12 ticks bit-identical\n"), "{expected}");

    let folder = tempfile::tempdir().unwrap();
    let (_, digest) = recorded(folder.path());
    assert!(run_in(folder.path(), &["verify", "run.mcap"]).done().starts_with("20 of 20 ticks bit-identical\n"));
    let info = run_in(folder.path(), &["info", "run.mcap"]).done();
    assert!(info.contains(&format!("digest   {digest}, which its end seals\n")), "{info}");
    let info = json(&run_in(folder.path(), &["info", "--json", "run.mcap"]).done());
    assert_eq!(info["sealed_digest"], digest.to_string());
}
