//! What people see and touch. Colours are known to [`Theme`] alone; what needs a window stands behind the feature `window`.

mod blend;
#[cfg(feature = "window")]
pub mod canvas;
mod cockpit;
#[cfg(feature = "window")]
mod dashboard;
#[cfg(feature = "window")]
mod drive;
mod readout;
mod theme;
#[cfg(feature = "window")]
mod time_line;
#[cfg(feature = "window")]
mod transport_bar;

pub use blend::{blend, heading};
pub use cockpit::{Cockpit, CockpitRobot, Dashboard};
#[cfg(feature = "window")]
pub use dashboard::dashboard;
pub use readout::{readout, readout_lines};
pub use theme::Theme;
#[cfg(feature = "window")]
pub use transport_bar::transport_bar;

/// What a widget asks for. Widgets change nothing but their own [`UiState`].
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Move the run.
    Transport(crate::simulation::TransportCommand),
    /// Put something in to a robot.
    Robot(crate::simulation::RobotCommand),
}

/// What the window remembers that is no part of a run.
#[derive(Clone, Debug, Default)]
pub struct UiState {
    /// Light or dark paper.
    pub theme: Theme,
    /// Which pane a narrow screen shows.
    pub pane: usize,
    /// The seed field's text while it is edited.
    pub seed_text: Option<String>,
    /// The name of the robot that the arrow keys drive.
    pub armed: Option<String>,
    /// The channels it was last told to hold.
    pub held: (i16, i16),
}
