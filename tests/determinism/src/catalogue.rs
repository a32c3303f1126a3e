//! The runs, by their names.

use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Warehouse, World};
use motion_lab_sim::run::Recipe;
use motion_lab_sim::tour::TourConfig;

use crate::feature::Feature;
use crate::inputs::script;
use crate::{recipes, swarm};

/// The pinned runs, whose digests `released.txt` holds.
const PINNED: [(&str, fn() -> Recipe); 5] = [
    ("pin-tour", recipes::tour),
    ("pin-driving", recipes::driving),
    ("pin-eight", recipes::eight),
    ("pin-noisy", recipes::noisy),
    ("pin-trailer", recipes::trailer),
];

/// What is asked of robots in the three worlds.
const DRIVING: [Feature; 5] =
    [Feature::Drives, Feature::Moves, Feature::Teleports, Feature::Trailers, Feature::Releases];

/// A run with its name.
pub struct NamedRun {
    /// The name, without blanks.
    pub name: String,
    /// The run.
    pub recipe: Recipe,
}

/// The pinned runs, then for each seed from 1 on a run in each of the three worlds, a warehouse and a generated run,
/// then two crowds that a tick divides among threads.
pub fn catalogue(seeds: u64) -> impl Iterator<Item = NamedRun> {
    let pinned = PINNED.into_iter().map(|(name, recipe)| NamedRun { name: name.into(), recipe: recipe() });
    let seeded = (1..=seeds).flat_map(|seed| {
        let worlds =
            World::built_in_names().into_iter().filter_map(World::built_in).map(move |world| driven(world, seed));
        let swarm = NamedRun { name: format!("swarm-{seed}"), recipe: swarm::recipe(Seed(seed)) };
        worlds.chain(warehouse("warehouse", seed, 10 * (1 + seed as usize % 4), 100)).chain([swarm])
    });
    pinned.chain(seeded).chain((1..=2).filter_map(|seed| warehouse("crowd", seed, 400, 30)))
}

/// The run of this name.
pub fn named(name: &str, seeds: u64) -> Option<NamedRun> {
    catalogue(seeds).find(|run| run.name == name)
}

/// A world whose robots are driven in every way.
fn driven(world: World, seed: u64) -> NamedRun {
    let name = format!("{}-{seed}", world.name.to_lowercase().replace(' ', "-"));
    let mut draws = Stream::new(Seed(seed), "determinism/driving");
    let worlds = vec![world];
    let script = script(&worlds, &DRIVING, 300, &mut draws);
    let config = TourConfig { worlds, ticks: 300, ..TourConfig::default() };
    NamedRun { name, recipe: Recipe::new(config, (Seed(seed), script)) }
}

/// A warehouse, some of whose robots leave their routes.
fn warehouse(name: &str, seed: u64, robots: usize, ticks: u64) -> Option<NamedRun> {
    let world = Warehouse { seed: Seed(seed), robots, trailers: seed.is_multiple_of(2) }.world().ok()?;
    let mut draws = Stream::new(Seed(seed), "determinism/warehouse");
    let worlds = vec![world];
    let script = script(&worlds, &[Feature::Drives, Feature::Trailers], ticks, &mut draws);
    let sensor = Some(RangeSensor { n_rays: 16, max_range: 4.0 });
    let recipe = Recipe::new(TourConfig { worlds, ticks, sensor }, (Seed(seed), script));
    Some(NamedRun { name: format!("{name}-{seed}"), recipe })
}
