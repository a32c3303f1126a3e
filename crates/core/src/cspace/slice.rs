//! `Slice`, a plane of configurations or a whole space of three coordinates, and the proof about a cell of it.

use std::f64::consts::PI;

use crate::collision::{Checker, Collision, ObstacleId, Overlap};
use crate::configuration::{AnyConfiguration, Configuration, HitchCfg, Tn};
use crate::geometry::{Footprint, Pose2};
use crate::num::{greater, hypot, lesser, ulp, wrap};
use crate::picture::in_signs;
use crate::robots::{AnyRobot, ConfigurationError, Robot};

/// Subtracted from every clearance and depth before it is compared with a bound, metres. It is far above the rounding
/// of either.
const ROUNDING: f64 = 1e-11;

/// By how many units in the last place of the slice's greatest coordinate a cell is grown before it is judged. Middles
/// of cells are rounded by three at most, and pi by less than one.
const OVERLAP_ULPS: f64 = 16.0;

/// The relative rounding of a motion bound, at most.
const BOUND_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// What is proven of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CellProof {
    /// Every configuration in it is free.
    Free,
    /// Every configuration in it is in contact, for this reason.
    InContact(Blocking),
    /// Every configuration in it is outside the robot's own limits.
    OutsideLimits,
    /// Nothing.
    None,
}

/// What proves that every configuration of a cell is in contact: at its middle a part of the robot is deeper in an
/// obstacle than any of its points moves within the cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocking {
    /// The number of the part.
    pub part: usize,
    /// The obstacle.
    pub obstacle: ObstacleId,
    /// A lower bound on how far the part must move to be free of the obstacle, metres; above `bound`.
    pub depth: f64,
    /// An upper bound on how far a point of the part moves from the middle to anywhere in the cell, metres.
    pub bound: f64,
}

/// What is known of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellState {
    /// Every configuration in it is free, by proof.
    Free,
    /// Every configuration in it is in contact, or outside the robot's own limits, by proof.
    Blocked,
    /// Neither is proven.
    #[default]
    Unknown,
}

/// Some coordinates of a robot's configurations, the others held: two, a plane through its configuration space or a
/// torus; or three, a whole space.
///
/// - An arm with two links: both angles, from -pi to pi, with opposite edges identified. With three links: the last two
///   angles, the first held.
/// - Rusty: its position, in the world's bounds. It is a disc, so its heading does not matter.
/// - Hitch: its rear axle's position, in the world's bounds, with the headings held.
#[derive(Clone, Debug)]
pub struct Slice<const N: usize = 2> {
    checker: Checker<AnyRobot>,
    base: AnyConfiguration,
    axes: [usize; N],
    min: [f64; N],
    max: [f64; N],
}

impl Slice {
    /// The plane through `q`.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` is not a configuration of the checker's robot.
    pub fn through(checker: &Checker<AnyRobot>, q: &AnyConfiguration) -> Result<Self, ConfigurationError> {
        checker.robot().check(q)?;
        let axes = if matches!(q, AnyConfiguration::T3(_)) { [1, 2] } else { [0, 1] };
        let bounds = checker.scene().bounds();
        let (min, max) = if q.is_angle(axes[0]) {
            ([-PI; 2], [PI; 2])
        } else {
            ([bounds.min.x, bounds.min.y], [bounds.max.x, bounds.max.y])
        };
        Ok(Slice { checker: checker.clone(), base: *q, axes, min, max })
    }

    /// Whether opposite edges are identified, so that the slice is a torus.
    pub fn wraps(&self) -> bool {
        self.base.is_angle(self.axes[0])
    }

    /// Describes the plane in a line: its two coordinates, and what is held.
    pub fn described(&self) -> String {
        let [across, up] = self.names().map(|name| in_signs(&name));
        let at = |(i, name): &(usize, String)| {
            let value = format!("{:.3}", self.base.coordinates()[*i]).replace('-', "\u{2212}");
            format!("{} = {value}", in_signs(name))
        };
        let held: Vec<String> = self.held().iter().map(at).collect();
        match self.checker.robot() {
            AnyRobot::Rusty(rover) => {
                format!("{across} and {up}: every obstacle is grown by r = {} m", rover.body_radius)
            }
            _ if held.is_empty() => format!("{across} and {up}: opposite edges are one"),
            _ => format!("{across} and {up} at {}", held.join(", ")),
        }
    }

