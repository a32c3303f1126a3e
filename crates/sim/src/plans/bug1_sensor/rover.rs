//! `Rover`, a disc that knows where it is, and the boundary nearest to it by its range sensor alone.

use crate::simulation::advance;
use motion_lab_core::collision::{Collision, DiscChecker};
use motion_lab_core::configuration::R2;
use motion_lab_core::geometry::{Footprint, Point2, Vector2};
use motion_lab_core::num::{greater, hypot, lesser};
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{ChartLine, Motion, Robot, RustyDisc};
use motion_lab_core::sensors::{BeamModel, RangeSensor};

/// Distance that the disc's centre keeps from the boundary it follows, metres. A larger disc than Rusty's keeps Rusty's
/// clearance.
pub(super) const KEEP: f64 = 0.2;

/// The clearance that goes with it, metres.
const CLEARANCE: f64 = 0.09;

/// The noise of a cheap range sensor.
pub(super) const NOISE: BeamModel =
    BeamModel { sigma_hit: 0.03, z_short: 0.02, lambda_short: 1.0, z_miss: 0.02, z_max: 0.01, z_rand: 0.01 };

/// The length of a step, metres.
pub(super) const STEP: f64 = 0.06;

const SENSOR: RangeSensor = RangeSensor { n_rays: 60, max_range: 4.0 };

/// The source of a rover's knowledge of the nearest boundary point.
#[derive(Clone, Debug)]
pub(super) enum Eyes {
    /// The exact nearest point, by which leave points are judged.
    Truth,
    Exact,
    /// A sensor with noise from a stream.
    Noisy(Box<(BeamModel, Stream)>),
}

/// The hand at which the boundary is that a rover follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

/// A rover on its way.
#[derive(Clone, Debug)]
pub(super) struct Rover {
    checker: DiscChecker,
    eyes: Eyes,
    pub(super) goal: Point2,
    pub(super) at: Point2,
    /// The number of steps so far: each has a scan of its own.
    pub(super) tick: u64,
    /// The length of its way, metres.
    pub(super) length: f64,
    /// The number of steps that a wall stopped.
    pub(super) bumps: u32,
    /// The last step as it was meant, if a wall stopped it.
    pub(super) stopped: Option<ChartLine<RustyDisc>>,
    /// The boundary point last followed: a wall seen end-on catches no ray.
    followed: Option<Point2>,
}

impl Rover {
    pub(super) fn new(checker: DiscChecker, eyes: Eyes, [at, goal]: [Point2; 2]) -> Self {
        Rover { checker, eyes, goal, at, tick: 0, length: 0.0, bumps: 0, stopped: None, followed: None }
    }

    /// One at the same place that knows the exact nearest point.
    pub(super) fn seeing_truth(&self) -> Self {
        Rover::new(self.checker.clone(), Eyes::Truth, [self.at, self.goal])
    }

    /// Distance that its centre keeps from the boundary it follows, metres.
    pub(super) fn keep(&self) -> f64 {
        greater(KEEP, self.checker.robot().radius + CLEARANCE)
    }

    /// The distance to its goal, metres.
    pub(super) fn to_goal(&self) -> f64 {
        (self.goal - self.at).norm()
    }

    /// The ranges that its sensor reads where it is; `None` for one without.
    pub(super) fn ranges(&self) -> Option<Vec<f64>> {
        if let Eyes::Truth = self.eyes {
            return None;
        }
        let mut ranges = SENSOR.scan(self.checker.scene(), self.at);
        if let Eyes::Noisy(noise) = &self.eyes {
            let (model, stream) = noise.as_ref();
            model.apply_to(&SENSOR, &mut ranges, stream, self.tick);
        }
        Some(ranges)
    }

    /// The boundary point that seems nearest; `None` when nothing is in range.
    fn nearest(&self) -> Option<Point2> {
        let Some(ranges) = self.ranges() else {
            return self.checker.scene().witness(&Footprint::disc(self.at, 0.0)).map(|w| w.on_obstacle);
        };
        let n = ranges.len();
        // the median of three neighbours, because a lone short return is no wall
        let median = |k: usize| {
            let (a, b, c) = (ranges[(k + n - 1) % n], ranges[k], ranges[(k + 1) % n]);
            greater(lesser(a, b), lesser(greater(a, b), c))
        };
        let seen = (0..n).fold((0, f64::INFINITY), |m, k| if median(k) < m.1 { (k, median(k)) } else { m });
        let (x, y) = SENSOR.direction(seen.0 as u32);
        let point = self.at + Vector2::new(x, y) * seen.1;
        let near = 1.5 * self.keep();
        match self.followed {
            Some(old) if seen.1 > near && (old - self.at).norm() < near => Some(old),
            _ => seen.1.is_finite().then_some(point),
        }
    }

    /// Takes a step in a direction, until a wall stops it.
    pub(super) fn step(&mut self, direction: Vector2, length: f64) {
        let to = R2(self.at + direction * (length / hypot(direction.x, direction.y)));
        self.tick += 1;
        self.stopped = None;
        if let Ok(line) = self.checker.robot().edge(&R2(self.at), &to) {
            let end = advance(self.checker.scene(), &line);
            let to = line.at(end.until).0;
            self.length += (to - self.at).norm();
            if end.blocked {
                self.bumps += 1;
                self.stopped = Some(line);
            }
            self.at = to;
        }
    }

    /// Whether something near seems to lie in the way to the goal.
    pub(super) fn is_blocked(&self) -> bool {
        let (at, goal) = (self.at, self.goal);
        self.nearest().is_some_and(|p| (p - at).norm() <= self.keep() && (p - at).dot(&(goal - at)) > 0.0)
    }

    /// Forgets the boundary that it followed.
    pub(super) fn turn_to_goal(&mut self) {
        self.followed = None;
    }

    /// Takes a step along the boundary. Returns the boundary's point.
    pub(super) fn follow(&mut self, side: Side) -> Point2 {
        let wall = self.nearest().or(self.followed).unwrap_or(self.goal);
        self.followed = Some(wall);
        let away = wall - self.at;
        let distance = greater(hypot(away.x, away.y), 1e-6);
        let toward = away / distance;
        let to_the_left = Vector2::new(-toward.y, toward.x);
        let along = if side == Side::Right { to_the_left } else { -to_the_left };
        let correction = (8.0 * (distance - self.keep())).clamp(-1.0, 1.0);
        self.step(along + toward * correction, STEP);
        wall
    }
}
