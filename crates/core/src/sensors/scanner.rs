//! `Scanner`, a range sensor with its working memory.

use std::f64::consts::TAU;

use super::cast_segments::RayMemory;
use super::grid_cast::{Boundary, Walk};
use super::kernel::{Kernel, raise};
use super::rays::{Fan, Lanes};
use super::simd::Instructions;
use super::view::View;
use crate::collision::{Circle, LANES, RowsError, Scene, SegmentSoup, touch};
use crate::geometry::{Aabb, Placed, Point2, Pose2, SinCos};
use crate::num;
use crate::worlds::{FanSensor, RangeSensor};

/// A range sensor that keeps its rays' directions and its scratch between scans: after the first scans it allocates
/// nothing. A small scene allocates when it lists what can be seen from a place where many scans begin, once a place.
///
/// ```
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::collision::Scene;
/// use motion_lab_core::sensors::{RangeSensor, Scanner};
/// let scene = Scene::apartment();
/// let mut scanner = Scanner::new(RangeSensor { n_rays: 360, max_range: 4.0 });
/// let mut ranges = [0.0; 360];
/// scanner.scan_into(&scene, &[], &Pose2::new(6.0, 4.0, 0.0), &mut ranges);
/// assert_eq!(ranges.to_vec(), scanner.sensor().scan(&scene, Point2::new(6.0, 4.0)));
/// ```
#[derive(Clone, Debug)]
pub struct Scanner {
    sensor: FanSensor,
    kernel: Kernel,
    /// The rays' directions in the sensor's frame.
    units: Vec<[Lanes; 2]>,
    fan: Fan,
    others: SegmentSoup,
    walk: Walk,
    desk: Box<RayMemory>,
}

impl Scanner {
    /// A scanner with the rays of this sensor that uses the fastest instructions of this processor.
    pub fn new(sensor: impl Into<FanSensor>) -> Self {
        Self::with_instructions(sensor, Instructions::best())
    }

    /// A scanner that uses these instructions. The ranges are the same to the last bit; a set that this processor does
    /// not have is replaced by the baseline.
    pub fn with_instructions(sensor: impl Into<FanSensor>, instructions: Instructions) -> Self {
        let sensor = sensor.into();
        let n_rays = sensor.sensor.n_rays;
        let blocks = (n_rays as usize).div_ceil(LANES);
        let mut units = vec![[[0.0; LANES]; 2]; blocks];
        for k in 0..n_rays {
            let (x, y) = sensor.direction(k);
            let k = k as usize;
            (units[k / LANES][0][k % LANES], units[k / LANES][1][k % LANES]) = (x, y);
        }
        Scanner {
            sensor,
            kernel: instructions.kernel(),
            units,
            fan: Fan::new(n_rays as usize),
            others: SegmentSoup::default(),
            walk: Walk::default(),
            desk: Box::default(),
        }
    }

    /// The sensor's rays, without their field of view.
    pub fn sensor(&self) -> &RangeSensor {
        &self.sensor.sensor
    }

    /// The sensor's field of view, radians; 2 pi for a full turn.
    pub fn field_of_view(&self) -> f64 {
        self.sensor.field_of_view
    }

    /// Writes the ranges from a pose into `ranges`, as [`FanSensor::scan_from`] gives them: ray k into place k, as
    /// far as there are places.
    pub fn scan_into(&mut self, scene: &Scene, others: &[Placed], pose: &Pose2, ranges: &mut [f64]) {
        self.scan_among(scene, others.iter(), pose, ranges);
    }

    /// As [`scan_into`](Self::scan_into), among other robots' parts that lie anywhere, in any order.
    pub fn scan_among<'a>(
        &mut self,
        scene: &Scene,
        others: impl Iterator<Item = &'a Placed> + Clone,
        pose: &Pose2,
        ranges: &mut [f64],
    ) {
        let sensor = self.sensor.sensor;
        let rays = ranges.len().min(sensor.n_rays as usize);
        let ranges = &mut ranges[..rays];
        let origin = pose.position();
        let point = Placed::new([origin], 0.0);
        if !pose.is_finite()
            || scene.holds(&point)
            || others.clone().any(|other| may_hold(other, origin) && touch(&point, other))
        {
            ranges.fill(0.0);
            return;
        }
        let heading = if pose.theta == 0.0 { SinCos { sin: 0.0, cos: 1.0 } } else { SinCos::of(pose.theta) };
        (self.kernel.turn)(&mut self.fan, &self.units, heading);
        // only for which rays may meet something: its error is far below that of the bearings
        let turns = if pose.theta.abs() < 1e6 { pose.theta / TAU } else { num::atan2(heading.sin, heading.cos) / TAU };
        // the bearing of ray 0, and how many rays a full turn would have
        let (turns, rays, fan_blocks) = match self.sensor.partial() {
            None => (turns, f64::from(sensor.n_rays), None),
            Some(wide) => {
                let blocks = self.units.len();
                (turns - 0.5 * wide / TAU, TAU * f64::from(sensor.n_rays - 1) / wide, Some(blocks))
            }
        };
        let reach = sensor.max_range * (1.0 + 1e-6);
        let view = View {
            origin,
            reach,
            reach_squared: reach * reach,
            heading: turns - turns.floor(),
            rays,
            fan_blocks,
            nothing: 0.0,
        };
        let Scanner { kernel, fan, walk, desk, others: soup, .. } = self;
        for boundary in std::iter::once(scene.boundary()).chain(scene.later_boundaries()) {
            let soup = boundary.soup();
            match boundary.cells() {
                Some(cells) => walk.raise(Boundary { soup, cells }, &view, kernel, fan, desk),
                None => raise_those(boundary.seen_from(origin, reach), soup.circles(), &view, kernel, fan, desk),
            }
            fan.open = u64::MAX;
        }
        soup.clear();
        for part in others {
            match (part.core(), part.radius()) {
                (&[centre], radius) if radius > 0.0 && part.is_valid() => {
                    (kernel.circle)(&Circle { centre, radius }, &view, fan)
                }
                _ => soup.push(part),
            }
        }
        raise_those(soup.segments().arrays(), soup.circles(), &view, kernel, fan, desk);
        (self.kernel.ranges)(&self.fan, sensor.max_range, ranges);
    }
}

