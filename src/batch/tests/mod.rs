//! Plans, points, rows and parts.

mod by_log;
mod filed;
mod files;
mod problems;
mod rows;
mod studies;
mod varied;

use super::*;
use motion_lab_core::worlds::World;
use motion_lab_import::Scenario;
use motion_lab_sim::run::{Event, RobotInput, Script};

fn try_plan(text: &str) -> Result<Study, StudyError> {
    let file = StudyFile::parse("study.ron", text)?;
    let worlds = file.world_names().into_iter().filter_map(|name| Some((name.to_owned(), World::built_in(name)?)));
    // a.ron goes straight ahead, b.ron steers by a unit, ..
    let drive = |name: &str| RobotInput::Drive(128, i16::from(name.as_bytes()[0]) - i16::from(b'a'));
    let script = |name| Script::new(vec![Event { tick: 1, robot: "Hitch".into(), input: drive(name) }], vec![]);
    let scripts = file.script_names().into_iter().map(|name| (name.to_owned(), script(name)));
    file.with(&worlds.collect(), &scripts.collect())
}

fn study(text: &str) -> Study {
    try_plan(text).unwrap()
}

/// A yard of 8 x 4 cells of half a metre, whose lower left corner is (1, 2), and of another one of 2 m at the origin.
fn yard(corner: [f64; 2], size: [f64; 2]) -> World {
    let [x, y] = corner;
    let text = format!(
        "World(version: 1, name: \"yard\", bounds: (min: ({x}, {y}), max: ({}, {})), obstacles: [], robots: [\
         (name: \"Rusty\", kind: \"rusty\", start: [{}, {}, 0.5]), \
         (name: \"Reach\", kind: \"reach\", start: [0.1, 0.1], \
         arm: (base: ({}, {}), lengths: [0.4, 0.4], radius: 0.03))])",
        x + size[0],
        y + size[1],
        x + 1.0,
        y + 1.0,
        x + 1.0,
        y + 1.0
    );
    World::parse("yard.ron", &text).unwrap()
}

const SCENARIO: &str = "version 1\n0\ty.map\t8\t4\t0\t0\t7\t3\t8.24264069\n3\ty.map\t8\t4\t5\t2\t1\t3\t4.5\n";

/// A study of the problems of a scenario.
fn try_problems(more: &str, axes: &str) -> Result<Study, StudyError> {
    let text = format!(
        "Sweep(version: 1, worlds: [\"half.ron\"], ticks: 2, {more}
         axes: [{axes}(vary: \"problem\", over: Problems(\"y.map.scen\"))])"
    );
    let file = StudyFile::parse("study.ron", &text)?;
    assert_eq!(file.scenario_names().into_iter().collect::<Vec<_>>(), ["y.map.scen"]);
    let worlds = [
        ("half.ron".to_owned(), yard([1.0, 2.0], [4.0, 2.0])),
        ("two.ron".to_owned(), yard([0.0, 0.0], [16.0, 8.0])),
        ("other.ron".to_owned(), yard([0.0, 0.0], [8.0, 5.0])),
    ];
    let scenario = Scenario::parse("y.map.scen", SCENARIO).unwrap();
    file.with_scenarios([("y.map.scen".to_owned(), scenario)].into()).with(&worlds.into(), &[].into())
}

const GOAL: &str =
    "robots: [\"Rusty\"], planner: (), goal: (robot: \"Rusty\", at: [0, 0, 1.5], within: [0.1, 0.1, 4]),";

/// A study of two problems, of Rusty.
fn of_problems() -> Result<Study, StudyError> {
    try_problems(GOAL, "")
}

/// A problem file of these sets, which may name the lot.
fn filed_bundle(sets: &str) -> ProblemBundle {
    let file = ProblemFile::parse("p.ron", &format!("Problems(version: 1, sets: [{sets}])")).unwrap();
    file.bundle(&[("lot".to_owned(), World::lot())].into(), &[].into())
}

/// A study of the problems of such a file.
fn try_filed(sets: &str, more: &str, axes: &str) -> Result<Study, String> {
    let text = format!("Sweep(version: 1, {more} axes: [{axes}(vary: \"problem\", over: Problems(\"p.ron\"))])");
    let file = StudyFile::parse("study.ron", &text).map_err(|error| error.to_string())?;
    assert!(file.problem_file_names().into_iter().eq(["p.ron"]) && file.scenario_names().is_empty());
    let worlds = file.world_names().into_iter().map(|name| (name.to_owned(), World::built_in(name).unwrap()));
    let worlds = worlds.collect();
    let file = file.with_problems([("p.ron".to_owned(), filed_bundle(sets))].into());
    file.with(&worlds, &[].into()).map_err(|error| error.to_string())
}

/// A study of these problems, for a robot with as many tolerances.
fn of_robot(sets: &str, robot: &str, at: &str) -> Study {
    let more = format!("robots: [{robot:?}], planner: (), goal: (robot: {robot:?}, at: {at}, within: {at}),");
    try_filed(sets, &more, "").unwrap()
}
