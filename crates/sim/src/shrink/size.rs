//! `RecipeSize`, how much a recipe holds.

use crate::run::Recipe;
use motion_lab_core::worlds::World;

/// How much a recipe holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct RecipeSize {
    /// The worlds.
    pub worlds: usize,
    /// The robots.
    pub robots: usize,
    /// The range sensors: the run's own as one, and those of the robots.
    pub sensors: usize,
    /// The obstacles and doors.
    pub obstacles: usize,
    /// What else the worlds hold: routes, places and marks.
    pub others: usize,
    /// The inputs to robots.
    pub events: usize,
    /// The changes of worlds.
    pub changes: usize,
    /// The length of the run, ticks.
    pub ticks: u64,
}

impl RecipeSize {
    /// The size of a recipe.
    pub fn of(recipe: &Recipe) -> Self {
        let (config, script) = (&recipe.config, &recipe.script);
        let sum = |of: fn(&World) -> usize| config.worlds.iter().map(of).sum::<usize>();
        let own = sum(|w| w.robots.iter().map(|robot| robot.sensors.len()).sum());
        RecipeSize {
            worlds: config.worlds.len(),
            robots: sum(|w| w.robots.len()),
            sensors: own + usize::from(config.sensor.is_some()),
            obstacles: sum(|w| w.obstacles.len() + w.doors.len()),
            others: sum(|w| w.routes.len() + w.places.len() + w.marks.len()),
            events: script.events.len(),
            changes: script.changes.len(),
            ticks: config.ticks,
        }
    }
}
