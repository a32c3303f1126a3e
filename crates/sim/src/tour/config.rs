//! `TourConfig`, the settings of a run: the worlds with their resident robots, its length, and the range sensor.

use std::collections::BTreeSet;

use motion_lab_core::random::Seed;
use motion_lab_core::sensors::{RangeSensor, SensorError};
use motion_lab_core::worlds::{
    AllRaysError, RayCount, Resident, ResidentSensorError, RouteError, World, check_sensors,
};

/// The seed of every run printed in the book.
pub const BOOK_SEED: Seed = Seed(2005);

/// The greatest number of ticks in a run: nearly seven years at 20 Hz.
pub const MAX_TICKS: u64 = 1 << 32;
/// The greatest number of worlds in a run.
pub const MAX_WORLDS: usize = 1000;
/// The greatest number of robots in a run.
pub const MAX_ROBOTS: usize = 100_000;

/// The settings of a run. The robots are the worlds' residents, numbered from 0 in the order of the worlds and their
/// lists.
#[derive(Clone, Debug, PartialEq)]
pub struct TourConfig {
    /// The worlds.
    pub worlds: Vec<World>,
    /// The number of ticks.
    pub ticks: u64,
    /// The range sensor of every Rusty; `None` for none. The worlds' residents may have further ones of their own.
    pub sensor: Option<RangeSensor>,
}

/// Why a run's settings are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// A run with too many ticks.
    #[error("{0} ticks: at most {MAX_TICKS}")]
    Ticks(u64),
    /// A range sensor out of range.
    #[error(transparent)]
    Sensor(#[from] SensorError),
    /// No world, or too many.
    #[error("{0} worlds: there must be 1 to {MAX_WORLDS}")]
    Worlds(usize),
    /// Too many robots.
    #[error("{0} robots: at most {MAX_ROBOTS}")]
    Robots(usize),
    /// Two robots with the same name, in the same world or in two.
    #[error("two robots are named {robot:?}, the second in world {world:?}: a script could not tell them apart")]
    RobotName {
        /// The name.
        robot: String,
        /// The world of the second one.
        world: String,
    },
    /// A sensor of a robot that is refused. World files are checked for this; a world made in code may have one.
    #[error("robot {robot:?} in world {world:?}: {source}")]
    ResidentSensor {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// Which of its sensors, and the reason.
        source: Box<ResidentSensorError>,
    },
    /// Sensors with too many rays in all: up to this robot's, the run's own sensor among them.
    #[error("robot {robot:?} in world {world:?}: {source}")]
    AllRays {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// How many there are, and may be.
        source: AllRaysError,
    },
    /// A route that is refused. World files are checked for this; a world made in code may have one.
    #[error("route {route:?} in world {world:?}: {source}")]
    Route {
        /// The route.
        route: String,
        /// Its world.
        world: String,
        /// The reason.
        source: RouteError,
    },
    /// A start coordinate that is NaN or infinite.
    #[error("robot {robot:?} in world {world:?}: start coordinate {value} is not a finite number")]
    Start {
        /// The robot.
        robot: String,
        /// Its world.
        world: String,
        /// The coordinate.
        value: f64,
    },
}

impl TourConfig {
    /// The robots' names by ascending id.
    pub fn robot_names(&self) -> impl Iterator<Item = &str> {
        self.worlds.iter().flat_map(|w| &w.robots).map(|r| r.name.as_str())
    }

    /// The robot of an id, with the number of its world.
    pub(crate) fn resident(&self, mut id: usize) -> Option<(usize, &Resident)> {
        for (w, world) in self.worlds.iter().enumerate() {
            match world.robots.get(id) {
                Some(resident) => return Some((w, resident)),
                None => id -= world.robots.len(),
            }
        }
        None
    }

