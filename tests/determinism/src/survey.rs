//! `Survey`, what the generated runs have met.

use std::collections::BTreeMap;

use motion_lab_core::configuration::InputKind;
use motion_lab_core::random::Seed;
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{Frame, Recipe, WorldChange};

use crate::feature::Feature;

/// The number of generated runs from which on each thing has to be met in an eighth of them.
const ENOUGH: u32 = 32;

/// How many of the generated runs have met what.
#[derive(Debug, Default)]
pub struct Survey {
    runs: u32,
    met: BTreeMap<String, u32>,
}

impl Survey {
    /// Counts what a run has met that has come to its end, and whether a trailer was coupled or let go on the way.
    pub fn see(&mut self, recipe: &Recipe, is_coupled: bool, run: &Recorder) {
        self.runs += 1;
        let on = Feature::of_seed(recipe.seed);
        let end = run.frame();
        for feature in Feature::ALL {
            let is_met = on.contains(&feature) && is_met(feature, recipe, end);
            *self.met.entry(format!("{feature:?}")).or_default() += u32::from(is_met);
        }
        let results = [
            ("a contact", end.robots.iter().any(|robot| robot.contacts > 0)),
            ("a refused input", end.robots.iter().any(|robot| robot.refusals > 0)),
            ("a trailer coupled or let go", is_coupled),
            ("no input at all", recipe.inputs() == 0),
        ];
        for (what, is_met) in results {
            *self.met.entry(what.to_owned()).or_default() += u32::from(is_met);
        }
    }

    /// What was met in how many of the runs.
    pub fn words(&self) -> String {
        let counts: Vec<String> = self.met.iter().map(|(what, runs)| format!("{what} {runs}")).collect();
        format!("of {} generated runs met: {}", self.runs, counts.join(", "))
    }

    /// What was met in too few of many runs.
    pub fn seldom(&self) -> Vec<&str> {
        // a run without any input is one of a few, in which most features are off
        let least = |what: &str| if what == "no input at all" { 1 } else { self.runs / 8 };
        let few = |(what, runs): &(&String, &u32)| **runs < least(what);
        if self.runs < ENOUGH {
            Vec::new()
        } else {
            self.met.iter().filter(few).map(|(what, _)| what.as_str()).collect()
        }
    }
}

/// Whether a run whose features include this one has it: in its worlds, its script or its last frame.
fn is_met(feature: Feature, recipe: &Recipe, end: &Frame) -> bool {
    let input = |kind: InputKind| recipe.script.events.iter().any(|event| event.input.kind() == kind);
    let change = |is_one: fn(&WorldChange) -> bool| recipe.script.changes.iter().any(|event| is_one(&event.change));
    let mut robots = recipe.config.worlds.iter().flat_map(|world| &world.robots);
    match feature {
        Feature::Drives => input(InputKind::Drive),
        Feature::Moves => input(InputKind::MoveTo),
        Feature::Teleports => input(InputKind::Teleport),
        Feature::Trailers => input(InputKind::SetTrailer),
        Feature::Releases => input(InputKind::Release),
        Feature::Doors => change(|c| matches!(c, WorldChange::Close(_))) && !end.obstacles.is_empty(),
        Feature::Additions => change(|c| matches!(c, WorldChange::Add { .. })) && !end.obstacles.is_empty(),
        Feature::Removals => {
            change(|c| matches!(c, WorldChange::Remove(_))) && end.obstacles.iter().any(|o| !o.present)
        }
        Feature::Displacements => change(|c| matches!(c, WorldChange::Move { .. })) && !end.obstacles.is_empty(),
        Feature::RunSensor => !end.scans.is_empty(),
        Feature::OwnSensors => robots.any(|robot| !robot.sensors.is_empty()),
        Feature::Noise => robots.any(|robot| robot.sensor.is_some()) && !end.scans.is_empty(),
        Feature::Crowd => recipe.config.worlds.iter().any(|world| world.robots.len() > 3),
        Feature::Sizes | Feature::Jackknife => robots.any(|robot| robot.sizes.is_some()),
        Feature::Routes => robots.any(|robot| robot.route.is_some()),
    }
}

/// Whether a robot has its trailer in one of the frames alone.
pub fn is_coupled_otherwise(start: &Frame, frame: &Frame) -> bool {
    start.robots.iter().zip(&frame.robots).any(|(before, now)| before.configuration.len() != now.configuration.len())
}

/// Whether a name is that of a generated run, and of which seed.
pub fn generated(name: &str) -> Option<Seed> {
    name.strip_prefix("swarm-")?.parse().ok().map(Seed)
}
