//! Starting a run: the worlds, obstacles, robots and sensors as entities.

use std::sync::Arc;

use bevy::prelude::*;

use super::robot::simulated::canonical;
use super::{
    Configuration, Keyframes, LatestFrame, MountedOn, ObstacleOf, ObstacleShape, OwnState, PendingInput,
    PreviousConfiguration, ResidesIn, RobotId, RobotKinds, RobotModel, RobotName, RobotOps, Route, Scan, SensorModel,
    SensorNoise, SensorScanner, SimulatedRobot, SimulatedWorld, Slip, Transport, WorldScene,
};
use crate::collision::Scene;
use crate::configuration::Configuration as _;
use crate::random::{Seed, Stream};
use crate::run::{Script, ScriptError};
use crate::sensors::{BeamError, RangeSensor, Scanner, SensorError};
use crate::tour::{BOOK_SEED, ConfigError, TourConfig};
use crate::worlds::{Resident, World as WorldModel};

/// What decides a run beside its configuration: a seed, a script, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct RunInput {
    /// The seed.
    pub seed: Seed,
    /// The script.
    pub script: Script,
}

impl From<Seed> for RunInput {
    fn from(seed: Seed) -> Self {
        RunInput { seed, script: Script::empty() }
    }
}

impl From<(Seed, Script)> for RunInput {
    fn from((seed, script): (Seed, Script)) -> Self {
        RunInput { seed, script }
    }
}

/// A script alone runs at the book's seed.
impl From<Script> for RunInput {
    fn from(script: Script) -> Self {
        RunInput { seed: BOOK_SEED, script }
    }
}

/// Why a run cannot start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpawnError {
    /// A kind of robot that nobody registered.
    #[error("robot {robot:?} in world {world:?}: there is no kind {kind:?}")]
    UnknownKind {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// The kind.
        kind: String,
    },
    /// Start coordinates that are no configuration of the robot.
    #[error("robot {robot:?} in world {world:?}: {start:?} is no configuration of a {kind}")]
    Start {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// Its kind.
        kind: String,
        /// The coordinates.
        start: Vec<f64>,
    },
    /// The configuration is out of range.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The script cannot be run with these robots.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// A sensor whose noise is no distribution, in a world put together by hand.
    #[error("robot {robot:?} in world {world:?}: sensor: {source}")]
    Noise {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// What is wrong.
        source: BeamError,
    },
    /// A range sensor out of range.
    #[error(transparent)]
    Sensor(#[from] SensorError),
}

/// The robots and worlds of the run by their numbers; fixed from tick 0 on.
#[derive(Resource, Clone, Debug, Default)]
pub struct Roster {
    worlds: Vec<Entity>,
    robots: Vec<Entity>,
}

impl Roster {
    /// The robots' entities by id.
    pub fn robots(&self) -> &[Entity] {
        &self.robots
    }

    /// The worlds' entities by number.
    pub fn worlds(&self) -> &[Entity] {
        &self.worlds
    }
}

/// The configuration of the run under way.
#[derive(Resource, Clone, Debug)]
pub struct RunConfig(pub Arc<TourConfig>);

/// One robot to be spawned.
pub(crate) struct SpawnRequest<'a> {
    seed: Seed,
    id: RobotId,
    world: Entity,
    model: &'a WorldModel,
    resident: &'a Resident,
    sensor: Option<RangeSensor>,
}

