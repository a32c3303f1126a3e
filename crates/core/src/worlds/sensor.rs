//! `RangeSensor`, `FanSensor` and `ResidentSensor`: a range sensor's numbers, and a sensor as a world file gives it.

use std::f64::consts::TAU;

use super::{BeamError, BeamModel};
use crate::geometry::{MAX_COORDINATE, Pose2};
use crate::num::{greater, lesser};

/// The greatest number of rays of a range sensor.
pub const MAX_RAYS: u32 = 100_000;
/// The greatest number of rays of all range sensors of a world's robots together, and of all sensors of a run: more
/// than the 360 that the tour gives a rover, for each of 100,000 rovers.
pub const MAX_ALL_RAYS: u64 = 40_000_000;
/// The smallest `max_range` that a range sensor may have, metres.
pub const MIN_RANGE: f64 = 1e-3;
/// The largest `max_range` that a range sensor may have, metres.
pub const MAX_RANGE: f64 = 1e4;
/// The smallest field of view that a range sensor may have, radians. The largest is a full turn, 2 pi.
pub const MIN_FIELD_OF_VIEW: f64 = 1e-3;
/// The greatest number of sensors that a robot may have, the run's own apart.
pub const MAX_SENSORS: usize = 64;

/// A range sensor with `n_rays` rays evenly spread over the full circle and a greatest range in metres.
///
/// The scan is the saturated raw distance function rho_R sampled at `n_rays` bearings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeSensor {
    /// The number of rays.
    pub n_rays: u32,
    /// The greatest range R, metres: a hit at exactly R counts, within four ulps; farther reads infinity.
    pub max_range: f64,
}

/// A range sensor whose rays are spread over a field of view.
///
/// Over a full turn, which is exactly [`TAU`], ray k has the bearing 2 pi k / n from the sensor's heading, as in a
/// [`RangeSensor`]. Over less, the n rays lie evenly from half the field of view on the right (negative bearings) to
/// half of it on the left, the first and the last ray on its borders; a single ray points straight ahead.
///
/// ```
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::sensors::{FanSensor, RangeSensor};
/// let ahead = FanSensor::try_new(RangeSensor { n_rays: 3, max_range: 4.0 }, 1.0)?;
/// assert_eq!([0, 1, 2].map(|k| ahead.bearing(k)), [-0.5, 0.0, 0.5]);
/// # Ok::<(), motion_lab_core::sensors::SensorError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FanSensor {
    /// The number of rays, and the greatest range.
    pub sensor: RangeSensor,
    /// The field of view, radians: [`MIN_FIELD_OF_VIEW`] to 2 pi.
    pub field_of_view: f64,
}

/// A range sensor of a robot, as a world file gives it.
///
/// A robot's sensors are ordered by the bytes of their names, whatever their order in the file. The sensor that a run
/// gives to its rovers has the empty name, which no sensor of a file has, so it comes before them.
#[derive(Clone, Debug, PartialEq)]
pub struct ResidentSensor {
    /// The name, unique on its robot.
    pub name: String,
    /// The rays.
    pub rays: FanSensor,
    /// The sensor's pose in the frame of its robot that sensors are mounted in: a rover's or a car's body, the last
    /// link of an arm at its tip.
    pub mount: Pose2,
    /// The noise; `None` for an exact sensor.
    pub noise: Option<BeamModel>,
}

/// Why a sensor's numbers are refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SensorError {
    /// Not from 1 to 100,000 rays.
    #[error("{0} rays: there must be 1 to {MAX_RAYS}")]
    Rays(u32),
    /// A range that is not finite, below 1 mm or beyond 10 km.
    #[error("range {0} m: it must be {MIN_RANGE} to {MAX_RANGE} m")]
    Range(f64),
    /// A field of view that is not finite, below a milliradian or above a full turn.
    #[error("field of view {0} rad: it must be {MIN_FIELD_OF_VIEW} to {TAU} rad, a full turn")]
    FieldOfView(f64),
    /// A mount that is not finite, or beyond the lab's greatest coordinate.
    #[error("mount x: {}, y: {}, theta: {}: it must be finite, and within {MAX_COORDINATE} m", .0.x, .0.y, .0.theta)]
    Mount(Pose2),
    /// Noise that is not a probability distribution.
    #[error("noise: {0}")]
    Noise(#[from] BeamError),
}

impl RangeSensor {
    /// A sensor with these numbers.
    ///
    /// # Errors
    /// [`SensorError`] when either is out of range.
    pub fn try_new(n_rays: u32, max_range: f64) -> Result<Self, SensorError> {
        let sensor = RangeSensor { n_rays, max_range };
        sensor.check()?;
        Ok(sensor)
    }

    /// Checks that the sensor's numbers are in range, for one that was put together by hand.
    ///
    /// # Errors
    /// [`SensorError`] when either is not.
    pub fn check(&self) -> Result<(), SensorError> {
        if !(1..=MAX_RAYS).contains(&self.n_rays) {
            return Err(SensorError::Rays(self.n_rays));
        }
        if !(MIN_RANGE..=MAX_RANGE).contains(&self.max_range) {
            return Err(SensorError::Range(self.max_range));
        }
        Ok(())
    }
}