/// Whether a shape may hold a point; false only where it certainly does not.
fn may_hold(shape: &Placed, p: Point2) -> bool {
    if let (&[centre], radius) = (shape.core(), shape.radius()) {
        // what is not finite may hold it
        let is_outside = (p - centre).norm_squared() > radius * radius * (1.0 + 1e-9) + 1e-18;
        return !(is_outside && shape.is_valid());
    }
    let Aabb { min, max } = shape.padded_bounds();
    (min.x..=max.x).contains(&p.x) && (min.y..=max.y).contains(&p.y)
}

/// Raises the rays that meet any of these segments and discs.
fn raise_those(
    segments: [&[f64]; 4],
    circles: &[Circle],
    view: &View,
    kernel: &Kernel,
    fan: &mut Fan,
    desk: &mut RayMemory,
) {
    raise(segments, view, kernel, fan, desk);
    for circle in circles {
        (kernel.circle)(circle, view, fan);
    }
}

impl FanSensor {
    /// The ranges from a pose, metres: ray k at its [`bearing`](Self::bearing) from the pose's heading, against the
    /// scene and the other robots' parts. A robot does not see itself: leave it out of `others`. For many scans keep a
    /// [`Scanner`].
    ///
    /// Infinity where nothing is within range, 0 everywhere when the position is inside an obstacle or touches one.
    /// Rays are closed: one through a corner hits it.
    pub fn scan_from(&self, scene: &Scene, others: &[Placed], pose: &Pose2) -> Vec<f64> {
        let mut ranges = vec![0.0; self.sensor.n_rays as usize];
        Scanner::new(*self).scan_into(scene, others, pose, &mut ranges);
        ranges
    }
}

impl RangeSensor {
    /// The ranges from `position`, metres: ray k at world bearing 2 pi k / n.
    ///
    /// Infinity where nothing is within range, 0 everywhere when the position is inside an obstacle or touches one.
    /// Rays are closed: one through a corner hits it.
    pub fn scan(&self, scene: &Scene, position: Point2) -> Vec<f64> {
        self.scan_from(scene, &[], &Pose2 { x: position.x, y: position.y, theta: 0.0 })
    }

    /// The ranges from a pose, with ray k at bearing 2 pi k / n from the pose's heading, against the scene and the
    /// other robots' parts. A robot does not see itself: leave it out of `others`. For many scans keep a [`Scanner`].
    pub fn scan_from(&self, scene: &Scene, others: &[Placed], pose: &Pose2) -> Vec<f64> {
        let mut ranges = vec![0.0; self.n_rays as usize];
        Scanner::new(*self).scan_into(scene, others, pose, &mut ranges);
        ranges
    }

    /// The ranges from many poses, one scan after the other, in parallel where threads exist. They do not depend on the
    /// number of threads.
    pub fn scans(&self, scene: &Scene, poses: &[Pose2]) -> Vec<f64> {
        let mut ranges = vec![0.0; self.n_rays as usize * poses.len()];
        self.scan_each(scene, poses, &mut ranges);
        ranges
    }

    /// As [`scans`](Self::scans), written into the caller's memory.
    ///
    /// # Errors
    /// [`RowsError::Places`] unless there are as many places as rays of all poses; nothing is written then.
    pub fn scans_into(&self, scene: &Scene, poses: &[Pose2], ranges: &mut [f64]) -> Result<(), RowsError> {
        let (answers, places) = (self.n_rays as usize * poses.len(), ranges.len());
        if answers != places {
            return Err(RowsError::Places { answers, places });
        }
        self.scan_each(scene, poses, ranges);
        Ok(())
    }

    fn scan_each(&self, scene: &Scene, poses: &[Pose2], ranges: &mut [f64]) {
        let n = self.n_rays as usize;
        if n == 0 {
            return;
        }
        let scan = |scanner: &mut Scanner, (pose, ranges): (&Pose2, &mut [f64])| {
            scanner.scan_into(scene, &[], pose, ranges);
        };
        #[cfg(not(target_family = "wasm"))]
        {
            use rayon::prelude::*;
            let scans = poses.par_iter().zip(ranges.par_chunks_mut(n));
            scans.for_each_init(|| Scanner::new(*self), scan);
        }
        #[cfg(target_family = "wasm")]
        {
            let mut scanner = Scanner::new(*self);
            poses.iter().zip(ranges.chunks_mut(n)).for_each(|one| scan(&mut scanner, one));
        }
    }
}
