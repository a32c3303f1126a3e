//! Begins lessons, and makes their widgets ready.

use super::atlas::FIRST_CELL;
use super::dashboard::hand::drive;
use super::dashboard::twins;
use super::paint::frame::{kind_of, mode_of};
use super::{AnatomyState, AtlasState, Command, CspaceState, Dashboard, LessonState, UiState};
use motion_lab_core::configuration::RobotKind;
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
    let start = under_way.start.take();
    let lesson = under_way.lesson;
    let Lesson { task, widget } = lesson;
    state.screen.fills = false;
    drive::let_go(state, commands);
    if widget != Widget::Dashboard && model.playing {
        state.played = true;
        commands.push(Command::from(TransportCommand::Pause));
    }
    match widget {
        Widget::Dashboard => {
            // what was under way before ends no lesson
            state.twin = None;
            let has = |kind| model.cockpits.iter().position(|c| c.robots.iter().any(|robot| robot.kind == kind));
            if let Some(world) = kind_of(task).and_then(has) {
                state.settings.world = world as u32;
            }
            if task == HintTask::TwoElbows {
                twins::put_where_it_teaches(model, &state.linked, commands);
            }
            // there has to be something to drag back over
            if task == HintTask::DriveOn && model.frontier < MIN_PAST && !model.playing {
                commands.push(Command::from(TransportCommand::Play));
            } else if task == HintTask::DriveOn && model.tick < MIN_PAST {
                commands.push(Command::from(TransportCommand::Seek(model.frontier)));
            }
        }
        Widget::Anatomy => {
            state.anatomy = AnatomyState::default();
            state.anatomy.set(lesson.scene(start));
        }
        Widget::Cspace => {
            state.anatomy = AnatomyState::default();
            state.anatomy.set(lesson.scene(start));
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
        Widget::Plan => state.plan.begin_anew(),
    }
}

/// What a lesson that has just been done taught, with the reader's own numbers where it is about one state of a robot.
pub fn learnt(lesson: Lesson, model: &Dashboard, state: &UiState) -> String {
    let own = match lesson.task {
        HintTask::TwoElbows => twins::both_of(RobotKind::REACH, model, state),
        HintTask::TwoHeadings => twins::both_of(RobotKind::HITCH, model, state),
        HintTask::Held => {
            let robots = model.cockpits.iter().flat_map(|cockpit| &cockpit.robots);
            let of_rover = robots
                .filter(|robot| robot.kind == RobotKind::RUSTY.name && robot.manual && robot.flash)
                .find_map(|robot| {
                    let before = robot.clearance.as_ref()?;
                    before.held_before.as_ref().map(|_| before.words(0.0))
                });
            of_rover.map(|held| format!("It is {held}: its next step would touch, and its clearance never comes to 0."))
        }
        _ => None,
    };
    own.unwrap_or_else(|| lesson.learnt().to_owned())
}