    /// The distance of two points of the slice, metres or radians: the length of their difference, angles taken the
    /// short way.
    pub fn distance(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let d = [b[0] - a[0], b[1] - a[1]];
        let [x, y] = if self.wraps() { d.map(wrap) } else { d };
        hypot(x, y)
    }

    /// The point of a cell that is nearest to `p`, and how far that is.
    pub(super) fn nearest_in(&self, p: [f64; 2], centre: [f64; 2], half: [f64; 2]) -> ([f64; 2], f64) {
        let nearest = [0, 1].map(|i| {
            let off = if self.wraps() { wrap(p[i] - centre[i]) } else { p[i] - centre[i] };
            centre[i] + off.clamp(-half[i], half[i])
        });
        (nearest, self.distance(p, nearest))
    }

    /// The shorter of two sides.
    pub(super) fn least_side(&self) -> f64 {
        lesser(self.max[0] - self.min[0], self.max[1] - self.min[1])
    }
}

impl Slice<3> {
    /// The whole space of a robot of three coordinates: an arm with three links; and a car, whose trailer is left out
    /// where it has one, since what the car alone can't pass it can't pass with a trailer. `None` for other robots.
    pub fn space(checker: &Checker<AnyRobot>) -> Option<Self> {
        let scene = checker.scene();
        let bounds = scene.bounds();
        let (robot, base) = match *checker.robot() {
            robot @ AnyRobot::Reach3(_) => (robot, AnyConfiguration::T3(Tn([0.0; 3]))),
            AnyRobot::Hitch(car) => {
                let alone = HitchCfg { body: Pose2::new(0.0, 0.0, 0.0), trailer: None };
                (AnyRobot::Hitch(car.without_trailer()), AnyConfiguration::Hitch(alone))
            }
            _ => return None,
        };
        let side = |i: usize, length: f64, angle: f64| if base.is_angle(i) { angle } else { length };
        let min = [side(0, bounds.min.x, -PI), side(1, bounds.min.y, -PI), -PI];
        let max = [side(0, bounds.max.x, PI), side(1, bounds.max.y, PI), PI];
        Some(Slice { checker: Checker::new(scene.clone(), robot), base, axes: [0, 1, 2], min, max })
    }
}

impl<const N: usize> Slice<N> {
    /// The robot in its scene.
    pub fn checker(&self) -> &Checker<AnyRobot> {
        &self.checker
    }

    /// The numbers of the coordinates that vary.
    pub fn axes(&self) -> [usize; N] {
        self.axes
    }

    /// The least coordinates.
    pub fn min(&self) -> [f64; N] {
        self.min
    }

    /// The greatest coordinates.
    pub fn max(&self) -> [f64; N] {
        self.max
    }

    /// Whether a coordinate of the slice is an angle, whose ends are one.
    pub fn wraps_along(&self, i: usize) -> bool {
        self.base.is_angle(self.axes[i])
    }

