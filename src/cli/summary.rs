//! What is said of a run: its robots' last states, its worlds, its digest.

use motion_lab::configuration::{Configuration, HitchCfg, T2, Tn};
use motion_lab::geometry::Pose2;
use motion_lab::random::Seed;
use motion_lab::run::{Digest, Frame};
use motion_lab::tour::TourConfig;
use serde::Serialize;

use super::json_number::JsonNumber;
use super::{Data, Failure};

/// A run as JSON.
#[derive(Debug, Serialize)]
pub struct RunSummary<'a> {
    /// The seed.
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
    /// The configuration as it is printed.
    #[serde(skip)]
    pub printed: String,
}

impl<'a> RunSummary<'a> {
    /// The summary of a run that has come to `last`.
    pub fn new(seed: Seed, config: &'a TourConfig, last: &Frame, digest: Digest) -> Self {
        let worlds = config.worlds.iter();
        RunSummary {
            seed: seed.0,
            ticks: config.ticks,
            recorded: last.tick,
            digest: digest.to_string(),
            worlds: worlds
                .map(|w| WorldSummary { name: &w.name, content_hash: format!("{:032x}", w.content_hash()) })
                .collect(),
            robots: robots(config, last),
        }
    }

    /// Prints one line for each robot: `Rusty  Pose2 { x: 2.250, y: 6.250 }  contacts: 0`.
    pub fn print_robots(&self, data: &mut Data) -> Result<(), Failure> {
        let width = self.robots.iter().map(|r| r.name.chars().count()).fold(0, usize::max);
        for RobotSummary { name, printed, contacts, .. } in &self.robots {
            data.line(format!("{name:<width$}  {printed}  contacts: {contacts}"))?;
        }
        Ok(())
    }
}

fn robots<'a>(config: &'a TourConfig, frame: &Frame) -> Vec<RobotSummary<'a>> {
    let residents = config.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| (w, r)));
    let summary = |((world, resident), state): (
        (&'a motion_lab::worlds::World, &'a motion_lab::worlds::Resident),
        &motion_lab::run::RobotState,
    )| RobotSummary {
        name: &resident.name,
        kind: &resident.kind,
        world: &world.name,
        configuration: state.configuration.iter().copied().map(JsonNumber).collect(),
        contacts: state.contacts,
        refusals: state.refusals,
        printed: print_configuration(&resident.kind, &state.configuration),
    };
    residents.zip(&frame.robots).map(summary).collect()
}

/// A configuration as its Rust type, three decimals; of a rusty x and y only.
pub fn print_configuration(kind: &str, coordinates: &[f64]) -> String {
    fn of<C: Configuration>(coordinates: &[f64]) -> Option<String> {
        C::from_coordinates(coordinates).map(|q| q.to_string())
    }
    let known = match (kind, coordinates) {
        ("rusty", [x, y, _]) => Some(format!("Pose2 {{ x: {x:.3}, y: {y:.3} }}")),
        ("hitch", [_, _, _]) => of::<Pose2>(coordinates),
        ("hitch", _) => of::<HitchCfg>(coordinates),
        ("reach", _) => of::<T2>(coordinates),
        ("reach3", _) => of::<Tn<3>>(coordinates),
        _ => None,
    };
    known.unwrap_or_else(|| format!("{kind} {coordinates:.3?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn configurations_print_as_the_book_prints_them() {
        for (kind, q, printed) in [
            ("rusty", &[6.2124, 4.4656, 0.1][..], "Pose2 { x: 6.212, y: 4.466 }"),
            ("reach", &[0.7856, 1.5714], "T2 { th1: 0.786, th2: 1.571 }"),
            ("reach3", &[0.1, 0.2, 0.3], "Tn<3> { th1: 0.100, th2: 0.200, th3: 0.300 }"),
            ("hitch", &[1.0, 2.0, 0.5], "Pose2 { x: 1.000, y: 2.000, theta: 0.500 }"),
            (
                "hitch",
                &[1.0, 2.0, 0.5, 0.1],
                "HitchCfg { body: Pose2 { x: 1.000, y: 2.000, theta: 0.500 }, trailer: Some(0.100) }",
            ),
            ("x-crane", &[1.0, 2.5], "x-crane [1.000, 2.500]"),
        ] {
            assert_eq!(print_configuration(kind, q), printed);
        }
    }
}
