//! Spawning a robot and its sensors as entities.

use std::any::TypeId;
use std::sync::Arc;

use bevy::prelude::*;

use super::request::SpawnRequest;
use super::simulated::canonical;
use crate::simulation::sensors::OfConfiguration;
use crate::simulation::truth::last_values::LastValues;
use crate::simulation::truth::lookup::thing_of;
use crate::simulation::truth::thing::RunThing;
use crate::simulation::{
    Cut, DrawnTour, LatestFrame, MountedOn, ResidesIn, RobotId, RobotKinds, RobotModel, RobotName, RobotOps, Roster,
    RunConfig, SensorModel, SensorMount, SensorName, SensorNoise, SimulatedRobot, Slip, SpawnError, TickMotion,
    Transport,
};
use crate::tour::{ConfigError, RouteTours, TourConfig};
use motion_lab_core::configuration::{Configuration as _, SizesError};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::sensors::{BeamModel, RangeSensor};
use motion_lab_core::worlds::{Resident, World as WorldModel};

/// The robot that a resident is: the kind's model, with the resident's own sizes.
fn sized<R: SimulatedRobot>(model: &R, resident: &Resident) -> Result<R, SizesError> {
    let Some(sizes) = &resident.sizes else { return Ok(model.clone()) };
    sizes.check()?;
    model.with_sizes(sizes).ok_or_else(|| {
        let (kind, found) = (resident.kind.clone(), sizes.field());
        sizes.check_for(&kind).err().unwrap_or(SizesError::OwnKind { kind, found })
    })
}

/// A robot that can be spawned.
pub(crate) struct SpawnableRobot<R: SimulatedRobot> {
    /// The robot, with the resident's own sizes.
    pub(crate) robot: R,
    pub(crate) q: R::Configuration,
    /// The noise of the sensor that the run gives it.
    pub(crate) noise: Option<BeamModel>,
}

impl<R: SimulatedRobot> SpawnableRobot<R> {
    /// The robot that a resident of a world is, of a kind with this model.
    pub(crate) fn new(model: &R, resident: &Resident, world: &WorldModel) -> Result<Self, SpawnError> {
        let (name, world) = (|| resident.name.clone(), || world.name.clone());
        let sized = sized(model, resident);
        let robot = sized.map_err(|source| SpawnError::Sizes { robot: name(), world: world(), source })?;
        let refused = || {
            let (kind, start) = (resident.kind.clone(), resident.start.clone());
            SpawnError::Start { robot: name(), world: world(), kind, start }
        };
        let q = R::Configuration::from_coordinates(&resident.start).ok_or_else(refused)?;
        // through the robot itself, which wraps the angles
        let q = canonical(&robot.configuration_at(&q, &resident.start).ok_or_else(refused)?);
        let fitted = robot.fitted(&q);
        fitted.check(&q).map_err(|_| refused())?;
        if !fitted.is_within_limits(&q) {
            return Err(refused());
        }
        let noise = resident.sensor.map(|noise| noise.try_new()).transpose();
        let noise = noise.map_err(|source| SpawnError::Noise { robot: name(), world: world(), source })?;
        Ok(SpawnableRobot { robot, q, noise })
    }
}

/// The stream of a robot's actuation noise.
pub(crate) fn slip(seed: Seed, robot: &str) -> Stream {
    Stream::new(seed, &format!("{robot}/slip"))
}

/// The routes of a world, at the speeds of a seed.
pub(crate) fn routes(world: &WorldModel, seed: Seed) -> Result<RouteTours, ConfigError> {
    let refused = |(route, source)| ConfigError::Route { route, world: world.name.clone(), source };
    RouteTours::of_world(world, seed).map_err(refused)
}

