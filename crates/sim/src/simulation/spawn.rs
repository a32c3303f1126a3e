//! Starting a run: the worlds, obstacles, robots and sensors as entities.

use std::sync::Arc;

use bevy::prelude::*;

use super::obstacles::roster::{self, WorldObstacles, at_work};
use super::robot::spawn::{SpawnRequest, routes};
use super::tick::world_crowds::WorldCrowds;
use super::{
    History, Keyframes, LatestFrame, PendingInput, Refusals, RobotId, RobotKinds, Roster, SceneRevision,
    SimulatedWorld, SpawnError, StandingWorld, Transport, WorldScene, sensors, state, tick,
};
use crate::run::{Recipe, RunInput};
use crate::tour::{RouteTours, TourConfig};
use motion_lab_core::collision::Scene;
use motion_lab_core::worlds::{Resident, World as WorldModel};

/// The configuration of the run under way.
#[derive(Resource, Clone, Debug)]
pub struct RunConfig(pub Arc<TourConfig>);

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

fn spawn_world(world: &mut World, index: u32, model: &WorldModel) -> Entity {
    let (scene, model) = (WorldScene(Arc::new(Scene::of_world(model))), Arc::new(model.clone()));
    world
        .spawn((SimulatedWorld { index, model: Arc::clone(&model) }, StandingWorld(model), scene, SceneRevision(0)))
        .id()
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
    let Recipe { seed, config, script } = recipe;
    let residents: Vec<(usize, &Resident)> =
        config.worlds.iter().enumerate().flat_map(|(i, w)| w.robots.iter().map(move |r| (i, r))).collect();
    config.validate()?;
    script.check()?;
    script.check_robots(&config.robot_names().collect::<Vec<_>>())?;
    script.check_worlds(&config.worlds)?;
    let routes: Vec<RouteTours> = config.worlds.iter().map(|w| routes(w, seed)).collect::<Result<_, _>>()?;
    let worlds: Vec<Entity> =
        config.worlds.iter().enumerate().map(|(i, model)| spawn_world(world, i as u32, model)).collect();
    let mut spawned: Vec<(RobotId, Entity)> = Vec::new();
    for &i in order {
        let (w, resident) = residents[i];
        let model = &config.worlds[w];
        let id = RobotId(i as u32);
        let about = world.get_resource::<RobotKinds>().and_then(|k| k.about(&resident.kind));
        let request = SpawnRequest {
            seed,
            id,
            world: worlds[w],
            model,
            resident,
            sensor: config.sensor,
            routes: &routes[w],
            about,
        };
        let spawner = world.get_resource::<RobotKinds>().and_then(|k| k.spawner(&resident.kind));
        let robot = match spawner {
            Some(spawn) => spawn(world, &request),
            None => Err(SpawnError::UnknownKind {
                robot: resident.name.clone(),
                world: model.name.clone(),
                kind: resident.kind.clone(),
            }),
        };
        match robot {
            Ok(entity) => spawned.push((id, entity)),
            Err(e) => {
                worlds.iter().for_each(|&w| _ = world.despawn(w));
                return Err(e);
            }
        }
    }
    spawned.sort_unstable_by_key(|(id, _)| *id);
    let robots: Vec<Entity> = spawned.into_iter().map(|(_, e)| e).collect();
    let names = residents.iter().map(|(_, resident)| resident.name.clone()).zip(robots.iter().copied()).collect();
    let roster = Roster { worlds, robots, names };
    let old = world.remove_resource::<Roster>();
    let grounds = at_work(world, |world, _| {
        old.iter().flat_map(|old| &old.worlds).for_each(|&w| _ = world.despawn(w));
        let model = |world: &World, w| world.get::<SimulatedWorld>(w).map(|w| Arc::clone(&w.model));
        let ground = |&w: &Entity| model(world, w).map(|model| WorldObstacles::spawn(world, w, model));
        roster.worlds.iter().filter_map(ground).collect()
    });
    world.insert_resource(roster);
    roster::begin(world, grounds);
    roster::sync_added(world, &script.changes);
    world.insert_resource(WorldCrowds::new(config.worlds.iter().map(|w| w.robots.len())));
    world.insert_resource(RunConfig(config));
    world.insert_resource(Transport::new(seed));
    world.insert_resource(PendingInput::new(script));
    world.insert_resource(Keyframes::default());
    world.insert_resource(Refusals::default());
    world.insert_resource(LatestFrame::default());
    if world.contains_resource::<History>() {
        world.insert_resource(History::default());
    }
    sensors::start::take_sensors(world);
    tick::sense::sense_now(world);
    state::record(world);
    Ok(())
}
