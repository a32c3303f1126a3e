//! Deeds: ticks off what hints ask for, once the reader has done it.

use std::sync::Arc;

use super::lesson::learnt;
use super::{Command, Dashboard, SessionCommand, UiState};
use crate::window::ui::atlas::FIRST_CELL;
use crate::window::ui::plan::PlanStage;
use motion_lab_core::collision::EdgeVerdict;
use motion_lab_core::configuration::{AnyConfiguration, Configuration, RobotKind};
use motion_lab_core::geometry::Point2;
use motion_lab_core::num::sin;
use motion_lab_sim::anatomy::{Anatomy, Tab};
use motion_lab_sim::manifest::{HintTask, Widget};
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::{RobotCommand, RunCommand, TransportCommand};

/// Distance within which two tips are one, metres.
const ONE_TIP: f64 = 0.05;

/// Distance from which on a robot is near an obstacle, metres.
const NEAR: f64 = 0.02;

/// Sine of the elbow's angle from which on an arm is bent to a side.
const MIN_BEND: f64 = 0.15;

/// Ticks off what was done in this frame, by `now` in seconds: in a widget, as the widget in front shows it, and what
/// was asked for.
pub fn tick_off(model: &Dashboard, state: &mut UiState, commands: &[Command], now: f64) {
    let is_sent = state.twin.as_ref().is_some_and(|asked| asked.way.is_some());
    // of its whole history, so only where it may matter
    let has_lost_wall = commands.iter().any(|c| matches!(c, Command::Session(_))) && state.atlas.editor.has_lost_wall();
    let mut done = std::mem::take(&mut state.did);
    done.extend(commands.iter().flat_map(|command| asked(command, model, is_sent, has_lost_wall)));
    done.extend(shown(model, state));
    done.append(&mut state.plan.tasks_done);
    if let Some(mut under_way) = state.lesson.take() {
        if under_way.see(&done, now) {
            under_way.learnt = learnt(under_way.lesson, model, state);
        }
        state.lesson = Some(under_way);
    }
    done.into_iter().for_each(|task| state.settings.tick_off(task));
}

/// The tasks that a command is; an arm may be moved `by_itself`, on its way to its other elbow, and the atlas's world
/// may have lost a wall.
fn asked(command: &Command, model: &Dashboard, by_itself: bool, has_lost_wall: bool) -> Vec<HintTask> {
    match command {
        Command::Run(RunCommand::Robot(RobotCommand { input, .. })) => match input {
            RobotInput::Drive(0, 0) => vec![],
            RobotInput::Drive(..) if model.tick < model.frontier => vec![HintTask::Drive, HintTask::DriveOn],
            RobotInput::Drive(..) => vec![HintTask::Drive],
            RobotInput::MoveTo(_) if !by_itself => vec![HintTask::MoveArm],
            _ => vec![],
        },
        Command::Run(RunCommand::Transport(TransportCommand::Reset)) => vec![HintTask::Reset],
        Command::Session(SessionCommand::PlayPath) => vec![HintTask::PlayPath],
        Command::Session(SessionCommand::RunWorld | SessionCommand::RunFromHere) if has_lost_wall => {
            vec![HintTask::EditWorld]
        }
        _ => vec![],
    }
}