impl From<RangeSensor> for FanSensor {
    fn from(sensor: RangeSensor) -> Self {
        FanSensor { sensor, field_of_view: TAU }
    }
}

impl FanSensor {
    /// A sensor with this field of view, radians.
    ///
    /// # Errors
    /// [`SensorError`] when a number is out of range.
    pub fn try_new(sensor: RangeSensor, field_of_view: f64) -> Result<Self, SensorError> {
        let fan = FanSensor { sensor, field_of_view };
        fan.check()?;
        Ok(fan)
    }

    /// Checks that the sensor's numbers are in range, for one that was put together by hand.
    ///
    /// # Errors
    /// [`SensorError`] when one is not.
    pub fn check(&self) -> Result<(), SensorError> {
        self.sensor.check()?;
        if !(MIN_FIELD_OF_VIEW..=TAU).contains(&self.field_of_view) {
            return Err(SensorError::FieldOfView(self.field_of_view));
        }
        Ok(())
    }

    /// The field of view of a fan of two rays and more, kept within its limits; `None` for a full turn and for a single
    /// ray.
    pub(crate) fn partial(&self) -> Option<f64> {
        let wide = lesser(greater(self.field_of_view, MIN_FIELD_OF_VIEW), TAU);
        (self.sensor.n_rays > 1 && wide < TAU).then_some(wide)
    }

    /// The bearing of ray `k` from the sensor's heading, radians: over a full turn from 0 up to 2 pi, over less from
    /// minus to plus half the field of view. The rays of a fan lie in mirror images to both sides of its middle.
    pub fn bearing(&self, k: u32) -> f64 {
        let n = self.sensor.n_rays;
        match self.partial() {
            Some(wide) => 0.5 * wide * ((2.0 * f64::from(k) - f64::from(n - 1)) / f64::from(n - 1)),
            None => TAU * f64::from(k) / f64::from(n),
        }
    }
}

/// Sensors with more rays than [`MAX_ALL_RAYS`] together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("with its sensors there are {0} rays in all: at most {MAX_ALL_RAYS}")]
pub struct AllRaysError(pub u64);

/// Counts the rays of the sensors of a world or of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCount(u64);

impl RayCount {
    /// Adds the rays of a sensor, or of several.
    ///
    /// # Errors
    /// [`AllRaysError`] with the sum, which is then not counted, where there are more than [`MAX_ALL_RAYS`].
    pub fn add(&mut self, rays: u64) -> Result<(), AllRaysError> {
        let sum = self.0.saturating_add(rays);
        if sum > MAX_ALL_RAYS {
            return Err(AllRaysError(sum));
        }
        self.0 = sum;
        Ok(())
    }
}

impl ResidentSensor {
    /// A sensor in the middle of its robot's frame, without noise. Nothing is checked.
    pub fn new(name: impl Into<String>, rays: impl Into<FanSensor>) -> Self {
        ResidentSensor { name: name.into(), rays: rays.into(), mount: Pose2::IDENTITY, noise: None }
    }

    /// Checks the numbers. Returns the sensor as a world file keeps it: the mount's heading wrapped, `-0.0` as `0.0`.
    ///
    /// # Errors
    /// [`SensorError`] for the first number that is out of range.
    pub fn try_numbers(self) -> Result<Self, SensorError> {
        self.rays.check()?;
        let mount = check_mount(self.mount)?;
        let noise = self.noise.map(BeamModel::try_new).transpose()?;
        Ok(ResidentSensor { mount, noise, ..self })
    }
}

/// Returns the mount of a sensor if it is finite and not too far off, with its heading wrapped and `-0.0` as `0.0`.
pub fn check_mount(mount: Pose2) -> Result<Pose2, SensorError> {
    let Pose2 { x, y, theta } = mount;
    if !(mount.is_finite() && x.abs() <= MAX_COORDINATE && y.abs() <= MAX_COORDINATE) {
        return Err(SensorError::Mount(mount));
    }
    Ok(Pose2::new(x + 0.0, y + 0.0, theta + 0.0))
}

/// A sensor of a robot that is refused: which one, and why. Prints as `sensors[1] "front": 0 rays: ...`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("sensors[{index}] {name:?}: {problem}")]
pub struct ResidentSensorError {
    /// Its index in the robot's list, from 0.
    pub index: usize,
    /// Its name.
    pub name: String,
    /// The reason.
    pub problem: ResidentSensorProblem,
}

/// Why a sensor of a robot is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ResidentSensorProblem {
    /// A name that is empty, longer than 200 bytes, padded with blanks, or has a control character.
    #[error("its name must be 1 to 200 bytes without control characters and without blanks at its ends")]
    Name,
    /// A name that an earlier sensor of the robot has.
    #[error("the name is taken by sensors[{0}]")]
    NameTaken(usize),
    /// One sensor too many.
    #[error("a robot has at most {MAX_SENSORS} sensors")]
    TooMany,
    /// A number out of range.
    #[error(transparent)]
    Numbers(#[from] SensorError),
}
