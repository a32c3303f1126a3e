//! `sweep`: the same bytes from any number of jobs and shards, stops and goes on, merges and repeats.

mod care;
pub mod planner;
mod problems;
mod report;
mod trust;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::{Run, command, ended, json, run_in};

/// Sixty short runs, ten of them with a start that is none.
const PLAN: &str = "Sweep(version: 1, worlds: [\"apartment\", \"lot\"], ticks: 20, sensor: (rays: 8, range: 2),
    goal: (robot: \"Rusty\", at: [3, 6.25, 0], within: [0.1, 0.1, 3.2]),
    axes: [
        (vary: \"seed\", over: Range(0, 10)),
        (vary: \"Rusty.start.x\", over: Values([3, 2.5, 20000])),
        (vary: \"Rusty.noise.sigma_hit\", over: Values([0, 0.02])),
    ])";

/// The names of the files in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = entries.collect();
    names.sort();
    names
}

fn folder_with(study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("plan.ron"), study).unwrap();
    folder
}

/// A folder with a study of four runs of a car that drives for two seconds: the second meets a wall, the third can't
/// be.
fn folder_with_a_drive() -> tempfile::TempDir {
    let folder = folder_with(
        "Sweep(version: 1, worlds: [\"lot\"], script: \"drive.ron\", ticks: 100,
        axes: [(vary: \"Hitch.start\", over: Starts([[6.5, 2.5, 0], [6.5, 2.5, 1.57], [20000, 1, 0], [7.5, 2.5, 0]]))])",
    );
    let drive = "Script(version: 1, events: [(tick: 1, robot: \"Hitch\", input: Drive(128, 0)), \
                 (tick: 41, robot: \"Hitch\", input: Drive(0, 0))])";
    fs::write(folder.path().join("drive.ron"), drive).unwrap();
    folder
}

/// Starts the program, and interrupts it by a signal as soon as `begun` says so, or after 100 s.
#[cfg(unix)]
fn interrupted(at: &Path, arguments: &[&str], signal: &str, mut begun: impl FnMut() -> bool) -> Run {
    let mut program = command(arguments);
    let child = program.current_dir(at).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begin = Instant::now();
    while !begun() && begin.elapsed() < Duration::from_secs(100) {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
    ended(child.wait_with_output().unwrap())
}

/// Both tables of the parts in these folders.
fn merged(folder: &Path, parts: &[&str]) -> (Vec<u8>, Vec<u8>) {
    run_in(folder, &[&["sweep", "merge"], parts, &["-o", "all.csv", "-o", "all.parquet"]].concat()).done();
    (fs::read(folder.join("all.csv")).unwrap(), fs::read(folder.join("all.parquet")).unwrap())
}

#[test]
fn any_number_of_jobs_and_any_sharding_gives_the_same_bytes() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "--jobs", "1", "-o", "one"]).done();
    run_in(at, &["sweep", "plan.ron", "--jobs", "3"]).done();
    assert_eq!(names(&at.join("plan.sweep")), ["part-1-of-1.sweep"], "no journal stays");
    let part = |folder: &str| fs::read(at.join(folder).join("part-1-of-1.sweep")).unwrap();
    assert!(part("one") == part("plan.sweep"), "jobs");
    for of in [3, 7] {
        for number in 1..=of {
            let shard = format!("{number}/{of}");
            run_in(at, &["sweep", "plan.ron", "--shard", &shard, "-o", &format!("of{of}"), "--jobs", "2"]).done();
        }
    }
    let whole = merged(at, &["one"]);
    for other in [&["of3"][..], &["of7"], &["of7", "of3", "one", "of3/part-2-of-3.sweep"]] {
        assert!(merged(at, other) == whole, "{other:?}");
    }
    let table = String::from_utf8(whole.0).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 61);
    let head = "row,seed,ticks,Rusty.start.x_m,Rusty.noise.sigma_hit_m,failure,failure_kind,contacts,";
    assert!(lines[0].starts_with(head), "{}", lines[0]);
    assert!(lines[1].starts_with("0,0,20,3,0,,,0,,") && lines[60].starts_with("59,9,20,20000,0.02,\"Rusty.start.x: "));
    assert_eq!(lines.iter().filter(|line| line.contains("Rusty.start.x: ")).count(), 20);
    assert_eq!(lines.iter().filter(|line| line.contains("the goal was not reached")).count(), 20);
}

