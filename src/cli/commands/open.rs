//! `open`: the window with a run or a world.

use std::path::PathBuf;

use bevy::app::App;
use clap::Args;

use crate::app::{Opened, WindowError, open_in_window};
use motion_lab_core::worlds::World;

use crate::cli::commands::plan::planners::planners;
use crate::cli::support::choices::WorldNames;
use crate::cli::support::input::read_bytes_if;
use crate::cli::support::log_source::{begins_as_one, other_file};
use crate::cli::support::world_source::find_world;
use crate::cli::{Failure, Outcome};

/// Open the window with a run of a world, or with a recorded run.
///
/// A world, built in or a file ending in `.ron`, runs from the book's seed. Anything else is a log: it is simulated
/// again and compared with what was recorded, and shown paused. Without either, the three worlds are toured.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  motion-lab open lot
  motion-lab open warehouse.ron
  motion-lab open run.mcap")]
pub struct OpenArgs {
    /// A built-in world, a world file, or a log.
    #[arg(value_parser = WorldNames)]
    what: Option<String>,
}

impl OpenArgs {
    /// Runs the command.
    pub fn run(self) -> Result<Outcome, Failure> {
        ended(open_in_window(self.what.as_deref().map_or(Ok(Opened::Tour), found)?, add_planners))
    }
}

/// The window offers the planners that the program has.
fn add_planners(app: &mut App) {
    app.insert_resource(planners().clone());
}

/// The world or the log of this name.
fn found(what: &str) -> Result<Opened, Failure> {
    let path = PathBuf::from(what);
    let is_world = path.extension().is_some_and(|e| e == "ron") || !path.is_file();
    Ok(if is_world {
        let world = Box::new(find_world(what)?);
        if path.is_file() && World::built_in(what).is_none() {
            Opened::WorldFile(path, world)
        } else {
            Opened::World(world)
        }
    } else {
        // what can't be read is said here rather than in the window
        if let (false, Some(other)) = (begins_as_one(&read_bytes_if(&path, u64::MAX, |_| false)?), other_file(&path)) {
            return Err(other);
        }
        Opened::Log(path)
    })
}

/// Opens the window with the tour: the program without a command, unless it is built to record the tour.
#[cfg(not(feature = "headless"))]
pub fn tour() -> Result<Outcome, Failure> {
    ended(crate::app::run_window_with(add_planners))
}

/// The code with which Ctrl-C or a termination signal closes the window.
const CTRL_C: u8 = 130;

/// What came of the window.
fn ended(window: Result<(), WindowError>) -> Result<Outcome, Failure> {
    match window {
        Ok(()) => Ok(Outcome::Done),
        // whoever ends it from the terminal has closed it
        Err(WindowError::Closed(CTRL_C)) => Ok(Outcome::Done),
        Err(error @ WindowError::Closed(_)) => Err(Failure::internal(error)),
        Err(error) => Err(Failure::NoDisplay(error.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_world_file_is_told_from_a_built_in_world() {
        assert!(matches!(found("lot"), Ok(Opened::World(_))));
        let file = "tests/samples/eight.ron";
        assert!(matches!(found(file), Ok(Opened::WorldFile(path, _)) if path.to_str() == Some(file)));
    }

    #[test]
    fn ctrl_c_closes_the_window_and_an_error_is_a_fault() {
        assert_eq!(ended(Err(WindowError::Closed(130))).unwrap(), Outcome::Done);
        assert!(matches!(ended(Err(WindowError::Closed(1))), Err(Failure::Internal(_))));
        assert!(matches!(ended(Err(WindowError::NoDisplay)), Err(Failure::NoDisplay(_))));
    }
}
