//! `open`: the window with a run or a world.

use std::path::PathBuf;

use clap::Args;

use motion_lab::app::{open_log_in_window, open_world_in_window};

use super::bare::ended;
use crate::cli::support::input::read_bytes_if;
use crate::cli::support::world_source::find_world;
use crate::cli::{Failure, Outcome};

/// Open the window with a run of a world, or with a recorded run.
///
/// A world, built in or a file ending in `.ron`, runs from the book's seed. Anything else is a log: it is simulated
/// again and compared with what was recorded, and shown paused.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  motion-lab open lot
  motion-lab world generate warehouse --robots 1000 -o warehouse.ron && motion-lab open warehouse.ron
  motion-lab open run.mcap")]
pub struct Open {
    /// A built-in world, a world file, or a log.
    what: String,
}

impl Open {
    /// Runs the command.
    pub fn run(self) -> Result<Outcome, Failure> {
        let path = PathBuf::from(&self.what);
        if path.extension().is_some_and(|e| e == "ron") || !path.is_file() {
            return ended(open_world_in_window(find_world(&self.what)?));
        }
        // what can't be read is said here rather than in the window
        read_bytes_if(&path, u64::MAX, |_| false)?;
        ended(open_log_in_window(path))
    }
}
