//! `UiState`, the state of the user interface. It is no part of a run.

use std::collections::BTreeMap;

use super::{ParkingGoal, Settings, Widget};
use crate::picture::{Role, Theme};

/// The state of the user interface, as a resource of the app.
#[derive(bevy::prelude::Resource, Default)]
pub struct Interface(pub UiState);

/// The state of the user interface. It is no part of a run.
#[derive(Clone, Debug, Default)]
pub struct UiState {
    /// The settings, which are kept from one start to the next.
    pub settings: Settings,
    /// The widget in front.
    pub widget: Widget,
    /// The state of the query anatomy. Its robot is also the configuration space's.
    pub anatomy: super::AnatomyState,
    /// The state of the configuration space.
    pub cspace: super::CspaceState,
    /// The state of the atlas.
    pub atlas: super::AtlasState,
    /// The robot picked in a crowd, and how crowds are shown.
    pub crowd: super::CrowdState,
    /// The state of the capture form.
    pub capture: super::CaptureState,
    /// The system's theme.
    pub system_theme: Theme,
    /// The seed field's text while it is edited.
    pub seed_text: Option<String>,
    /// The name of the robot that the arrow keys drive.
    pub armed: Option<String>,
    /// The channels last sent to that robot, from -128 to 128, the maximum.
    pub held: (i16, i16),
    /// The channels of the pad on the screen, from -128 to 128, the maximum.
    pub pad: (i16, i16),
    /// Whether a handle of an arm had the focus in the last frame. Such a handle keeps the arrow keys and no others.
    pub nudging: bool,
    /// The role that is lit: all others fade.
    pub lit: Option<Role>,
    /// The role that the surrounding page asks to light. It counts only while nothing here is pointed at.
    pub page_lit: Option<Role>,
    /// Whether the lab is embedded in another page: it shows one widget and no rail.
    pub embedded: bool,
    /// The role that is pointed at in this frame.
    pub pointed: Option<Role>,
    /// Whether the list of keys is open.
    pub help: bool,
    /// The name of a car and its parking exercise.
    pub goal: Option<(String, ParkingGoal)>,
    /// Indices of the hidden plots.
    pub hidden_plots: Vec<usize>,
    /// The flash shown for each robot, by name.
    pub flashes: BTreeMap<String, Flash>,
    /// The last message to the user, until it is dismissed.
    pub notice: Option<Notice>,
    /// The work in the background, if any.
    pub working: Option<Working>,
}

/// Work in the background.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Working {
    /// Its progress, in words.
    pub text: String,
    /// Whether it was asked to stop.
    pub stop: bool,
}

/// A robot's contact flash, as shown on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flash {
    /// Whether the robot is shown red.
    pub red: bool,
    /// Time of the last change, seconds of the window's clock.
    pub since: f64,
}

/// A message to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// The words.
    pub text: String,
    /// Whether it reports an error.
    pub is_error: bool,
}

/// Shortest time between two changes of a flash, seconds: at most three changes a second.
const FLASH_SECONDS: f64 = 1.0 / 3.0;

impl UiState {
    /// The theme in use: the chosen one, or the system's.
    pub fn theme(&self) -> Theme {
        self.settings.theme.theme(self.system_theme)
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