    /// The unit of a coordinate of the slice: `m` or `rad`.
    pub fn unit(&self, i: usize) -> &'static str {
        if self.wraps_along(i) { "rad" } else { "m" }
    }

    /// The names of the coordinates: `th1`, `x`.
    pub fn names(&self) -> [String; N] {
        let names = self.base.coordinate_names();
        self.axes.map(|axis| names.get(axis).cloned().unwrap_or_default())
    }

    /// The coordinates that are held, by number and name: none of a whole space, and none of a disc, whose heading
    /// does not matter.
    pub fn held(&self) -> Vec<(usize, String)> {
        let names = self.base.coordinate_names().into_iter().enumerate();
        let matters = |i: &usize| !self.axes.contains(i) && !matches!(self.base, AnyConfiguration::Pose(_));
        names.filter(|(i, _)| matters(i)).map(|(i, name)| (i, name.to_string())).collect()
    }

    /// The configuration at a point of the slice.
    pub fn at(&self, p: [f64; N]) -> AnyConfiguration {
        self.base.with_point(self.axes, p)
    }

    /// The projection of a configuration onto the slice.
    pub fn point(&self, q: &AnyConfiguration) -> [f64; N] {
        let c = q.coordinates();
        self.axes.map(|axis| c.get(axis).copied().unwrap_or(0.0))
    }

    /// Whether `q` lies in this slice: its other coordinates are the held ones. A disc's heading does not matter.
    pub fn holds(&self, q: &AnyConfiguration) -> bool {
        let same = matches!(q, AnyConfiguration::Pose(_)) || self.base.with_point(self.axes, self.point(q)) == *q;
        same && self.checker.robot().check(q).is_ok()
    }

    /// Judges a cell: all points within `half` of `centre` in each coordinate. [`prove`](Self::prove) says how.
    pub fn judge(&self, centre: [f64; N], half: [f64; N]) -> CellState {
        match self.prove(centre, half) {
            CellProof::Free => CellState::Free,
            CellProof::OutsideLimits | CellProof::InContact(_) => CellState::Blocked,
            CellProof::None => CellState::Unknown,
        }
    }

    /// What is proven of a cell: of all points within [`grown`](Self::grown) of `half` of `centre` in each coordinate.
    ///
    /// At the centre every part has a clearance, or a depth: how far it must move to be free. Within the cell no point
    /// of a part moves farther from there than the robot's motion bound to the cell's corner, the greatest bound in the
    /// cell. A clearance of every part above its bound proves the cell free, a depth of one part above its bound proves
    /// it blocked.
    pub fn prove(&self, centre: [f64; N], half: [f64; N]) -> CellProof {
        let (robot, scene) = (self.checker.robot(), self.checker.scene());
        let q = self.at(centre);
        if !robot.is_within_limits(&q) {
            // only a car with a trailer has limits; they are about its headings, which a slice holds
            return CellProof::OutsideLimits;
        }
        // the rates depend on the difference alone; it is taken from 0, so that it is not wrapped
        let Ok(rates) = robot.edge_rates(&self.at([0.0; N]), &self.at(self.grown(half))) else {
            return CellProof::None;
        };
        let footprint = robot.footprint(&q);
        let mut free = true;
        for (number, (part, rate)) in footprint.parts().iter().zip(&rates).enumerate() {
            let (part, bound) = (Footprint::new([part.clone()]), rate.speed * (1.0 + BOUND_ROUNDING));
            let gap = scene.distance(&part) - ROUNDING;
            if gap > bound {
                continue;
            }
            free = false;
            let overlap = if gap <= 0.0 { scene.deepest(&part) } else { None };
            if let Some(Overlap { obstacle, depth, .. }) = overlap.filter(|overlap| overlap.depth - ROUNDING > bound) {
                return CellProof::InContact(Blocking { part: number, obstacle, depth: depth - ROUNDING, bound });
            }
        }
        if free { CellProof::Free } else { CellProof::None }
    }

    /// The half sides of the cell that a proof is about: longer by some roundings of the slice's greatest coordinate.
    /// The places of cells are rounded, and pi is; grown so, neighbours overlap, over the edge of a torus too.
    pub fn grown(&self, half: [f64; N]) -> [f64; N] {
        std::array::from_fn(|i| half[i] + OVERLAP_ULPS * ulp(greater(self.min[i].abs(), self.max[i].abs())))
    }

    /// The middle of the slice, and half its sides.
    pub(super) fn whole(&self) -> ([f64; N], [f64; N]) {
        let half: [f64; N] = std::array::from_fn(|i| 0.5 * (self.max[i] - self.min[i]));
        (std::array::from_fn(|i| self.min[i] + half[i]), half)
    }
}

impl AnyConfiguration {
    /// This configuration with some coordinates replaced.
    fn with_point<const N: usize>(&self, axes: [usize; N], p: [f64; N]) -> AnyConfiguration {
        axes.into_iter().zip(p).fold(*self, |q, (axis, x)| q.with(axis, x))
    }
}
