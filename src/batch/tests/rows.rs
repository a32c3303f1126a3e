//! Rows: what they say of runs, and their columns.

use std::collections::BTreeSet;

use super::super::*;
use super::study;
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{Recipe, RunDigest};

/// The run of a row, as the command makes it.
pub fn run(study: &Study, row: u64) -> RunRow {
    let setup = match study.setup(row) {
        Ok(setup) => setup,
        Err(reason) => return study.failed(row, &reason),
    };
    let RunSetup { seed, config, inputs: RunInputs::Script(script), .. } = setup else { panic!("no planner here") };
    let recipe = Recipe::new(config, (seed, script));
    let mut run = Recorder::of(&recipe).unwrap();
    let mut digest = RunDigest::new(&recipe, run.frame());
    let mut gatherer = RowGatherer::new(study, row, &recipe.config, &recipe.script);
    gatherer.see(run.frame());
    while !run.is_complete() {
        let frame = run.step();
        digest.tick(frame);
        gatherer.see(frame);
    }
    gatherer.row(run.frame(), digest.digest(), run.refusals())
}

pub fn cell(study: &Study, row: &RunRow, name: &str) -> RowValue {
    row.cell(study.columns(), name).unwrap_or_else(|| panic!("{name}: {}", study.heading())).clone()
}

#[test]
fn a_row_says_what_became_of_its_run() {
    // straight ahead at 1.5 m/s for 2 s, in an aisle with room before it
    let text = "Sweep(version: 1, worlds: [\"lot\"], script: \"a.ron\", ticks: 40, \
                goal: (robot: \"Hitch\", at: [9, 2.5, 0], within: [0.5, 0.1, 0.1]), \
                axes: [(vary: \"Hitch.start\", over: Starts([[6.5, 2.5, 0], [9000, 9000, 0], [6.5, 2.5, 3.14159], [20000, 2, 0]]))])";
    let study = study(text);
    let [ahead, away, back, beyond] = [0, 1, 2, 3].map(|row| run(&study, row));
    let number = |row: &RunRow, name| match cell(&study, row, name) {
        RowValue::Number(x) => x,
        other => panic!("{name}: {other:?}"),
    };
    assert!((number(&ahead, "path_m") - 3.0).abs() < 1e-9 && (number(&ahead, "Hitch.end.x_m") - 9.5).abs() < 1e-9);
    // 0.075 m a tick: from 8.5 m on, in rounding's reach, which is 26.67 ticks on
    assert_eq!(number(&ahead, "first_at_goal_s"), 0.05 * 27.0);
    assert!((number(&ahead, "at_goal_s") - 0.7).abs() < 0.051);
    assert_eq!(cell(&study, &ahead, "failure"), RowValue::Empty);
    assert_eq!(cell(&study, &ahead, "Hitch.contacts"), RowValue::Whole(0));
    assert_eq!(cell(&study, &ahead, "Hitch.first_contact_s"), RowValue::Empty);
    assert!(!ahead.is_failure(study.columns()) && !ahead.has_contacts(study.columns()));
    assert_eq!(cell(&study, &back, "failure"), RowValue::Text("the goal was not reached".into()));
    assert_eq!(cell(&study, &back, "first_at_goal_s"), RowValue::Empty);
    assert!(back.is_failure(study.columns()));
    assert_eq!(cell(&study, &away, "digest"), cell(&study, &run(&study, 1), "digest"));
    let reason = cell(&study, &beyond, "failure");
    assert!(matches!(&reason, RowValue::Text(reason) if reason.starts_with("Hitch.start: ")), "{reason:?}");
    assert_eq!(
        (cell(&study, &beyond, "digest"), cell(&study, &beyond, "contacts")),
        (RowValue::Empty, RowValue::Empty)
    );
    for row in [ahead, away, back, beyond] {
        assert_eq!(row.cells.len(), study.columns().len());
        assert_eq!(RunRow::of_line(&row.to_line(), study.columns()), Some(row));
    }
}

