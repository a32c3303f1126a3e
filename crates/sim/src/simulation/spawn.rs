//! Starting a run: the worlds, obstacles, robots and sensors as entities.

use std::sync::Arc;

use bevy::prelude::*;

use super::obstacles::roster::{ObstacleRoster, WorldObstacles};
use super::obstacles::sync::sync_added;
use super::robot::spawn::{RobotEntities, spawn_robots};
use super::tick::world_crowds::WorldCrowds;
use super::truth::run_config::RunConfig;
use super::truth::thing::RunThing;
use super::truth::touched::{ForeignTouches, at_work};
use super::truth::watch::are_observers_of_others;
use super::{
    History, Keyframes, LatestFrame, PendingInput, Refusals, Roster, SceneRevision, SimulatedWorld, SpawnError,
    StandingWorld, Transport, WorldScene, sensors, state, tick,
};
use crate::run::{Recipe, RunInput};
use crate::tour::TourConfig;
use motion_lab_core::collision::Scene;
use motion_lab_core::worlds::World as WorldModel;

/// The recipe of the run under way, its script as far as it is known; `None` before the first run.
pub fn recipe(world: &World) -> Option<Recipe> {
    let config = Arc::clone(&world.get_resource::<RunConfig>()?.0);
    let script = world.resource::<PendingInput>().script().clone();
    Some(Recipe { seed: world.resource::<Transport>().seed, config, script })
}

/// Whether the run under way is that of a recipe: the very same configuration, seed and script.
pub fn is_under_way(world: &World, recipe: &Recipe) -> bool {
    world.get_resource::<RunConfig>().is_some_and(|config| Arc::ptr_eq(&config.0, &recipe.config))
        && world.resource::<Transport>().seed == recipe.seed
        && *world.resource::<PendingInput>().script() == recipe.script
}

fn spawn_world(world: &mut World, index: usize, model: &Arc<WorldModel>) -> Entity {
    let scene = WorldScene(Arc::new(Scene::of_world(model)));
    let at = SimulatedWorld { index: index as u32, model: Arc::clone(model) };
    let standing = StandingWorld(Arc::clone(model));
    world.spawn((at, standing, scene, SceneRevision::new(), RunThing::World(index))).id()
}

/// Starts a run in `world`, in place of the one under way: spawns everything and takes frame 0. The new run is paused.
///
/// # Errors
/// [`SpawnError`] names the robot, script event or sensor that cannot be; the run under way then goes on.
pub fn start_run(
    world: &mut World,
    config: impl Into<Arc<TourConfig>>,
    input: impl Into<RunInput>,
) -> Result<(), SpawnError> {
    start_recipe(world, Recipe::new(config, input))
}

/// [`start_run`] by a recipe.
///
/// # Errors
/// As [`start_run`].
pub fn start_recipe(world: &mut World, recipe: Recipe) -> Result<(), SpawnError> {
    let count = recipe.config.worlds.iter().map(|w| w.robots.len()).sum();
    start_run_in_order(world, recipe, &(0..count).collect::<Vec<_>>())
}

/// [`start_run`] with the robots spawned in this order of their ids, which changes nothing.
pub(super) fn start_run_in_order(world: &mut World, recipe: Recipe, order: &[usize]) -> Result<(), SpawnError> {
    at_work(world, |world| begin(world, recipe, order))
}

fn begin(world: &mut World, recipe: Recipe, order: &[usize]) -> Result<(), SpawnError> {
    let Recipe { seed, config, script } = recipe;
    config.validate()?;
    script.check()?;
    script.check_robots(&config.robot_names().collect::<Vec<_>>())?;
    script.check_worlds(&config.worlds)?;
    let models: Vec<Arc<WorldModel>> = config.worlds.iter().map(|model| Arc::new(model.clone())).collect();
    let worlds: Vec<Entity> = models.iter().enumerate().map(|(i, model)| spawn_world(world, i, model)).collect();
    let spawned = spawn_robots(world, (&config, seed), (&worlds, &RobotEntities::none(&config)), order);
    let robots = spawned.inspect_err(|_| worlds.iter().for_each(|&w| _ = world.despawn(w)))?;
    let names = config.robot_names().map(str::to_owned).zip(robots.iter().copied()).collect();
    let roster = Roster { worlds, robots, names };
    for w in world.remove_resource::<Roster>().into_iter().flat_map(|old| old.worlds) {
        world.despawn(w);
    }
    let mut grounds = Vec::new();
    for (number, (&w, start)) in roster.worlds.iter().zip(models).enumerate() {
        let mut ground = WorldObstacles::new(w, number, start, &[]);
        ground.dress_all(world);
        grounds.push(ground.fresh());
    }
    world.insert_resource(roster);
    world.insert_resource(ObstacleRoster { grounds });
    // observers of others may have answered what was spawned; what they changed is not told from the start's own work
    let is_unsettled = are_observers_of_others(world);
    let mut touched = world.resource_mut::<ForeignTouches>();
    touched.entities.clear();
    touched.is_unsettled |= is_unsettled;
    sync_added(world, &script.changes);
    world.insert_resource(WorldCrowds::new(config.worlds.iter().map(|w| w.robots.len())));
    world.insert_resource(RunConfig(config));
    world.insert_resource(Transport::new(seed));
    world.insert_resource(PendingInput::new(script));
    world.insert_resource(Keyframes::default());
    world.insert_resource(Refusals::default());
    world.insert_resource(LatestFrame::of_no_run());
    if world.contains_resource::<History>() {
        world.insert_resource(History::default());
    }
    sensors::start::take_sensors(world);
    tick::sense::sense_now(world);
    state::record(world);
    Ok(())
}
