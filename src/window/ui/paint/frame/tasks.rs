//! Which of a widget's tasks suit what is in front.

use crate::window::ui::atlas::Mode;
use crate::window::ui::{Dashboard, LessonState, UiState};
use motion_lab_core::configuration::RobotKind;
use motion_lab_sim::manifest::{Hint, HintTask, Widget};

/// Whether what the widget in front says of the misconception that it removes is true of what it shows: what is said of
/// three robots is true of three worlds.
pub fn is_true_of(model: &Dashboard, state: &UiState) -> bool {
    state.widget != Widget::Dashboard || model.cockpits.len() == 3
}

/// Whether a hint can be followed with the robot that the widget in front shows.
pub fn suits(hint: &Hint, state: &UiState) -> bool {
    !hint.arm || state.anatomy.anatomy.lengths().is_some()
}

/// Whether the lesson under way is shown in the widget in front.
pub fn is_shown_here(under_way: &LessonState, state: &UiState) -> bool {
    // what ends on the dashboard, such as a world that is run, says there that it is done
    let leads_on = matches!(under_way.lesson.task, HintTask::EditWorld | HintTask::PlayPath);
    let has_ended = under_way.took.is_some() && state.widget == Widget::Dashboard && leads_on;
    under_way.lesson.widget == state.widget || has_ended
}

/// Whether a run has the robot that a task of the dashboard is about; other widgets have robots of their own.
pub fn has_its_robot(task: HintTask, model: &Dashboard) -> bool {
    let mut robots = model.cockpits.iter().flat_map(|cockpit| &cockpit.robots);
    match task {
        HintTask::Drive | HintTask::DriveOn => robots.any(|robot| robot.drivable),
        task => kind_of(task).is_none_or(|kind| robots.any(|robot| robot.kind == kind)),
    }
}

/// The kind of the robot that a lesson of the dashboard is about.
pub fn kind_of(task: HintTask) -> Option<&'static str> {
    match task {
        HintTask::TwoElbows | HintTask::MoveArm => Some(RobotKind::REACH.name),
        HintTask::TwoHeadings => Some(RobotKind::HITCH.name),
        HintTask::Drive | HintTask::DriveOn | HintTask::Held => Some(RobotKind::RUSTY.name),
        _ => None,
    }
}

/// What a click does in the atlas of a lesson.
pub fn mode_of(task: HintTask) -> Mode {
    match task {
        HintTask::Coarsen => Mode::Measure,
        HintTask::PickWall | HintTask::EditWorld => Mode::Edit,
        _ => Mode::Put,
    }
}