#[test]
fn a_row_is_the_run_that_record_records_and_reproduce_repeats() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    merged(at, &["parts"]);
    let out = run_in(at, &["sweep", "reproduce", "all.parquet", "--row", "42", "-o", "42.mcap"]).done();
    let table = fs::read_to_string(at.join("all.csv")).unwrap();
    let line = table.lines().nth(43).unwrap();
    let digest = out.trim().rsplit(' ').next().unwrap();
    assert!(out.starts_with("row 42 is reproduced: digest ") && line.contains(digest), "{out}{line}");
    run_in(at, &["verify", "42.mcap"]).done();
    let stats = json(&run_in(at, &["stats", "--json", "42.mcap"]).done());
    let names: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let cells: Vec<&str> = line.split(',').collect();
    let cell = |name: &str| cells[names.iter().position(|n| *n == name).unwrap()];
    for (i, robot) in ["Rusty", "Hitch"].into_iter().enumerate() {
        let stat = &stats["robots"][i];
        for (column, key) in
            [("path_m", "path_m"), ("least_clearance_m", "least_clearance_m"), ("contacts", "contacts")]
        {
            let expected = stat[key].to_string();
            let found = cell(&format!("{robot}.{column}"));
            assert_eq!(found.parse::<f64>().unwrap(), expected.parse::<f64>().unwrap(), "{robot} {column}");
        }
    }
    // a part holds its study, too; a row of another digest is refused
    let part = at.join("parts/part-1-of-1.sweep");
    run_in(at, &["sweep", "reproduce", part.to_str().unwrap(), "--row", "42", "-o", "again.mcap"]).done();
    assert!(fs::read(at.join("again.mcap")).unwrap() == fs::read(at.join("42.mcap")).unwrap());
    let text = fs::read_to_string(&part).unwrap();
    let (rows, _) = text.rsplit_once("seal ").unwrap();
    let forged = rows.replace(digest, "00112233445566778899aabbccddeeff");
    // where the seal is not that of the rows, the part is at fault and not the run
    fs::write(at.join("damaged.sweep"), text.replace(digest, "00112233445566778899aabbccddeeff")).unwrap();
    let damaged = run_in(at, &["sweep", "reproduce", "damaged.sweep", "--row", "42", "-o", "none.mcap"]).failed(3);
    assert!(damaged.contains("damaged.sweep") && !at.join("none.mcap").exists(), "{damaged}");
    let seal = xxhash_rust::xxh3::xxh3_128(forged.as_bytes());
    fs::write(at.join("forged.sweep"), format!("{forged}seal {seal:032x}\n")).unwrap();
    let differs = run_in(at, &["sweep", "reproduce", "forged.sweep", "--row", "42"]);
    assert_eq!(differs.code, Some(4), "{}", differs.err);
    assert!(differs.out.contains(&format!("differs: digest {digest}, expected 0011")) && at.join("42.mcap").exists());
    let failed = run_in(at, &["sweep", "reproduce", "all.parquet", "--row", "4"]).done();
    assert!(failed.contains("row 4 could not be run") && !at.join("4.mcap").exists(), "{failed}");
    let beyond = run_in(at, &["sweep", "reproduce", "all.parquet", "--row", "60"]).failed(3);
    assert!(beyond.contains("there is no row 60: it has 60"), "{beyond}");
    let csv = run_in(at, &["sweep", "reproduce", "all.csv", "--row", "1"]).failed(3);
    assert!(csv.contains("does not hold its study"), "{csv}");
}

