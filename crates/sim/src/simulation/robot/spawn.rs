//! Spawning a robot and its sensors as entities.

use bevy::prelude::*;

use super::simulated::canonical;
use crate::simulation::sensors::OfConfiguration;
use crate::simulation::{
    Configuration, DrawnTour, MountedOn, OwnState, PreviousConfiguration, ResidesIn, RobotId, RobotModel, RobotName,
    RobotOps, SensorModel, SensorMount, SensorName, SensorNoise, SimulatedRobot, Slip, SpawnError,
};
use crate::tour::{ConfigError, RouteTours};
use motion_lab_core::configuration::{Configuration as _, RobotKind, SizesError};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::sensors::{BeamModel, RangeSensor};
use motion_lab_core::worlds::{Resident, World as WorldModel};

/// One robot to be spawned.
pub(crate) struct SpawnRequest<'a> {
    pub(crate) seed: Seed,
    pub(crate) id: RobotId,
    pub(crate) world: Entity,
    pub(crate) model: &'a WorldModel,
    pub(crate) resident: &'a Resident,
    pub(crate) sensor: Option<RangeSensor>,
    pub(crate) routes: &'a RouteTours,
    pub(crate) about: Option<&'static RobotKind>,
}

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

/// Spawns a robot of type `R`, with its sensors.
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
    let entity = world
        .spawn((
            RobotModel(robot.clone()),
            Configuration::<R>(q),
            PreviousConfiguration::<R>(q),
            OwnState::<R>::new(robot.initial_extra()),
            DrawnTour::<R>(tour),
            Slip(slip(request.seed, &resident.name)),
            ops,
            request.id,
            RobotName { name: resident.name.clone(), kind: resident.kind.clone(), about: request.about },
            ResidesIn(request.world),
        ))
        .id();
    if let Some(sensor) = sensor {
        let mut spawned = world.spawn((SensorModel::from(sensor), OfConfiguration, MountedOn(entity)));
        noise.into_iter().for_each(|noise| _ = spawned.insert(SensorNoise(noise)));
    }
    for sensor in &resident.sensors {
        let name = SensorName(sensor.name.clone());
        let mount = SensorMount(sensor.mount);
        let mut spawned = world.spawn((SensorModel(sensor.rays), name, mount, OfConfiguration, MountedOn(entity)));
        sensor.noise.into_iter().for_each(|noise| _ = spawned.insert(SensorNoise(noise)));
    }
    Ok(entity)
}
