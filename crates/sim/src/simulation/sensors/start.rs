//! Takes the sensor entities into the run.

use bevy::prelude::*;

use super::named::{are_alike, by_name, chosen, own_sensor, senses};
use super::refusal::{SensorRefusal, SensorRefused};
use super::roster::{RunSensor, SensorRoster};
use super::write::write;
use crate::simulation::truth::thing::RunThing;
use crate::simulation::{
    MountedOn, RobotId, RobotName, Roster, Scan, SensorModel, SensorMount, SensorName, SensorNoise, Transport,
};
use motion_lab_core::random::Stream;
use motion_lab_core::sensors::SensorError;
use motion_lab_core::worlds::{MAX_SENSORS, check_mount, check_name};

/// Makes the roster of the sensors that there are, and writes them into the run's configuration.
pub(crate) fn take_sensors(world: &mut World) {
    let mut roster = SensorRoster::none();
    let mut refusals = Vec::new();
    let robots = world.get_resource::<Roster>().map_or_else(Vec::new, |roster| roster.robots().to_vec());
    let own = own_sensor(world, &robots);
    for &robot in &robots {
        let is_given = own.is_some() && senses(world, robot);
        take_sensors_of(world, robot, is_given, &mut roster, &mut refusals);
    }
    write(world, &roster.sensors, robots.iter().any(|&robot| senses(world, robot)).then_some(own));
    let mut strays: Vec<String> = Vec::new();
    let mut all = world.query_filtered::<(Option<&SensorName>, Option<&MountedOn>), With<SensorModel>>();
    for (name, mounted) in all.iter(world) {
        if mounted.is_none_or(|on| robot_of(world, on.0).is_none()) {
            strays.push(name.map_or_else(String::new, |name| name.0.clone()));
        }
    }
    strays.sort();
    refusals.extend(strays.into_iter().map(|sensor| SensorRefused {
        robot: None,
        sensor,
        reason: SensorRefusal::NoRobot,
    }));
    refusals.retain(|refused| roster.refuse(refused));
    roster.sort_fans();
    for (k, sensor) in roster.sensors.iter().enumerate() {
        if let Ok(mut entity) = world.get_entity_mut(sensor.entity) {
            entity.insert((Scan::default(), RunThing::Sensor(k)));
        }
    }
    world.insert_resource(roster);
    refusals.into_iter().for_each(|refused| _ = world.write_message(refused));
}

/// The name of an entity that is a robot of the run under way.
pub(super) fn robot_of(world: &World, entity: Entity) -> Option<&str> {
    let id = world.get::<RobotId>(entity)?.0 as usize;
    let is_in_run = world.get_resource::<Roster>()?.robots().get(id) == Some(&entity);
    world.get::<RobotName>(entity).filter(|_| is_in_run).map(|name| name.name.as_str())
}

/// Takes the sensors of a robot, in the order of their names. `is_given` says whether the run gives it its own, which
/// is the one without a name.
fn take_sensors_of(
    world: &World,
    robot: Entity,
    is_given: bool,
    roster: &mut SensorRoster,
    refusals: &mut Vec<SensorRefused>,
) {
    let Some(name) = world.get::<RobotName>(robot) else { return };
    let first = roster.sensors.len();
    for (sensor, entities) in by_name(world, robot) {
        let refuse = |reason| SensorRefused { robot: Some(name.name.clone()), sensor: sensor.to_owned(), reason };
        let Some(entity) = chosen(world, &entities) else {
            refusals.push(refuse(SensorRefusal::NameTaken));
            continue;
        };
        if entities.iter().any(|&other| other != entity && !are_alike(world, entity, other)) {
            refusals.push(refuse(SensorRefusal::NameOfConfiguration));
        }
        let taken = &roster.sensors;
        let named = taken[first..].iter().filter(|sensor| !sensor.name.is_empty()).count();
        // a robot's first sensor has the stream of a robot with one sensor
        let beam = beam(&name.name);
        let stream = if taken.len() == first { beam } else { format!("{beam}/{sensor}") };
        match make(world, &Request { robot, entity, name: sensor, stream: &stream }) {
            Ok(_) if sensor.is_empty() && !is_given => refusals.push(refuse(SensorRefusal::Unnamed)),
            Ok(_) if named == MAX_SENSORS => refusals.push(refuse(SensorRefusal::TooMany)),
            Ok(sensor) => refusals.extend(roster.take(sensor).err().map(|reason| refuse(reason.into()))),
            Err(reason) => refusals.push(refuse(reason)),
        }
    }
}

/// The name of the stream of noise of a robot's first sensor.
pub(crate) fn beam(robot: &str) -> String {
    format!("{robot}/beam")
}

/// A sensor to be made.
struct Request<'a> {
    robot: Entity,
    entity: Entity,
    name: &'a str,
    /// The name of the stream of its noise.
    stream: &'a str,
}

/// The sensor of an entity's components, if they are in range.
fn make(world: &World, request: &Request) -> Result<RunSensor, SensorRefusal> {
    let Request { robot, entity, name, stream } = *request;
    let (Some(SensorModel(rays)), Some(id)) = (world.get::<SensorModel>(entity), world.get::<RobotId>(robot)) else {
        return Err(SensorRefusal::NoRobot);
    };
    let seed = world.resource::<Transport>().seed;
    if !name.is_empty() {
        check_name(name).map_err(|_| SensorRefusal::Name)?;
    }
    rays.check()?;
    let mount = check_mount(world.get::<SensorMount>(entity).copied().unwrap_or_default().0)?;
    let noise = world.get::<SensorNoise>(entity).map(|SensorNoise(noise)| noise.try_new()).transpose();
    Ok(RunSensor {
        entity,
        robot,
        id: id.0,
        name: name.to_owned(),
        rays: *rays,
        mount,
        noise: noise.map_err(SensorError::from)?.map(|noise| (noise, Stream::new(seed, stream))),
        fan: 0,
    })
}