#[test]
fn a_report_shows_distributions_worst_runs_and_failures() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    merged(at, &["parts"]);
    run_in(at, &["sweep", "report", "all.parquet", "-o", "all.html"]).done();
    run_in(at, &["sweep", "report", "all.parquet", "-o", "all.svg"]).done();
    let (page, figure) = ["all.html", "all.svg"].map(|name| fs::read_to_string(at.join(name)).unwrap()).into();
    assert!(page.contains("<p>60 runs, 40 of them failed. Study ") && page.contains(&figure) && !page.contains("NaN"));
    assert!(page.contains("Varied: seed (10 values), Rusty.start.x (3 values), Rusty.noise.sigma_hit (2 values)."));
    // forty runs have a path; twenty reach their goal, at once
    for said in ["path, m of 40 runs goes from ", "least clearance, m of 40 runs goes from "] {
        assert!(figure.contains(said), "{said}");
    }
    assert!(figure.contains("first at goal, s is 0 in all of 20 runs."));
    let failures = &page[page.find("Failures, the first").unwrap()..];
    assert_eq!(failures.matches("<tr><td>").count(), 20);
    assert!(failures.contains("reproduce 'all.parquet' --row 2 &amp;&amp; motion-lab open 2.mcap"));
    assert!(failures.contains("<td>4</td>") && failures.contains("there was no run"));
    let worst = &page[page.find("Worst runs").unwrap()..page.find("Failures, the first").unwrap()];
    let clearance =
        |line: &str| line.split("<td>").nth(10).and_then(|cell| cell.split('<').next()?.parse::<f64>().ok());
    let listed: Vec<f64> = worst.lines().filter(|line| line.starts_with("<tr><td>")).filter_map(clearance).collect();
    let table = fs::read_to_string(at.join("all.csv")).unwrap();
    let column = table.lines().next().unwrap().split(',').position(|name| name == "least_clearance_m").unwrap();
    let cells =
        table.lines().skip(1).filter(|line| !line.contains('"')).map(|line| line.split(',').nth(column).unwrap());
    let mut all: Vec<f64> = cells.map(|cell| cell.parse().unwrap()).collect();
    all.sort_by(f64::total_cmp);
    assert_eq!(listed.len(), 20);
    assert!(listed.iter().zip(&all).all(|(shown, least)| (shown - least).abs() < 1e-6), "{listed:?} {all:?}");
    assert!(
        run_in(at, &["sweep", "report", "all.parquet", "-o", "all.pdf"])
            .failed(2)
            .contains("no report has this ending")
    );
    assert!(run_in(at, &["sweep", "report", "all.csv", "-o", "all.html"]).failed(3).contains("all.csv: "));
}

#[test]
fn a_merge_proves_that_every_row_is_there_once_and_of_one_plan() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    for number in ["1/4", "3/4"] {
        run_in(at, &["sweep", "plan.ron", "--shard", number, "-o", "parts"]).done();
    }
    let missing = run_in(at, &["sweep", "merge", "parts", "-o", "all.csv"]);
    assert_eq!((missing.code, missing.out.as_str()), (Some(3), "15..30\n45..60\n"), "{}", missing.err);
    assert!(missing.err.contains("30 of 60 rows are missing") && !at.join("all.csv").exists());
    fs::write(at.join("plan.ron"), PLAN.replace("ticks: 20", "ticks: 21")).unwrap();
    let other = run_in(at, &["sweep", "plan.ron", "--shard", "1/4", "-o", "parts"]).failed(3);
    assert!(other.contains("it is of another study"), "{other}");
    run_in(at, &["sweep", "plan.ron", "--shard", "2/4", "-o", "parts"]).done();
    let mixed = run_in(at, &["sweep", "merge", "parts"]).failed(3);
    assert!(mixed.contains("part-2-of-4.sweep: it is of another study"), "{mixed}");
    fs::remove_file(at.join("parts/part-2-of-4.sweep")).unwrap();
    fs::write(at.join("plan.ron"), PLAN).unwrap();
    run_in(at, &["sweep", "plan.ron", "-o", "whole"]).done();
    run_in(at, &["sweep", "merge", "parts", "whole"]).done();
    // the same row with another number in it, and the seal of those bytes
    let part = at.join("parts/part-1-of-4.sweep");
    let text = fs::read_to_string(&part).unwrap();
    let (rows, _) = text.rsplit_once("seal ").unwrap();
    let forged = rows.replacen("\n7,1,20,3,0.02,,,0,", "\n7,1,20,3,0.02,,,9,", 1);
    assert_ne!(forged, rows);
    let seal = xxhash_rust::xxh3::xxh3_128(forged.as_bytes());
    fs::write(&part, format!("{forged}seal {seal:032x}\n")).unwrap();
    let unequal = run_in(at, &["sweep", "merge", "parts", "whole", "-o", "all.csv"]).failed(3);
    assert!(unequal.contains("row 7 is not the same in ") && !at.join("all.csv").exists(), "{unequal}");
    fs::write(&part, &text[..text.len() - 40]).unwrap();
    let cut = run_in(at, &["sweep", "merge", "parts", "whole"]).failed(3);
    assert!(cut.contains("part-1-of-4.sweep: ") && cut.contains("damaged"), "{cut}");
    run_in(at, &["sweep", "merge", "plan.ron"]).failed(3);
    run_in(at, &["sweep", "merge", "whole", "-o", "all.txt"]).failed(2);
}

