//! Checks the robots of a world.

use std::f64::consts::TAU;

use super::description::{RobotText, SensorText};
use super::items::{finite, make_point};
use super::name::{MAX_NAME, check_name};
use super::sizes::{SizesText, make_sizes};
use crate::configuration::{RobotKind, Sizes, WrittenCoordinate};
use crate::geometry::Pose2;
use crate::num;
use crate::worlds::{
    BeamModel, FanSensor, MAX_SENSORS, RangeSensor, Resident, ResidentSensor, ResidentSensorError,
    ResidentSensorProblem, WorldProblem,
};

impl Resident {
    /// Creates a resident that a world file may hold. The kind must be known and the number of coordinates must fit it.
    /// The position must lie within the lab's greatest coordinate, and angles are wrapped to `(-pi, pi]`. The
    /// coordinates of a kind that begins with `x-` need only be finite. The name is not checked.
    ///
    /// # Errors
    /// [`WorldProblem`]: an unknown kind, a wrong number of coordinates, a coordinate that
    /// is not finite or is too large, or a refused sensor.
    pub fn try_new(
        name: impl Into<String>,
        kind: impl Into<String>,
        start: impl Into<Vec<f64>>,
        sensor: Option<BeamModel>,
    ) -> Result<Self, WorldProblem> {
        let kind = kind.into();
        let start = make_start(&kind, start.into())?;
        let sensor = sensor.map(|noise| make_noise(&kind, noise)).transpose()?;
        Ok(Resident { name: name.into(), kind, start, sizes: None, sensor, sensors: Vec::new(), route: None })
    }

    /// The resident with these range sensors of its own, in place of those it has. Angles are wrapped to `(-pi, pi]`.
    ///
    /// # Errors
    /// [`WorldProblem::Sensors`] for the first sensor with a bad or taken name, or with a number out of range, and for
    /// more than [`MAX_SENSORS`].
    pub fn try_with_sensors(self, sensors: &[ResidentSensor]) -> Result<Self, WorldProblem> {
        Ok(Resident { sensors: check_sensors(sensors)?, ..self })
    }

    /// The number of rays of its own sensors.
    pub fn own_rays(&self) -> u64 {
        self.sensors.iter().map(|sensor| u64::from(sensor.rays.sensor.n_rays)).sum()
    }

    /// The same resident with these sizes, which a world file may hold.
    ///
    /// # Errors
    /// [`WorldProblem::Sizes`]: a number out of range, or sizes that are not this kind's.
    pub fn try_with_sizes(self, sizes: Sizes) -> Result<Self, WorldProblem> {
        sizes.check_for(&self.kind)?;
        Ok(self.with_sizes(sizes))
    }
}

pub(crate) fn make_resident(text: &RobotText) -> Result<Resident, WorldProblem> {
    let RobotText { name, kind, start, disc, arm, car, sensor, sensors, route: _ } = text;
    let sizes = SizesText { disc: disc.as_ref(), arm: arm.as_ref(), car: car.as_ref() };
    let sensors: Vec<ResidentSensor> = sensors.iter().map(make_sensor).collect();
    let lengths = RobotKind::of(kind).map_or(0, |known| known.lengths);
    let start = WrittenCoordinate::values(start, lengths)?;
    let resident = Resident::try_new(name.clone(), kind.clone(), start, *sensor)?;
    Resident { sizes: make_sizes(kind, &sizes)?, ..resident }.try_with_sensors(&sensors)
}

/// A sensor as written, with what is left out filled in.
fn make_sensor(text: &SensorText) -> ResidentSensor {
    let SensorText { name, rays, range, field_of_view, mount, noise } = text;
    let sensor = RangeSensor { n_rays: *rays, max_range: *range };
    ResidentSensor {
        name: name.clone(),
        rays: FanSensor { sensor, field_of_view: field_of_view.map_or(TAU, WrittenCoordinate::value) },
        mount: mount.map_or(Pose2::IDENTITY, Pose2::from),
        noise: *noise,
    }
}

/// Checks the start of a robot of this kind and wraps its angles.
pub(crate) fn make_start(kind: &str, mut start: Vec<f64>) -> Result<Vec<f64>, WorldProblem> {
    // how many coordinates are a position, how many are allowed, and how an error names them
    let (lengths, counts, expected) = match RobotKind::of(kind) {
        Some(known) => {
            let least = known.spaces.first().map_or(0, |space| space.coordinates);
            (known.lengths, least..=known.coordinates.len(), known.start)
        }
        None if kind.len() > 2 && kind.starts_with("x-") && check_name(kind).is_ok() => (usize::MAX, 1..=64, "1 to 64"),
        None => return Err(WorldProblem::Kind(kind.to_owned())),
    };
    if !counts.contains(&start.len()) {
        return Err(WorldProblem::Start { kind: kind.to_owned(), expected, found: start.len() });
    }
    for (i, x) in start.iter_mut().enumerate() {
        *x = finite(*x, "a start coordinate")?;
        if i >= lengths {
            *x = num::wrap(*x);
        }
    }
    if lengths == 2 {
        make_point((start[0], start[1]))?;
    }
    Ok(start)
}

/// Checks the sensor noise of a robot. Its kind must have a range sensor.
pub(crate) fn make_noise(kind: &str, noise: BeamModel) -> Result<BeamModel, WorldProblem> {
    if RobotKind::of(kind).is_some_and(|known| !known.senses) {
        return Err(WorldProblem::NoSensor(kind.to_owned()));
    }
    Ok(noise.try_new()?)
}

/// Checks the sensors of a robot. Returns them as a world file keeps them, in the same order.
pub fn check_sensors(sensors: &[ResidentSensor]) -> Result<Vec<ResidentSensor>, ResidentSensorError> {
    let mut checked: Vec<ResidentSensor> = Vec::with_capacity(sensors.len());
    for (index, sensor) in sensors.iter().enumerate() {
        let refused = |problem| {
            let name = sensor.name.chars().take(MAX_NAME).collect();
            ResidentSensorError { index, name, problem }
        };
        if index == MAX_SENSORS {
            return Err(refused(ResidentSensorProblem::TooMany));
        }
        check_name(&sensor.name).map_err(|_| refused(ResidentSensorProblem::Name))?;
        if let Some(earlier) = checked.iter().position(|earlier| earlier.name == sensor.name) {
            return Err(refused(ResidentSensorProblem::NameTaken(earlier)));
        }
        checked.push(sensor.clone().try_numbers().map_err(|reason| refused(reason.into()))?);
    }
    Ok(checked)
}
