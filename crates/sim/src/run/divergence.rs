//! `Divergence`, the first difference between two runs.

use std::fmt;

use super::field::{FrameField, Value};
use super::{Frame, RobotScan};
use crate::tour::TourConfig;

/// The first value in which two runs differ. A replay that diverges is data, not a panic.
///
/// Prints as `tick 17, robot 0, configuration[2]: expected 1.5 (0x3ff8000000000000), found 1.5000000000000002
/// (0x3ff8000000000001), 1 ulp apart`.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    /// The tick of the frame that differs.
    pub tick: u64,
    /// The robot's id; `None` for a value that belongs to no robot.
    pub robot: Option<u32>,
    /// The scan that holds the value, of a robot with several in the first run; `None` for any other value.
    pub scan: Option<DivergingScan>,
    /// The value's name, in the order of [`Frame::encode`]: `configuration[2]`, `contacts`, `ranges.len`; `frames.len`
    /// when one run is the beginning of the other.
    pub field: String,
    /// The value in the first run.
    pub expected: Value,
    /// The value in the second run.
    pub found: Value,
}

/// One of several scans of a robot, in which two runs differ.
///
/// Prints as `sensor "left"` where the sensor is known, as `the run's sensor` for the one of the configuration, else as
/// `scan 2`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DivergingScan {
    /// Its number among the robot's scans, from 1.
    pub number: usize,
    /// How many scans the robot has, 2 or more.
    pub of: usize,
    /// The robot's name; `None` until the divergence is [named](Divergence::named).
    pub robot: Option<String>,
    /// The sensor's name, empty for the run's own sensor. `None` until the divergence is named, and where the robot has
    /// other sensors than the configuration's.
    pub sensor: Option<String>,
}

impl fmt::Display for DivergingScan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.sensor.as_deref() {
            Some("") => f.write_str("the run's sensor"),
            Some(name) => write!(f, "sensor {name:?}"),
            None => write!(f, "scan {}", self.number),
        }
    }
}

impl Divergence {
    /// The same divergence, with the names of the scan's robot and sensor by the first run's configuration. Nothing
    /// changes where the value is in no scan, or in the only one of its robot.
    #[must_use]
    pub fn named(mut self, config: &TourConfig) -> Self {
        let resident = self.robot.and_then(|id| config.residents().nth(id as usize));
        if let (Some(scan), Some(resident)) = (&mut self.scan, resident) {
            let sensors = config.sensors_of(resident, scan.of);
            scan.robot = Some(resident.name.clone());
            scan.sensor = sensors.and_then(|sensors| Some(sensors.get(scan.number.checked_sub(1)?)?.name.clone()));
        }
        self
    }

    /// The distance of the two values in representable numbers; `None` unless both are floats and neither is NaN.
    pub fn ulps(&self) -> Option<u64> {
        match (self.expected, self.found) {
            (Value::Float(a), Value::Float(b)) if !a.is_nan() && !b.is_nan() => {
                Some(u64::try_from((rank(a) - rank(b)).unsigned_abs()).unwrap_or(u64::MAX))
            }
            _ => None,
        }
    }
}

/// The rank of a number among all `f64` in ascending order, counted from +0.0; -0.0 comes just before it.
fn rank(x: f64) -> i128 {
    let magnitude = i128::from(x.abs().to_bits());
    if x.is_sign_negative() { -magnitude - 1 } else { magnitude }
}

impl fmt::Display for Divergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tick {}, ", self.tick)?;
        if let Some(robot) = self.robot {
            write!(f, "robot {robot}")?;
            match &self.scan {
                Some(scan @ DivergingScan { robot: Some(name), .. }) => write!(f, " ({name}), {scan}, ")?,
                Some(scan) => write!(f, ", {scan}, ")?,
                None => write!(f, ", ")?,
            }
        }
        let Divergence { field, expected, found, .. } = self;
        write!(f, "{field}: expected {expected} ({:#018x}), found {found} ({:#018x})", expected.bits(), found.bits())?;
        match self.ulps() {
            Some(1) => write!(f, ", 1 ulp apart"),
            Some(n) => write!(f, ", {n} ulps apart"),
            None => Ok(()),
        }
    }
}

/// The first value, in order of ticks and then of [`Frame::encode`], in which two runs' frames differ in a bit. `None`
/// if they agree in every bit of every frame.
pub fn first_divergence(expected: &[Frame], found: &[Frame]) -> Option<Divergence> {
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for (one, other) in expected.iter().zip(found) {
        a.clear();
        b.clear();
        one.encode(&mut a);
        other.encode(&mut b);
        if a != b {
            return differing_value(one, other);
        }
    }
    let common = expected.len().min(found.len());
    let beyond = expected.get(common).or(found.get(common))?;
    Some(Divergence {
        tick: beyond.tick,
        robot: None,
        scan: None,
        field: "frames.len".into(),
        expected: Value::of_len(expected.len()),
        found: Value::of_len(found.len()),
    })
}

