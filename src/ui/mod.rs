//! What people see and touch. Colours are known to [`Theme`](crate::picture::Theme) alone; what needs a screen stands behind the feature `screen`.

#[cfg(feature = "screen")]
mod anatomy_view;
pub mod arm;
#[cfg(feature = "screen")]
mod atlas_editing;
#[cfg(feature = "screen")]
mod atlas_state;
#[cfg(feature = "screen")]
mod atlas_view;
mod blend;
#[cfg(feature = "screen")]
mod button;
#[cfg(feature = "screen")]
pub mod canvas;
#[cfg(feature = "screen")]
mod capture_form;
mod cockpit;
#[cfg(feature = "screen")]
mod cspace_view;
#[cfg(feature = "screen")]
mod dashboard;
#[cfg(feature = "screen")]
mod drive;
mod formula;
#[cfg(feature = "screen")]
mod frame;
mod goal;
#[cfg(feature = "screen")]
mod handles;
#[cfg(feature = "screen")]
mod help;
#[cfg(feature = "screen")]
pub mod keys;
#[cfg(feature = "screen")]
mod lab;
#[cfg(feature = "screen")]
mod look;
#[cfg(feature = "screen")]
mod pad;
#[cfg(feature = "screen")]
mod pane;
#[cfg(feature = "screen")]
mod plots;
mod settings;
#[cfg(feature = "screen")]
mod sheet;
mod state;
#[cfg(feature = "screen")]
mod style;
#[cfg(feature = "screen")]
mod time_line;
#[cfg(feature = "screen")]
mod tools;
#[cfg(feature = "screen")]
mod transport_bar;

#[cfg(feature = "screen")]
pub use anatomy_view::AnatomyState;
#[cfg(feature = "screen")]
pub use atlas_state::{AtlasState, Mode};
pub use blend::{blend, heading};
#[cfg(feature = "screen")]
pub use capture_form::{CaptureOrder, CaptureState};
pub use cockpit::{Cockpit, CockpitRobot, Dashboard};
#[cfg(feature = "screen")]
pub use cspace_view::CspaceState;
pub use formula::{Formula, Level, Term};
pub use goal::{Off, ParkingGoal, trailer_of};
#[cfg(feature = "screen")]
pub use lab::lab;
#[cfg(feature = "screen")]
pub use look::Look;
pub use settings::{Settings, ThemeChoice};
pub use state::{Flash, Notice, UiState, Working};
#[cfg(feature = "screen")]
pub use transport_bar::transport_bar;

pub use crate::manifest::{KeyText, WidgetText, number_of, widget, widgets};
pub use crate::picture::{readout, readout_lines};

/// What a widget asks for. Widgets change nothing but their own [`UiState`].
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Move the run.
    Transport(crate::simulation::TransportCommand),
    /// Put something in to a robot.
    Robot(crate::simulation::RobotCommand),
    /// Do something with runs as a whole.
    Session(SessionCommand),
}

/// What is asked for that is neither a move of the run nor an input to it.
#[derive(bevy::prelude::Message, Clone, Debug, PartialEq, Eq)]
pub enum SessionCommand {
    /// Save the run: ask for a file first.
    Save,
    /// Open a run: ask for a file first.
    Open,
    /// Open a world in the atlas: ask for a file first.
    OpenWorld,
    /// Save the atlas's world: ask for a file first.
    SaveWorld,
    /// Capture the widget in front: ask for a file first.
    #[cfg(feature = "screen")]
    Capture(CaptureOrder),
    /// A new run in the atlas's world.
    RunWorld,
    /// A new run in which an arm has so many links.
    Links {
        /// The arm.
        robot: String,
        /// Two or three.
        links: usize,
    },
}
