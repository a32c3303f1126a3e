//! Grading with a kind of robot of a program's own.

use motion_lab::configuration::RobotKind;
use motion_lab::prelude::*;
use motion_lab::recording::{
    Assignment, AssignmentError, AssignmentFile, AssignmentProblem, AttemptOutcome, Refusal, Run, RunError, Submission,
};
use motion_lab::run::{Event, Log, RobotInput, Script};
use motion_lab::simulation::{App, RobotPlugin, SpawnError};
use motion_lab::tour::TourConfig;
use motion_lab::worlds::{Resident, World};

use super::examples::custom_robot::{ABOUT, TRAIN, with_trains};

/// An event of a script.
fn event(tick: u64, robot: &str, input: RobotInput) -> Event {
    Event { tick, robot: robot.into(), input }
}

/// A train that faces west, a whisker short of half a turn, has to go a metre ahead and to face west from the other
/// side of half a turn: 3.2 mrad away, by the short way round.
const EXAM: &str = "Assignment(version: 1, world: \"lot\", robot: \"Train\", start: [11, 2, 3.14, 3.14, 3.14],
    goal: (at: [10, 2, -3.14, -3.14, -3.14], within: [0.1, 0.1, 0.01, 0.01, 0.01]),
    limits: (ticks: 60, contacts: 0, reversals: 1), seeds: [1, 2005])";

fn lot(kind: &str) -> World {
    let mut world = World::lot();
    world.robots = vec![Resident::new("Train", kind, [8.0, 1.9, 0.0, 0.0, 0.0])];
    world
}

fn exam(text: &str) -> Result<Assignment, AssignmentError> {
    AssignmentFile::parse("exam.ron", text).unwrap().in_world_with_robots(lot(ABOUT.name), with_trains)
}

/// A script that drives the train at these speeds, each from its tick on.
fn driving(speeds: &[(u64, i16)]) -> Script {
    let events = speeds.iter().map(|&(tick, speed)| event(tick, "Train", RobotInput::Drive(speed, 0)));
    Script::new(events.collect(), vec![])
}

fn verdicts(assignment: &Assignment, script: Script) -> Vec<AttemptOutcome> {
    let grade = assignment.grade(&Submission::Script(script));
    assert_eq!(grade.refusal, None);
    grade.attempts.iter().map(|attempt| attempt.verdict).collect()
}

#[test]
fn a_kind_of_ones_own_is_graded_by_its_own_description() {
    let assignment = exam(EXAM).unwrap();
    assert_eq!((assignment.kind(), assignment.about()), ("x-train", Some(&ABOUT)));
    assert_eq!(assignment, assignment.clone());
    assert_ne!(assignment, exam(EXAM).unwrap(), "made with another function");
    // headings are compared the short way round
    let grade = assignment.grade(&Submission::Script(driving(&[(1, 128)])));
    assert!(grade.passed(), "{grade:?}");
    // at a metre a second it comes within 0.1 m of the goal after 0.9 s
    assert!(grade.attempts.iter().all(|a| (18..=19).contains(&a.tick) && a.configuration.len() == 5), "{grade:?}");
    assert_eq!(verdicts(&assignment, driving(&[(1, -16)])), [AttemptOutcome::Missed; 2]);
    // there and back and there: one time too many it changes between forward and backward
    assert_eq!(verdicts(&assignment, driving(&[(1, 64), (5, -64), (9, 64)])), [AttemptOutcome::Reversals; 2]);
    assert_eq!(verdicts(&assignment, driving(&[(1, -64), (5, 128)])), [AttemptOutcome::Passed; 2], "once is allowed");
}

#[test]
fn its_own_footprint_decides_where_start_and_goal_may_be() {
    // the second trailer ends 2.3 m behind the car's axle
    let touched = |x: &str| exam(&EXAM.replace("[11, 2", &format!("[{x}, 2")));
    assert!(touched("13.69").is_ok());
    let error = touched("13.71").unwrap_err();
    assert_eq!(error.to_string(), "exam.ron:1:61: start: there the robot touches the east curb");
    let error = exam(&EXAM.replace("at: [10, 2", "at: [1.49, 2")).unwrap_err();
    assert_eq!(error.to_string(), "exam.ron:2:11: goal: there the robot touches the west curb");
}

