//! `Command` and `SessionCommand`, what widgets ask for.

use super::capture_state::CaptureOrder;
use motion_lab_sim::run::Quantized;
use motion_lab_sim::simulation::{RobotCommand, RunCommand, TransportCommand};

/// A request of a widget. Widgets change nothing but their own [`UiState`](super::UiState).
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Command {
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
pub(crate) enum SessionCommand {
    /// Save the run: ask for a file first.
    Save,
    /// Open a run: ask for a file first.
    Open,
    /// Open a world in the atlas: ask for a file first.
    OpenWorld,
    /// Save the atlas's world: ask for a file first.
    SaveWorld,
    /// Open one of the files opened or saved last.
    OpenRecent(std::path::PathBuf),
    /// Capture the widget in front: ask for a file first.
    Capture(CaptureOrder),
    /// Put the picture of the widget in front on the clipboard.
    CopyPicture(CaptureOrder),
    /// A new run in the atlas's world.
    RunWorld,
    /// A new run in the atlas's world, with its robots where the atlas has them.
    RunFromHere,
    /// Put a robot of the run at these chart coordinates.
    PutRobot { world: String, robot: String, coordinates: Vec<Quantized> },
    /// A new run of the three robots, each in its world.
    ThreeRobots,
    /// A new run in which a robot plays the plan's path.
    PlayPath,
    /// Explain the contact at the present tick; once that is done, play its way out.
    Why,
    /// Play the way out of the contact that was explained.
    PlayWayOut,
    /// Save the plan's path: ask for a file first.
    SavePath,
    /// Open a path in the plan: ask for a file first.
    OpenPath,
    /// A new run in which an arm has this number of links.
    Links {
        robot: String,
        /// The number of links: two or three.
        links: usize,
    },
}
