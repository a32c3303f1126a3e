//! The sensors of a run's robots, as its configuration says.

use super::TourConfig;
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::worlds::{Resident, ResidentSensor};

impl TourConfig {
    /// The sensors of a robot that has this many scans in each frame, in the order of the scans: first the run's own,
    /// which has the empty name, if it gives the robot one, then the resident's by the bytes of their names. `None`
    /// when there are other sensors than the configuration's, as in a run to which a program added some.
    pub fn sensors_of(&self, resident: &Resident, scans: usize) -> Option<Vec<ResidentSensor>> {
        let kind = RobotKind::of(&resident.kind);
        let given = self.sensor.filter(|_| kind.is_none_or(|kind| kind.senses));
        let given = given.map(|rays| ResidentSensor { noise: resident.sensor, ..ResidentSensor::new("", rays) });
        // a program's own kind may or may not carry the run's sensor
        let given = given.filter(|_| kind.is_some() || scans > resident.sensors.len());
        let mut sensors: Vec<ResidentSensor> = given.into_iter().chain(resident.sensors.iter().cloned()).collect();
        sensors.sort_by(|a, b| a.name.cmp(&b.name));
        (sensors.len() == scans).then_some(sensors)
    }

    /// The number of rays of a resident's sensors, that of the run's own among them wherever its kind may carry one.
    pub(super) fn rays_of(&self, resident: &Resident) -> u64 {
        let senses = RobotKind::of(&resident.kind).is_none_or(|kind| kind.senses);
        let given = self.sensor.filter(|_| senses).map_or(0, |sensor| u64::from(sensor.n_rays));
        given + resident.own_rays()
    }

    /// The residents of all worlds, by ascending id of their robots.
    pub fn residents(&self) -> impl Iterator<Item = &Resident> {
        self.worlds.iter().flat_map(|world| &world.robots)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::sensors::RangeSensor;

    #[test]
    fn the_runs_sensor_comes_first_and_the_others_by_name() {
        let rays = RangeSensor { n_rays: 4, max_range: 2.0 };
        let config = TourConfig { sensor: Some(rays), ..TourConfig::default() };
        let with = |kind: &str, names: &[&str]| {
            let sensors = names.iter().map(|name| ResidentSensor::new(*name, rays)).collect();
            Resident { sensors, ..Resident::new("it", kind, [0.0; 3]) }
        };
        let names = |config: &TourConfig, resident: &Resident, scans: usize| {
            let sensors = config.sensors_of(resident, scans)?;
            Some(sensors.iter().map(|s| s.name.clone()).collect::<Vec<_>>().join(","))
        };
        let (rover, own) = (RobotKind::RUSTY.name, "x-own");
        assert_eq!(names(&config, &with(rover, &["b", "a", "B"]), 4).unwrap(), ",B,a,b");
        assert_eq!(names(&config, &with(RobotKind::HITCH.name, &["b", "a"]), 2).unwrap(), "a,b");
        assert_eq!(names(&config, &with(own, &["a"]), 1).unwrap(), "a");
        assert_eq!(names(&config, &with(own, &["a"]), 2).unwrap(), ",a");
        let without = TourConfig { sensor: None, ..config.clone() };
        assert_eq!(names(&without, &with(rover, &["a"]), 1).unwrap(), "a");
        for (config, resident, scans) in
            [(&config, with(rover, &["a"]), 1), (&without, with(rover, &["a"]), 2), (&config, with(own, &[]), 2)]
        {
            assert_eq!(names(config, &resident, scans), None, "{resident:?}");
        }
    }
}
