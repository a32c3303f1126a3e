//! `UiState`, what the window remembers that is no part of a run.

use std::collections::BTreeMap;

use super::{ParkingGoal, Settings};
use crate::picture::{Role, Theme};

/// What the window remembers that is no part of a run.
#[derive(Clone, Debug, Default)]
pub struct UiState {
    /// What is kept from one start to the next.
    pub settings: Settings,
    /// The number of the widget in front, on the rail.
    pub widget: usize,
    /// The anatomy's, with the robot of the configuration space.
    #[cfg(feature = "screen")]
    pub anatomy: super::AnatomyState,
    /// The configuration space's.
    #[cfg(feature = "screen")]
    pub cspace: super::CspaceState,
    /// The atlas's.
    #[cfg(feature = "screen")]
    pub atlas: super::AtlasState,
    /// The capture form.
    #[cfg(feature = "screen")]
    pub capture: super::CaptureState,
    /// The paper that the system asks for.
    pub system_theme: Theme,
    /// The seed field's text while it is edited.
    pub seed_text: Option<String>,
    /// The name of the robot that the arrow keys drive.
    pub armed: Option<String>,
    /// The channels it was last told to hold.
    pub held: (i16, i16),
    /// The channels that the pad on the screen asks for.
    pub pad: (i16, i16),
    /// Whether a handle of an arm had the focus in the last frame: it keeps the arrow keys and leaves the others.
    pub nudging: bool,
    /// The role that is lit.
    pub lit: Option<Role>,
    /// The role that the page around the lab asks to light, while nothing here is pointed at.
    pub page_lit: Option<Role>,
    /// Whether the lab shows one widget on a page of someone else's: no rail.
    pub embedded: bool,
    /// The role that is pointed at in this frame.
    pub pointed: Option<Role>,
    /// Whether the list of keys is open.
    pub help: bool,
    /// The parking exercise, by the name of the car.
    pub goal: Option<(String, ParkingGoal)>,
    /// The plots that are not shown, by number.
    pub hidden_plots: Vec<usize>,
    /// Since when each robot's flash is shown as it is.
    pub flashes: BTreeMap<String, Flash>,
    /// What the window says of the last file, until it is put away.
    pub notice: Option<Notice>,
    /// What is under way beside the window, and whether it is to stop.
    pub working: Option<Working>,
}

/// What is under way beside the window.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Working {
    /// How far it has come, in words.
    pub text: String,
    /// Whether it was asked to stop.
    pub stop: bool,
}

/// A robot's flash as it is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flash {
    /// Whether it holds red.
    pub red: bool,
    /// Since when, seconds of the window's clock.
    pub since: f64,
}

/// What the window says of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// The words.
    pub text: String,
    /// Whether it tells of something wrong.
    pub is_error: bool,
}

/// A flash changes at most so often: three times a second.
const FLASH_SECONDS: f64 = 1.0 / 3.0;

impl UiState {
    /// The paper.
    pub fn theme(&self) -> Theme {
        self.settings.theme.theme(self.system_theme)
    }

    /// Whether a robot is drawn red at `now`, seconds, when the run says `red`: its flash changes at most three times a second,
    /// however fast the run goes.
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

    /// Whether a flash that the run has ended still holds on the screen.
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