/// The tasks that the widget in front shows.
fn shown(model: &Dashboard, state: &UiState) -> Vec<HintTask> {
    let is_asked = |task| state.lesson.as_ref().is_some_and(|under_way| under_way.lesson.task == task);
    let is_open = |task| !state.settings.is_ticked_off(task) || is_asked(task);
    let anatomy = &state.anatomy.anatomy;
    let of = |tasks: &[(HintTask, &dyn Fn() -> bool)]| {
        tasks.iter().filter(|(task, is_done)| is_open(*task) && is_done()).map(|(task, _)| *task).collect()
    };
    match state.widget {
        Widget::Cspace => of(&[(HintTask::TwoPoints, &|| have_one_tip(anatomy, &state.cspace.trace))]),
        Widget::Atlas => of(&[
            (HintTask::Coarsen, &|| state.atlas.resolution > FIRST_CELL),
            (HintTask::PickWall, &|| state.atlas.has_picked_wall()),
        ]),
        Widget::Plan => of(&[(HintTask::FindPath, &|| *state.plan.stage() == PlanStage::Solved)]),
        Widget::Dashboard => of(&[(HintTask::Held, &|| {
            let mut robots = model.cockpits.iter().flat_map(|cockpit| &cockpit.robots);
            robots.any(|robot| robot.kind == RobotKind::RUSTY.name && robot.manual && robot.flash)
        })]),
        Widget::Anatomy => vec![],
    }
}

/// What the reader has done between two moments of the query anatomy, a press and its release or a frame and the next:
/// the robot was moved until it touches, the motion changed until it hits. Another world, robot or tab is no task.
pub fn of_anatomy(before: &Anatomy, now: &Anatomy) -> Vec<HintTask> {
    let is_same = Arc::ptr_eq(before.world(), now.world()) && before.checker().robot() == now.checker().robot();
    let hits = || now.sweep().is_ok_and(|sweep| matches!(sweep.verdict, EdgeVerdict::Hit { .. }));
    let is_moved = is_same && before.q() != now.q();
    let touch = is_moved && now.intersects();
    let is_near = || now.nearest().first().is_some_and(|pair| pair.witness.dist > 0.0 && pair.witness.dist <= NEAR);
    let near = is_moved && before.tab == Tab::Witness && now.tab == Tab::Witness && is_near();
    let is_swept = before.tab == Tab::Swept && now.tab == Tab::Swept;
    let is_stepped = is_same && before.step() != now.step();
    let hit = is_swept && is_stepped && hits();
    let has_free_ends = || now.sweep().is_ok_and(|sweep| sweep.from_free && sweep.to_free);
    let free_ends = is_swept && (is_stepped || is_moved) && hits() && has_free_ends();
    let done =
        [(touch, HintTask::Touch), (near, HintTask::Near), (hit, HintTask::Hit), (free_ends, HintTask::FreeEnds)];
    done.into_iter().filter(|(is_done, _)| *is_done).map(|(_, task)| task).collect()
}

