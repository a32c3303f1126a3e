//! Begins lessons, and makes their widgets ready.

use super::atlas::{FIRST_CELL, Mode};
use super::dashboard::hand::drive;
use super::{AtlasState, Command, CspaceState, Dashboard, LessonState, PlanState, UiState};
use motion_lab_core::configuration::RobotKind;
use motion_lab_sim::anatomy::Tab;
use motion_lab_sim::manifest::{HintTask, Lesson, Widget};
use motion_lab_sim::simulation::TransportCommand;

/// The least past that is dragged back over, ticks: two seconds.
const MIN_PAST: u64 = 40;

impl UiState {
    /// Begins a lesson: its widget comes in front, as the next frame makes it ready.
    pub fn begin(&mut self, lesson: Lesson) {
        self.widget = lesson.widget;
        self.lesson = Some(LessonState::begun(lesson));
    }
}

/// Makes the widget of a lesson that has just begun ready for it: its robot in front, its question asked, nothing of it
/// done yet. A world's edits are put on the shelf.
pub fn make_ready(model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let Some(under_way) = state.lesson.as_mut().filter(|under_way| !under_way.is_ready) else { return };
    under_way.is_ready = true;
    let Lesson { task, widget } = under_way.lesson;
    state.fills = false;
    drive::let_go(state, commands);
    if widget != Widget::Dashboard && model.playing {
        state.played = true;
        commands.push(Command::from(TransportCommand::Pause));
    }
    match widget {
        Widget::Dashboard => {
            let has = |kind| model.cockpits.iter().position(|c| c.robots.iter().any(|robot| robot.kind == kind));
            if let Some(world) = kind_of(task).and_then(has) {
                state.settings.world = world as u32;
            }
            // there has to be something to drag back over
            if task == HintTask::DriveOn && model.frontier < MIN_PAST && !model.playing {
                commands.push(Command::from(TransportCommand::Play));
            } else if task == HintTask::DriveOn && model.tick < MIN_PAST {
                commands.push(Command::from(TransportCommand::Seek(model.frontier)));
            }
        }
        Widget::Anatomy => {
            state.anatomy = super::AnatomyState::default();
            state.anatomy.anatomy.tab = tab_of(task);
        }
        Widget::Cspace => {
            state.anatomy = super::AnatomyState::default();
            state.cspace = CspaceState::default();
        }
        Widget::Atlas => {
            if state.atlas.has_history() || state.atlas.world() != AtlasState::default().world() {
                state.open_world(AtlasState::default());
            }
            state.atlas.set_resolution(FIRST_CELL);
            state.atlas.selected = None;
            state.atlas.mode = mode_of(task);
        }
        Widget::Plan => state.plan = PlanState::default(),
    }
}

/// The kind of the robot that a lesson of the dashboard is about.
fn kind_of(task: HintTask) -> Option<&'static str> {
    match task {
        HintTask::TwoElbows | HintTask::MoveArm => Some(RobotKind::REACH.name),
        HintTask::TwoHeadings => Some(RobotKind::HITCH.name),
        HintTask::Drive | HintTask::DriveOn | HintTask::Held => Some(RobotKind::RUSTY.name),
        _ => None,
    }
}

/// The question of Query that a lesson is about.
fn tab_of(task: HintTask) -> Tab {
    match task {
        HintTask::Near => Tab::Witness,
        HintTask::Hit | HintTask::FreeEnds => Tab::Swept,
        _ => Tab::Distance,
    }
}

/// What a click does in the atlas of a lesson.
fn mode_of(task: HintTask) -> Mode {
    match task {
        HintTask::Coarsen => Mode::Measure,
        HintTask::PickWall | HintTask::EditWorld => Mode::Edit,
        _ => Mode::Put,
    }
}
