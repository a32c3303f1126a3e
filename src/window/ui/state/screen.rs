//! `ScreenState`, the screen and its surroundings.

use motion_lab_core::picture::Theme;

/// The screen: its room, its system, and the page around.
#[derive(Clone, Debug, Default)]
pub struct ScreenState {
    /// Whether the screen is so narrow that a widget shows one thing at a time.
    pub is_narrow: bool,
    /// Whether the dashboard's panes are more than fit the window, so that the wheel scrolls them.
    pub scrolls: bool,
    /// Whether the picture in front fills the window.
    pub fills: bool,
    /// Whether the lab is embedded in another page: it shows one widget and no rail.
    pub embedded: bool,
    /// The system's theme.
    pub system_theme: Theme,
    /// Whether the system asks for less motion.
    pub system_reduced_motion: bool,
}
