//! The simulator: robots, worlds, obstacles and sensors as entities, and one schedule that is a tick.
//!
//! - [`SimulationPlugin`] puts it into a Bevy app; [`start_run`] starts a run; [`step`] and [`seek()`] move it.
//! - A robot is an entity with a [`RobotModel<R>`] and the components that come with it. [`RobotPlugin`] adds a kind.
//! - The state after a tick is a [`Frame`](crate::run::Frame): [`snapshot`] takes it, [`restore`] puts it back.
//! - A window reads [`view`], [`Transport`] and [`LatestFrame`], and sends [`RunCommand`]s.
//! - [`headless_app`] is an app without a window; [`ContactBegan`] and [`ContactEnded`] are for observers. The guide's
//!   chapter is `motion_lab::guide::bevy_app`.

mod command;
mod command_error;
mod components;
mod history;
mod latest_frame;
mod obstacles;
mod past;
mod play;
mod plugin;
mod restore_error;
mod robot;
mod roster;
mod schedule;
mod seek;
mod sensors;
mod spawn;
mod spawn_error;
mod state;
#[cfg(test)]
mod tests;
mod tick;
mod transport;
mod truth;
mod undo;

pub(crate) use command::{Later, give_change, give_input};
pub use command::{RunCommand, WorldCommand};
pub use command_error::{CommandError, CommandRefused};
pub use components::{
    Configuration, Contacts, Control, Cut, Door, DrawnTour, DriveMode, MountedOn, ObstacleOf, ObstacleShape, Obstacles,
    OwnState, Placement, PreviousConfiguration, Residents, ResidesIn, RobotId, RobotModel, RobotName, Scan,
    SceneRevision, SensorModel, SensorMount, SensorName, SensorNoise, Sensors, SimulatedWorld, Slip, StandingWorld,
    TickMotion, WorldScene,
};
pub use history::{Happening, History, HistoryPlugin, TickMark};
pub use latest_frame::LatestFrame;
pub use obstacles::change::ChangeRefused;
pub use past::keyframes::Keyframes;
pub(crate) use past::keyframes::size_of_lists;
pub use past::trail::Trail;
pub use play::{PlayError, PlayStage, PlayablePath, PlayedPath};
pub use plugin::{SimulationPlugin, headless_app};
pub use restore_error::RestoreError;
pub use robot::contact::{ContactBegan, ContactEnded};
pub use robot::ops::RobotOps;
pub use robot::plugin::RobotPlugin;
pub use robot::refusal::InputRefusal;
pub use robot::registry::RobotKinds;
pub use robot::replicas::Replicas;
pub use robot::simulated::{Extra, SimulatedRobot};
pub use robot::view::RobotView;
pub use roster::{Roster, footprint_of, view, view_of};
pub use schedule::{SimulationSchedule, SimulationSystems};
pub(crate) use seek::step_alone;
pub use seek::{extend_frontier, play_tick, restore, seek, step};
pub use sensors::refusal::{SensorRefusal, SensorRefused};
pub use sensors::roster::SensorRoster;
pub use sensors::view::{SensorView, sensors, sensors_of};
pub use spawn::{is_under_way, recipe, start_recipe, start_run};
pub use spawn_error::SpawnError;
pub use state::snapshot;
pub use tick::drive::StandingRobots;
pub use tick::hold::{Advance, HOLD_CLEARANCE, MARGIN, MIN_CLEARANCE, advance, margin_from};
pub use tick::input::{PendingInput, RobotCommand};
pub(crate) use tick::parallel::each;
pub(crate) use tick::phase_states::{PhaseState, PhaseStates, watch_phases};
pub use tick::refusals::{Refusals, RefusedEvent, RefusedInput};
pub use tick::settle::FLASH_TICKS;
pub use transport::{Playback, Transport, TransportCommand};
pub use truth::foreign_change::ForeignChange;
pub use truth::robot_refusal::RobotRefusal;
pub use truth::run_config::RunConfig;
pub use truth::settle;
pub use undo::{Undo, checkpoint, take_script, undoes};

/// Bevy's app, for a program that adds robots of its own and does not otherwise use Bevy.
pub use bevy::app::App;

#[cfg(test)]
use spawn::start_run_in_order;
