//! Deeds: ticks off what hints ask for, once the reader has done it.

use super::lesson::learnt;
use super::{Command, Dashboard, SessionCommand, UiState};
use crate::window::ui::atlas::FIRST_CELL;
use crate::window::ui::plan::PlanStage;
use motion_lab_core::configuration::RobotKind;
use motion_lab_sim::lens::have_one_tip;
use motion_lab_sim::manifest::{HintTask, Widget};
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::{RobotCommand, RunCommand, TransportCommand};

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
