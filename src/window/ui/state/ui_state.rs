//! `UiState`, the state of the user interface. It is no part of a run.

use std::collections::BTreeMap;

use super::focus::FocusState;
use super::hand::HandState;
use super::pointer::PointerState;
use super::screen::ScreenState;
use super::words::{Closing, Flash, Notice, Offer, SeedDraft, Working};
use crate::window::ui::atlas::Mode;
use crate::window::ui::paint::camera::Camera;
use crate::window::ui::time::span::ShownSpan;
use crate::window::ui::{
    AnatomyState, AskedTwin, AtlasState, CaptureState, CockpitRobot, CrowdState, CspaceState, LessonState, LinkedState,
    ParkingExercise, PlanState, Recent, Settings, ShownChance,
};
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab_core::picture::Theme;
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};
use motion_lab_sim::manifest::{HintTask, Widget};

/// The state of the user interface, as a resource of the app.
#[derive(bevy::prelude::Resource, Default)]
pub struct Interface(pub UiState);

/// The state of the user interface. It is no part of a run.
#[derive(Clone, Debug, Default)]
pub struct UiState {
    /// The settings, which are kept from one start to the next.
    pub settings: Settings,
    /// The robot in hand.
    pub hand: HandState,
    /// Who has the keys.
    pub focus: FocusState,
    /// What is pointed at.
    pub pointer: PointerState,
    /// The screen and its surroundings.
    pub screen: ScreenState,
    /// The widget in front.
    pub widget: Widget,
    /// Whether the run waits, since the dashboard was left, to play on there.
    pub played: bool,
    /// The state of the query anatomy. Its robot is also the configuration space's.
    pub anatomy: AnatomyState,
    /// The state of the configuration space.
    pub cspace: CspaceState,
    /// The configuration beside the cockpit in front.
    pub linked: LinkedState,
    /// What was asked for with a robot's twin on the dashboard.
    pub twin: Option<AskedTwin>,
    /// The state of the atlas.
    pub atlas: AtlasState,
    /// The state of the widget that plans.
    pub plan: PlanState,
    /// Other worlds of the atlas with their edits and what can be undone of them, in the order they were left.
    pub shelf: Vec<AtlasState>,
    /// The robot picked in a crowd, and how crowds are shown.
    pub crowd: CrowdState,
    /// What part of each world the dashboard shows, by the world's name.
    pub cameras: BTreeMap<String, Camera>,
    /// The part of the run that the time line shows.
    pub span: ShownSpan,
    /// The state of the capture form.
    pub capture: CaptureState,
    /// What is typed into the seed's field and is not yet the run's seed.
    pub seed: Option<SeedDraft>,
    /// Whether the list of keys is open.
    pub help: bool,
    /// The name of a car and its parking exercise.
    pub goal: Option<(String, ParkingExercise)>,
    /// Indices of the hidden plots.
    pub hidden_plots: Vec<usize>,
    /// The flash shown for each robot, by name.
    pub flashes: BTreeMap<String, Flash>,
    /// The last message of each widget, until it is dismissed.
    notices: BTreeMap<Widget, Notice>,
    /// How far closing the window has come, if it is to close.
    pub closing: Option<Closing>,
    /// The run that a window before left, while it is offered.
    pub offer: Option<Offer>,
    /// The files opened or saved last.
    pub recent: Recent,
    /// The last chance to avoid the contact that was asked about, while the run is the same.
    pub chance: Option<ShownChance>,
    /// The work in the background, if any.
    pub working: Option<Working>,
    /// The lesson under way.
    pub lesson: Option<LessonState>,
    /// What the reader did in this frame that hints ask for.
    pub did: Vec<HintTask>,
}

/// Shortest time between two changes of a flash, seconds: at most three changes a second.
const FLASH_SECONDS: f64 = 1.0 / 3.0;

impl UiState {
    /// The theme in use: the chosen one, or the system's.
    pub fn theme(&self) -> Theme {
        self.settings.theme.theme(self.screen.system_theme)
    }

    /// Whether something goes on that must not fade: a robot in hand, a refusal, a dialog.
    pub fn is_busy(&self) -> bool {
        let refused = self.widget == Widget::Atlas && self.atlas.refusal().is_some();
        self.hand.armed.is_some() || self.focus.nudged.is_some() || refused || self.focus.dialog
    }

    /// Whether the wheel alone magnifies a world: it is not needed to scroll the page around or the panes.
    pub fn takes_wheel(&self) -> bool {
        !self.screen.embedded && !self.screen.scrolls
    }

    /// Whether a dialog or a form stands before the lab, so that no key is the lab's.
    pub fn is_covered(&self) -> bool {
        if self.closing.is_some() {
            return true;
        }
        self.help || self.capture.open || self.focus.dialog
    }

    /// The last message of the widget in front.
    pub fn notice(&self) -> Option<&Notice> {
        self.notices.get(&self.widget)
    }

