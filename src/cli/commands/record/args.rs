//! `RecordArgs`, what `record` is asked for.

use super::choice::StartChoice;
use super::seeds::SeedRange;
use crate::cli::support::choices::{RobotNames, WorldNames, log_kind};
use clap::Args;
use motion_lab_sim::run::LogKind;
use std::path::PathBuf;

/// Record a run, and print where its robots end, their contacts and its digest.
///
/// The same options give the same digest on every machine, whatever the number of threads. Ctrl-C ends a recording
/// after the tick under way: with -o FILE what was done is kept in FILE.partial, and `record --resume FILE.partial`
/// goes on from there.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab record --seed 7 --seconds 10 -o seven.mcap
  motion-lab record --world apartment --robot Rusty --script drive.ron
  motion-lab record --place Reach=reach3:0.1,0.2,0.3
  motion-lab record --seeds 0..100 --threads 4
  motion-lab record --resume seven.mcap.partial")]
pub struct RecordArgs {
    /// A built-in world or the path of a world file; may be given several times. [default: apartment, workbench, lot]
    #[arg(long, value_name = "NAME|FILE", value_parser = WorldNames, hide_possible_values = true)]
    pub(super) world: Vec<String>,
    /// Keep only the robots named so; may be given several times. [default: all]
    #[arg(long, value_name = "NAME", value_parser = RobotNames, hide_possible_values = true)]
    pub(super) robot: Vec<String>,
    /// Start the robot of this name at these coordinates, as another kind if one is given (rusty, reach, reach3,
    /// hitch): "Rusty=1,2,0", "Reach=reach3:0.1,0.2,0.3". The other robots stay. It keeps the sizes that the world says
    /// unless it becomes of another kind. May be given several times.
    #[arg(long, value_name = "NAME=[KIND:]NUMBERS")]
    pub(super) place: Vec<StartChoice>,
    /// The seed. [default: 2005]
    #[arg(long, conflicts_with = "seeds")]
    pub(super) seed: Option<u64>,
    /// Record a run for each of these seeds, A to B without B, and print a line for each, `SEED DIGEST`, in this order.
    #[arg(long, value_name = "A..B", conflicts_with_all = ["resume", "stop_after"])]
    pub(super) seeds: Option<SeedRange>,
    /// How long, in ticks of 0.05 s. [default: 1200]
    #[arg(long)]
    pub(super) ticks: Option<u64>,
    /// How long, in seconds; a whole number of ticks.
    #[arg(long, conflicts_with = "ticks")]
    pub(super) seconds: Option<f64>,
    /// The input script.
    #[arg(long, value_name = "FILE")]
    pub(super) script: Option<PathBuf>,
    /// Fail at the first input of the script that is refused, and write nothing. Without it refused inputs are counted,
    /// and the first one's reason is said.
    #[arg(long)]
    pub(super) strict: bool,
    /// First run it with each tick saved, stepped, restored, stepped again and compared; where a tick comes out
    /// otherwise the second time, say the phase, the robot, the value and its bits, and record nothing. It takes three
    /// times as long.
    #[arg(long, conflicts_with_all = ["seeds", "resume"])]
    pub(super) paranoid: bool,
    /// The range sensor's number of rays, 1 to 100000.
    #[arg(long)]
    pub(super) rays: Option<u32>,
    /// The range sensor's greatest range, metres, up to 10000.
    #[arg(long)]
    pub(super) range: Option<f64>,
    /// No range sensor.
    #[arg(long, conflicts_with_all = ["rays", "range"])]
    pub(super) no_sensor: bool,
    /// Write the log to this file; with --seeds {seed} in its name stands for the seed.
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// What the log keeps: `full`, every frame, or `digest`, a digest of each second, which `verify` compares. A digest
    /// log takes some 11 bytes a second; `replay --log full -o FILE` makes the frames from it. [default: full, but
    /// digest above 100 robots]
    #[arg(long, value_name = "KIND", value_parser = log_kind(), conflicts_with = "resume", hide_possible_values = true)]
    pub(super) log: Option<LogKind>,
    /// Go on with a recording that stopped early: run it again from its seed and script, check it against what is
    /// there, and write the whole. The output is named as FILE is, without .partial.
    #[arg(long, value_name = "FILE", conflicts_with_all = [
        "world", "robot", "place", "seed", "ticks", "seconds", "script", "rays", "range", "no_sensor",
    ])]
    pub(super) resume: Option<PathBuf>,
    /// Stop after this tick as if by Ctrl-C.
    #[arg(long, value_name = "TICK")]
    pub(super) stop_after: Option<u64>,
    /// How many seeds to run at once, at most 256. It changes no bit. [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(..=256))]
    pub(super) threads: Option<u16>,
    /// One line of JSON for each run.
    #[arg(long)]
    pub(super) json: bool,
    /// Configurations as Rust prints them.
    #[arg(long, conflicts_with_all = ["seeds", "json"])]
    pub(super) debug: bool,
}
