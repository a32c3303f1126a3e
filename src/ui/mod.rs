//! What people see and touch. Colours are known to [`Theme`] alone; what needs a window stands behind the feature `window`.

#[cfg(feature = "window")]
mod anatomy_view;
pub mod arm;
#[cfg(feature = "window")]
mod atlas_editing;
#[cfg(feature = "window")]
mod atlas_state;
#[cfg(feature = "window")]
mod atlas_view;
mod blend;
#[cfg(feature = "window")]
mod button;
#[cfg(feature = "window")]
pub mod canvas;
#[cfg(feature = "window")]
mod capture_form;
mod cockpit;
#[cfg(feature = "window")]
mod cspace_view;
#[cfg(feature = "window")]
mod dashboard;
#[cfg(feature = "window")]
mod drive;
mod formula;
#[cfg(feature = "window")]
mod frame;
mod goal;
#[cfg(feature = "window")]
mod handles;
#[cfg(feature = "window")]
mod help;
#[cfg(feature = "window")]
pub mod keys;
#[cfg(feature = "window")]
mod lab;
#[cfg(feature = "window")]
mod look;
#[cfg(feature = "window")]
mod pad;
#[cfg(feature = "window")]
mod pane;
#[cfg(feature = "window")]
mod plots;
mod settings;
#[cfg(feature = "window")]
mod sheet;
mod state;
mod theme;
#[cfg(feature = "window")]
mod time_line;
#[cfg(feature = "window")]
mod tools;
#[cfg(feature = "window")]
mod transport_bar;

#[cfg(feature = "window")]
pub use anatomy_view::AnatomyState;
#[cfg(feature = "window")]
pub use atlas_state::{AtlasState, Mode};
pub use blend::{blend, heading};
#[cfg(feature = "window")]
pub use capture_form::{CaptureOrder, CaptureState};
pub use cockpit::{Cockpit, CockpitRobot, Dashboard};
#[cfg(feature = "window")]
pub use cspace_view::CspaceState;
pub use formula::{Formula, Level, Term};
pub use goal::{Off, ParkingGoal, trailer_of};
#[cfg(feature = "window")]
pub use lab::lab;
#[cfg(feature = "window")]
pub use look::Look;
pub use settings::{Settings, ThemeChoice};
pub use state::{Flash, Notice, UiState, Working};
pub use theme::Theme;
#[cfg(feature = "window")]
pub use transport_bar::transport_bar;

pub use crate::manifest::{KeyText, WidgetText, widget, widgets};
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
    #[cfg(feature = "window")]
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