/// Whether the last point of a trace has the tip of an earlier one that is another point of the torus.
fn have_one_tip(anatomy: &Anatomy, trace: &[AnyConfiguration]) -> bool {
    let robot = anatomy.checker().robot();
    let tip = |q: &AnyConfiguration| -> Point2 { robot.reference(q) };
    let Some((last, earlier)) = trace.split_last().filter(|(last, _)| matches!(last, AnyConfiguration::T2(_))) else {
        return false;
    };
    // where the arm is straight or folded, a little to either side has nearly one tip
    let bend = |q: &AnyConfiguration| q.coordinates().last().map_or(0.0, |angle| sin(*angle));
    let are_two = |a: f64, b: f64| a * b < 0.0 && a.abs() > MIN_BEND && b.abs() > MIN_BEND;
    earlier.iter().any(|q| are_two(bend(q), bend(last)) && (tip(q) - tip(last)).norm() < ONE_TIP)
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::configuration::T2;

    #[test]
    fn two_points_with_one_tip_are_two_bends_of_the_elbow() {
        let anatomy = Anatomy::default();
        let at = |th1: f64, th2: f64| AnyConfiguration::T2(T2::new(th1, th2));
        // for links of equal length the other elbow is (th1 + th2, -th2)
        let (one, other) = (at(0.4, 0.9), at(1.3, -0.9));
        assert!(have_one_tip(&anatomy, &[one, at(0.0, 0.1), other]));
        assert!(!have_one_tip(&anatomy, &[other, at(0.0, 0.1), one, at(0.2, 0.9)]), "only where it has come to");
        assert!(!have_one_tip(&anatomy, &[one, one]) && !have_one_tip(&anatomy, &[one, at(1.3, -0.7)]));
        assert!(!have_one_tip(&anatomy, &[at(0.4, 0.02), at(0.4, -0.02)]), "it has only passed a straight arm");
        assert!(!have_one_tip(&anatomy, &[]));
    }

    #[test]
    fn what_was_asked_for_is_a_task_done_and_nothing_else_is() {
        let (seed, cockpits) = (motion_lab_core::random::Seed(1), Vec::new());
        let (behind, next_contact) = (None, None);
        let [playing, looping, can_undo, can_redo] = [false; 4];
        let (speed, tick, frontier) = (1.0, 3, 3);
        let now = Dashboard {
            cockpits,
            seed,
            tick,
            frontier,
            speed,
            playing,
            looping,
            behind,
            next_contact,
            has_contact: false,
            can_undo,
            can_redo,
        };
        let before = Dashboard { tick: 2, ..now.clone() };
        let of_robot = |input| Command::from(RobotCommand { robot: "Rusty".into(), input });
        let drive = |forward| of_robot(RobotInput::Drive(forward, 0));
        assert_eq!(asked(&drive(0), &now, false, false), [], "it was let go");
        assert_eq!(asked(&drive(9), &now, false, false), [HintTask::Drive]);
        assert_eq!(asked(&drive(9), &before, false, false), [HintTask::Drive, HintTask::DriveOn]);
        let moved = of_robot(RobotInput::MoveTo(vec![]));
        assert_eq!(asked(&moved, &now, true, false), [], "by itself");
        assert_eq!(asked(&moved, &now, false, false), [HintTask::MoveArm]);
        let run = Command::Session(SessionCommand::RunWorld);
        assert_eq!(asked(&run, &now, false, false), [], "no wall was taken away");
        assert_eq!(asked(&run, &now, false, true), [HintTask::EditWorld]);
    }

    #[test]
    fn a_task_is_done_by_the_reader_and_not_by_a_scene() {
        // the chapter's motion hits the block, and its arm touches it where the elbow is bent less
        let start = Anatomy::default();
        let swept = start.clone().with_tab(Tab::Swept);
        assert_eq!(of_anatomy(&start, &swept), [], "the tab was only opened");
        let with = |of: &dyn Fn(&mut Anatomy)| {
            let mut anatomy = swept.clone();
            of(&mut anatomy);
            anatomy
        };
        assert_eq!(of_anatomy(&swept, &with(&|a| a.set_step(0, -1.0))), [HintTask::Hit, HintTask::FreeEnds]);
        assert_eq!(of_anatomy(&swept, &with(&|a| a.set_step(0, -0.4))), [HintTask::Hit], "it ends in contact");
        assert_eq!(of_anatomy(&swept, &with(&|a| a.set_step(0, 0.01))), [], "a step that is free");
        assert_eq!(of_anatomy(&swept, &with(&|a| a.set_coordinate(1, 1.2))), [HintTask::Touch]);
        assert_eq!(of_anatomy(&start, &start.clone().with_tab(Tab::Witness)), []);
        let witness = start.clone().with_tab(Tab::Witness);
        let bent = |th2: f64| {
            let mut anatomy = witness.clone();
            anatomy.set_coordinate(1, th2);
            anatomy
        };
        // it touches below 1.4009: at 1.42 it is 7 mm off, at pi/2 61 mm
        assert_eq!(of_anatomy(&witness, &bent(1.42)), [HintTask::Near]);
        assert_eq!(of_anatomy(&witness, &bent(1.5)), []);
        assert_eq!(of_anatomy(&witness, &bent(1.39)), [HintTask::Touch]);
        let thick = with(&|a| a.set_thick_links(true));
        assert_eq!(of_anatomy(&thick, &with(&|a| a.set_coordinate(1, 1.2))), [], "another robot");
    }
}
