//! `stats`: what runs were like for each of their robots.

use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab_core::configuration::Kinds;
use motion_lab_sim::export::{JsonNumber, json_seed};
use motion_lab_sim::run::{Recipe, RobotStats, RunStats, StatsColumn, StatsGatherer, StatsNumber, seconds};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::cli::support::input::{shown, worst_of_each};
use crate::cli::support::log_source::{LogSource, read_log, say_damage};
use crate::cli::support::simulate::each_frame;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome, say};

/// Say what runs were like for each of their robots: contacts, time in contact, length of the path, least clearance.
///
/// The clearance is the distance from the nearest obstacle at the end of a tick; other robots are no obstacles. An
/// arm's path is that of its tip. Of a log with frames nothing is simulated; the run of a digest log is simulated again
/// first.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab stats run.mcap
  motion-lab stats --json runs/*.mcap")]
pub struct StatsArgs {
    /// The logs; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// One line of JSON for each log.
    #[arg(long)]
    json: bool,
}

/// The stats of a log as JSON.
#[derive(Serialize)]
struct LogStats<'a> {
    file: String,
    #[serde(serialize_with = "json_seed")]
    seed: u64,
    ticks: u64,
    seconds: JsonNumber,
    robots: Vec<RobotStatsRow<'a>>,
}

/// A robot's stats as JSON: its names, then its numbers, null where one is not known.
struct RobotStatsRow<'a>(&'a RobotStats);

impl Serialize for RobotStatsRow<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let RobotStatsRow(robot) = self;
        let mut row = serializer.serialize_map(None)?;
        row.serialize_entry("name", &robot.name)?;
        row.serialize_entry("kind", &robot.kind)?;
        row.serialize_entry("world", &robot.world)?;
        for column in StatsColumn::ALL {
            match column.number(robot) {
                Some(StatsNumber::Whole(count)) => row.serialize_entry(column.name, &count)?,
                Some(StatsNumber::Measure(value)) => row.serialize_entry(column.name, &JsonNumber(value))?,
                None => row.serialize_entry(column.name, &())?,
            }
        }
        row.end()
    }
}

impl StatsArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let mut is_first = true;
        worst_of_each(&self.files, data, |file, data| {
            let LogSource { log, damage, .. } = read_log(file)?;
            say_damage(damage.as_ref(), "counted");
            let Recipe { seed, config, script } = &log.recipe;
            let kinds = Kinds::default();
            let mut gatherer = StatsGatherer::new(config, script, &kinds);
            let difference = each_frame(&log, |frame| gatherer.see(frame))?;
            if let Some(difference) = &difference {
                say(format!("{}: the run does not repeat its recording: {difference}", shown(file)));
            }
            let stats = gatherer.stats();
            if self.json {
                data.json(&LogStats::new(file, seed.0, &stats))?;
            } else {
                if !std::mem::replace(&mut is_first, false) {
                    data.line("")?;
                }
                print(file, &stats, data)?;
            }
            Ok(match (difference, damage) {
                (Some(_), _) => Outcome::Differs,
                (None, Some(_)) => Outcome::Recovered,
                (None, None) => Outcome::Done,
            })
        })
    }
}

impl<'a> LogStats<'a> {
    fn new(file: &Path, seed: u64, stats: &'a RunStats) -> Self {
        let time = JsonNumber(seconds(stats.ticks));
        let robots = stats.robots.iter().map(RobotStatsRow).collect();
        LogStats { file: shown(file), seed, ticks: stats.ticks, seconds: time, robots }
    }
}

/// Prints a table, a row for each robot.
fn print(file: &Path, stats: &RunStats, data: &mut Data) -> Result<(), Failure> {
    let width = |of: fn(&RobotStats) -> &str, least: usize| {
        stats.robots.iter().map(|robot| of(robot).chars().count()).max().unwrap_or(0).max(least)
    };
    let (names, worlds) = (width(|robot| &robot.name, "robot".len()), width(|robot| &robot.world, "world".len()));
    let ticks = counted(stats.ticks, "tick");
    data.line(format!("{}: {ticks} ({:.2} s)", shown(file), seconds(stats.ticks)))?;
    data.line(format!("{:names$}  {:worlds$}  contacts  in contact         path  least clearance", "robot", "world"))?;
    for robot in &stats.robots {
        let RobotStats { name, world, contacts, .. } = robot;
        let path = robot.path_length.map_or_else(|| "unknown".into(), |length| format!("{length:.3} m"));
        let clearance = robot
            .least_clearance
            .map_or_else(|| "none".into(), |least| format!("{:.4} m at {:.2} s", least.metres, seconds(least.tick)));
        let in_contact = format!("{:.2} s", robot.contact_seconds());
        data.line(format!("{name:names$}  {world:worlds$}  {contacts:>8}  {in_contact:>10}  {path:>11}  {clearance}"))?;
    }
    Ok(())
}
