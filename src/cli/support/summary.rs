//! The summary of a run: its robots' last states, its worlds, its digest.

use motion_lab_core::configuration::RobotKind;
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::export::{JsonNumber, json_seed};
use motion_lab_sim::recording::printed_configuration;
use motion_lab_sim::run::{Digest, Frame, Log, Recipe, Recorded, RobotState};
use motion_lab_sim::tour::TourConfig;
use serde::Serialize;

use crate::cli::{Data, Failure};

/// From more robots on they are printed in one line; JSON has them all.
const MAX_PRINTED: usize = 100;

/// A run as JSON.
#[derive(Debug, Serialize)]
pub struct RunSummary<'a> {
    /// The seed.
    #[serde(serialize_with = "json_seed")]
    pub seed: u64,
    /// The ticks configured.
    pub ticks: u64,
    /// The ticks recorded.
    pub recorded: u64,
    /// The digest of the run as far as it is recorded, as 32 hexadecimal digits.
    pub digest: String,
    /// The worlds.
    pub worlds: Vec<WorldSummary<'a>>,
    /// The robots' last states, by id.
    pub robots: Vec<RobotSummary<'a>>,
}

/// A world of a run.
#[derive(Debug, Serialize)]
pub struct WorldSummary<'a> {
    /// Its name.
    pub name: &'a str,
    /// The hash of its content, as 32 hexadecimal digits.
    pub content_hash: String,
}

/// A robot's last state.
#[derive(Debug, Serialize)]
pub struct RobotSummary<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its kind.
    pub kind: &'a str,
    /// Its world's name.
    pub world: &'a str,
    /// The coordinates of its configuration.
    pub configuration: Vec<JsonNumber>,
    /// Its contact episodes.
    pub contacts: u32,
    /// The inputs it refused.
    pub refusals: u32,
    /// The coordinates as numbers.
    #[serde(skip)]
    pub numbers: Vec<f64>,
    /// The configuration in Rust's spelling.
    #[serde(skip)]
    pub printed: String,
}

/// The worlds of a run.
fn worlds(config: &TourConfig) -> Vec<WorldSummary<'_>> {
    let hash = |w: &World| format!("{:032x}", w.content_hash());
    config.worlds.iter().map(|w| WorldSummary { name: &w.name, content_hash: hash(w) }).collect()
}

impl<'a> RunSummary<'a> {
    /// The summary of a log. One of digests knows no robot's state, and where it ends early, the last 16 digits of its
    /// digest only.
    pub fn of(log: &'a Log) -> Self {
        let Recipe { seed, config, .. } = &log.recipe;
        let (digest, last) = match &log.recorded {
            Recorded::Frames { initial, frames } => (log.digest(), Some(frames.last().unwrap_or(initial))),
            Recorded::Digests(digests) => (digests.whole, None),
        };
        let so_far = || match &log.recorded {
            Recorded::Digests(digests) => format!("{:016x}", digests.after(digests.ticks).unwrap_or(digests.start)),
            Recorded::Frames { .. } => String::new(),
        };
        RunSummary {
            seed: seed.0,
            ticks: config.ticks,
            recorded: log.ticks(),
            digest: digest.map_or_else(so_far, |digest| digest.to_string()),
            worlds: worlds(config),
            robots: last.map_or_else(Vec::new, |last| robots(config, last)),
        }
    }

    /// The summary of a run that has come to `last`.
    pub fn new(recipe: &'a Recipe, last: &Frame, digest: Digest) -> Self {
        let Recipe { seed, config, .. } = recipe;
        RunSummary {
            seed: seed.0,
            ticks: config.ticks,
            recorded: last.tick,
            digest: digest.to_string(),
            worlds: worlds(config),
            robots: robots(config, last),
        }
    }

    /// Prints a table with a line for each robot, under a heading; in Rust's spelling with `debug`, without one: `Rusty
    /// Pose2 { x: 2.250, y: 6.250 }  contacts: 0`. Of a crowd it prints one line, `1000 robots  contacts: 12, of 7 of
    /// them`.
    pub fn print_robots(&self, debug: bool, data: &mut Data) -> Result<(), Failure> {
        if self.robots.len() > MAX_PRINTED {
            let contacts: u64 = self.robots.iter().map(|robot| u64::from(robot.contacts)).sum();
            let touching = self.robots.iter().filter(|robot| robot.contacts > 0).count();
            let of = if contacts > 0 { format!(", of {touching} of them") } else { String::new() };
            return data.line(format!("{} robots  contacts: {contacts}{of}", self.robots.len()));
        }
        if debug {
            for RobotSummary { name, printed, contacts, .. } in &self.robots {
                data.line(format!("{name}  {printed}  contacts: {contacts}"))?;
            }
            return Ok(());
        }
        let rows: Vec<[String; 3]> = self.robots.iter().map(RobotSummary::row).collect();
        let heading = ["robot", "where", "contacts"].map(str::to_owned);
        let width = |column: usize| {
            let widths = rows.iter().chain([&heading]).map(|row| row[column].chars().count());
            widths.max().unwrap_or(0)
        };
        let (names, places) = (width(0), width(1));
        let table = if rows.is_empty() { &[][..] } else { std::slice::from_ref(&heading) };
        for [name, place, contacts] in table.iter().chain(&rows) {
            data.line(format!("{name:names$}  {place:places$}  {contacts:>8}"))?;
        }
        Ok(())
    }
}

impl RobotSummary<'_> {
    /// The robot's line: its name, its coordinates with names and units, its contacts.
    fn row(&self) -> [String; 3] {
        [self.name.to_owned(), in_words(RobotKind::of(self.kind), &self.numbers), self.contacts.to_string()]
    }
}

/// A number with three decimals, never `-0.000`.
fn decimals(x: f64) -> String {
    let text = format!("{x:.3}");
    if text == "-0.000" { "0.000".to_owned() } else { text }
}

/// A configuration with the names of its coordinates and their units: `x 2.250 m, y 6.250 m, heading 1.571 rad`. The
/// coordinates alone of a kind that the lab does not have.
fn in_words(kind: Option<&RobotKind>, q: &[f64]) -> String {
    let coordinate = |(i, x): (usize, &f64)| match kind {
        Some(kind) => {
            let unit = if i < kind.lengths { "m" } else { "rad" };
            let name = kind.coordinates.get(i).copied().unwrap_or("");
            let name = match (name, kind.drives) {
                ("theta", true) => "heading",
                ("psi", true) => "trailer's heading",
                (name, _) => name,
            };
            format!("{name} {} {unit}", decimals(*x))
        }
        None => decimals(*x),
    };
    q.iter().enumerate().map(coordinate).collect::<Vec<_>>().join(", ")
}

fn robots<'a>(config: &'a TourConfig, frame: &Frame) -> Vec<RobotSummary<'a>> {
    let residents = config.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| (w, r)));
    let summary = |((world, resident), state): ((&'a World, &'a Resident), &RobotState)| RobotSummary {
        name: &resident.name,
        kind: &resident.kind,
        world: &world.name,
        configuration: state.configuration.iter().copied().map(JsonNumber).collect(),
        contacts: state.contacts,
        refusals: state.refusals,
        numbers: state.configuration.to_vec(),
        printed: printed_configuration(&resident.kind, &state.configuration),
    };
    residents.zip(&frame.robots).map(summary).collect()
}
