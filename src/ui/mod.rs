//! The user interface: the four widgets, their settings and their commands.
//!
//! Colours are named by [`Theme`](crate::picture::Theme) alone. Whatever draws on a screen is behind the feature
//! `screen`.

#[cfg(feature = "screen")]
mod anatomy;
#[cfg(feature = "screen")]
mod atlas;
#[cfg(feature = "screen")]
mod capture_form;
#[cfg(feature = "screen")]
mod capture_state;
#[cfg(feature = "screen")]
mod cspace;
mod dashboard;
#[cfg(feature = "screen")]
mod help;
#[cfg(feature = "screen")]
pub mod keys;
#[cfg(feature = "screen")]
mod lab;
#[cfg(feature = "screen")]
mod paint;
mod settings;
mod state;
#[cfg(feature = "screen")]
mod tools;

#[cfg(feature = "screen")]
pub use anatomy::AnatomyState;
#[cfg(feature = "screen")]
pub use atlas::{AtlasState, Mode};
#[cfg(feature = "screen")]
pub use capture_state::{CaptureOrder, CaptureState};
#[cfg(feature = "screen")]
pub use cspace::CspaceState;
pub use dashboard::arm;
pub use dashboard::blend::{blend, heading};
pub use dashboard::goal::{Off, ParkingGoal, trailer_of};
#[cfg(feature = "screen")]
pub use dashboard::transport_bar::transport_bar;
pub use dashboard::values::{Cockpit, CockpitRobot, Dashboard};
#[cfg(feature = "screen")]
pub use lab::lab;
#[cfg(feature = "screen")]
pub use paint::canvas;
#[cfg(feature = "screen")]
pub use paint::look::Look;
pub use settings::{Settings, ThemeChoice};
pub use state::{Flash, Notice, UiState, Working};

use crate::simulation::{RobotCommand, RunCommand, TransportCommand};

pub use crate::manifest::{Formula, KeyText, Level, Term, Widget, WidgetText};
pub use crate::picture::{readout, readout_lines};

/// A request of a widget. Widgets change nothing but their own [`UiState`].
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Move the run, or give a robot an input.
    Run(RunCommand),
    /// Act on the session: files, captures, new runs.
    Session(SessionCommand),
}

impl From<TransportCommand> for Command {
    fn from(command: TransportCommand) -> Self {
        Command::Run(command.into())
    }
}

impl From<RobotCommand> for Command {
    fn from(command: RobotCommand) -> Self {
        Command::Run(command.into())
    }
}

/// A request that neither moves the run through time nor gives a robot an input.
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
    /// A new run in the atlas's world, with its robots where the atlas has them.
    RunFromHere,
    /// Put a robot of the run where the atlas has it.
    PutRobot {
        /// The robot's name.
        robot: String,
    },
    /// A new run in which an arm has this number of links.
    Links {
        /// The arm's name.
        robot: String,
        /// The number of links: two or three.
        links: usize,
    },
}
