//! Axes of the problems of a scenario.

use super::super::*;
use super::rows::{cell, run};
use super::{GOAL, of_problems, try_problems};
use motion_lab_core::worlds::World;

fn starts_and_goals(study: &Study) -> Vec<(Vec<f64>, Vec<f64>)> {
    let ends = |row| {
        let RunSetup { config, inputs, .. } = study.setup(row).unwrap();
        let RunInputs::Planner(planning) = inputs else { panic!("{inputs:?}") };
        (config.worlds[0].robots[0].start.clone(), planning.goal)
    };
    (0..study.runs()).map(ends).collect()
}

#[test]
fn a_problem_is_where_the_robot_starts_and_where_it_should_go() {
    let study = of_problems().unwrap();
    // cell (x, y) of a map of 4 rows has its middle at (x + 0.5, 4 - y - 0.5) cells from the lower left corner, (1, 2)
    assert_eq!(
        starts_and_goals(&study),
        [(vec![1.25, 3.75, 0.5], vec![4.75, 2.25, 1.5]), (vec![3.75, 2.75, 0.5], vec![1.75, 2.25, 1.5]),]
    );
    let names: Vec<&str> = study.columns()[3..10].iter().map(|column| column.name.as_str()).collect();
    let expected = "problem problem.bucket problem.start.x_m problem.start.y_m problem.goal.x_m problem.goal.y_m \
                    problem.optimal_m";
    assert_eq!(names.join(" "), expected);
    let row = study.failed(1, "made up").to_table_line();
    // 4.5 cells of half a metre
    assert!(row.starts_with("1,2005,2,2,3,3.75,2.75,1.75,2.25,2.25,made up,"), "{row}");
    // the study's line holds the scenario
    let again = Study::of_line(study.line()).unwrap();
    assert_eq!((again.digest(), starts_and_goals(&again)), (study.digest(), starts_and_goals(&study)));
}

#[test]
fn each_world_has_the_problems_in_its_own_scale() {
    let worlds = "(vary: \"world\", over: Names([\"half.ron\", \"two.ron\", \"other.ron\"])), ";
    let study = try_problems(GOAL, worlds).unwrap();
    let start = |row| study.setup(row).map(|setup| setup.config.worlds[0].robots[0].start.clone());
    assert_eq!(start(0).unwrap(), [1.25, 3.75, 0.5]);
    assert_eq!(start(2).unwrap(), [1.0, 7.0, 0.5], "cells of 2 m");
    let refused = "y.map.scen: 8 x 4 cells do not fill the world's bounds, 8 x 5 m";
    assert_eq!(start(4), Err(refused.into()));
    let row = study.failed(4, "none").to_table_line();
    assert!(row.starts_with("4,2005,2,other.ron,1,0,,,,,,none,"), "{row}");
}

#[test]
fn a_goal_of_a_row_is_watched() {
    // without a planner nobody drives it there, so it is at the goal where it starts there
    let goal = "robots: [\"Rusty\"], goal: (robot: \"Rusty\", at: [0, 0, 0], within: [3.1, 1.1, 4]),";
    let study = try_problems(goal, "").unwrap();
    let at_goal = |row| cell(&study, &run(&study, row), "first_at_goal_s");
    // 3.5 m and 1.5 m apart, then 2 m and 0.5 m
    assert_eq!((at_goal(0), at_goal(1)), (RowValue::Empty, RowValue::Number(0.0)));
}

#[test]
fn problems_without_a_robot_that_has_them_are_refused() {
    let refused = |more: &str, axes: &str| try_problems(more, axes).unwrap_err().to_string();
    assert!(refused("", "").contains("it would change nothing: the study has no goal"), "{}", refused("", ""));
    let arm = "robots: [\"Reach\"], goal: (robot: \"Reach\", at: [1, 1], within: [1, 1]),";
    assert!(refused(arm, "").ends_with("it would change nothing: a reach does not go from place to place"));
    for start in
        ["(vary: \"Rusty.start.x\", over: Values([2])), ", "(vary: \"Rusty.start\", over: Starts([[2, 3, 0]])), "]
    {
        assert!(refused(GOAL, start).ends_with("axes[0] varies the same"), "{}", refused(GOAL, start));
    }
    // a heading is no part of a problem
    let turned = try_problems(GOAL, "(vary: \"Rusty.start.theta\", over: Values([2])), ").unwrap();
    assert_eq!(starts_and_goals(&turned)[0].0, [1.25, 3.75, 2.0]);
    let values = |vary: &str, over: &str| {
        let text = format!("Sweep(version: 1, {GOAL} axes: [(vary: {vary:?}, over: {over})])");
        StudyFile::parse("study.ron", &text).unwrap()
    };
    let apartment = [("apartment".to_owned(), World::apartment())].into();
    let error = |file: StudyFile| file.with(&apartment, &[].into()).unwrap_err().to_string();
    let names = error(values("problem", "Names([\"y.map.scen\"])"));
    assert!(names.ends_with("names do not fit: it takes Problems(\"FILE\")"), "{names}");
    let seeds = error(values("seed", "Problems(\"y.map.scen\")"));
    assert!(seeds.contains("problems do not fit: it takes Range(FROM, TO)"), "{seeds}");
    let missing = error(values("problem", "Problems(\"y.map.scen\")"));
    assert!(missing.ends_with("there is no scenario \"y.map.scen\""), "{missing}");
}