/// The tour of a robot that starts at `q`: along the route that its world gives it, or its kind's own.
pub(crate) fn tour<R: SimulatedRobot>(
    robot: &R,
    seed: Seed,
    (world, routes): (&WorldModel, &RouteTours),
    resident: &Resident,
    q: &R::Configuration,
) -> Result<R::Tour, SpawnError> {
    let Some(name) = &resident.route else {
        return Ok(robot.tour(seed, &resident.name, world, q));
    };
    let route = routes.get(name).ok_or_else(|| SpawnError::NoSuchRoute {
        robot: resident.name.clone(),
        world: world.name.clone(),
        route: name.clone(),
    })?;
    robot.route_tour(route, q).ok_or_else(|| SpawnError::Route {
        robot: resident.name.clone(),
        world: world.name.clone(),
        kind: resident.kind.clone(),
        route: name.clone(),
        speed: route.fastest(),
    })
}

/// Makes an entity the robot of type `R` that a resident is, at its start. What it is by another type goes.
pub(crate) fn spawn_robot<R: SimulatedRobot>(
    world: &mut World,
    model: &R,
    ops: RobotOps,
    request: &SpawnRequest,
) -> Result<Entity, SpawnError> {
    let resident = request.resident;
    let SpawnableRobot { robot, q, noise } = SpawnableRobot::new(model, resident, request.model)?;
    let tour = tour(&robot, request.seed, (request.model, request.routes), resident, &q)?;
    let sensor = request.sensor.filter(|_| robot.sensor_pose(&q).is_some());
    let entity = request.entity.unwrap_or_else(|| world.spawn_empty().id());
    let types = world.resource::<RobotKinds>().types().to_vec();
    types.iter().filter(|other| other.id != TypeId::of::<R>()).for_each(|other| (other.strip)(world, entity));
    // in one go, for an observer may despawn what it sees
    let parts = (
        RobotModel(robot.clone()),
        DrawnTour::<R>(tour),
        Slip(slip(request.seed, &resident.name)),
        TickMotion::<R>::default(),
        Cut::<R>::default(),
        ops,
        request.id,
        RobotName { name: resident.name.clone(), kind: resident.kind.clone(), about: request.about },
        ResidesIn(request.world),
        RunThing::Robot(request.id.0 as usize),
    );
    if let Ok(mut spawned) = world.get_entity_mut(entity) {
        spawned.insert((parts, LastValues::at_start(&robot, q).into_parts()));
    }
    if request.with_sensors {
        spawn_sensors(world, entity, resident, sensor.map(|sensor| (sensor, noise)));
    }
    Ok(entity)
}

/// Spawns the sensors of a robot: the run's own, with the robot's noise, and those that the resident names.
fn spawn_sensors(world: &mut World, robot: Entity, resident: &Resident, own: Option<(RangeSensor, Option<BeamModel>)>) {
    if let Some((sensor, noise)) = own {
        spawn_sensor(world, (SensorModel::from(sensor), OfConfiguration, MountedOn(robot)), noise);
    }
    for sensor in &resident.sensors {
        let name = SensorName(sensor.name.clone());
        let mount = SensorMount(sensor.mount);
        spawn_sensor(world, (SensorModel(sensor.rays), name, mount, OfConfiguration, MountedOn(robot)), sensor.noise);
    }
}

fn spawn_sensor(world: &mut World, parts: impl Bundle, noise: Option<BeamModel>) {
    match noise {
        Some(noise) => world.spawn((parts, SensorNoise(noise))),
        None => world.spawn(parts),
    };
}

/// The entities of a run's robots by world, in the order of their ids; `None` for one that is to be spawned.
pub(crate) struct RobotEntities(pub(crate) Vec<Vec<Option<Entity>>>);

impl RobotEntities {
    /// Those of a run whose robots are all to be spawned.
    pub(crate) fn none(config: &TourConfig) -> Self {
        RobotEntities(config.worlds.iter().map(|w| vec![None; w.robots.len()]).collect())
    }
}

