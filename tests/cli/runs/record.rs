//! `record`: the inputs that determine a run, and no others.

use std::fs;

use crate::cli::{json, run, run_in};

/// The digest that `record` prints.
#[track_caller]
fn digest(arguments: &[&str]) -> String {
    let summary = json(&run(&[&["record", "--json"], arguments].concat()).done());
    summary["digest"].as_str().unwrap().to_owned()
}

#[test]
fn the_seed_decides_and_a_second_process_agrees() {
    let short = |seed: &str| digest(&["--ticks", "60", "--seed", seed]);
    assert_eq!(short("2005"), short("2005"));
    assert_ne!(short("2005"), short("2006"));
    assert_eq!(digest(&["--ticks", "60"]), short("2005"), "the book's seed when none is given");
    assert_eq!(digest(&["--seconds", "3"]), short("2005"), "3 s are 60 ticks");
}

#[test]
fn a_recording_of_many_seeds_says_which_logs_it_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let record = |seeds: &str, more: &[&str]| {
        let arguments = ["record", "--ticks", "2", "--seeds", seeds, "-o", "run-{seed}.mcap"];
        run_in(folder.path(), &[&arguments[..], more].concat())
    };
    let first = record("3..6", &[]);
    assert_eq!((first.err.as_str(), first.out.lines().count()), ("motion-lab: wrote 3 logs\n", 3));
    let size = |seed: u64| fs::metadata(folder.path().join(format!("run-{seed}.mcap"))).unwrap().len();
    let older = size(4) + size(5);
    let said = format!("wrote 4 logs, replacing 2 older files of {older} bytes in all, those of the seeds 4..6\n");
    assert_eq!(record("4..8", &[]).err, format!("motion-lab: {said}"));
    assert_eq!(record("3..8", &["--quiet"]).err, "");
    // without logs nothing is written and nothing replaced
    assert_eq!(run_in(folder.path(), &["record", "--ticks", "2", "--seeds", "3..6"]).err, "");
}

#[test]
fn options_that_change_the_run_change_its_digest() {
    let mut digests = vec![digest(&["--ticks", "20"])];
    for more in [
        &["--ticks", "21"][..],
        &["--ticks", "20", "--no-sensor"],
        &["--ticks", "20", "--rays", "12"],
        &["--ticks", "20", "--range", "2.5"],
        &["--ticks", "20", "--world", "lot"],
        &["--ticks", "20", "--robot", "Hitch"],
        &["--ticks", "20", "--robot", "Reach=reach3:0.1,0.2,0.3"],
    ] {
        let other = digest(more);
        assert!(!digests.contains(&other), "{more:?}");
        digests.push(other);
    }
}

#[test]
fn a_stand_in_s_angles_are_wrapped_and_its_place_is_checked() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("f.mcap");
    let log = log.to_str().unwrap();
    let recorded = |robot: &str| {
        let arguments = ["record", "--ticks", "20", "--world", "workbench", "--robot", robot, "-o", log, "--json"];
        let digest = json(&run(&arguments).done())["digest"].as_str().unwrap().to_owned();
        assert!(run(&["verify", log]).done().contains(&digest), "{robot}");
        digest
    };
    // 4 rad is 4 - 2 pi, and -pi is pi
    assert_eq!(recorded("Reach=reach:4,0"), recorded("Reach=reach:-2.2831853071795862,0"));
    assert_eq!(recorded("Reach=reach:-3.141592653589793,1"), recorded("Reach=reach:3.141592653589793,1"));
    for (robot, reason) in [
        ("Rusty=rusty:10001,1,0", "10001"),
        ("Rusty=rusty:1,1", "three: x, y, theta"),
        ("Rusty=rusty:1,inf,0", "finite"),
        ("Rusty=rocket:1,1,0", "rocket"),
    ] {
        let error = run(&["record", "--ticks", "2", "--robot", robot, "-o", log]).failed(2);
        assert!(error.contains(reason) && error.contains("--robot Rusty"), "{robot}: {error}");
    }
}

#[test]
fn the_text_and_the_json_tell_the_same() {
    let text = run(&["record", "--ticks", "40"]).done();
    let summary = json(&run(&["record", "--ticks", "40", "--json"]).done());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0].split_whitespace().collect::<Vec<_>>(), ["robot", "where", "contacts"]);
    let names = [&["x", "y", "heading"][..], &["theta1", "theta2"], &["x", "y", "heading"]];
    for (id, names) in names.into_iter().enumerate() {
        let robot = &summary["robots"][id];
        let coordinate = |(i, name): (usize, &&str)| {
            let unit = if i < 2 && id != 1 { "m" } else { "rad" };
            format!("{name} {:.3} {unit}", robot["configuration"][i].as_f64().unwrap())
        };
        let place: Vec<String> = names.iter().enumerate().map(coordinate).collect();
        let line = format!("{}  {}", robot["name"].as_str().unwrap(), place.join(", "));
        let rest = lines[id + 1].strip_prefix(&line).unwrap_or_else(|| panic!("{}, not {line}", lines[id + 1]));
        assert_eq!(rest.trim(), robot["contacts"].to_string());
        assert_eq!(lines[id + 1].len(), lines[0].len(), "the columns stand below their headings");
    }
    assert_eq!(lines[4..], [format!("digest {}", summary["digest"].as_str().unwrap())]);
    assert_eq!(summary["recorded"], 40);
}

