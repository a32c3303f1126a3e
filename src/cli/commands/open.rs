//! `open`: the window with a run or a world.

use std::path::PathBuf;

use clap::Args;

use motion_lab::app::{FrameTimes, Opened, open_in_window};
use motion_lab::worlds::World;

use super::bare::ended;
use crate::cli::support::choices::WorldNames;
use crate::cli::support::input::read_bytes_if;
use crate::cli::support::world_source::find_world;
use crate::cli::{Data, Failure, Outcome};

/// Open the window with a run of a world, or with a recorded run.
///
/// A world, built in or a file ending in `.ron`, runs from the book's seed. Anything else is a log: it is simulated
/// again and compared with what was recorded, and shown paused. Without either, the three worlds are toured.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  motion-lab open lot
  motion-lab open warehouse.ron
  motion-lab open run.mcap
  motion-lab open --measure 300")]
pub struct Open {
    /// A built-in world, a world file, or a log.
    #[arg(value_parser = WorldNames)]
    what: Option<String>,
    /// Play N frames, pause for some twenty seconds and close. Prints what the frames took of the program's own time,
    /// ticks apart, and the pause of a processor core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    measure: Option<u32>,
}

impl Open {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let what = self.what.as_deref().map_or(Ok(Opened::Tour), found)?;
        match open_in_window(what, self.measure) {
            Ok(times) if self.measure.is_some() => data.line(words(&times))?,
            shown => return ended(shown.map(drop)),
        }
        Ok(Outcome::Done)
    }
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
        read_bytes_if(&path, u64::MAX, |_| false)?;
        Opened::Log(path)
    })
}

/// What the frames and the pause took, in words. A window that was closed before has no pause.
fn words(times: &FrameTimes) -> String {
    let millis = |share| times.quantile(share).map_or(f64::NAN, |t| 1e3 * t.as_secs_f64());
    let (median, most) = (millis(0.5), millis(0.95));
    let rate = times.rate().unwrap_or(f64::NAN);
    let frames = times.own.len();
    let played = format!(
        "{frames} frames, {rate:.1} a second; own time {median:.2} ms in the median, {most:.2} ms in 95 of 100"
    );
    let on_core = times.on_core(0.5).zip(times.on_core(0.95)).map_or_else(String::new, |(median, most)| {
        let [median, most] = [median, most].map(|time| 1e3 * time.as_secs_f64());
        format!("\nwithout the wait for a core that others held: {median:.2} ms, {most:.2} ms in 95 of 100")
    });
    let pieces = times.medians().map(|pieces| pieces.map(|piece| 1e3 * piece.as_secs_f64()));
    let pieces = pieces.map_or_else(String::new, |[reading, laying_out, triangles]| {
        format!(
            "\nof it, in the median: reading the run {reading:.2}, laying out {laying_out:.2}, triangles {triangles:.2}"
        )
    });
    let played = played + &on_core + &pieces;
    let Some(pause) = &times.paused else { return played };
    let seconds = pause.clock.as_secs_f64();
    match pause.share() {
        Some(share) => format!("{played}\npaused for {seconds:.1} s: {:.1} % of a core", 100.0 * share),
        None => format!("{played}\npaused for {seconds:.1} s: the share of a core is not known here"),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use motion_lab::app::Pause;

    use super::*;

    #[test]
    fn a_world_file_is_told_from_a_built_in_world() {
        assert!(matches!(found("lot"), Ok(Opened::World(_))));
        let file = "tests/samples/eight.ron";
        assert!(matches!(found(file), Ok(Opened::WorldFile(path, _)) if path.to_str() == Some(file)));
    }

    #[test]
    fn the_words_say_frames_own_time_and_the_share_of_a_core() {
        let mut times = FrameTimes::default();
        times.own = [2, 1, 9].map(Duration::from_millis).to_vec();
        times.clock = Duration::from_millis(50);
        let played = "3 frames, 60.0 a second; own time 2.00 ms in the median, 9.00 ms in 95 of 100";
        assert_eq!(words(&times), played, "closed before the pause");
        times.waited = [1, 0, 2].map(Duration::from_millis).to_vec();
        let played = format!("{played}\nwithout the wait for a core that others held: 1.00 ms, 7.00 ms in 95 of 100");
        assert_eq!(words(&times), played);
        times.pieces = vec![[0.25, 1.0, 0.75].map(Duration::from_secs_f64).map(|time| time / 1000)];
        let played = format!("{played}\nof it, in the median: reading the run 0.25, laying out 1.00, triangles 0.75");
        assert_eq!(words(&times), played);
        let mut pause = Pause::default();
        (pause.clock, pause.processor) = (Duration::from_secs(5), Some(Duration::from_millis(40)));
        times.paused = Some(pause);
        assert_eq!(words(&times), format!("{played}\npaused for 5.0 s: 0.8 % of a core"));
        times.paused = Some({
            pause.processor = None;
            pause
        });
        assert_eq!(words(&times), format!("{played}\npaused for 5.0 s: the share of a core is not known here"));
    }
}