fn differing_value(expected: &Frame, found: &Frame) -> Option<Divergence> {
    let values = |frame: &Frame| {
        let mut values: Vec<(Option<u32>, FrameField, Value)> = Vec::new();
        frame.visit(&mut |robot: Option<u32>, field: FrameField, value: Value| values.push((robot, field, value)));
        values
    };
    let (a, b) = (values(expected), values(found));
    let at = a.iter().zip(&b).position(|((_, _, x), (_, _, y))| x.bits() != y.bits())?;
    let ((robot, field, expected_value), (_, _, found_value)) = (a[at], b[at]);
    let scans = a[..=at].iter().filter(|(_, field, _)| *field == FrameField::one("scan.robot")).count();
    Some(Divergence {
        tick: expected.tick,
        robot,
        scan: robot.and_then(|_| scan_of_several(&expected.scans[..], scans.checked_sub(1)?)),
        field: field.to_string(),
        expected: expected_value,
        found: found_value,
    })
}

/// The scan of this index in a frame, if its robot has several.
fn scan_of_several(scans: &[RobotScan], index: usize) -> Option<DivergingScan> {
    let robot = scans.get(index)?.robot;
    let count = |scans: &[RobotScan]| scans.iter().filter(|scan| scan.robot == robot).count();
    let (number, of) = (count(&scans[..=index]), count(scans));
    (of > 1).then_some(DivergingScan { number, of, robot: None, sensor: None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::fixture;

    #[test]
    fn every_field_is_compared_and_named() {
        type Change = fn(&mut Frame);
        let changes: [(&str, Change); 18] = [
            ("tick", |f| f.tick += 1),
            ("robots.len", |f| f.robots.truncate(1)),
            ("id", |f| f.robots[1].id = 8),
            ("configuration.len", |f| f.robots[1].configuration.push(0.0)),
            ("configuration[1]", |f| f.robots[1].configuration[1] = -0.0),
            ("extra.len", |f| f.robots[1].extra.push(0.0)),
            ("extra[0]", |f| f.robots[0].extra[0] += 1.0),
            ("channels[0]", |f| f.robots[1].channels[0] = -1),
            ("channels[1]", |f| f.robots[1].channels[1] = -1),
            ("target.len", |f| f.robots[1].target.clear()),
            ("target[0]", |f| f.robots[1].target[0] = 7.0),
            ("manual", |f| f.robots[1].manual ^= true),
            ("in_contact", |f| f.robots[1].in_contact ^= true),
            ("contacts", |f| f.robots[1].contacts += 1),
            ("flash", |f| f.robots[1].flash += 1),
            ("refusals", |f| f.robots[1].refusals += 1),
            ("scans.len", |f| f.scans.clear()),
            ("ranges[2]", |f| f.scans[0].ranges_mut()[2] = 1.0),
        ];
        let frames: Vec<Frame> = (1..=3).map(fixture::frame).collect();
        assert_eq!(first_divergence(&frames, &frames), None);
        for (field, change) in changes {
            let mut other = frames.clone();
            change(&mut other[1]);
            change(&mut other[2]); // the first one is reported
            let found = first_divergence(&frames, &other).expect(field);
            assert_eq!((found.field.as_str(), found.tick), (field, 2), "{found}");
            assert_ne!(found.expected.bits(), found.found.bits());
            let robot = match field {
                "extra[0]" | "ranges[2]" => Some(0),
                "tick" | "robots.len" | "scans.len" => None,
                _ => Some(1),
            };
            assert_eq!(found.robot, robot, "{field}");
        }
    }

    #[test]
    fn a_run_that_ends_early_diverges_where_it_ends() {
        let frames: Vec<Frame> = (1..=3).map(fixture::frame).collect();
        for (a, b) in [(&frames[..], &frames[..2]), (&frames[..2], &frames[..])] {
            let found = first_divergence(a, b).unwrap();
            assert_eq!((found.tick, found.field.as_str(), found.robot), (3, "frames.len", None));
            assert_eq!((found.expected, found.found), (Value::of_len(a.len()), Value::of_len(b.len())));
        }
        assert_eq!(first_divergence(&[], &[]), None);
    }

    #[test]
    fn it_prints_both_values_both_bit_patterns_and_the_ulps_between() {
        let at = |expected, found| Divergence {
            tick: 17,
            robot: Some(0),
            scan: None,
            field: "configuration[2]".into(),
            expected,
            found,
        };
        assert_eq!(
            at(Value::Float(1.5), Value::Float(1.500_000_000_000_000_2)).to_string(),
            "tick 17, robot 0, configuration[2]: expected 1.5 (0x3ff8000000000000), found 1.5000000000000002 \
             (0x3ff8000000000001), 1 ulp apart"
        );
        let next = f64::from_bits(1);
        for (a, b, ulps) in [
            (0.0, -0.0, Some(1)),
            (next, -0.0, Some(2)),
            (-next, 0.0, Some(2)),
            (f64::MAX, f64::INFINITY, Some(1)),
            (1.0, 2.0, Some(1 << 52)),
            (f64::NAN, 1.0, None),
        ] {
            assert_eq!(at(Value::Float(a), Value::Float(b)).ulps(), ulps, "{a:?} {b:?}");
        }
        assert_eq!(at(Value::Count(1), Value::Count(2)).ulps(), None);
    }

    /// Robot 0 has three scans and robot 1 has one, of as many ranges as their numbers say.
    fn scanned() -> Vec<Frame> {
        let scan = |robot, rays| RobotScan { robot, ranges: vec![1.0; rays].into() };
        let scans = vec![scan(0, 2), scan(0, 4), scan(0, 3), scan(1, 2)];
        (1..=2).map(|tick| Frame { scans: scans.clone(), ..fixture::frame(tick) }).collect()
    }

    #[test]
    fn of_several_scans_the_one_that_differs_is_numbered() {
        let frames = scanned();
        let differing = |change: fn(&mut Frame)| {
            let mut other = frames.clone();
            change(&mut other[1]);
            first_divergence(&frames, &other).unwrap()
        };
        let begins = |change: fn(&mut Frame), words: &str| {
            let printed = differing(change).to_string();
            assert!(printed.starts_with(words), "{printed}");
        };
        begins(|f| f.scans[0].ranges_mut()[1] = 2.0, "tick 2, robot 0, scan 1, ranges[1]: expected 1.0 ");
        begins(|f| f.scans[1].ranges_mut()[3] = 2.0, "tick 2, robot 0, scan 2, ranges[3]: expected 1.0 ");
        begins(|f| f.scans[2].ranges = [1.0; 2].into(), "tick 2, robot 0, scan 3, ranges.len: expected 3 ");
        begins(|f| f.scans[2].robot = 1, "tick 2, robot 0, scan 3, scan.robot: expected 0 ");
        // of a robot with one scan, and of values in none, nothing more is said
        begins(|f| f.scans[3].ranges_mut()[0] = 2.0, "tick 2, robot 1, ranges[0]: expected 1.0 ");
        begins(|f| f.robots[0].contacts += 1, "tick 2, robot 0, contacts: expected ");
        begins(|f| _ = f.scans.pop(), "tick 2, scans.len: expected 4 ");
        let obstacle = |f: &mut Frame| {
            let pose = motion_lab_core::geometry::Pose2::IDENTITY;
            f.obstacles.push(crate::run::ObstacleState { world: 0, obstacle: 0, present: false, pose });
        };
        begins(obstacle, "tick 2, obstacles.len: expected 0 ");
        let found = differing(|f| f.scans[1].ranges_mut()[3] = 2.0);
        assert_eq!(found.scan, Some(DivergingScan { number: 2, of: 3, robot: None, sensor: None }));
    }

    #[test]
    fn a_scan_has_the_name_of_its_sensor_where_the_configuration_says_it() {
        use motion_lab_core::worlds::ResidentSensor;
        let (frames, mut log) = (scanned(), fixture::log());
        let config = fixture::config_of(&mut log);
        let rays = motion_lab_core::sensors::RangeSensor { n_rays: 4, max_range: 2.0 };
        config.worlds[0].robots[0].sensors = ["left", "aft"].map(|name| ResidentSensor::new(name, rays)).to_vec();
        let printed = |config: &TourConfig, scan: usize| {
            let mut other = frames.clone();
            other[0].scans[scan].ranges_mut()[1] = 2.0;
            let printed = first_divergence(&frames, &other).unwrap().named(config).to_string();
            printed.split(": expected").next().unwrap().to_owned()
        };
        // the car carries the run's sensor too, and its own come in the order of their names
        let names = [0, 1, 2, 3].map(|scan| printed(config, scan));
        let expected = [
            "tick 1, robot 0 (Car), the run's sensor, ranges[1]",
            "tick 1, robot 0 (Car), sensor \"aft\", ranges[1]",
            "tick 1, robot 0 (Car), sensor \"left\", ranges[1]",
            "tick 1, robot 1, ranges[1]",
        ];
        assert_eq!(names, expected);
        // a program gave it others
        config.worlds[0].robots[0].sensors.clear();
        assert_eq!(printed(config, 2), "tick 1, robot 0 (Car), scan 3, ranges[1]");
        config.worlds.clear();
        assert_eq!(printed(config, 2), "tick 1, robot 0, scan 3, ranges[1]");
    }
}
