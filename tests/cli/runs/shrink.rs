//! `shrink`: the smallest run that still shows something.

use std::fs;
use std::path::Path;

use motion_lab::recording::Run;
use motion_lab::run::LogKind;
use motion_lab::web::Link;
use motion_lab::worlds::World;

use crate::cli::{json, run, run_in, run_with};

const SCRIPT: &str = r#"Script(version: 1, events: [
    (tick: 2, robot: "Rusty", input: Drive(127, 3)),
    (tick: 3, robot: "Hitch", input: MoveTo([0, 0])),
    (tick: 5, robot: "Rusty", input: Drive(-100, 0)),
    (tick: 9, robot: "Hitch", input: Drive(100, 0)),
])"#;

/// A folder with a run of 40 ticks, in which Hitch refuses an input and Reach has a contact.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("drive.ron"), SCRIPT).unwrap();
    run_in(folder.path(), &["record", "--script", "drive.ron", "--ticks", "40", "-o", "run.mcap"]).done();
    folder
}

fn stats(folder: &Path, log: &str) -> serde_json::Value {
    json(&run_in(folder, &["stats", "--json", log]).done())
}

#[test]
fn what_is_left_shows_it_verifies_and_is_said() {
    let folder = folder();
    let at = folder.path();
    let shrunk = run_in(at, &["shrink", "run.mcap", "--while", "Hitch.refusals > 0"]);
    assert!(shrunk.err.contains("wrote run.shrunk.mcap"), "{}", shrunk.err);
    // what was taken out of the world is not in the address either
    let link = shrunk.out.lines().last().unwrap();
    assert!(link.starts_with("http://localhost:8000/?v=3&seed=2005&file=World("), "{link}");
    let again =
        Run::record_recipe(Link::parse(link.split_once('?').unwrap().1).unwrap().recipe(), LogKind::Frames, |_| {});
    let digest = format!("\ndigest {}\n", again.unwrap().digest().unwrap());
    assert!(shrunk.out.contains(&digest), "{digest}{}", shrunk.out);
    let rows: Vec<Vec<&str>> = shrunk.out.lines().map(|line| line.split_whitespace().collect()).collect();
    for (name, before, after) in
        [("worlds", "3", "1"), ("robots", "3", "1"), ("events", "4", "1"), ("seconds", "2.00", "0.15")]
    {
        assert!(rows.contains(&vec![name, before, after]), "{}", shrunk.out);
    }
    assert!(shrunk.out.contains("1-minimal, after ") && shrunk.out.contains("\ndigest "), "{}", shrunk.out);
    assert!(run_in(at, &["verify", "run.shrunk.mcap"]).done().starts_with("3 of 3 ticks bit-identical"));
    let robots = &stats(at, "run.shrunk.mcap")["robots"];
    assert_eq!((robots.as_array().unwrap().len(), &robots[0]["refusals"]), (1, &1.into()));
    let script = run_in(at, &["script", "print", "run.shrunk.mcap"]).done();
    assert!(script.contains(r#"(tick: 3, robot: "Hitch", input: MoveTo([0, 0])),"#), "{script}");
    // the same whatever the number of jobs, and nothing is left to take away
    for jobs in ["1", "2", "8"] {
        let line = ["shrink", "run.mcap", "--while", "Hitch.refusals>0", "--jobs", jobs, "-o", "again.mcap"];
        assert_eq!(run_in(at, &line).done(), shrunk.out);
        assert_eq!(fs::read(at.join("again.mcap")).unwrap(), fs::read(at.join("run.shrunk.mcap")).unwrap());
    }
    let twice = json(&run_in(at, &["shrink", "again.mcap", "--while", "Hitch.refusals>0", "--json"]).done());
    assert!(twice["before"] == twice["after"] && twice["minimal"] == true, "{twice}");
}

#[test]
fn worlds_that_are_kept_leave_a_link_to_the_run() {
    let folder = folder();
    let line = ["shrink", "run.mcap", "--while", "Hitch.refusals>0", "--keep-worlds", "--json"];
    let said = json(&run_in(folder.path(), &[&line[..], &["--site", "https://example.org/"]].concat()).done());
    let (link, digest) = (said["link"].as_str().unwrap(), said["digest"].as_str().unwrap());
    assert!(link.starts_with("https://example.org/?v=1&seed=2005&world=lot&script="), "{said}");
    assert!(link.ends_with(&format!("&tick=3&digest={digest}")), "{said}");
    let obstacles = said["after"]["obstacles"].as_u64().unwrap();
    assert!(said["after"]["worlds"] == 1 && obstacles == World::lot().obstacles.len() as u64, "{said}");
    let printed = run_in(folder.path(), &["link", "run.shrunk.mcap", "--site", "https://example.org/"]).done();
    assert_eq!(printed.trim_end(), link);
}

#[cfg(unix)]
#[test]
fn a_command_of_ones_own_decides_by_its_exit_code() {
    let folder = folder();
    let at = folder.path();
    run_in(at, &["record", "--ticks", "40", "-o", "other.mcap"]).done();
    let lab = env!("CARGO_BIN_EXE_motion-lab");
    let prints = format!("{lab} script print {{}} | grep -q 'Drive(100' && exit 7");
    let line = ["shrink", "run.mcap", "--exec", &prints, "--exit", "7", "--json", "-o", "small.mcap"];
    let said = json(&run_in(at, &line).done());
    assert_eq!((&said["after"]["events"], &said["after"]["robots"]), (&1.into(), &1.into()));
    assert_eq!((&said["before"]["events"], &said["after"]["seconds"]), (&4.into(), &0.45.into()));
    // both have to hold
    let both = [&line[..], &["--while", "Rusty.contact_ticks>=0&&Hitch.refusals>0"]].concat();
    let said = json(&run_in(at, &both).done());
    assert_eq!((&said["after"]["events"], &said["after"]["robots"]), (&2.into(), &2.into()));
    // the logs that a command reads have frames where the run has
    let differs = format!("{lab} diff {{}} other.mcap");
    let error = run_in(at, &["shrink", "run.mcap", "--exec", &differs, "--exit", "3"]).failed(3);
    assert!(error.contains("the run itself does not show it: the command's exit code is 4, expected 3"), "{error}");
    // without {} the log is the last word
    let error = run_in(at, &["shrink", "run.mcap", "--exec", "exec head -c 0 nowhere"]).failed(3);
    assert!(error.contains("the command's exit code is 1, expected 0"), "{error}");
    run_in(at, &["shrink", "run.mcap", "--exec", "exec test -s", "--tries", "1"]).failed(75);
    let error = run_in(at, &["shrink", "run.mcap", "--exec", "kill -9 $$ # {}"]).failed(3);
    assert!(error.contains("the command was ended by a signal"), "{error}");
}

#[test]
fn the_best_so_far_is_kept_where_the_tries_are_spent() {
    let folder = folder();
    let at = folder.path();
    let line = ["shrink", "run.mcap", "--while", "Hitch.refusals>0", "--tries", "4", "--json"];
    let ended = run_in(at, &line);
    assert!(ended.err.contains("stopped after 4 runs, the most allowed"), "{}", ended.err);
    let again = r"Shrink what is left: motion-lab shrink run.shrunk.mcap --while 'Hitch.refusals>0'";
    assert!(ended.err.contains(again), "{}", ended.err);
    let said = json(&ended.out);
    assert!(ended.code == Some(75) && said["minimal"] == false && said["tries"] == 4, "{said}");
    assert_eq!(&said["after"]["worlds"], &1);
    assert_eq!(stats(at, "run.shrunk.mcap")["robots"][0]["refusals"], 1);
    run_in(at, &["verify", "run.shrunk.mcap"]).done();
}

#[test]
fn logs_of_each_kind_unfinished_ones_and_standard_input_are_shrunk() {
    let folder = folder();
    let at = folder.path();
    run_in(at, &["replay", "run.mcap", "--log", "digest", "-o", "digests.mcap"]).done();
    let line = ["shrink", "digests.mcap", "--while", "Hitch.refusals>0", "-o"];
    run_in(at, &[&line[..], &["as.mcap"]].concat()).done();
    run_in(at, &[&line[..], &["full.mcap", "--log", "full"]].concat()).done();
    run_in(at, &["shrink", "run.mcap", "--while", "Hitch.refusals>0"]).done();
    assert_eq!(fs::read(at.join("full.mcap")).unwrap(), fs::read(at.join("run.shrunk.mcap")).unwrap());
    assert!(fs::read(at.join("as.mcap")).unwrap() != fs::read(at.join("full.mcap")).unwrap());
    let whole = fs::read(at.join("run.mcap")).unwrap();
    fs::write(at.join("cut.mcap"), &whole[..whole.len() / 2]).unwrap();
    let cut = run_in(at, &["shrink", "cut.mcap", "--while", "Hitch.refusals>0"]);
    assert!(cut.code == Some(5) && cut.err.contains("the log is cut off"), "{}", cut.err);
    let output = at.join("from.mcap").display().to_string();
    run_with(&whole, &["shrink", "-", "--while", "Hitch.refusals>0", "-o", &output]).done();
    assert_eq!(fs::read(output).unwrap(), fs::read(at.join("full.mcap")).unwrap());
}

#[test]
fn what_cannot_be_shrunk_is_refused_with_what_was_found() {
    let folder = folder();
    let at = folder.path();
    let shrink = |condition: &str| run_in(at, &["shrink", "run.mcap", "--while", condition]);
    for (condition, code, reason) in [
        ("Hitch.contacts > 90", 3, "run.mcap: the run itself does not show it: Hitch.contacts is "),
        ("hitch.contacts > 0", 2, "character 1: the run has no robot \"hitch\"; did you mean \"Hitch\"?"),
        ("Hitch.contcts > 0", 2, "character 1: no column \"contcts\"; did you mean \"contacts\"?"),
        ("Hitch.contacts > many", 2, "character 18: \"many\" is no number"),
        ("digest == 00000000000000000000000000000000", 3, "does not show it: the digest is "),
    ] {
        let error = shrink(condition).failed(code);
        assert!(error.contains(reason), "{condition}: {error}");
    }
    assert!(run_in(at, &["shrink", "run.mcap"]).failed(2).contains("--while <CONDITION>"));
    let lone = run_in(at, &["shrink", "run.mcap", "--while", "Hitch.refusals>0", "--exit", "3"]).failed(2);
    assert!(lone.contains("--exec <COMMAND>"), "{lone}");
    assert!(run(&["shrink", "nowhere.mcap", "--while", "Hitch.refusals>0"]).failed(3).contains("nowhere.mcap"));
    assert!(!at.join("run.shrunk.mcap").exists());
}

#[cfg(unix)]
#[test]
fn the_line_that_goes_on_with_what_is_left_is_run_as_it_is_printed() {
    let folder = folder();
    let at = folder.path();
    let condition = r#""Hitch".refusals>0 && Hitch.path_m >= 0"#;
    let line = ["shrink", "run.mcap", "--while", condition, "--exec", "test 'a b' = {} || exit 7", "--keep-worlds"];
    let named = ["--exit", "7", "--tries", "1", "-o", "what's left.mcap"];
    let ended = run_in(at, &[&line[..], &named[..]].concat());
    assert_eq!(ended.code, Some(75), "{}", ended.err);
    let again = ended.err.split("Shrink what is left: motion-lab").nth(1).unwrap().lines().next().unwrap();
    let again = format!("{} {again}", env!("CARGO_BIN_EXE_motion-lab"));
    let ended = std::process::Command::new("sh").arg("-c").arg(&again).current_dir(at).output().unwrap();
    assert!(ended.status.success(), "{again}: {}", String::from_utf8_lossy(&ended.stderr));
    assert_eq!(stats(at, "what's left.shrunk.mcap")["robots"].as_array().unwrap().len(), 1);
}

#[cfg(unix)]
#[test]
fn a_command_that_cannot_be_run_is_told_with_what_it_says() {
    let folder = folder();
    let refusal = |command: &str| run_in(folder.path(), &["shrink", "run.mcap", "--exec", command]).failed(3);
    let error = refusal("no-such-command");
    assert!(error.contains("is 127, expected 0 (127: there is no such command)\n  "), "{error}");
    assert!(error.contains("no-such-command: ") && !error.contains("motion-lab stats"), "{error}");
    assert!(refusal("./drive.ron").contains("is 126, expected 0 (126: the command is there but can't be run)\n  "));
    assert!(refusal("echo why it is 3 >&2; exit 3 #").contains("is 3, expected 0\n  why it is 3\n"));
}

#[test]
fn a_run_without_robots_is_said_to_have_none() {
    let folder = folder();
    let world = r#"World(version: 1, name: "bare", bounds: (min: (0, 0), max: (4, 4)))"#;
    fs::write(folder.path().join("bare.ron"), world).unwrap();
    run_in(folder.path(), &["record", "--world", "bare.ron", "--ticks", "2", "-o", "bare.mcap"]).done();
    let error = run_in(folder.path(), &["shrink", "bare.mcap", "--while", "Hitch.contacts>0"]).failed(2);
    assert!(error.contains("The run has no robots"), "{error}");
}
