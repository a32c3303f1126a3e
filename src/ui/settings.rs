//! `Settings`, what is kept from one start of the program to the next.

use serde::{Deserialize, Serialize};

use crate::picture::Theme;

/// The choice of theme.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "window", derive(bevy::reflect::Reflect))]
pub enum ThemeChoice {
    /// The system's theme.
    #[default]
    System,
    /// Light.
    Light,
    /// Dark.
    Dark,
}

impl ThemeChoice {
    /// Every choice, in the order of the list.
    pub const ALL: [ThemeChoice; 3] = [ThemeChoice::System, ThemeChoice::Light, ThemeChoice::Dark];

    /// Its name on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            ThemeChoice::System => "System",
            ThemeChoice::Light => "Light",
            ThemeChoice::Dark => "Dark",
        }
    }

    /// The next choice of the list, the first after the last.
    #[must_use]
    pub const fn next(self) -> Self {
        match self {
            ThemeChoice::System => ThemeChoice::Light,
            ThemeChoice::Light => ThemeChoice::Dark,
            ThemeChoice::Dark => ThemeChoice::System,
        }
    }

    /// The theme of this choice, where the system's is `system`.
    #[must_use]
    pub const fn theme(self, system: Theme) -> Theme {
        match self {
            ThemeChoice::System => system,
            ThemeChoice::Light => Theme::Light,
            ThemeChoice::Dark => Theme::Dark,
        }
    }
}

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