    /// Checks whether this can be run. The worlds themselves were checked when they were made.
    ///
    /// # Errors
    /// [`ConfigError`], for the first thing out of range.
    pub fn validate(&self) -> Result<(), ConfigError> {
        if self.ticks > MAX_TICKS {
            return Err(ConfigError::Ticks(self.ticks));
        }
        if let Some(sensor) = self.sensor {
            sensor.check()?;
        }
        if !(1..=MAX_WORLDS).contains(&self.worlds.len()) {
            return Err(ConfigError::Worlds(self.worlds.len()));
        }
        let robots = self.robot_names().count();
        if robots > MAX_ROBOTS {
            return Err(ConfigError::Robots(robots));
        }
        for world in &self.worlds {
            for route in &world.routes {
                let refused =
                    |source| ConfigError::Route { route: route.name.clone(), world: world.name.clone(), source };
                route.path().map_err(refused)?;
            }
        }
        let (mut names, mut rays) = (BTreeSet::new(), RayCount::default());
        for (world, robot) in self.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| (w, r))) {
            let (world, name) = (world.name.clone(), robot.name.clone());
            if !names.insert(&robot.name) {
                return Err(ConfigError::RobotName { robot: name, world });
            }
            if let Some(&value) = robot.start.iter().find(|x| !x.is_finite()) {
                return Err(ConfigError::Start { robot: name, world, value });
            }
            if let Err(source) = check_sensors(&robot.sensors) {
                return Err(ConfigError::ResidentSensor { robot: name, world, source: Box::new(source) });
            }
            if let Err(source) = rays.add(self.rays_of(robot)) {
                return Err(ConfigError::AllRays { robot: name, world, source });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::geometry::Aabb;
    use motion_lab_core::geometry::Point2;
    use motion_lab_core::sensors::{MAX_RANGE, MAX_RAYS, MIN_RANGE};
    use motion_lab_core::worlds::{Resident, ResidentSensor};

    fn world(name: &str, robots: &[&str]) -> World {
        let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(1.0, 1.0) };
        let resident = |name: &&str| Resident::new(*name, "rusty", [0.5; 3]);
        World { robots: robots.iter().map(resident).collect(), ..World::empty(name, bounds) }
    }

    fn config() -> TourConfig {
        let sensor = Some(RangeSensor { n_rays: MAX_RAYS, max_range: MAX_RANGE });
        TourConfig { worlds: vec![world("one", &["a", "b"]), world("two", &["c"])], ticks: MAX_TICKS, sensor }
    }

    #[test]
    fn the_limits_themselves_are_allowed() {
        assert_eq!(config().validate(), Ok(()));
        assert_eq!(config().robot_names().collect::<Vec<_>>(), ["a", "b", "c"], "by id");
        let least = RangeSensor { n_rays: 1, max_range: MIN_RANGE };
        assert_eq!(TourConfig { sensor: Some(least), ticks: 0, ..config() }.validate(), Ok(()));
        assert_eq!(TourConfig { sensor: None, worlds: vec![world("bare", &[])], ..config() }.validate(), Ok(()));
    }

    #[test]
    fn what_lies_beyond_them_is_refused() {
        type Change = fn(&mut TourConfig);
        let changes: [(&str, Change); 12] = [
            ("4294967297 ticks", |c| c.ticks += 1),
            ("0 rays", |c| c.sensor = Some(RangeSensor { n_rays: 0, max_range: 1.0 })),
            ("100001 rays", |c| c.sensor = Some(RangeSensor { n_rays: MAX_RAYS + 1, max_range: 1.0 })),
            ("range NaN", |c| c.sensor = Some(RangeSensor { n_rays: 1, max_range: f64::NAN })),
            ("range inf", |c| c.sensor = Some(RangeSensor { n_rays: 1, max_range: f64::INFINITY })),
            ("range 0 m", |c| c.sensor = Some(RangeSensor { n_rays: 1, max_range: 0.0 })),
            ("range 0.000001 m", |c| c.sensor = Some(RangeSensor { n_rays: 1, max_range: 1e-6 })),
            ("range 10000.00", |c| c.sensor = Some(RangeSensor { n_rays: 1, max_range: 10_000.000_000_000_002 })),
            ("0 worlds", |c| c.worlds.clear()),
            ("1001 worlds", |c| c.worlds = vec![world("w", &[]); 1001]),
            ("two robots are named \"a\", the second in world \"two\"", |c| c.worlds[1].robots[0].name = "a".into()),
            ("robot \"b\" in world \"one\": start coordinate NaN", |c| c.worlds[0].robots[1].start[2] = f64::NAN),
        ];
        for (reason, change) in changes {
            let mut changed = config();
            change(&mut changed);
            let error = changed.validate().expect_err(reason).to_string();
            assert!(error.starts_with(reason), "{error}");
        }
    }

    #[test]
    fn the_rays_of_all_worlds_and_of_the_runs_own_sensor_are_counted_together() {
        let sensor = |n_rays| RangeSensor { n_rays, max_range: 1.0 };
        let mut one = world("one", &["a", "b"]);
        let own = ["x", "y"].map(|name| ResidentSensor::new(name, sensor(MAX_RAYS)));
        one.robots.iter_mut().for_each(|robot| robot.sensors = own.to_vec());
        one.robots[1].kind = "hitch".into();
        let names: Vec<String> = (0..396).map(|k| format!("r{k}")).collect();
        let two = world("two", &names.iter().map(String::as_str).collect::<Vec<_>>());
        // of its own a has two sensors and b two; with the run's, of which the car b has none, 400 and one more
        let full =
            |rays: u32| TourConfig { worlds: vec![one.clone(), two.clone()], ticks: 1, sensor: Some(sensor(rays)) };
        let error = full(MAX_RAYS).validate().unwrap_err().to_string();
        let expected = "with its sensors there are 40100000 rays in all: at most 40000000";
        assert_eq!(error, format!("robot \"r395\" in world \"two\": {expected}"));
        assert_eq!(full(99_748).validate(), Ok(()), "four times 100,000 and 397 times 99,748");
        assert!(full(99_749).validate().is_err());
    }
}