#[test]
fn many_seeds_give_what_each_gives_alone_on_any_number_of_threads() {
    let many = |threads: &str| run(&["record", "--ticks", "30", "--seeds", "3..20", "--threads", threads]).done();
    let one = many("1");
    assert_eq!(one, many("2"));
    assert_eq!(one, many("8"));
    assert_eq!(one.lines().count(), 17);
    for (line, seed) in one.lines().zip(3..) {
        assert!(line.starts_with(&format!("{seed} ")), "in order: {line}");
    }
    assert_eq!(one.lines().nth(4).unwrap(), format!("7 {}", digest(&["--ticks", "30", "--seed", "7"])));
}

#[test]
fn many_logs_get_a_name_each() {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &["record", "--ticks", "10", "--seeds", "4..6", "-o", "run-{seed}.mcap"]).done();
    let alone = folder.path().join("alone.mcap");
    run(&["record", "--ticks", "10", "--seed", "5", "-o", alone.to_str().unwrap()]).done();
    assert_eq!(fs::read(folder.path().join("run-5.mcap")).unwrap(), fs::read(&alone).unwrap(), "byte for byte");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}

#[test]
fn a_recording_that_stopped_early_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let whole = run_in(folder.path(), &["record", "--ticks", "80", "-o", "whole.mcap"]).done();
    let stop = ["record", "--ticks", "80", "-o", "run.mcap", "--stop-after", "25"];
    let stopped = run_in(folder.path(), &stop).failed(75);
    assert!(stopped.contains("after tick 25 of 80") && stopped.contains("--resume run.mcap.partial"), "{stopped}");
    assert!(!folder.path().join("run.mcap").exists());
    // the part recorded so far verifies and can be inspected
    let verified = run_in(folder.path(), &["verify", "run.mcap.partial"]);
    assert_eq!(
        (verified.code, verified.out.as_str()),
        (Some(5), "25 of 25 sealed ticks bit-identical; the run has 80\n")
    );
    assert_eq!(run_in(folder.path(), &["info", "run.mcap.partial"]).code, Some(5));
    // stopping again within that part changes nothing
    let before = fs::read(folder.path().join("run.mcap.partial")).unwrap();
    run_in(folder.path(), &["record", "--resume", "run.mcap.partial", "--stop-after", "10"]).failed(75);
    assert_eq!(fs::read(folder.path().join("run.mcap.partial")).unwrap(), before);
    // to the end
    let resumed = run_in(folder.path(), &["record", "--resume", "run.mcap.partial"]).done();
    assert_eq!(resumed, whole);
    assert_eq!(
        fs::read(folder.path().join("run.mcap")).unwrap(),
        fs::read(folder.path().join("whole.mcap")).unwrap(),
        "byte for byte as if it had never stopped"
    );
    assert!(!folder.path().join("run.mcap.partial").exists());
}

#[test]
fn stopping_does_not_touch_an_older_recording() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("run.mcap"), "older").unwrap();
    run_in(folder.path(), &["record", "--ticks", "80", "-o", "run.mcap", "--stop-after", "25"]).failed(75);
    assert_eq!(fs::read_to_string(folder.path().join("run.mcap")).unwrap(), "older");
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_was_done() {
    let folder = tempfile::tempdir().unwrap();
    let child = crate::cli::worlds::files::long_recording(folder.path(), "long.mcap");
    assert!(std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let ended = child.wait_with_output().unwrap();
    let error = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(75), "{error}");
    assert!(error.contains("--resume long.mcap.partial"), "{error}");
    let info = run_in(folder.path(), &["info", "--json", "long.mcap.partial"]);
    assert_eq!(info.code, Some(5));
    assert!(json(&info.out)["recorded"].as_u64().unwrap() > 0);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file is left");
}

#[test]
fn a_wrong_script_is_3_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("drive.ron");
    for (text, reason) in [
        (
            "Script(version: 1, events: [\n(tick: 9, robot: \"Rusty\", input: Drive(129, 0))])",
            "drive.ron:2: events[0]: channel 129",
        ),
        ("Script(version: 1, events: [\n(tick: 9, robot: \"Rosty\", input: Release)])", "Rosty"),
        ("Script(version: 9, events: [])", "version 9"),
        ("Script(", "drive.ron:1"),
    ] {
        fs::write(&file, text).unwrap();
        let error = run(&["record", "--script", file.to_str().unwrap()]).failed(3);
        assert!(error.contains(reason) && error.contains("drive.ron"), "{error}");
    }
}