    /// Shows a message in the widget in front, until it is dismissed or another comes there. One that reports no error
    /// goes by itself.
    pub fn say(&mut self, notice: Notice) {
        self.say_in(self.widget, notice);
    }

    /// Says why something was refused, if it was. It goes by itself: what is refused stays as it was.
    pub fn refuse(&mut self, why: Option<String>) {
        if let Some(text) = why {
            self.say(Notice { text, is_error: false });
        }
    }

    /// Shows a message in this widget.
    pub fn say_in(&mut self, widget: Widget, notice: Notice) {
        self.notices.insert(widget, notice);
    }

    /// Dismisses the message of the widget in front.
    pub fn dismiss_notice(&mut self) {
        self.notices.remove(&self.widget);
    }

    /// Puts another world into the atlas. The present one is put on the shelf if something of it would be lost.
    pub fn open_world(&mut self, new: AtlasState) {
        let kept = self.shelf.iter().chain(Some(&self.atlas).filter(|present| present.has_history()));
        let new = new.like(&self.atlas).numbered_among(kept);
        let mut old = std::mem::replace(&mut self.atlas, new);
        old.put_down();
        if old.has_history() {
            self.shelf.push(old);
        }
        self.atlas.others = self.shelf.iter().map(|kept| kept.world().name.clone()).collect();
    }

    /// Opens a new world in the editor: nothing but a wall around 12 x 8 m.
    pub fn new_world(&mut self) {
        let bounds = Aabb::new(Point2::origin(), Point2::new(12.0, 8.0));
        let taken: Vec<String> = self.shelf.iter().chain([&self.atlas]).map(|kept| kept.world().name.clone()).collect();
        let named = |n: u32| if n == 1 { "New world".to_owned() } else { format!("New world {n}") };
        let name = (1..).map(named).find(|name| !taken.contains(name)).unwrap_or_default();
        let mut world = World::empty(name, bounds);
        let corners = [(0.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0), (0.0, 0.0)].map(|(x, y)| Point2::new(x, y));
        let sides = corners.windows(2).map(|w| (Pose2::IDENTITY, Shape::Segment { a: w[0], b: w[1] }));
        world.obstacles.push(Obstacle::new("the outer wall", ObstacleKind::Wall, sides.collect()));
        self.open_world(AtlasState::of(world));
        self.atlas.mode = Mode::Edit;
    }

    /// Whether nothing eases: the system or the reader asks for it.
    pub fn has_reduced_motion(&self) -> bool {
        self.settings.reduced_motion || self.screen.system_reduced_motion
    }

    /// The worlds of the atlas whose edits are in no file, by their names in the list of worlds.
    pub fn unsaved(&self) -> Vec<String> {
        let worlds = self.shelf.iter().chain([&self.atlas]);
        worlds.filter(|world| world.is_unsaved()).map(AtlasState::label).collect()
    }

    /// Puts the world with this index on the shelf back into the atlas.
    pub fn take_from_shelf(&mut self, index: usize) {
        if index < self.shelf.len() {
            let kept = self.shelf.remove(index);
            self.open_world(kept);
        }
    }

    /// Whether to draw a robot red at `now`, seconds, when the run says `red`.
    ///
    /// The answer changes at most three times a second, however fast the run goes.
    pub fn flash(&mut self, robot: &str, red: bool, now: f64) -> bool {
        match self.flashes.get_mut(robot) {
            None => {
                self.flashes.insert(robot.to_owned(), Flash { red, since: now });
                red
            }
            Some(flash) => {
                if flash.red != red && now - flash.since >= FLASH_SECONDS {
                    *flash = Flash { red, since: now };
                }
                flash.red
            }
        }
    }

    /// Whether a robot is drawn red now.
    pub fn is_red(&self, robot: &CockpitRobot) -> bool {
        self.flashes.get(&robot.name).map_or(robot.flash, |flash| flash.red)
    }

    /// Whether the flash on the screen differs from the run's, `red`, because it may not change yet.
    pub fn flash_lags(&self, robot: &str, red: bool) -> bool {
        self.flashes.get(robot).is_some_and(|f| f.red != red)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flash_changes_at_most_three_times_a_second() {
        let mut state = UiState::default();
        let mut changes = 0;
        let mut shown = false;
        // the run flickers with every frame, 60 of them a second, for ten seconds
        for frame in 0..600 {
            let now = state.flash("Reach", frame % 2 == 1, f64::from(frame) / 60.0);
            changes += u32::from(now != shown);
            shown = now;
        }
        assert!(changes <= 30 && changes > 10, "{changes}");
        // a single contact shows, if late, and ends
        assert!(!state.flash("Rusty", false, 0.0));
        assert!(state.flash("Rusty", true, 5.0) && state.flash("Rusty", false, 5.1));
        assert!(state.flash_lags("Rusty", false) && !state.flash("Rusty", false, 5.4));
    }
}
