//! `diff`: where two logs differ.

use std::path::PathBuf;
use std::slice::from_ref;

use clap::Args;
use motion_lab_sim::export::JsonNumber;
use motion_lab_sim::run::{Divergence, DivergingScan, Log, SetupDifference, Value, first_divergence};
use serde::Serialize;

use crate::cli::support::log_source::{read_full_log, say_damage};
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};

/// Compare two logs to the last bit, and name the first value that differs.
///
/// Seed, ticks, sensor, worlds and script are compared first, then the frames tick by tick; the programs that wrote the
/// files don't count. The exit code is 4 when the logs differ. Of a damaged or unfinished file the sealed beginning is
/// compared; when all of that is equal, the exit code is 5.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab diff mine.mcap yours.mcap
  motion-lab diff --json run.mcap replayed.mcap")]
pub struct Diff {
    /// The first log; `-` is standard input.
    a: PathBuf,
    /// The second log; one of the two may be `-`.
    b: PathBuf,
    /// One line of JSON.
    #[arg(long)]
    json: bool,
}

/// What differs between two logs: the answer of `diff`, printed in words or as JSON.
#[derive(Serialize)]
struct LogDifference {
    equal: bool,
    /// The ticks that both logs have.
    ticks: u64,
    /// The number of these that differ.
    differing_ticks: u64,
    setup: Vec<Setup>,
    divergence: Option<FirstValue>,
}

#[derive(Serialize)]
struct Setup {
    item: String,
    a: String,
    b: String,
}

/// The first value that differs.
#[derive(Serialize)]
struct FirstValue {
    tick: u64,
    robot: Option<u32>,
    name: Option<String>,
    /// Of a robot with several scans, the number of the scan that holds the value, from 1, and its sensor's name, which
    /// is empty for the run's own sensor and null for one that the run's configuration does not have.
    #[serde(flatten)]
    scan: Option<ScanDifference>,
    field: String,
    a: JsonValue,
    b: JsonValue,
    a_bits: String,
    b_bits: String,
    ulps: Option<u64>,
    #[serde(skip)]
    printed: [String; 2],
}

/// One of a robot's scans.
#[derive(Serialize)]
struct ScanDifference {
    scan: usize,
    sensor: Option<String>,
    #[serde(skip)]
    printed: String,
}

/// A frame's value as JSON has it.
#[derive(Serialize)]
#[serde(untagged)]
enum JsonValue {
    Float(JsonNumber),
    Integer(i64),
    Count(u64),
    Flag(bool),
}

impl Diff {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let (a, b) = (read_full_log(&self.a)?, read_full_log(&self.b)?);
        for damage in [&a.damage, &b.damage] {
            say_damage(damage.as_ref(), "compared");
        }
        let damaged = a.damage.or(b.damage).is_some();
        let difference = LogDifference::of(&a.log, &b.log, damaged);
        if self.json {
            data.json(&difference)?;
        } else {
            difference.print(data)?;
        }
        Ok(match (difference.equal, damaged) {
            (false, _) => Outcome::Differs,
            (true, true) => Outcome::Recovered,
            (true, false) => Outcome::Done,
        })
    }
}

impl LogDifference {
    /// Compares all ticks; if `common_only`, those that both logs have.
    fn of(a: &Log, b: &Log, common_only: bool) -> Self {
        let common = std::cmp::min(a.frames().len(), b.frames().len());
        let compared = |log: &'_ Log| log.frames().len().min(if common_only { common } else { usize::MAX });
        let divergence = first_divergence(a.initial().map_or(&[], from_ref), b.initial().map_or(&[], from_ref))
            .or_else(|| first_divergence(&a.frames()[..compared(a)], &b.frames()[..compared(b)]))
            .map(|d| FirstValue::of(&d.named(&a.recipe.config), a));
        let setup: Vec<Setup> = a
            .recipe
            .differences(&b.recipe)
            .into_iter()
            .map(|SetupDifference { item, first, second }| Setup { item, a: first, b: second })
            .collect();
        let both = a.frames().iter().zip(b.frames());
        LogDifference {
            equal: setup.is_empty() && divergence.is_none(),
            ticks: common as u64,
            differing_ticks: both.filter(|(a, b)| a.digest() != b.digest()).count() as u64,
            setup,
            divergence,
        }
    }

    fn print(&self, data: &mut Data) -> Result<(), Failure> {
        for Setup { item, a, b } in &self.setup {
            data.line(format!("{item}: {a} in A, {b} in B"))?;
        }
        if let Some(value) = &self.divergence {
            data.line(value.line())?;
        }
        let LogDifference { ticks, differing_ticks, .. } = self;
        match self.equal {
            true => data.line(format!("{}, equal to the last bit", counted(ticks, "tick"))),
            false => data.line(format!("{differing_ticks} of {} differ", counted(ticks, "tick"))),
        }
    }
}

impl FirstValue {
    fn of(divergence: &Divergence, log: &Log) -> Self {
        let Divergence { tick, robot, scan, field, expected, found } = divergence;
        let name = robot.and_then(|id| log.recipe.config.robot_names().nth(id as usize)).map(str::to_owned);
        FirstValue {
            tick: *tick,
            robot: *robot,
            name,
            scan: scan.as_ref().map(ScanDifference::of),
            field: field.clone(),
            a: (*expected).into(),
            b: (*found).into(),
            a_bits: format!("{:#018x}", expected.bits()),
            b_bits: format!("{:#018x}", found.bits()),
            ulps: divergence.ulps(),
            printed: [expected.to_string(), found.to_string()],
        }
    }

    /// `tick 17, robot 1 (Reach), configuration[0]: 1.5 (0x3ff8000000000000) in A, ... in B, 1 ulp apart`.
    fn line(&self) -> String {
        let FirstValue { tick, field, a_bits, b_bits, printed: [a, b], .. } = self;
        let robot = match (self.robot, &self.name) {
            (Some(id), Some(name)) => format!("robot {id} ({name}), "),
            (Some(id), None) => format!("robot {id}, "),
            (None, _) => String::new(),
        };
        let apart = match self.ulps {
            Some(1) => ", 1 ulp apart".to_owned(),
            Some(n) => format!(", {n} ulps apart"),
            None => String::new(),
        };
        let scan = self.scan.as_ref().map_or_else(String::new, |scan| format!("{}, ", scan.printed));
        format!("tick {tick}, {robot}{scan}{field}: {a} ({a_bits}) in A, {b} ({b_bits}) in B{apart}")
    }
}

impl ScanDifference {
    fn of(scan: &DivergingScan) -> Self {
        ScanDifference { scan: scan.number, sensor: scan.sensor.clone(), printed: scan.to_string() }
    }
}

impl From<Value> for JsonValue {
    fn from(value: Value) -> Self {
        match value {
            Value::Float(x) => JsonValue::Float(JsonNumber(x)),
            Value::Integer(i) => JsonValue::Integer(i),
            Value::Count(n) => JsonValue::Count(n),
            Value::Flag(yes) => JsonValue::Flag(yes),
        }
    }
}
