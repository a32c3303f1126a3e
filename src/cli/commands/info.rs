//! `info`: what is in a log.

use std::path::PathBuf;

use clap::Args;
use motion_lab::export::JsonNumber;
use motion_lab::run::DT;
use motion_lab::tour::TourConfig;
use serde::Serialize;

use crate::cli::support::log_kind::{AnyLog, LogKind};
use crate::cli::support::log_source::{AnySource, read_any_log};
use crate::cli::support::script_words::{changes_in_words, none};
use crate::cli::support::summary::RunSummary;
use crate::cli::{Data, Failure, Outcome, say};

/// Say what is in a log, without running it again.
#[derive(Debug, Args)]
pub struct Info {
    /// The log.
    file: PathBuf,
    /// One line of JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Contents<'a> {
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
        let AnySource { log, program, damage } = read_any_log(&self.file)?;
        let (seed, config, script) = log.parts();
        let run = match &log {
            AnyLog::Full(log) => RunSummary::new(seed, config, log.frames.last().unwrap_or(&log.initial), log.digest()),
            AnyLog::Digest(log) => RunSummary::of_digests(log),
        };
        let contents = Contents {
            run,
            sensor: config.sensor.map(|s| Sensor { rays: s.n_rays, range: JsonNumber(s.max_range) }),
            robots_sensors: robots_sensors(config),
            script_events: script.events.len(),
            script_changes: script.changes.len(),
            program: &program,
            log: (log.kind() == LogKind::Digest).then_some("digest"),
            damage: damage.as_deref(),
        };
        if self.json {
            data.json(&contents)?;
        } else {
            contents.print(data)?;
        }
        Ok(match &damage {
            None => Outcome::Done,
            Some(damage) => {
                say(format!("{damage}\n`motion-lab record --resume` makes it whole."));
                Outcome::Recovered
            }
        })
    }
}

impl Contents<'_> {
    fn print(&self, data: &mut Data) -> Result<(), Failure> {
        let Contents { run, sensor, robots_sensors, script_events, script_changes, program, log, .. } = self;
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
        data.line(format!("script   {script_events} events{changes}"))?;
        data.line(format!("program  {program}"))?;
        if log.is_some() {
            data.line("log      a digest of each second; `motion-lab replay --log full -o FILE` makes the frames")?;
        }
        data.line(format!("digest   {}", run.digest))?;
        run.print_robots(data)
    }
}