#[test]
fn the_first_contact_is_the_tick_at_which_the_car_meets_the_wall() {
    let text = "Sweep(version: 1, worlds: [\"lot\"], script: \"a.ron\", ticks: 200, \
                axes: [(vary: \"Hitch.start.x\", over: Values([6.5, 7.25]))])";
    let study = study(text);
    let rows = [0, 1].map(|row| run(&study, row));
    let at = rows.each_ref().map(|row| match (cell(&study, row, "first_contact_s"), cell(&study, row, "contacts")) {
        (RowValue::Number(at), RowValue::Whole(1)) => at,
        other => panic!("{other:?}"),
    });
    // 0.75 m less at 1.5 m/s is half a second, ten ticks
    assert!((at[0] - at[1] - 0.5).abs() < 1e-9, "{at:?}");
    assert!(rows.iter().all(|row| row.has_contacts(study.columns())));
}

#[test]
fn a_plan_comes_back_from_its_line_and_comments_are_no_part_of_it() {
    let text = "Sweep(version: 1, worlds: [\"lot\"], script: \"a.ron\", sensor: (rays: 9, range: 0.1), ticks: 3,\n\
                goal: (robot: \"Hitch\", at: [1, 2, 0.1], within: [1, 1, 1]), points: Sample(count: 9, seed: 2), \
                axes: [(vary: \"Hitch.start.x\", over: Uniform(6, 7)), (vary: \"seed\", over: Range(0, 18446744073709551615))])";
    let first = study(text);
    let again = Study::of_line(first.line()).unwrap();
    assert_eq!((again.line(), again.digest(), again.columns()), (first.line(), first.digest(), first.columns()));
    assert!((0..9).all(|row| again.setup(row) == first.setup(row)));
    let commented = text.replace("ticks: 3,", "/* short */ ticks : 3, // so\n");
    assert_eq!(study(&commented).digest(), first.digest());
    assert_ne!(study(&text.replace("ticks: 3", "ticks: 4")).digest(), first.digest());
    assert!(Study::of_line(&first.line().replace("motion-lab sweep 1", "motion-lab sweep 2")).is_err());
}

#[test]
fn columns_have_names_of_their_own_and_end_with_their_units() {
    let text = "Sweep(version: 1, axes: [(vary: \"ticks\", over: Range(1, 3)), (vary: \"Rusty.noise.lambda_short\", over: Values([1])), \
                (vary: \"Hitch.start\", over: Starts([[7, 2, 0]])), (vary: \"sensor.rays\", over: Values([3]))])";
    let study = study(text);
    let names: Vec<&str> = study.columns().iter().map(|column| column.name.as_str()).collect();
    assert_eq!(
        names[..9],
        [
            "row",
            "seed",
            "ticks",
            "Rusty.noise.lambda_short_per_m",
            "Hitch.start.x_m",
            "Hitch.start.y_m",
            "Hitch.start.theta_rad",
            "Hitch.start.psi_rad",
            "sensor.rays",
        ]
    );
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
    for column in study.columns() {
        assert!(
            column.unit.is_empty() || column.name == column.unit || column.name.ends_with(&format!("_{}", column.unit))
        );
        assert!(!column.about.is_empty());
    }
}

#[test]
fn a_goal_whose_robot_is_elsewhere_is_not_reached() {
    let study = study(
        "Sweep(version: 1, ticks: 2, goal: (robot: \"Rusty\", at: [2, 2, 0], within: [99, 99, 4]), \
         axes: [(vary: \"world\", over: Names([\"apartment\", \"lot\"]))])",
    );
    let [apartment, lot] = [0, 1].map(|row| run(&study, row));
    assert_eq!(cell(&study, &apartment, "failure"), RowValue::Empty);
    assert_eq!(cell(&study, &lot, "failure"), RowValue::Text("the goal's robot is not in this run".into()));
    assert_eq!(cell(&study, &lot, "at_goal_s"), RowValue::Empty);
}

