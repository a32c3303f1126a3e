//! `sweep`: what a row claims is compared with its run and its study, cell by cell.

use std::fs;
use std::path::Path;

use super::folder_with;
use crate::cli::{Run, SHUT, run_in};

/// Three runs to a goal; the third starts outside the world.
const STUDY: &str = "Sweep(version: 1, worlds: [\"lot\"], ticks: 20,
    goal: (robot: \"Hitch\", at: [6.5, 2.5, 0], within: [9, 9, 3.2]),
    axes: [(vary: \"Hitch.start\", over: Starts([[6.5, 2.5, 0], [6.75, 2.5, 0], [900, 2.5, 0]]))])";

/// Writes a part whose rows are these lines, with the head of another and the right seal.
fn forge(part: &str, rows: &[String], to: &Path) {
    let head: String = part.split_inclusive('\n').take(4).collect();
    let text = format!("{head}{}\n", rows.join("\n"));
    let seal = xxhash_rust::xxh3::xxh3_128(text.as_bytes());
    fs::write(to, format!("{text}seal {seal:032x}\n")).unwrap();
}

/// A cell with another value of its kind.
fn other(cell: &str) -> String {
    match cell.parse::<f64>() {
        Ok(x) => (x + 1.0).to_string(),
        Err(_) if cell.is_empty() => "7".into(),
        Err(_) => format!("{cell}0").replacen('0', "1", 1),
    }
}

#[test]
fn reproduce_finds_every_forged_cell_and_merge_those_that_the_study_decides() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    let part = fs::read_to_string(at.join("parts/part-1-of-1.sweep")).unwrap();
    let lines: Vec<String> = part.lines().map(str::to_owned).collect();
    let (names, rows) = (lines[3].split(',').collect::<Vec<_>>(), &lines[4..7]);
    let reproduce =
        |file: &str, row: &str| -> Run { run_in(at, &["sweep", "reproduce", file, "--row", row, "-o", "again.mcap"]) };
    assert_eq!(reproduce("parts/part-1-of-1.sweep", "1").code, Some(0));
    let cells: Vec<&str> = rows[1].split(',').collect();
    assert!(cells.len() == names.len() && !rows[1].contains('"'), "{}", rows[1]);
    // the first cell is the row's number, which the part itself checks
    let (mut found, mut refused) = (0, Vec::new());
    for (i, name) in names.iter().enumerate().skip(1) {
        let mut forged = cells.clone();
        let value = other(cells[i]);
        forged[i] = &value;
        forge(&part, &[rows[0].clone(), forged.join(","), rows[2].clone()], &at.join("forged.sweep"));
        let differs = reproduce("forged.sweep", "1");
        assert_eq!(differs.code, Some(4), "{name}: {}{}", differs.out, differs.err);
        assert!(differs.out.starts_with(&format!("row 1 differs: {name} ")), "{}", differs.out);
        found += 1;
        let merged = run_in(at, &["sweep", "merge", "forged.sweep", "-o", "all.csv"]);
        if merged.code == Some(3) {
            assert!(
                merged.err.contains(&format!("row 1 has {name} ")) && !at.join("all.csv").exists(),
                "{}",
                merged.err
            );
            refused.push(*name);
        } else {
            fs::remove_file(at.join("all.csv")).unwrap();
        }
    }
    assert!(found >= 17, "{found}");
    assert_eq!(
        refused,
        ["seed", "ticks", "Hitch.start.x_m", "Hitch.start.y_m", "Hitch.start.theta_rad", "Hitch.start.psi_rad"]
    );
    // a run that could not be is said to have been, and one that was not to have been
    for (row, claims) in [(2, &rows[1]), (1, &rows[2])] {
        let mut claimed = rows.to_vec();
        let (own, other): (Vec<&str>, Vec<&str>) = (rows[row].split(',').collect(), claims.split(',').collect());
        let joined: Vec<&str> = own[..7].iter().chain(&other[7..]).copied().collect();
        claimed[row] = joined.join(",");
        forge(&part, &claimed, &at.join("forged.sweep"));
        let differs = reproduce("forged.sweep", &row.to_string());
        assert_eq!(differs.code, Some(4), "{row}: {}{}", differs.out, differs.err);
    }
}

#[test]
fn what_lies_outside_the_world_is_refused_by_name_and_more_than_a_turn_is_noted() {
    let study =
        |rest: &str| format!("Sweep(version: 1, worlds: [\"apartment\"], robots: [\"Rusty\"], ticks: 4, {rest})");
    for (rest, said) in [
        (
            "goal: (robot: \"Rusty\", at: [99.75, 6.25, 0], within: [0.05, 0.05, 3])",
            "goal: the goal (99.75, 6.25) lies outside the world, which reaches from ",
        ),
        ("axes: [(vary: \"Rusty.start.x\", over: Values([-5, 100]))]", "Rusty: the start (-5, "),
        ("axes: [(vary: \"Rusty.disc.radius\", over: Values([110]))]", "Rusty: a diameter of 220 m: the world is "),
        ("axes: [(vary: \"Rusty.start.x\", over: Values([\"90deg\"]))]", "degrees are for angles, and this is none"),
        ("axes: [(vary: \"Rusty.start\", over: Starts([[\"3deg\", 5.5, 0]]))]", "coordinate 0 is a length in metres"),
    ] {
        let folder = folder_with(&study(rest));
        let refused = run_in(folder.path(), &["sweep", "plan.ron", "--check"]).failed(3);
        assert!(refused.contains(said), "{said}: {refused}");
    }
    // where some runs can be, the others are rows that say why they can't
    let folder = folder_with(&study("axes: [(vary: \"Rusty.start.x\", over: Values([3, 100]))]"));
    run_in(folder.path(), &["sweep", "plan.ron", "-o", "parts"]).done();
    let part = fs::read_to_string(folder.path().join("parts/part-1-of-1.sweep")).unwrap();
    assert!(part.contains("the start (100, ") && part.matches("lies outside the world").count() == 1, "{part}");

    let turned = |values: &str| {
        let folder = folder_with(&study(&format!("axes: [(vary: \"Rusty.start.theta\", over: {values})]")));
        let ran = run_in(folder.path(), &["sweep", "plan.ron", "-o", "parts"]);
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        run_in(folder.path(), &["sweep", "merge", "parts", "-o", "all.csv"]).done();
        let table = fs::read_to_string(folder.path().join("all.csv")).unwrap();
        let thetas: Vec<String> =
            table.lines().skip(1).map(|line| line.split(',').nth(3).unwrap().to_owned()).collect();
        (ran.err, thetas)
    };
    let (said, _) = turned("Values([0, 90, 180])");
    assert!(
        said.contains("plan.ron: Rusty.start.theta: 90 rad is 14.3 turns; angles are radians; write \"90deg\""),
        "{said}"
    );
    let (said, thetas) = turned("Values([0, \"90deg\", \"-45deg\"])");
    assert!(!said.contains("turns"), "{said}");
    assert_eq!(thetas, ["0", "1.5707963267948966", "-0.7853981633974483"]);
    let (_, thetas) = turned("Steps(\"0deg\", \"90deg\", 3)");
    assert_eq!(thetas, ["0", "0.7853981633974483", "1.5707963267948966"]);
}

#[test]
fn a_goal_that_lies_in_one_of_the_worlds_is_refused_in_the_rows_of_the_other() {
    let folder = folder_with(
        "Sweep(version: 1, robots: [\"R\"], ticks: 4, goal: (robot: \"R\", at: [7, 1, 0], within: [0.1, 0.1, 3]),
        axes: [(vary: \"world\", over: Names([\"small.ron\", \"large.ron\"]))])",
    );
    for (name, width) in [("small", 4), ("large", 8)] {
        let bounds = format!("max: ({width}, 4)");
        fs::write(folder.path().join(format!("{name}.ron")), SHUT.replace("max: (4, 4)", &bounds)).unwrap();
    }
    let ran = run_in(folder.path(), &["sweep", "plan.ron", "-o", "parts"]).done();
    // nobody drives to the other goal
    assert!(ran.contains("2 failed, of which 1 without a run"), "{ran}");
    run_in(folder.path(), &["sweep", "merge", "parts", "-o", "all.csv"]).done();
    let table = fs::read_to_string(folder.path().join("all.csv")).unwrap();
    let rows: Vec<&str> = table.lines().skip(1).collect();
    let said = "R: the goal (7, 1) lies outside the world, which reaches from (0, 0) to (4, 4)";
    assert_eq!(rows.iter().map(|row| row.contains(said)).collect::<Vec<_>>(), [true, false], "{table}");
}

#[test]
fn a_table_with_a_flipped_bit_is_refused_whoever_reads_it() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    let said = run_in(at, &["sweep", "verify", "all.parquet", "parts/part-1-of-1.sweep"]).done();
    assert_eq!(said.matches("3 rows, as they were sealed").count(), 2, "{said}");
    let same = run_in(at, &["sweep", "verify", "all.parquet", "--csv", "all.csv"]).done();
    assert_eq!(same, "3 rows, the same in both and as they were sealed\n");
    // the last digit of a digest, as a value stands in the file
    let table = fs::read(at.join("all.parquet")).unwrap();
    let csv = fs::read_to_string(at.join("all.csv")).unwrap();
    let (heading, row) = csv.split_once('\n').unwrap();
    let digest = heading.split(',').position(|name| name == "digest").unwrap();
    let digest = row.split(',').nth(digest).unwrap();
    assert_eq!(digest.len(), 32);
    let place = table.windows(32).position(|bytes| bytes == digest.as_bytes()).unwrap();
    let mut flipped = table.clone();
    flipped[place + 31] ^= 1;
    fs::write(at.join("flipped.parquet"), &flipped).unwrap();
    for arguments in [
        &["sweep", "verify", "flipped.parquet"][..],
        &["sweep", "verify", "flipped.parquet", "--csv", "all.csv"],
        &["sweep", "report", "flipped.parquet", "-o", "page.html"],
        &["sweep", "reproduce", "flipped.parquet", "--row", "1", "-o", "again.mcap"],
    ] {
        let refused = run_in(at, arguments).failed(3);
        assert!(refused.contains("flipped.parquet: it is damaged: its seal is not that of its rows"), "{refused}");
        assert!(refused.contains("`sweep merge`"), "{refused}");
    }
    assert!(!at.join("page.html").exists() && !at.join("again.mcap").exists());
    // a line of the table for others: another digit, one too many, one too few
    let last = csv.trim_end().rfind('\n').unwrap() + 1;
    for (text, line) in [
        (csv.replacen(&digest[..31], &format!("{}x", &digest[..30]), 1), "line 2"),
        (format!("{csv}\n"), "line 5"),
        (csv[..last].to_owned(), "line 4"),
        (csv.replacen("seed", "Seed", 1), "line 1"),
    ] {
        fs::write(at.join("other.csv"), text).unwrap();
        let differs = run_in(at, &["sweep", "verify", "all.parquet", "--csv", "other.csv"]);
        assert_eq!(
            (differs.code, &*differs.out),
            (Some(4), &*format!("other.csv: {line} is not as all.parquet has it\n"))
        );
    }
    let alone = run_in(at, &["sweep", "verify", "all.csv"]).failed(3);
    assert!(alone.contains("--csv"), "{alone}");
    // a part has a seal of its own
    let part = fs::read_to_string(at.join("parts/part-1-of-1.sweep")).unwrap();
    fs::write(at.join("damaged.sweep"), part.replacen(digest, &digest.replace(&digest[..1], "x"), 1)).unwrap();
    run_in(at, &["sweep", "verify", "damaged.sweep"]).failed(3);
}