#[test]
fn the_same_command_goes_on_after_a_crash_and_skips_what_is_finished() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "whole"]).done();
    let part = fs::read_to_string(at.join("whole/part-1-of-1.sweep")).unwrap();
    // the journal of a process that died in the middle of a line: rows 5 and 2, and half of row 9
    let lines: Vec<&str> = part.lines().collect();
    let sealed = |row: usize| {
        // a wrong number, so that a row that is run again shows
        let line = lines[4 + row].replacen(",20,", ",77,", 1);
        format!("{:016x} {line}\n", xxhash_rust::xxh3::xxh3_64(line.as_bytes()))
    };
    let half = sealed(9);
    fs::create_dir(at.join("parts")).unwrap();
    let journal = format!("{}\n{}{}{}", lines[..4].join("\n"), sealed(5), sealed(2), &half[..half.len() / 2]);
    fs::write(at.join("parts/part-1-of-1.journal"), journal).unwrap();
    let resumed = run_in(at, &["sweep", "plan.ron", "-o", "parts"]);
    assert!(resumed.err.contains("2 of 60 rows are there already"), "{}", resumed.err);
    let made = fs::read_to_string(at.join("parts/part-1-of-1.sweep")).unwrap();
    let made: Vec<&str> = made.lines().collect();
    for row in 0..60 {
        let expected =
            if [2, 5].contains(&row) { lines[4 + row].replacen(",20,", ",77,", 1) } else { lines[4 + row].into() };
        assert_eq!(made[4 + row], expected, "row {row}");
    }
    let again = run_in(at, &["sweep", "plan.ron", "-o", "parts"]);
    assert!(again.out.contains("60 runs, finished before"), "{}", again.out);
    fs::write(at.join("plan.ron"), PLAN.replace("ticks: 20", "ticks: 21")).unwrap();
    fs::write(at.join("parts/part-1-of-2.journal"), format!("{}\n", lines[..4].join("\n"))).unwrap();
    let other = run_in(at, &["sweep", "plan.ron", "-o", "parts", "--shard", "1/2"]).failed(3);
    assert!(other.contains("part-1-of-2.journal: it is of another study"), "{other}");
}

#[cfg(unix)]
#[test]
fn a_signal_ends_it_with_75_and_what_was_done_is_kept() {
    let long = PLAN.replace("ticks: 20", "ticks: 20000").replace(", 20000]", "]");
    let folder = folder_with(&long);
    let at = folder.path();
    for (round, signal) in [(1, "-INT"), (2, "-TERM")] {
        let journal = at.join("parts/part-1-of-1.journal");
        let lines = || fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
        let before = lines().max(4);
        // until a row is there; the runs of this many ticks take a good part of a second
        let run = interrupted(at, &["sweep", "plan.ron", "--jobs", "2", "-o", "parts"], signal, || lines() > before);
        assert_eq!(run.code, Some(75), "{}", run.err);
        assert!(run.err.contains("of 40 rows done\nThe same command goes on."), "{}", run.err);
        assert!(lines() >= 4 + round, "{} lines", lines());
        assert_eq!(names(&at.join("parts")), ["part-1-of-1.journal"]);
    }
}