#[test]
fn the_docs_list_every_column_with_its_unit_and_kind() {
    let docs = include_str!("../../../docs/formats.md");
    let section = docs.split("\n## ").find(|part| part.starts_with("The tables of sweeps")).unwrap();
    let mut listed = BTreeSet::new();
    for line in section.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        listed.extend(cells[1].split(", ").map(|name| (name.trim_matches('`').to_owned(), cells[2], cells[3])));
    }
    let all = "Sweep(version: 1, worlds: [\"apartment\", \"workbench\", \"lot\"], goal: (robot: \"Rusty\", at: [1, 1, 1], within: [1, 1, 1]))";
    let planned = |robot: &str, at: &str| {
        format!("Sweep(version: 1, robots: [{robot:?}], planner: (), goal: (robot: {robot:?}, at: {at}, within: {at}))")
    };
    let studies = [study(all), study(&planned("Rusty", "[1, 1, 1]")), study(&planned("Reach", "[1, 1]"))];
    let robots = ["Rusty.", "Reach.", "Hitch."];
    let general = |name: &str| match robots.iter().find_map(|robot| name.strip_prefix(robot)) {
        Some(of_robot) => format!("ROBOT.{of_robot}"),
        None => name.to_owned(),
    };
    let kind = |kind| match kind {
        CellKind::Whole => "whole",
        CellKind::Number => "number",
        CellKind::Text => "text",
    };
    let of_problems = super::of_problems().unwrap();
    let filed = [
        ("Paired(world: \"lot\", robot: \"hitch\", starts: [[4, 2, 0]], goals: [[9, 2, 0]])", "Hitch", "[0, 0, 0]"),
        ("Generated(of: Circles(robot: \"reach3\"), count: 1)", "Reach", "[0, 0, 0]"),
    ];
    let filed = filed.map(|(sets, robot, at)| super::of_robot(sets, robot, at));
    let columns = studies.iter().chain([&of_problems]).chain(&filed).flat_map(Study::columns);
    let written: BTreeSet<_> =
        columns.map(|column| (general(&column.name), column.unit.as_str(), kind(column.kind))).collect();
    assert_eq!(listed, written);
}

#[test]
fn what_came_of_planning_stands_before_the_digest() {
    let text = "Sweep(version: 1, robots: [\"Rusty\"], planner: (iterations: 7), ticks: 3, \
                goal: (robot: \"Rusty\", at: [4.5, 2, 1], within: [1, 1, 4]), \
                axes: [(vary: \"planner\", over: Names([\"rrt\", \"prm\"])), (vary: \"planner.tube\", over: Values([0, 2]))])";
    let study = study(text);
    let planning = |row| study.setup(row).map(|setup| setup.inputs);
    let expected = Planning {
        planner: Some("prm".into()),
        goal: vec![4.5, 2.0, 1.0],
        iterations: Some(7),
        tube: 0.0,
        clearance: None,
    };
    assert_eq!(planning(2), Ok(RunInputs::Planner(expected)));
    assert_eq!(planning(1), Err("planner.tube: 2 m: it must be from 0 to 1 m".into()));
    let path = PlannedPath { length: 4.5, clearance: f64::INFINITY, time: Some(8.05) };
    let planned = PlanningResult { iterations: 3, edges: 12, path: Some(path) };
    let row = study.with_planned(study.failed(2, "why"), &planned);
    let names = ["solved", "iterations", "edges", "planned_path_m", "planned_clearance_m", "planned_time_s", "digest"];
    let cells = [
        RowValue::Whole(1),
        RowValue::Whole(3),
        RowValue::Whole(12),
        RowValue::Number(4.5),
        RowValue::Empty,
        RowValue::Number(8.05),
        RowValue::Empty,
    ];
    assert_eq!(names.map(|name| cell(&study, &row, name)), cells);
    assert_eq!(RunRow::of_line(&row.to_line(), study.columns()), Some(row));
    // a study without a planner is the line that it was, and its rows have no such cells
    let other = super::study("Sweep(version: 1, worlds: [\"lot\"])");
    assert!(!other.line().contains("planner"));
    assert_eq!(other.with_planned(other.failed(0, "why"), &planned), other.failed(0, "why"));
}