/// The train's run at this seed, driven by this script from the assignment's start.
fn recorded(assignment: &Assignment, script: Script) -> Log {
    let config = TourConfig { worlds: vec![assignment.world().clone()], ticks: 25, sensor: None };
    Run::record_with_robots(config, (Seed(9), script), with_trains).unwrap()
}

#[test]
fn logs_of_a_kind_of_ones_own_are_graded_and_forged_ones_found() {
    let assignment = exam(EXAM).unwrap();
    let log = recorded(&assignment, driving(&[(1, 128)]));
    let graded = |log: Log| assignment.grade(&Submission::Log(Box::new(log)));
    assert!(graded(log.clone()).passed());
    let mut forged = log.clone();
    forged.frames_mut()[11].robots[0].configuration[4] += 1e-12;
    let grade = graded(forged);
    let Some(Refusal::Forged(difference)) = grade.refusal else { panic!("{grade:?}") };
    assert!(difference.first_tick() == 12 && difference.to_string().contains("configuration[4]"), "{difference}");

    // an assignment that does not know trains
    let ahead = "Assignment(version: 1, world: \"lot\", robot: \"Hitch\", goal: (at: [11, 2.5, 0], within: [1, 1, 1]),
        limits: (ticks: 9), seeds: [1])";
    let plain = AssignmentFile::parse("plain.ron", ahead).unwrap().in_world(World::lot()).unwrap();
    let refusal = plain.grade(&Submission::Log(Box::new(log))).refusal.unwrap();
    assert!(matches!(&refusal, Refusal::Run(RunError::Spawn(SpawnError::UnknownKind { .. }))), "{refusal:?}");
}

#[test]
fn a_kind_that_is_missing_or_another_is_refused() {
    let parsed = |text: &str| AssignmentFile::parse("exam.ron", text).unwrap();
    let error = parsed(EXAM).in_world(lot(ABOUT.name)).unwrap_err();
    let AssignmentProblem::Configuration(RunError::Spawn(unknown)) = &*error.problem else { panic!("{error}") };
    assert!(matches!(unknown, SpawnError::UnknownKind { .. }), "{error}");
    // a car under the train's name: five numbers are no configuration of it
    let cars = |app: &mut App| _ = app.add_plugins(RobotPlugin::new(ABOUT.name, HITCH));
    let error = parsed(EXAM).in_world_with_robots(lot(ABOUT.name), cars).unwrap_err();
    assert!(matches!(&*error.problem, AssignmentProblem::Configuration(RunError::Spawn(_))), "{error}");
}

#[test]
fn only_a_kind_that_is_said_to_drive_has_reversals() {
    static BARGE: RobotKind = RobotKind { drives: false, ..ABOUT };
    fn undescribed(app: &mut App) {
        app.add_plugins(RobotPlugin::new(ABOUT.name, TRAIN));
    }
    fn barges(app: &mut App) {
        app.add_plugins(RobotPlugin::new(ABOUT.name, TRAIN).described(&BARGE));
    }
    let parsed = |text: &str| AssignmentFile::parse("exam.ron", text).unwrap();
    for add in [undescribed, barges] {
        let error = parsed(EXAM).in_world_with_robots(lot(ABOUT.name), add).unwrap_err();
        assert_eq!(error.to_string(), "exam.ron:3:13: limits: only a robot that drives has a direction to reverse");
    }
    // undescribed, its headings are compared as numbers, and 3.14 is far from -3.14
    let text = EXAM.replace(", reversals: 1", "");
    let assignment = parsed(&text).in_world_with_robots(lot(ABOUT.name), undescribed).unwrap();
    assert_eq!(assignment.about(), None);
    assert_eq!(verdicts(&assignment, driving(&[(1, 128)])), [AttemptOutcome::Missed; 2]);
    let assignment = parsed(&text).in_world_with_robots(lot(ABOUT.name), barges).unwrap();
    assert_eq!(verdicts(&assignment, driving(&[(1, 128)])), [AttemptOutcome::Passed; 2]);
}