#[test]
fn full_logs_are_kept_of_the_runs_asked_for() {
    let folder = folder_with_a_drive();
    let at = folder.path();
    let kept = |keep: &str| {
        run_in(at, &["sweep", "plan.ron", "--keep", keep, "-o", keep]).done();
        let logs = at.join(keep).join("logs");
        if logs.exists() { names(&logs) } else { vec![] }
    };
    assert!(kept("none").is_empty());
    assert_eq!(kept("all"), ["0.mcap", "1.mcap", "3.mcap"]);
    // the car that turns off the aisle drives into the parked ones
    assert_eq!(kept("contacts"), ["1.mcap"]);
    assert!(kept("failures").is_empty(), "the run that can't be has no log");
    run_in(at, &["verify", "all/logs/1.mcap", "contacts/logs/1.mcap"]).done();
    let part = |keep: &str| fs::read(at.join(keep).join("part-1-of-1.sweep")).unwrap();
    for keep in ["all", "contacts", "failures"] {
        assert!(part(keep) == part("none"), "{keep}");
    }
}

#[test]
fn check_lists_estimate_measures_and_engines_name_their_shard() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    let listed = run_in(at, &["sweep", "plan.ron", "--check", "--shard", "2/20"]);
    let lines: Vec<&str> = listed.out.lines().collect();
    assert_eq!(
        lines[..3],
        ["row,seed,ticks,Rusty.start.x_m,Rusty.noise.sigma_hit_m,failure", "3,0,20,2.5,0.02,", { lines[2] }]
    );
    assert!(lines.len() == 4 && lines[2].starts_with("4,0,20,20000,0,\"Rusty.start.x: "), "{lines:?}");
    assert!(
        listed.err.contains("60 runs, varying seed (10), Rusty.start.x (3), Rusty.noise.sigma_hit (2); 2 of those")
    );
    assert_eq!(names(at), ["plan.ron"], "nothing was run");
    let estimate = run_in(at, &["sweep", "plan.ron", "--estimate", "--jobs", "2", "--keep", "all"]).done();
    for part in [
        "60 runs, 32 of them measured: ",
        " s of one processor, ",
        " with 2 jobs",
        " bytes of logs",
        "1 shard of ten minutes",
    ] {
        assert!(estimate.contains(part), "{part}: {estimate}");
    }
    assert_eq!(names(at), ["plan.ron"]);
    let engine = |variables: &[(&str, &str)], shard: &str| {
        let mut sweep = command(&["sweep", "plan.ron", "--shard", shard, "-o", "parts"]);
        ended(sweep.current_dir(at).envs(variables.iter().copied()).output().unwrap())
    };
    engine(&[("SLURM_ARRAY_TASK_ID", "2"), ("SLURM_ARRAY_TASK_COUNT", "9"), ("SLURM_ARRAY_TASK_MIN", "1")], "auto")
        .done();
    engine(&[("HQ_TASK_ID", "9")], "auto/9").done();
    engine(&[("JOB_COMPLETION_INDEX", "0")], "auto/9").done();
    assert_eq!(names(&at.join("parts")), ["part-1-of-9.sweep", "part-2-of-9.sweep", "part-9-of-9.sweep"]);
    let none = engine(&[], "auto").failed(2);
    assert!(none.contains("neither SLURM_ARRAY_TASK_ID, nor HQ_TASK_ID, nor JOB_COMPLETION_INDEX is set"), "{none}");
    assert!(engine(&[("HQ_TASK_ID", "3")], "auto").failed(2).contains("write auto/N"));
    for wrong in ["0/3", "4/3", "auto/0", "auto/x", "half"] {
        run_in(at, &["sweep", "plan.ron", "--shard", wrong]).failed(2);
    }
}
