//! `info`: what is in a log.

use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab_sim::export::JsonNumber;
use motion_lab_sim::run::{DT, LogKind, Recipe};
use motion_lab_sim::tour::TourConfig;
use serde::Serialize;

use crate::cli::support::input::{shown, title, worst_of_each};
use crate::cli::support::log_source::{LogSource, read_log};
use crate::cli::support::summary::RunSummary;
use crate::cli::support::words::{changes_in_words, counted, none};
use crate::cli::{Data, Failure, Outcome, say};

/// Say what is in logs, without running them again.
///
/// Of several files each has its turn, and the exit code is 3 if any can't be read, else 5 if any is damaged.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab info run.mcap
  motion-lab info --json runs/*.mcap
  zstd -dc run.mcap.zst | motion-lab info -")]
pub struct Info {
    /// The logs; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// One line of JSON for each; with several, `file` is its name.
    #[arg(long)]
    json: bool,
    /// Configurations as Rust prints them.
    #[arg(long)]
    debug: bool,
}

#[derive(Serialize)]
struct Contents<'a> {
    /// The file; left out where there is one alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(flatten)]
    run: RunSummary<'a>,
    sensor: Option<Sensor>,
    /// The robots with sensors of their own; left out without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    robots_sensors: Vec<RobotSensors<'a>>,
    script_events: usize,
    /// Changes of worlds; left out where there are none.
    #[serde(skip_serializing_if = "none")]
    script_changes: usize,
    program: &'a str,
    /// `digest` for a log without frames; left out for one with frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    log: Option<&'a str>,
    /// The run's digest that the log's end seals; null where it seals none.
    sealed_digest: Option<String>,
    damage: Option<&'a str>,
}

#[derive(Serialize)]
struct Sensor {
    rays: u32,
    range: JsonNumber,
}

/// The sensors of a robot's own.
#[derive(Serialize)]
struct RobotSensors<'a> {
    robot: &'a str,
    /// Their names, in the order of their scans.
    sensors: Vec<&'a str>,
}

/// The robots with sensors of their own.
fn robots_sensors(config: &TourConfig) -> Vec<RobotSensors<'_>> {
    let own = config.residents().filter(|resident| !resident.sensors.is_empty()).map(|resident| {
        let mut sensors: Vec<&str> = resident.sensors.iter().map(|sensor| sensor.name.as_str()).collect();
        sensors.sort_unstable();
        RobotSensors { robot: &resident.name, sensors }
    });
    own.collect()
}

impl Info {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let several = self.files.len() > 1;
        worst_of_each(&self.files, data, |file, data| self.one(file, several, data))
    }

    fn one(&self, file: &Path, several: bool, data: &mut Data) -> Result<Outcome, Failure> {
        let LogSource { log, program, sealed, damage } = read_log(file)?;
        let Recipe { config, script, .. } = &log.recipe;
        let contents = Contents {
            file: several.then(|| shown(file)),
            run: RunSummary::of(&log),
            sensor: config.sensor.map(|s| Sensor { rays: s.n_rays, range: JsonNumber(s.max_range) }),
            robots_sensors: robots_sensors(config),
            script_events: script.events.len(),
            script_changes: script.changes.len(),
            program: &program,
            log: (log.kind() == LogKind::Digests).then_some("digest"),
            sealed_digest: sealed.map(|digest| digest.to_string()),
            damage: damage.as_ref().map(|damage| damage.words.as_str()),
        };
        if self.json {
            data.json(&contents)?;
        } else {
            title(file, several, data)?;
            contents.print(self.debug, data)?;
        }
        Ok(match &damage {
            None => Outcome::Done,
            Some(damage) => {
                say(format!("{damage}\n{}", damage.next()));
                Outcome::Recovered
            }
        })
    }
}

impl Contents<'_> {
    fn print(&self, debug: bool, data: &mut Data) -> Result<(), Failure> {
        let Contents { run, sensor, robots_sensors, script_events, script_changes, program, log, .. } = self;
        let Contents { sealed_digest, damage, .. } = self;
        data.line(format!("seed     {}", run.seed))?;
        data.line(format!("ticks    {} of {} ({:.2} s)", run.recorded, run.ticks, DT * run.recorded as f64))?;
        for world in &run.worlds {
            data.line(format!("world    {}  {}", world.content_hash, world.name))?;
        }
        match sensor {
            Some(Sensor { rays, range }) => data.line(format!("sensor   {rays} rays, {} m", range.0))?,
            None => data.line("sensor   none")?,
        }
        for RobotSensors { robot, sensors } in robots_sensors {
            data.line(format!("sensors  {robot}: {}", sensors.join(", ")))?;
        }
        let changes = changes_in_words(*script_changes);
        data.line(format!("script   {}{changes}", counted(*script_events, "event")))?;
        data.line(format!("program  {program}"))?;
        if log.is_some() {
            data.line("log      a digest of each second; `motion-lab replay --log full -o FILE` makes the frames")?;
        }
        let seal = match (sealed_digest, damage) {
            (Some(_), _) => ", which its end seals",
            (None, None) => ", which its end does not seal: only its frames say that it is this run",
            (None, Some(_)) => "",
        };
        data.line(format!("digest   {}{seal}", run.digest))?;
        run.print_robots(debug, data)
    }
}
