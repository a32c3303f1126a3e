//! `Settings`, what is kept from one start of the program to the next.

use serde::{Deserialize, Serialize};

use crate::manifest::ThemeChoice;

/// The user's settings. They are no part of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "window", derive(bevy::reflect::Reflect))]
#[serde(default)]
pub struct Settings {
    /// Light or dark paper.
    pub theme: ThemeChoice,
    /// Whether places and obstacles carry their names.
    pub labels: bool,
    /// Whether the range sensor's scan is drawn.
    pub scan: bool,
    /// Whether the plots are open.
    pub plots: bool,
    /// Index of the world that a narrow screen shows.
    pub world: u32,
    /// Whether the first hints were dismissed.
    pub hints_seen: bool,
    /// Whether fades and other animations are off.
    pub reduced_motion: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            theme: ThemeChoice::System,
            labels: false,
            scan: false,
            plots: false,
            world: 0,
            hints_seen: false,
            reduced_motion: false,
        }
    }
}
