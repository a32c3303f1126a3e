//! How far a command has come, on a terminal.

use std::fs;

use crate::cli::program::habits::folder;
use crate::cli::{ended, run_in};

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
    let at_terminal = |arguments: &str| {
        let line = format!("stty cols 120; {} {arguments}", env!("CARGO_BIN_EXE_motion-lab"));
        let mut script = std::process::Command::new("script");
        let run = ended(script.args(["-qec", &line, "/dev/null"]).current_dir(folder.path()).output().unwrap());
        assert_eq!(run.code, Some(0), "{}", run.out);
        run.out
    };
    for (arguments, unit) in [
        ("record --ticks 300", "300 ticks, "),
        ("record --seeds 0..9 --ticks 60", "9 seeds, "),
        ("verify run.mcap", "40 ticks, "),
        ("replay run.mcap", "40 ticks, "),
        ("export run.mcap -o run.gif", "11 pictures, "),
        ("capture --widget dashboard --run run.mcap -o film.gif", "11 pictures, "),
        ("capture --widget dashboard --run run.mcap -o still.svg", "40 ticks, "),
        ("capture --widget cspace --cells 7 -o cells.svg", " cells, as far as is known, "),
        ("export run.mcap -o viewer.mcap", "82 frames, each drawn and written, "),
        ("export run.mcap --format rerun -o rerun.mcap", "82 frames, each drawn and written, "),
        ("record --ticks 900 -o long.mcap", "900 ticks, "),
        ("diff long.mcap long.mcap", " MiB, "),
        ("stats run.mcap", "40 ticks, "),
        ("plot run.mcap --what speed -o speed.svg", "40 ticks, "),
        ("grade exam.ron wait.ron", "540 ticks, "),
        ("query distance --robot rusty --input poses.jsonl", "3.91 KiB, "),
        ("stats copy*.mcap", "12 files, "),
        ("verify copy*.mcap", "12 files, "),
    ] {
        let shown = at_terminal(arguments);
        assert!(shown.contains(unit) && shown.contains("/s, ") && shown.contains(" left"), "{arguments}: {shown:?}");
        // not its beginning and its end alone
        if let Ok(all) = unit.split(' ').next().unwrap().parse::<u64>() {
            let parts: Vec<&str> = shown.split(&format!(" of {unit}")).collect();
            let mut done = parts.iter().filter_map(|part| part.rsplit(' ').next().unwrap().parse::<u64>().ok());
            assert!(done.any(|done| (1..all).contains(&done)), "{arguments}: {shown:?}");
        }
        let quiet = at_terminal(&format!("{arguments} --quiet"));
        assert!(!quiet.contains(unit) && !quiet.contains(" left"), "{arguments}: {quiet:?}");
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
