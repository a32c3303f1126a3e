//! The user interface: the widgets, their settings and their commands.
//!
//! Colours are named by [`Theme`](motion_lab_core::picture::Theme) alone.

mod anatomy;
mod atlas;
mod capture_form;
pub(crate) mod capture_state;
mod closing;
mod crowd;
mod cspace;
mod dashboard;
mod help;
pub(crate) mod keys;
mod lab;
mod lesson;
mod lesson_state;
mod menu;
mod number;
pub(crate) mod paint;
pub(crate) mod plan;
mod recent;
mod recent_menu;
mod settings;
mod state;
mod tasks_done;
mod time;

pub(crate) use anatomy::AnatomyState;
pub(crate) use atlas::AtlasState;
pub(crate) use capture_state::{CaptureOrder, CaptureState};
pub(crate) use crowd::members::Members;
pub(crate) use crowd::state::CrowdState;
pub(crate) use crowd::values::{CrowdRobot, CrowdView, MAX_SHOWN_EACH, Stance};
pub(crate) use cspace::put_at::footprint_at;
pub(crate) use cspace::{CspaceState, LinkedState, TRAIL};
pub(crate) use dashboard::blend::blend;
pub(crate) use dashboard::goal::ParkingGoal;
pub(crate) use dashboard::hand::arm::{joints, turned};
pub(crate) use dashboard::twin_state::AskedTwin;
pub(crate) use dashboard::values::{Cockpit, CockpitRobot, Dashboard};
pub(crate) use lab::lab;
pub(crate) use lesson_state::LessonState;
pub(crate) use paint::frame_colours::FrameColours;
pub(crate) use plan::PlanState;
pub(crate) use recent::Recent;
pub(crate) use settings::Settings;
pub(crate) use state::{Closing, Grasp, Interface, Notice, Offer, SeedDraft, UiState, Working};

use motion_lab_sim::simulation::{RobotCommand, RunCommand, TransportCommand};

pub(crate) use motion_lab_core::picture::{readout, readout_lines};
pub(crate) use motion_lab_sim::manifest::{Widget, WidgetText};

/// A request of a widget. Widgets change nothing but their own [`UiState`].
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
    /// Put a robot of the run where the atlas has it.
    PutRobot {
        /// The robot's name.
        robot: String,
    },
    /// A new run of the three robots, each in its world.
    ThreeRobots,
    /// A new run in which a robot plays the plan's path.
    PlayPath,
    /// Save the plan's path: ask for a file first.
    SavePath,
    /// Open a path in the plan: ask for a file first.
    OpenPath,
    /// A new run in which an arm has this number of links.
    Links {
        /// The arm's name.
        robot: String,
        /// The number of links: two or three.
        links: usize,
    },
}