/// Makes entities the robots of a run at its start, in the order of their ids as `order` gives it, which changes
/// nothing. Returns them by id.
///
/// # Errors
/// [`SpawnError`] for the first that cannot be.
pub(crate) fn spawn_robots(
    world: &mut World,
    (config, seed): (&TourConfig, Seed),
    (worlds, RobotEntities(entities)): (&[Entity], &RobotEntities),
    order: &[usize],
) -> Result<Vec<Entity>, SpawnError> {
    let routes: Vec<RouteTours> = config.worlds.iter().map(|w| routes(w, seed)).collect::<Result<_, _>>()?;
    let residents: Vec<(usize, &Resident, Option<Entity>)> = config
        .worlds
        .iter()
        .zip(entities)
        .enumerate()
        .flat_map(|(w, (model, entities))| model.robots.iter().zip(entities).map(move |(r, &e)| (w, r, e)))
        .collect();
    let mut spawned: Vec<(usize, Entity)> = Vec::new();
    for &id in order {
        let (w, resident, entity) = residents[id];
        let is_known = entity.is_some_and(|e| matches!(thing_of(world, e), Some(RunThing::Robot(_))));
        let request = SpawnRequest {
            entity,
            with_sensors: !is_known,
            seed,
            id: RobotId(id as u32),
            world: worlds[w],
            model: &config.worlds[w],
            resident,
            sensor: config.sensor,
            routes: &routes[w],
            about: world.resource::<RobotKinds>().about(&resident.kind),
        };
        spawned.push((id, spawn(world, &request)?));
    }
    spawned.sort_unstable();
    Ok(spawned.into_iter().map(|(_, entity)| entity).collect())
}

/// Spawns the robot of a request, of whichever kind it is.
fn spawn(world: &mut World, request: &SpawnRequest) -> Result<Entity, SpawnError> {
    let kind = &request.resident.kind;
    match world.resource::<RobotKinds>().kind(kind).map(|kind| kind.spawn.clone()) {
        Some(spawn) => spawn(world, request),
        None => Err(SpawnError::UnknownKind {
            robot: request.resident.name.clone(),
            world: request.model.name.clone(),
            kind: kind.clone(),
        }),
    }
}

/// Gives a robot of the run under way its components, on an entity of its own if it has lost it, with the values that
/// it has at the present tick.
pub(crate) fn respawn(world: &mut World, id: usize) {
    let (config, seed) = (Arc::clone(world.resource::<RunConfig>().config()), world.resource::<Transport>().seed);
    let (Some((w, resident)), Some(&old)) = (config.resident(id), world.resource::<Roster>().robots.get(id)) else {
        return;
    };
    let (entity, model) = (world.get_entity(old).is_ok().then_some(old), &config.worlds[w]);
    let kind = world.resource::<RobotKinds>().kind(&resident.kind).map(|kind| kind.of_type);
    let of_type = kind.and_then(|of_type| world.resource::<RobotKinds>().types().get(of_type).copied());
    // all routes of a world are drawn at once, for those that follow one
    let routes = if resident.route.is_some() { routes(model, seed) } else { Ok(RouteTours::default()) };
    let (Some(of_type), Ok(routes)) = (of_type, routes) else { return };
    let kept = entity.and_then(|entity| (of_type.last_values)(world, entity));
    let (about, of_world) =
        (world.resource::<RobotKinds>().about(&resident.kind), world.resource::<Roster>().worlds[w]);
    let request = SpawnRequest {
        entity,
        with_sensors: false,
        seed,
        id: RobotId(id as u32),
        world: of_world,
        model,
        resident,
        sensor: config.sensor,
        routes: &routes,
        about,
    };
    // it was spawned before, from the same
    let Ok(entity) = spawn(world, &request) else { return };
    let roster = world.resource_mut::<Roster>().into_inner();
    roster.robots[id] = entity;
    roster.names.insert(resident.name.clone(), entity);
    match kept {
        Some(kept) => kept(world, entity),
        None => {
            let states = &world.resource::<LatestFrame>().0.robots;
            let at = states.binary_search_by_key(&(id as u32), |state| state.id).ok();
            let state = at.map(|i| states[i].clone());
            let ops = world.get::<RobotOps>(entity).copied();
            state.zip(ops).and_then(|(state, ops)| (ops.decode)(world, entity, &state));
        }
    }
}
