//! `LessonState`, the lesson under way.

use super::atlas::{FIRST_CELL, Mode};
use super::dashboard::drive;
use super::{AtlasState, Command, CspaceState, Dashboard, PlanState, UiState};
use crate::anatomy::Tab;
use crate::manifest::{Deed, Lesson, Widget};
use crate::simulation::TransportCommand;

/// The lesson under way.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonState {
    /// Which one it is.
    pub lesson: Lesson,
    /// The seconds that it took, once it has been done.
    pub took: Option<f64>,
    /// The clock at its first frame, seconds.
    began: Option<f64>,
    /// Whether its widget has been made ready.
    is_ready: bool,
    /// Whether the frame before showed it done. What is so from the start is not the reader's doing.
    was_done: bool,
}

impl LessonState {
    /// Takes in what was done in a frame, by `now` in seconds.
    pub fn see(&mut self, done: &[Deed], now: f64) {
        let began = *self.began.get_or_insert(now);
        let is_done = done.contains(&self.lesson.deed);
        if is_done && !self.was_done && self.took.is_none() {
            self.took = Some(now - began);
        }
        self.was_done = is_done;
    }
}

impl UiState {
    /// Begins a lesson: its widget comes in front, as the next frame makes it ready.
    pub fn begin(&mut self, lesson: Lesson) {
        self.widget = lesson.widget;
        self.lesson = Some(LessonState { lesson, took: None, began: None, is_ready: false, was_done: true });
    }
}

/// Makes the widget of a lesson that has just begun ready for it: its robot in front, its question asked, nothing of it
/// done yet. A world's edits are put on the shelf.
pub fn make_ready(model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let Some(under_way) = state.lesson.as_mut().filter(|under_way| !under_way.is_ready) else { return };
    under_way.is_ready = true;
    let Lesson { deed, widget } = under_way.lesson;
    state.fills = false;
    drive::let_go(state, commands);
    if widget != Widget::Dashboard && model.playing {
        commands.push(Command::from(TransportCommand::Pause));
    }
    match widget {
        Widget::Dashboard => {
            let has = |kind| model.cockpits.iter().position(|c| c.robots.iter().any(|robot| robot.kind == kind));
            if let Some(world) = kind_of(deed).and_then(has) {
                state.settings.world = world as u32;
            }
        }
        Widget::Anatomy => {
            state.anatomy = super::AnatomyState::default();
            state.anatomy.anatomy.tab = tab_of(deed);
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
            state.atlas.mode = mode_of(deed);
        }
        Widget::Plan => state.plan = PlanState::default(),
    }
}

/// The kind of the robot that a lesson of the dashboard is about.
fn kind_of(deed: Deed) -> Option<&'static str> {
    match deed {
        Deed::TwoElbows | Deed::MoveArm => Some("reach"),
        Deed::TwoHeadings => Some("hitch"),
        Deed::Drive | Deed::DriveOn | Deed::Held => Some("rusty"),
        _ => None,
    }
}

/// The question of Query that a lesson is about.
fn tab_of(deed: Deed) -> Tab {
    match deed {
        Deed::Near => Tab::Witness,
        Deed::Hit | Deed::FreeEnds => Tab::Swept,
        _ => Tab::Distance,
    }
}

/// What a click does in the atlas of a lesson.
fn mode_of(deed: Deed) -> Mode {
    match deed {
        Deed::Coarsen => Mode::Measure,
        Deed::PickWall | Deed::EditWorld => Mode::Edit,
        _ => Mode::Put,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lesson_is_done_by_what_comes_after_its_beginning_and_once() {
        let mut state = UiState::default();
        let near = Lesson::of("near").unwrap();
        state.begin(near);
        assert_eq!(state.widget, Widget::Anatomy);
        let under_way = state.lesson.as_mut().unwrap();
        under_way.see(&[Deed::Near], 10.0);
        assert_eq!(under_way.took, None, "it was so from the start");
        under_way.see(&[Deed::Touch], 12.0);
        assert_eq!(under_way.took, None, "another task");
        under_way.see(&[Deed::Touch, Deed::Near], 17.5);
        assert_eq!(under_way.took, Some(7.5));
        under_way.see(&[], 20.0);
        under_way.see(&[Deed::Near], 30.0);
        assert_eq!(under_way.took, Some(7.5), "the first time counts");
    }
}
