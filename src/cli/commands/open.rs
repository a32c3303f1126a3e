//! `open`: the window with a run or a world.

use std::path::PathBuf;

use clap::Args;

use motion_lab::app::{FrameTimes, Opened, open_in_window};

use super::bare::ended;
use crate::cli::support::choices::WorldNames;
use crate::cli::support::input::read_bytes_if;
use crate::cli::support::world_source::find_world;
use crate::cli::{Data, Failure, Outcome};

/// Open the window with a run of a world, or with a recorded run.
///
/// A world, built in or a file ending in `.ron`, runs from the book's seed. Anything else is a log: it is simulated
/// again and compared with what was recorded, and shown paused.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  motion-lab open lot
  motion-lab open warehouse.ron
  motion-lab open run.mcap")]
pub struct Open {
    /// A built-in world, a world file, or a log.
    #[arg(value_parser = WorldNames)]
    what: String,
    /// Close after N frames, and print what they took of the program's own time, ticks apart.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    measure: Option<u32>,
}

impl Open {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let path = PathBuf::from(&self.what);
        let is_world = path.extension().is_some_and(|e| e == "ron") || !path.is_file();
        let what = if is_world {
            Opened::World(Box::new(find_world(&self.what)?))
        } else {
            // what can't be read is said here rather than in the window
            read_bytes_if(&path, u64::MAX, |_| false)?;
            Opened::Log(path)
        };
        match open_in_window(what, self.measure) {
            Ok(times) if self.measure.is_some() => data.line(words(&times))?,
            shown => return ended(shown.map(drop)),
        }
        Ok(Outcome::Done)
    }
}

/// What the frames took, in words.
fn words(times: &FrameTimes) -> String {
    let millis = |share| times.quantile(share).map_or(f64::NAN, |t| 1e3 * t.as_secs_f64());
    let (median, most) = (millis(0.5), millis(0.95));
    let rate = times.rate().unwrap_or(f64::NAN);
    format!(
        "{} frames, {rate:.1} a second; own time {median:.2} ms in the median, {most:.2} ms in 95 of 100",
        times.own.len()
    )
}
