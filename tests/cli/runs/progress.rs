//! How far a command has come, on a terminal.

use std::fs;

use crate::cli::program::habits::folder;
use crate::cli::{ended, run_in};

/// A line of a terminal without the sequences that steer it.
fn without_sequences(line: &str) -> String {
    let mut parts = line.split("\u{1b}[");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |line, part| {
        line + part.trim_start_matches(|c: char| !c.is_ascii_alphabetic()).get(1..).unwrap_or("")
    })
}

/// What runs for long says how far it has come, where standard error is a terminal.
#[test]
fn progress_with_rate_and_time_left_is_shown_on_a_terminal() {
    let there = std::process::Command::new("script").arg("--version").output().is_ok_and(|o| o.status.success());
    if !there {
        println!("skipped: without the program `script` there is no terminal to show progress on");
        return;
    }
    let folder = folder();
    fs::write(folder.path().join("poses.jsonl"), "[3,5.5]\n".repeat(500)).unwrap();
    let ahead = "Script(version: 1, events: [(tick: 1, robot: \"Hitch\", input: Drive(128, 0)), \
                 (tick: 14, robot: \"Hitch\", input: Drive(0, 0))])";
    fs::write(folder.path().join("wait.ron"), ahead).unwrap();
    let exam = "Assignment(version: 1, world: \"lot\", robot: \"Hitch\", start: [6.5, 2.5, 0], \
                goal: (at: [7.5, 2.5, 0], within: [0.11, 0.1, 0.1]), \
                stay: (at: end), limits: (ticks: 60), seeds: \"0..9\")";
    fs::write(folder.path().join("exam.ron"), exam).unwrap();
    for i in 0..12 {
        fs::copy(folder.path().join("run.mcap"), folder.path().join(format!("copy{i}.mcap"))).unwrap();
    }
    let at_columns = |columns: u32, arguments: &str| {
        let line = format!("stty rows 24 cols {columns}; {} {arguments}", env!("CARGO_BIN_EXE_motion-lab"));
        let mut script = std::process::Command::new("script");
        let run = ended(script.args(["-qec", &line, "/dev/null"]).current_dir(folder.path()).output().unwrap());
        assert_eq!(run.code, Some(0), "{}", run.out);
        run.out
    };
    let at_terminal = |arguments: &str| at_columns(120, arguments);
    for (arguments, unit) in [
        ("record --ticks 300", "300 ticks"),
        ("record --seeds 0..9 --ticks 60", "9 seeds"),
        ("verify run.mcap", "40 ticks"),
        ("replay run.mcap", "40 ticks"),
        ("export run.mcap -o run.gif", "11 pictures"),
        ("capture --widget dashboard --run run.mcap -o film.gif", "11 pictures"),
        ("capture --widget dashboard --run run.mcap -o still.svg", "40 ticks"),
        ("capture --widget cspace --cells 7 -o cells.svg", " cells, as known"),
        ("export run.mcap -o viewer.mcap", "82 steps, two a frame"),
        ("export run.mcap --format rerun -o rerun.mcap", "82 steps, two a frame"),
        ("record --ticks 900 -o long.mcap", "900 ticks"),
        ("diff long.mcap long.mcap", " MiB"),
        ("stats run.mcap", "40 ticks"),
        ("plot run.mcap --what speed -o speed.svg", "40 ticks"),
        ("grade exam.ron wait.ron", "540 ticks"),
        ("query distance --robot rusty --input poses.jsonl", "3.91 KiB"),
        ("stats copy*.mcap", "12 files"),
        ("verify copy*.mcap", "12 files"),
    ] {
        let shown = at_terminal(arguments);
        assert!(shown.contains(unit) && shown.contains("/s, ") && shown.contains(" left"), "{arguments}: {shown:?}");
        // not its beginning and its end alone
        if let Ok(all) = unit.split(' ').next().unwrap().parse::<u64>() {
            let parts: Vec<&str> = shown.split(&format!(" of {unit}")).collect();
            let mut done = parts
                .iter()
                .filter_map(|part| part.rsplit(|c: char| !c.is_ascii_digit()).next().unwrap().parse::<u64>().ok());
            assert!(done.any(|done| (1..all).contains(&done)), "{arguments}: {shown:?}");
        }
        // each line of it fits a terminal of 40 columns
        let narrow = at_columns(40, arguments);
        assert!(narrow.contains(unit) && narrow.contains(" left"), "{arguments}: {narrow:?}");
        let drawn = narrow.split(['\r', '\n']).map(without_sequences);
        let drawn: Vec<String> = drawn.filter(|drawn| drawn.contains("/s, ")).collect();
        assert!(!drawn.is_empty(), "{arguments}: {narrow:?}");
        for bar in drawn {
            // the bar fills its line, and the terminal begins the next one
            let (line, counts) = bar.split_once(" left").unwrap();
            assert_eq!(line.chars().count() + " left".len(), 40, "{arguments}: {bar:?}");
            assert!(counts.trim_end().chars().count() <= 40, "{arguments}: {bar:?}");
        }
        let quiet = at_terminal(&format!("{arguments} --quiet"));
        assert!(!quiet.contains("/s, ") && !quiet.contains(" left"), "{arguments}: {quiet:?}");
    }
    // no line of the output stands behind what is left of the bar, and none is lost
    let shown = at_terminal("grade exam.ron wait.ron");
    let rows: Vec<&str> = shown.split('\n').filter(|line| line.contains("passed")).collect();
    // the bar's line is cleared, and the cursor goes back up to it
    let begins = |row: &&str| {
        let before = row.split("wait.ron ").next().unwrap();
        before.rsplit("\u{1b}[2K").next().unwrap().replace("\u{1b}[1A", "").is_empty()
    };
    assert!(rows.len() == 9 && rows.iter().all(begins), "{rows:?}");
    // and what goes to a pipe has no bar in it
    let piped = run_in(folder.path(), &["query", "distance", "--robot", "rusty", "--input", "poses.jsonl"]);
    assert_eq!((piped.err.as_str(), piped.out.lines().count()), ("", 500));
}
