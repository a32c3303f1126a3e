//! Writes the sensors of a run into its configuration, so that any program can run it again.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy::prelude::*;

use super::roster::RunSensor;
use crate::simulation::RunConfig;
use crate::simulation::obstacles::sync::set_residents;
use crate::tour::TourConfig;
use motion_lab_core::sensors::{BeamModel, RangeSensor};
use motion_lab_core::worlds::{Resident, ResidentSensor};

/// Makes the run's configuration say these sensors. `own` is the run's own sensor; `None` leaves the configuration's,
/// as in a run without robots that sense. A configuration that says the same stays as it is, to the bit.
pub(super) fn write(world: &mut World, sensors: &[RunSensor], own: Option<Option<RangeSensor>>) {
    let Some(old) = world.get_resource::<RunConfig>().map(|config| Arc::clone(config.config())) else { return };
    let mut of_robot: BTreeMap<u32, Vec<&RunSensor>> = BTreeMap::new();
    sensors.iter().for_each(|sensor| of_robot.entry(sensor.id).or_default().push(sensor));
    let numbered = old.worlds.iter().enumerate().flat_map(|(w, model)| (0..model.robots.len()).map(move |r| (w, r)));
    let mut new: Option<TourConfig> = None;
    for (id, (w, r)) in (0..).zip(numbered) {
        let resident = &old.worlds[w].robots[r];
        let with = resident_with(resident, of_robot.get(&id).map_or(&[], |sensors| sensors));
        if with != *resident {
            new.get_or_insert_with(|| TourConfig::clone(&old)).worlds[w].robots[r] = with;
        }
    }
    if let Some(own) = own.filter(|own| *own != old.sensor) {
        new.get_or_insert_with(|| TourConfig::clone(&old)).sensor = own;
    }
    if let Some(new) = new {
        set_residents(world, &new.worlds);
        world.insert_resource(RunConfig(Arc::new(new)));
    }
}

/// The resident with these sensors: those that it has keep their order, then come the others by their names.
fn resident_with(resident: &Resident, sensors: &[&RunSensor]) -> Resident {
    let mut with = Resident { sensors: Vec::new(), ..resident.clone() };
    let mut named: BTreeMap<&str, &RunSensor> = sensors.iter().map(|s| (s.name.as_str(), *s)).collect();
    if let Some(own) = named.remove("") {
        let noise = noise_of(own);
        if resident.sensor.and_then(|old| old.try_new().ok()) != noise {
            with.sensor = noise;
        }
    }
    for old in &resident.sensors {
        let Some(new) = named.remove(old.name.as_str()).map(described) else { continue };
        // a world made in code may have a heading that is not wrapped: it stays
        let is_same = old.clone().try_numbers().is_ok_and(|old| old == new);
        with.sensors.push(if is_same { old.clone() } else { new });
    }
    with.sensors.extend(named.into_values().map(described));
    with
}

fn described(sensor: &RunSensor) -> ResidentSensor {
    let RunSensor { name, rays, mount, .. } = sensor;
    ResidentSensor { name: name.clone(), rays: *rays, mount: *mount, noise: noise_of(sensor) }
}

fn noise_of(sensor: &RunSensor) -> Option<BeamModel> {
    sensor.noise.as_ref().map(|(noise, _)| *noise)
}
