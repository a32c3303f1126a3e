//! The whole program: every command and every exit code, by running it.

mod exports;
mod files;
mod grades;
mod program;
mod questions;
mod runs;
mod sweep;
mod worlds;

use motion_lab::run::Log;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// The exit code and the output of a run of the program.
struct Run {
    code: Option<i32>,
    out: String,
    err: String,
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motion-lab"));
    command.args(arguments).stdin(Stdio::null()).env_remove("COLUMNS");
    command
}

fn ended(output: Output) -> Run {
    Run {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Runs the program with these arguments.
fn run(arguments: &[&str]) -> Run {
    ended(command(arguments).output().unwrap())
}

/// Runs the program in a folder.
fn run_in(folder: &Path, arguments: &[&str]) -> Run {
    ended(command(arguments).current_dir(folder).output().unwrap())
}

/// Runs the program with `input` on its standard input.
fn run_with(input: &[u8], arguments: &[&str]) -> Run {
    let mut child =
        command(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_owned();
    let writer = std::thread::spawn(move || drop(stdin.write_all(&input)));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    ended(output)
}

impl Run {
    /// The standard output. Fails unless the run succeeded.
    #[track_caller]
    fn done(self) -> String {
        assert_eq!(self.code, Some(0), "{}", self.err);
        self.out
    }

    /// The messages. Fails unless the run ended with this exit code.
    #[track_caller]
    fn failed(self, code: i32) -> String {
        assert_eq!(self.code, Some(code), "out: {}\nerr: {}", self.out, self.err);
        self.err
    }
}

/// The bytes of a log, with right seals whatever was changed in it.
fn sealed(log: &Log) -> Vec<u8> {
    let mut file = Vec::new();
    log.write_mcap(&mut file).unwrap();
    file
}

fn json(line: &str) -> serde_json::Value {
    serde_json::from_str(line).unwrap()
}

/// A world of two rooms without a door between them, and a rover in the left one.
pub const SHUT: &str = r#"World(version: 1, name: "shut", bounds: (min: (0, 0), max: (4, 4)),
    walls: [(name: "between", points: [(2, 0), (2, 4)])], robots: [(name: "R", kind: "rusty", start: [1, 1, 0])])"#;

#[test]
fn help_tells_the_exit_codes() {
    let help = run(&["--help"]).done();
    let table = help.split("Exit codes:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let mut listed: Vec<(u8, String)> = Vec::new();
    for line in table.lines() {
        match line.trim_start().split_once("  ").map(|(code, meaning)| (code.parse(), meaning)) {
            Some((Ok(code), meaning)) => listed.push((code, meaning.to_owned())),
            // a meaning goes on
            _ => listed.last_mut().unwrap().1.push_str(&format!(" {}", line.trim())),
        }
    }
    assert_eq!(listed.iter().map(|(code, _)| *code).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5, 6, 7, 75, 130]);
    // the manual's table says the same
    let manual = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/cli.md")).unwrap();
    let rows = manual.split("\n## Exit codes\n").nth(1).unwrap().split("\n## ").next().unwrap().lines();
    let rows = rows.filter_map(|row| row.strip_prefix("| ")?.strip_suffix(" |")?.split_once(" | "));
    let listed_there: Vec<_> =
        rows.filter_map(|(code, meaning)| Some((code.parse().ok()?, meaning.to_owned()))).collect();
    assert_eq!(listed_there, listed);
    assert!(run(&["--version"]).done().starts_with("motion-lab 0."));
}

#[test]
fn a_wrong_command_line_is_2() {
    for arguments in [
        &["fly"][..],
        &["query", "distance", "1,2"],
        &["query", "distance", "--robot", "reach"],
        &["query", "distance", "--robot", "reach", "1,x"],
        &["query", "distance", "--robot", "reach", "1,nan"],
        &["query", "distance", "--robot", "reach", "1,2,3"],
        &["query", "distance", "--robot", "rusty", "10001,0"],
        &["query", "distance", "--robot", "reach", "1,2", "3,4"],
        &["query", "edge", "--robot", "reach", "1,2"],
        &["query", "edge", "--robot", "hitch", "5,5,0", "5,5,0,0"],
        &["query", "swept", "--robot", "reach", "1,2", "1,2,3"],
        &["query", "swept", "--robot", "hitch", "5,5,0", "5,5,0,0"],
        &["query", "scan", "1,2", "--rays", "0"],
        &["query", "scan", "1,2", "--range", "nan"],
        &["record", "--ticks", "-1"],
        &["record", "--ticks", "4294967297"],
        &["record", "--seconds", "0.01"],
        &["record", "--seconds", "nan"],
        &["record", "--rays", "100001"],
        &["record", "--seeds", "7..3"],
        &["record", "--seeds", "1..3", "-o", "one.mcap"],
        &["record", "--seeds", "1..3", "--threads", "257"],
        &["record", "--robot", "Nobody"],
        &["record", "--resume", "x.partial", "--seed", "3"],
    ] {
        let run = run(arguments);
        assert_eq!(run.code, Some(2), "{arguments:?}: {}", run.err);
        assert!(run.out.is_empty() && run.err.lines().count() >= 2, "{arguments:?} says what to do: {}", run.err);
    }
}

#[test]
fn a_missing_or_wrong_input_is_3_and_names_the_file() {
    for arguments in [
        &["world", "show", "nowhere.ron"][..],
        &["world", "check", "nowhere.ron"],
        &["query", "distance", "--robot", "reach", "1,2", "--world", "nowhere.ron"],
        &["query", "distance", "--robot", "reach", "--input", "nowhere.ron"],
        &["record", "--world", "nowhere.ron"],
        &["record", "--script", "nowhere.ron"],
        &["record", "--resume", "nowhere.ron"],
        &["verify", "nowhere.ron"],
        &["info", "nowhere.ron"],
    ] {
        let error = run(arguments).failed(3);
        assert!(error.contains("nowhere.ron: ") && error.lines().count() >= 2, "{arguments:?}: {error}");
    }
}

/// Without a command, the program's features decide what it does.
#[cfg(feature = "headless")]
#[test]
fn the_tour_is_recorded_replayed_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let tour = run_in(folder.path(), &[]);
    assert_eq!(tour.code, Some(0), "{}", tour.err);
    let lines: Vec<&str> = tour.out.lines().collect();
    for (line, start) in lines.iter().zip(["robot ", "Rusty  x ", "Reach  theta1 ", "Hitch  x ", "digest "]) {
        assert!(line.starts_with(start), "{line}");
    }
    assert_eq!(lines[5..], ["1200 of 1200 ticks bit-identical"]);
    for said in
        ["wrote runs/tour-2005.mcap\n", "wrote runs/tour-2005.svg\n", "motion-lab --help", "verify, export, draw"]
    {
        assert!(tour.err.contains(said), "{said}: {}", tour.err);
    }
    let recorded = run(&["record"]).done();
    assert_eq!(recorded.lines().collect::<Vec<_>>(), lines[..5], "the tour is what `record` records by itself");
    let log = folder.path().join("runs/tour-2005.mcap");
    assert!(run(&["verify", log.to_str().unwrap()]).done().contains(lines[4]));
    let figure = std::fs::read_to_string(folder.path().join("runs/tour-2005.svg")).unwrap();
    assert!(figure.starts_with("<svg") && figure.trim_end().ends_with("</svg>"));
    assert!(figure.contains(lines[4].trim_start_matches("digest ")), "the figure tells the digest");
}

#[cfg(all(feature = "window", not(feature = "headless"), target_os = "linux"))]
#[test]
fn no_display_is_6_and_names_what_works_without() {
    let ended = ended(command(&[]).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap());
    let error = ended.failed(6);
    assert!(error.lines().count() == 1 && error.contains("motion-lab --help"), "{error}");
}

#[cfg(not(any(feature = "window", feature = "headless")))]
#[test]
fn without_features_it_prints_its_help() {
    assert!(run(&[]).done().contains("Usage:"));
}
