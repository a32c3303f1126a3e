//! Spawning a robot and its sensors as entities.

use bevy::prelude::*;

use super::simulated::canonical;
use crate::configuration::{Configuration as _, RobotKind, SizesError};
use crate::random::{Seed, Stream};
use crate::sensors::RangeSensor;
use crate::simulation::sensors::OfConfiguration;
use crate::simulation::{
    Configuration, MountedOn, OwnState, PreviousConfiguration, ResidesIn, RobotId, RobotModel, RobotName, RobotOps,
    Route, SensorModel, SensorMount, SensorName, SensorNoise, SimulatedRobot, Slip, SpawnError,
};
use crate::worlds::{Resident, World as WorldModel};

/// One robot to be spawned.
pub(crate) struct SpawnRequest<'a> {
    pub(crate) seed: Seed,
    pub(crate) id: RobotId,
    pub(crate) world: Entity,
    pub(crate) model: &'a WorldModel,
    pub(crate) resident: &'a Resident,
    pub(crate) sensor: Option<RangeSensor>,
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

/// Spawns a robot of type `R`, with its sensors.
pub(crate) fn spawn_robot<R: SimulatedRobot>(
    world: &mut World,
    robot: &R,
    ops: RobotOps,
    request: &SpawnRequest,
) -> Result<Entity, SpawnError> {
    let resident = request.resident;
    let sized = sized(robot, resident).map_err(|source| SpawnError::Sizes {
        robot: resident.name.clone(),
        world: request.model.name.clone(),
        source,
    })?;
    let robot = &sized;
    let refused = || SpawnError::Start {
        robot: resident.name.clone(),
        world: request.model.name.clone(),
        kind: resident.kind.clone(),
        start: resident.start.clone(),
    };
    let q = R::Configuration::from_coordinates(&resident.start).ok_or_else(refused)?;
    // through the robot itself, which wraps the angles
    let q = canonical(&robot.configuration_at(&q, &resident.start).ok_or_else(refused)?);
    let fitted = robot.fitted(&q);
    fitted.check(&q).map_err(|_| refused())?;
    if !fitted.is_within_limits(&q) {
        return Err(refused());
    }
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