/// Spawns a robot of type `R`, with its sensor.
pub(super) fn spawn_robot<R: SimulatedRobot>(
    world: &mut World,
    robot: &R,
    ops: RobotOps,
    request: &SpawnRequest,
) -> Result<Entity, SpawnError> {
    let resident = request.resident;
    let refused = || SpawnError::Start {
        robot: resident.name.clone(),
        world: request.model.name.clone(),
        kind: resident.kind.clone(),
        start: resident.start.clone(),
    };
    let q = R::Configuration::from_coordinates(&resident.start).ok_or_else(refused)?;
    // through the robot itself, which wraps the angles
    let q = canonical(&robot.configuration_at(&q, &resident.start).ok_or_else(refused)?);
    robot.fitted(&q).check(&q).map_err(|_| refused())?;
    let noise = resident.sensor.map(|noise| noise.try_new()).transpose().map_err(|source| SpawnError::Noise {
        robot: resident.name.clone(),
        world: request.model.name.clone(),
        source,
    })?;
    let sensor = request.sensor.filter(|_| robot.sensor_pose(&q).is_some());
    let entity = world
        .spawn((
            RobotModel(robot.clone()),
            Configuration::<R>(q),
            PreviousConfiguration::<R>(q),
            OwnState::<R>::new(robot.initial_extra()),
            Route::<R>(robot.tour(request.seed, &resident.name, request.model, &q)),
            Slip(Stream::new(request.seed, &format!("{}/slip", resident.name))),
            ops,
            request.id,
            RobotName { name: resident.name.clone(), kind: resident.kind.clone() },
            ResidesIn(request.world),
        ))
        .id();
    if let Some(sensor) = sensor {
        let mut spawned = world.spawn((
            SensorModel(sensor),
            SensorScanner(Some(Box::new(Scanner::new(sensor)))),
            Scan::default(),
            MountedOn(entity),
        ));
        if let Some(model) = noise {
            let stream = Stream::new(request.seed, &format!("{}/beam", resident.name));
            spawned.insert(SensorNoise { model, stream });
        }
    }
    Ok(entity)
}

fn spawn_world(world: &mut World, index: u32, model: &WorldModel) -> Entity {
    let scene = WorldScene(Arc::new(Scene::of_world(model)));
    let entity = world.spawn((SimulatedWorld { index, model: Arc::new(model.clone()) }, scene)).id();
    for obstacle in &model.obstacles {
        let shape = ObstacleShape { name: obstacle.name.clone(), pieces: obstacle.pieces.clone() };
        world.spawn((shape, ObstacleOf(entity)));
    }
    entity
}

/// Starts a run in `world`, in place of the one under way: spawns everything and takes frame 0. Paused.
///
/// # Errors
/// [`SpawnError`] names the robot, script event or sensor that cannot be; the run under way then goes on.
pub fn start_run(world: &mut World, config: TourConfig, input: impl Into<RunInput>) -> Result<(), SpawnError> {
    let count = config.worlds.iter().map(|w| w.robots.len()).sum();
    start_run_in_order(world, Arc::new(config), input.into(), &(0..count).collect::<Vec<_>>())
}

/// [`start_run`] with the robots spawned in this order of their ids, which changes nothing.
pub(super) fn start_run_in_order(
    world: &mut World,
    config: Arc<TourConfig>,
    input: RunInput,
    order: &[usize],
) -> Result<(), SpawnError> {
    let residents: Vec<(usize, &Resident)> =
        config.worlds.iter().enumerate().flat_map(|(i, w)| w.robots.iter().map(move |r| (i, r))).collect();
    config.validate()?;
    input.script.check()?;
    input.script.check_robots(&config.robot_names().collect::<Vec<_>>())?;
    let sensor = config.sensor.map(|s| RangeSensor::try_new(s.n_rays, s.max_range)).transpose()?;
    let worlds: Vec<Entity> =
        config.worlds.iter().enumerate().map(|(i, model)| spawn_world(world, i as u32, model)).collect();
    let mut spawned: Vec<(RobotId, Entity)> = Vec::new();
    for &i in order {
        let (w, resident) = residents[i];
        let model = &config.worlds[w];
        let id = RobotId(i as u32);
        let request = SpawnRequest { seed: input.seed, id, world: worlds[w], model, resident, sensor };
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
    let roster = Roster { worlds, robots: spawned.into_iter().map(|(_, e)| e).collect() };
    if let Some(old) = world.remove_resource::<Roster>() {
        old.worlds.iter().for_each(|&w| _ = world.despawn(w));
    }
    world.insert_resource(roster);
    world.insert_resource(RunConfig(config));
    world.insert_resource(Transport::new(input.seed));
    world.insert_resource(PendingInput::new(input.script));
    world.insert_resource(Keyframes::default());
    world.insert_resource(LatestFrame::default());
    if world.contains_resource::<super::History>() {
        world.insert_resource(super::History::default());
    }
    super::tick::sense::sense(world);
    super::state::record(world);
    Ok(())
}
