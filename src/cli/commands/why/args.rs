//! `WhyArgs`, what `why` is asked for.

use std::path::PathBuf;

use clap::Args;
use motion_lab_sim::avoid::{ContactEpisode, EvasionSet, EvasionSpeeds};
use motion_lab_sim::run::DT;

use crate::cli::Failure;
use crate::cli::support::choices::RobotNames;

/// Say until when each contact of a run could have been avoided, and how
///
/// The run is simulated again, and branches from the ticks before a contact: the robot gets other inputs, all else goes
/// on as it would. Two answers come of it for each contact, each with its last chance:
///
/// - by stopping. A rover and a car stop within a tick, so standing still in the contact's own tick avoids it.
/// - by going on. A robot that drives keeps the speed that it had and steers: all of the set's inputs are tried from
///   each tick, from the contact's back. "Too late" is exact over this set and nothing else: channels that stay the
///   same but for --switches, at multiples of --every. An arm goes round to where it leaves the contact, by a planner.
///
/// A way out has been simulated in the whole run, and has no contact of the robot until --horizon after the beginning
/// of the one it avoids; a robot that drives stops then. Another robot may still drive into one that stands, and is
/// said to.
#[derive(Debug, Args)]
#[command(
    verbatim_doc_comment,
    after_help = "\
Examples:
  motion-lab why run.mcap
  motion-lab why run.mcap --robot Hitch --contact 1 -o saved.mcap
  motion-lab why run.mcap --speeds 128,64,-64 --turns 0,128,-128 --switches 2 --every 0.5 --back 3"
)]
pub struct WhyArgs {
    /// The log; `-` is standard input.
    pub(super) file: PathBuf,
    /// The contacts of this robot alone. [default: of all]
    #[arg(long, value_name = "NAME", value_parser = RobotNames, hide_possible_values = true)]
    pub(super) robot: Option<String>,
    /// The contact of this number alone, from 1, of each robot. [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) contact: Option<u32>,
    /// The speed channels to be tried, -128 to 128, joined by commas. [default: the speed that the robot had]
    #[arg(long, value_name = "CHANNELS", value_delimiter = ',', allow_hyphen_values = true)]
    pub(super) speeds: Vec<i16>,
    /// The values of the second channel to be tried: the turn rate or the steering angle.
    #[arg(
        long,
        value_name = "CHANNELS",
        value_delimiter = ',',
        allow_hyphen_values = true,
        default_value = "0,32,-32,64,-64,96,-96,128,-128"
    )]
    pub(super) turns: Vec<i16>,
    /// How often the channels may change.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) switches: u32,
    /// The time between changes, seconds: they change at its multiples after the first input.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.25)]
    pub(super) every: f64,
    /// How long the robot must be free of any contact, from the first tick of the one it avoids on, seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 2.0)]
    pub(super) horizon: f64,
    /// How long before the contact a way out is sought, seconds: at most up to the end of the contact before, and an
    /// arm's way round from 20 ticks.
    #[arg(long, value_name = "SECONDS", default_value_t = 5.0)]
    pub(super) back: f64,
    /// Write the run with the way out, of one contact, as a log: by going on where there is one, else by stopping. It
    /// ends where the way out is known to be free.
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Write its script.
    #[arg(long, value_name = "FILE")]
    pub(super) script: Option<PathBuf>,
    /// One line of JSON for each contact.
    #[arg(long)]
    pub(super) json: bool,
}

impl WhyArgs {
    /// The inputs among which a way out is sought.
    pub(super) fn set(&self) -> Result<EvasionSet, Failure> {
        let speeds =
            if self.speeds.is_empty() { EvasionSpeeds::Kept } else { EvasionSpeeds::Channels(self.speeds.clone()) };
        let set = EvasionSet {
            speeds,
            turns: self.turns.clone(),
            switches: self.switches,
            every: ticks("--every", self.every)?,
            horizon: ticks("--horizon", self.horizon)?,
            back: ticks("--back", self.back)?,
        };
        let refused = |error| Failure::usage(error, "See `motion-lab why --help`.");
        set.check().map(|()| set).map_err(refused)
    }

    /// Whether the contacts of a robot are asked for.
    pub(super) fn wants(&self, robot: &str) -> bool {
        self.robot.as_ref().is_none_or(|name| name == robot)
    }

    /// Whether a contact is asked for, by its number.
    pub(super) fn wants_number(&self, episode: &ContactEpisode) -> bool {
        self.contact.is_none_or(|number| number == episode.number)
    }
}

/// A time in ticks.
fn ticks(option: &str, seconds: f64) -> Result<u64, Failure> {
    let ticks = (seconds / DT).round();
    let reason = match () {
        () if !(0.0..1e9).contains(&ticks) => format!("{option} {seconds}: it is out of range"),
        () if (ticks * DT - seconds).abs() < 1e-9 => return Ok(ticks as u64),
        () => format!("{option} {seconds}: not a whole number of ticks of {DT} s"),
    };
    Err(Failure::usage(reason, format!("Write {option} 0.5, for one.")))
}
