//! `sweep` of a study with a planner: the path that `plan` finds, the run that its script drives.

use std::fs;

use motion_lab::planning::Progress;
use motion_lab::prelude::*;
use motion_lab::robots::RUSTY;

use super::{folder_with, interrupted, names};
use crate::cli::{json, run_in};

/// Reach goes round the post by two planners, at three seeds, with two bounds: with 3 iterations there is no path.
pub const PLAN: &str = "Sweep(version: 1, worlds: [\"workbench\"], ticks: 600, planner: (name: \"rrt-connect\"),
    goal: (robot: \"Reach\", at: [3.1, 0], within: [0.001, 0.001]),
    axes: [
        (vary: \"planner\", over: Names([\"rrt-connect\", \"prm\"])),
        (vary: \"planner.iterations\", over: Values([3, 1000])),
        (vary: \"seed\", over: Range(7, 10)),
        (vary: \"Reach.start\", over: Starts([[2, 0], [0.785, 0.785]])),
    ])";

/// The rows of a table, a cell by its column's name.
pub fn rows(table: &str) -> Vec<impl Fn(&str) -> String> {
    let names: Vec<String> = table.lines().next().unwrap().split(',').map(str::to_owned).collect();
    let row = |line: &str| {
        // a comma between quotation marks belongs to its cell
        let quoted = line.split('"').enumerate();
        let parts: Vec<String> =
            quoted.map(|(i, part)| if i % 2 == 1 { part.replace(',', ";") } else { part.into() }).collect();
        let cells: Vec<String> = parts.concat().split(',').map(str::to_owned).collect();
        let names = names.clone();
        move |name: &str| cells[names.iter().position(|n| n == name).unwrap_or_else(|| panic!("{name}"))].clone()
    };
    table.lines().skip(1).map(row).collect()
}

#[test]
fn a_row_is_the_path_that_plan_finds_and_the_run_that_its_script_drives() {
    let folder = folder_with(PLAN);
    let at = folder.path();
    let swept = run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    assert!(swept.contains("24 runs, 24 of them made now; 18 failed, of which 18 without a run"), "{swept}");
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
    let table = fs::read_to_string(at.join("all.csv")).unwrap();
    let rows = rows(&table);
    let world = run_in(at, &["world", "show", "workbench"]).done();
    let (mut solved, mut bounded, mut in_contact) = (0, 0, 0);
    for row in &rows {
        let (planner, seed, iterations) = (row("planner"), row("seed"), row("planner.iterations"));
        // the world with another start, as the axis has it
        let start = [row("Reach.start.theta1_rad"), row("Reach.start.theta2_rad")].join(", ");
        let (before, after) = world.split_once("start: [").unwrap();
        let (_, after) = after.split_once(']').unwrap();
        fs::write(at.join("world.ron"), format!("{before}start: [{start}]{after}")).unwrap();
        let arguments = ["plan", "--planner", &planner, "--robot", "Reach", "--world", "world.ron", "--to", "3.1,0"];
        let more = ["--seed", &seed, "--iterations", &iterations, "--json", "--script", "path.ron"];
        let alone = run_in(at, &[&arguments[..], &more].concat());
        let answer = json(alone.out.lines().next().unwrap());
        assert_eq!(row("solved"), if answer["solved"] == true { "1" } else { "0" }, "{}", alone.err);
        if answer["solved"] == false {
            // the reason is that of `study`
            assert_eq!(row("failure"), answer["reason"].as_str().unwrap().replace(',', ";"));
            assert_eq!((row("digest"), row("planned_path_rad"), row("contacts")), Default::default());
            bounded += u64::from(row("iterations") == "3");
            in_contact += u64::from(row("iterations") == "0" && row("edges") == "0");
            let kind = if row("iterations") == "3" { "exhausted" } else { "no-problem" };
            assert_eq!(row("failure_kind"), kind, "{}", row("failure"));
            continue;
        }
        solved += 1;
        for (column, found) in [
            ("iterations", &answer["effort"]["iterations"]),
            ("edges", &answer["effort"]["edges"]),
            ("planned_path_rad", &answer["length"]),
            ("planned_clearance_m", &answer["clearance"]),
        ] {
            assert_eq!(row(column).parse::<f64>().unwrap(), found.as_f64().unwrap(), "{column}");
        }
        // the run is that of the script that `study` writes
        let record = ["record", "--world", "world.ron", "--script", "path.ron", "--seed", &seed];
        run_in(at, &[&record[..], &["--ticks", "600", "-o", "run.mcap"]].concat()).done();
        let info = json(&run_in(at, &["info", "--json", "run.mcap"]).done());
        assert_eq!(info["digest"], row("digest").as_str(), "{planner} at {seed}");
        assert_eq!([row("contacts"), row("failure"), row("failure_kind")], ["0", "", ""]);
        assert_eq!(row("first_at_goal_s").parse::<f64>().unwrap(), row("planned_time_s").parse::<f64>().unwrap());
    }
    assert_eq!((rows.len(), solved, bounded, in_contact), (24, 6, 6, 12));
    // a log is made again by planning again
    let number = rows.iter().position(|row| row("solved") == "1").unwrap().to_string();
    run_in(at, &["sweep", "reproduce", "all.parquet", "--row", &number, "-o", "again.mcap"]).done();
    run_in(at, &["verify", "again.mcap"]).done();
    run_in(at, &["sweep", "report", "all.parquet", "-o", "all.html"]).done();
    let page = fs::read_to_string(at.join("all.html")).unwrap();
    assert!(page.contains("no link: a planner makes its script") && page.contains("planned path, rad of 6 runs goes"));
    run_in(at, &["sweep", "plan.ron", "-o", "parts", "--keep", "all"]).done();
    assert_eq!(names(&at.join("parts/logs")).len(), 6);
}

#[test]
fn a_path_is_the_same_whether_no_run_plays_it_or_one_as_long_as_it_is() {
    let table = |ticks: &str| {
        let folder = folder_with(&PLAN.replace("ticks: 600, ", ticks));
        let at = folder.path();
        run_in(at, &["sweep", "plan.ron", "-o", "parts", "--keep", "all"]).done();
        run_in(at, &["sweep", "merge", "parts", "-o", "all.csv", "-o", "all.parquet"]).done();
        (fs::read_to_string(at.join("all.csv")).unwrap(), folder)
    };
    let ((long, _long), (alone, at), (fitting, _fitting)) =
        (table("ticks: 600, "), table(""), table("ticks: Planned, "));
    let mut solved = Vec::new();
    for ((long, alone), fitting) in rows(&long).iter().zip(rows(&alone)).zip(rows(&fitting)) {
        let planned = ["planner", "seed", "solved", "iterations", "edges", "planned_path_rad", "planned_clearance_m"];
        for column in planned {
            assert_eq!((long(column), long(column)), (alone(column), fitting(column)), "{column}");
        }
        for column in ["ticks", "contacts", "least_clearance_m", "path_m", "at_goal_s", "planned_time_s", "digest"] {
            assert_eq!(alone(column), "", "{column}");
        }
        assert_eq!(fitting("ticks"), "");
        if long("solved") == "0" {
            assert_eq!((long("failure"), long("failure")), (alone("failure"), fitting("failure")));
            continue;
        }
        solved.push(alone("row"));
        assert_eq!((alone("failure"), fitting("failure")), Default::default());
        // it ends when the robot is at the goal: then it is there for no longer than the last tick
        assert_eq!(
            (fitting("planned_time_s"), fitting("first_at_goal_s")),
            (long("planned_time_s"), long("first_at_goal_s"))
        );
        assert_eq!(fitting("at_goal_s"), "0.05");
        assert!(long("at_goal_s").parse::<f64>().unwrap() > 10.0);
        for column in ["path_m", "least_clearance_m", "Reach.end.theta1_rad", "Reach.end.theta2_rad"] {
            assert_eq!(fitting(column), long(column), "{column}");
        }
        assert!(!fitting("digest").is_empty() && fitting("digest") != long("digest"));
    }
    assert_eq!(solved.len(), 6);
    assert!(!at.path().join("parts/logs").exists() || names(&at.path().join("parts/logs")).is_empty());
    let again = run_in(at.path(), &["sweep", "reproduce", "all.parquet", "--row", &solved[0]]).done();
    assert!(again.contains("is reproduced: no run plays its path"), "{again}");
    assert!(!names(at.path()).contains(&format!("{}.mcap", solved[0])));
    let report = run_in(at.path(), &["sweep", "report", "all.parquet", "-o", "all.html"]);
    assert_eq!(report.code, Some(0), "{}", report.err);
}

#[test]
fn a_rover_and_a_car_are_planned_for_and_driven() {
    for (world, robot, at, within) in [
        ("apartment", "Rusty", "[4.5, 2, 0]", "[0.03, 0.03, 4]"),
        ("lot", "Hitch", "[6.75, 7, -1.5707963]", "[0.1, 0.1, 0.05]"),
    ] {
        let study = format!(
            "Sweep(version: 1, worlds: [\"{world}\"], planner: (), ticks: 600, \
             goal: (robot: \"{robot}\", at: {at}, within: {within}), axes: [(vary: \"seed\", over: Range(1, 3))])"
        );
        let folder = folder_with(&study);
        let at = folder.path();
        run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
        run_in(at, &["sweep", "merge", "parts", "-o", "all.csv"]).done();
        let table = fs::read_to_string(at.join("all.csv")).unwrap();
        for row in rows(&table) {
            assert_eq!((row("solved").as_str(), row("failure").as_str()), ("1", ""), "{robot}: {table}");
            assert_eq!(row(&format!("{robot}.contacts")), "0");
            // the robot drives about as far as its path is long: a rover turns on the spot, and slips
            let [planned, driven] = ["planned_path_m", "path_m"].map(|name| row(name).parse::<f64>());
            let (planned, driven) = (planned.unwrap(), driven.unwrap());
            assert!(planned > 3.0 && (planned - driven).abs() < 0.02 * planned, "{robot}: {planned} {driven}");
        }
    }
}

#[test]
fn a_planner_without_anything_to_do_is_refused_where_the_plan_names_it() {
    let goal = "goal: (robot: \"Rusty\", at: [4.5, 2, 0], within: [1, 1, 4])";
    for (study, place, reason) in [
        ("planner: (name: \"rrt-3\")", ":2:", "there is no planner \"rrt-3\"; there are rrt-connect, rrt, "),
        ("planner: ()", ":2:", "it needs a goal"),
        ("ticks: Planned", ":1:1", "planner: there is none whose path could say the ticks"),
        ("ticks: Never", ":2:", "a number of ticks, or Planned"),
        ("ticks: -5", ":2:", "a number of ticks, or Planned"),
        (&format!("planner: (), {goal}, script: \"s.ron\""), ":2:", "planner: the study has a script too"),
        (&format!("{goal}, axes: [(vary: \"planner\", over: Names([\"rrt\"]))]"), ":2:", "the study has no planner"),
        (
            &format!("planner: (), {goal}, axes: [(vary: \"script\", over: Names([\"s.ron\"]))]"),
            ":2:",
            "it would change nothing: the planner makes the script",
        ),
        (&format!("planner: (), worlds: [\"apartment\", \"lot\"], {goal}"), ":1:1", "write robots: [\"Rusty\"]"),
        (
            &format!("planner: (tube: 2), robots: [\"Rusty\"], {goal}"),
            ":1:1",
            "planner.tube: 2 m: it must be from 0 to 1 m",
        ),
        (
            &format!("planner: (clearance: -1), robots: [\"Rusty\"], {goal}"),
            ":1:1",
            "planner.clearance: -1 m: it must be from 0 to 100 m",
        ),
    ] {
        let folder = folder_with(&format!("Sweep(version: 1,\n{study})"));
        fs::write(folder.path().join("s.ron"), "Script(version: 1, events: [])").unwrap();
        let said = run_in(folder.path(), &["sweep", "plan.ron", "--check"]).failed(3);
        assert!(said.contains(&format!("plan.ron{place}")) && said.contains(reason), "{study}: {said}");
    }
    // a car does not take a planner of straight lines: each of its rows says so
    let folder = folder_with(
        "Sweep(version: 1, worlds: [\"lot\"], ticks: 20, planner: (name: \"rrt\"), \
         goal: (robot: \"Hitch\", at: [6.75, 7, 0], within: [1, 1, 1]))",
    );
    run_in(folder.path(), &["sweep", "plan.ron", "-o", "parts"]).done();
    let part = fs::read_to_string(folder.path().join("parts/part-1-of-1.sweep")).unwrap();
    assert!(part.contains("it plans straight lines, which no car can drive"), "{part}");
}

#[test]
fn rrt_star_shortens_its_path_up_to_the_iterations_of_its_row() {
    let folder = folder_with(
        "Sweep(version: 1, worlds: [\"apartment\"], robots: [\"Rusty\"], ticks: 1, planner: (name: \"rrt-star\"), \
         goal: (robot: \"Rusty\", at: [9.75, 6.25, 0], within: [1, 1, 4]), \
         axes: [(vary: \"planner.iterations\", over: Values([1500, 3000]))])",
    );
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv"]).done();
    let table = fs::read_to_string(at.join("all.csv")).unwrap();
    let rows = rows(&table);
    let [few, many] = [0, 1].map(|i| (rows[i]("iterations"), rows[i]("planned_path_m").parse::<f64>().unwrap()));
    assert_eq!((few.0.as_str(), many.0.as_str()), ("1500", "3000"));
    assert!(many.1 < few.1, "{few:?} {many:?}");
}

#[cfg(unix)]
#[test]
fn a_planner_at_work_is_stopped() {
    // a goal behind a wall, and more iterations than anybody waits for
    let folder = folder_with(
        "Sweep(version: 1, worlds: [\"shut.ron\"], planner: (name: \"rrt\", iterations: 1000000000), \
         goal: (robot: \"R\", at: [3, 1, 0], within: [1, 1, 4]))",
    );
    fs::write(folder.path().join("shut.ron"), crate::cli::SHUT).unwrap();
    let begin = std::time::Instant::now();
    let stopped = interrupted(folder.path(), &["sweep", "plan.ron", "-o", "parts"], "-INT", || {
        begin.elapsed().as_millis() > 1000
    });
    assert_eq!(stopped.code, Some(75), "{}", stopped.err);
    assert!(stopped.err.contains("stopped with 0 of 1 row done\nThe same command goes on."), "{}", stopped.err);
}

/// Walks by a sensor with this noise, from the start and to the goal of the study below.
fn walked(sigma_hit: f64, seed: u64) -> (u64, f64) {
    use motion_lab::configuration::AnyConfiguration;
    use motion_lab::plans::{PlannerName, Task};
    use motion_lab::robots::AnyRobot;
    use motion_lab::worlds::{BeamModel, World};
    let [start, goal] =
        [[3.0, 6.25, 0.0], [9.75, 6.25, 0.0]].map(|[x, y, theta]| AnyConfiguration::Pose(Pose2::new(x, y, theta)));
    let task = Task::new("Rusty", AnyRobot::Rusty(RUSTY), World::apartment(), [start, goal]);
    let task = Task { noise: Some(BeamModel { sigma_hit, ..BeamModel::EXACT }), ..task };
    let mut attempt = task.attempt(PlannerName::Bug1Sensor, Seed(seed)).unwrap();
    while attempt.step() == Progress::Growing {}
    (attempt.effort().iterations, attempt.lengths().length)
}

#[test]
fn a_planner_that_walks_by_its_sensor_reads_the_noise_of_its_robot() {
    let folder = folder_with(
        "Sweep(version: 1, worlds: [\"apartment\"], robots: [\"Rusty\"], planner: (name: \"bug1-sensor\"),
            goal: (robot: \"Rusty\", at: [9.75, 6.25, 0], within: [0.5, 0.5, 3.2]),
            axes: [(vary: \"Rusty.start\", over: Starts([[3, 6.25, 0]])),
                (vary: \"Rusty.noise.sigma_hit\", over: Values([0, 0.1])), (vary: \"seed\", over: Range(0, 2))])",
    );
    let at = folder.path();
    run_in(at, &["sweep", "plan.ron", "-o", "parts"]).done();
    run_in(at, &["sweep", "merge", "parts", "-o", "all.csv"]).done();
    let text = fs::read_to_string(at.join("all.csv")).unwrap();
    let table = rows(&text);
    let mut lengths = Vec::new();
    for (row, (sigma_hit, seed)) in table.iter().zip([(0.0, 0), (0.0, 1), (0.1, 0), (0.1, 1)]) {
        let (iterations, length) = walked(sigma_hit, seed);
        assert_eq!(
            (row("iterations"), row("planned_path_m")),
            (iterations.to_string(), length.to_string()),
            "{sigma_hit}"
        );
        lengths.push(length);
    }
    // an exact sensor knows no seed, and noise changes the way
    assert!(lengths.len() == 4 && lengths[0] == lengths[1] && lengths[2] != lengths[0], "{lengths:?}");
}

#[test]
fn the_examples_are_plans_whose_runs_can_be() {
    for (name, runs) in [("noise.ron", 1000), ("planners.ron", 300), ("problems.ron", 252)] {
        let study = format!("{}/examples/sweeps/{name}", env!("CARGO_MANIFEST_DIR"));
        let listed = run_in(&std::env::temp_dir(), &["sweep", &study, "--check"]);
        assert!(listed.err.contains(&format!("{runs} runs, varying ")), "{}", listed.err);
        assert!(listed.err.contains("; 0 of those listed can't be run"), "{}", listed.err);
    }
}
