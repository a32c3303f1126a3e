//! Hitch, a kinematic car that may pull a trailer.

use super::jackknife::leaves_along_line;
use super::robot::{sample_angle, turning};
use super::{
    ConfigurationError, Drivable, Leaving, Linkage, Motion, PartRates, PointJacobian, Rates, Robot, TurningPart,
};
use crate::configuration::{CarSizes, Configuration, HitchCfg};
use crate::geometry::{Aabb, Footprint, Part, Point2, Pose2, Shape, Vector2};
use crate::num;
use crate::random::Stream;
use crate::short_list::ShortList;

/// A car whose reference point is the middle of its rear axle; the hitch is there too.
///
/// `x' = v cos theta`, `y' = v sin theta`, `theta' = (v / wheelbase) tan phi`, `psi' = (v / d_h) sin(theta - psi)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hitch {
    /// Distance from the rear to the front axle, metres.
    pub wheelbase: f64,
    /// Greatest steering angle to either side, radians.
    pub max_steer: f64,
    /// Greatest speed, metres per second, forward or back; a limit on what drivers command.
    pub max_speed: f64,
    /// The chassis.
    pub body: CarBody,
    /// The trailer's box; matters only with a hitch.
    pub trailer_body: TrailerBody,
    /// Distance d_h from the rear axle, where the hitch is, to the trailer's axle, metres. `None` without a trailer.
    pub hitch_len: Option<f64>,
    /// Greatest angle of the hitch to either side, `|psi - theta|` wrapped, radians, between 0 and pi. A configuration
    /// beyond it is not free, and no motion passes it. `None` without a limit: car and trailer may lie on each other.
    pub jackknife: Option<f64>,
}

/// The chassis rectangle, seen from the rear axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarBody {
    /// Overall length, metres.
    pub length: f64,
    /// Overall width, metres.
    pub width: f64,
    /// How far the chassis reaches behind the rear axle, metres.
    pub rear_overhang: f64,
}

/// The trailer's box, seen from its axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrailerBody {
    /// How far the box reaches ahead of the trailer's axle, metres.
    pub front_overhang: f64,
    /// How far the box reaches behind the trailer's axle, metres.
    pub rear_overhang: f64,
    /// Width of the box, metres.
    pub width: f64,
}

/// The lab's car, without a trailer: a compact. [`Hitch::with_trailer`] fits the hitch.
pub const HITCH: Hitch = Hitch {
    wheelbase: CarSizes::HITCH.wheelbase,
    max_steer: CarSizes::HITCH.max_steer,
    max_speed: 1.5,
    body: CarBody {
        length: CarSizes::HITCH.length,
        width: CarSizes::HITCH.width,
        rear_overhang: CarSizes::HITCH.rear_overhang,
    },
    trailer_body: TrailerBody {
        front_overhang: CarSizes::HITCH.trailer.front_overhang,
        rear_overhang: CarSizes::HITCH.trailer.rear_overhang,
        width: CarSizes::HITCH.trailer.width,
    },
    hitch_len: None,
    jackknife: CarSizes::HITCH.trailer.jackknife,
};

/// The car's control: speed and steering angle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CarCmd {
    /// Speed of the rear axle along the heading, metres per second; negative backs up.
    pub v: f64,
    /// Steering angle phi, radians, positive to the left; clamped to the car's `max_steer`.
    pub phi: f64,
}

impl Default for Hitch {
    fn default() -> Self {
        HITCH
    }
}

impl CarBody {
    /// How far the chassis reaches ahead of the front axle, metres.
    pub fn front_overhang(&self, wheelbase: f64) -> f64 {
        self.length - self.rear_overhang - wheelbase
    }

    /// The rectangle in the rear axle's frame.
    pub(crate) fn rectangle(&self) -> Aabb {
        let half = 0.5 * self.width;
        let min = Point2::new(-self.rear_overhang, -half);
        Aabb { min, max: Point2::new(self.length - self.rear_overhang, half) }
    }
}

impl TrailerBody {
    /// The rectangle in the hitch's frame, x axis along the trailer's heading.
    pub(crate) fn rectangle(&self, hitch_len: f64) -> Aabb {
        let half = 0.5 * self.width;
        let min = Point2::new(-hitch_len - self.rear_overhang, -half);
        Aabb { min, max: Point2::new(-hitch_len + self.front_overhang, half) }
    }
}

/// The distance from a frame's origin to the farthest point of a rectangle in that frame, metres.
pub(super) fn farthest(rectangle: Aabb) -> f64 {
    let Aabb { min, max } = rectangle;
    num::hypot(num::greater(min.x.abs(), max.x.abs()), num::greater(min.y.abs(), max.y.abs()))
}

impl Hitch {
    /// The same car with the trailer attached, by the hitch that it has, or by one of two metres if it has none.
    #[must_use]
    pub fn with_trailer(self) -> Self {
        Hitch { hitch_len: self.hitch_len.or(Some(CarSizes::HITCH.trailer.hitch_len)), ..self }
    }

    /// The same car without a trailer.
    #[must_use]
    pub fn without_trailer(self) -> Self {
        Hitch { hitch_len: None, ..self }
    }

    /// The same car with a hitch that folds by at most `limit` radians to either side, between 0 and pi. With a limit
    /// that is not a number no configuration with a trailer is free.
    #[must_use]
    pub fn with_jackknife(self, limit: f64) -> Self {
        Hitch { jackknife: Some(limit), ..self }
    }

    /// The curvature of the rear axle's path at steering angle `phi`, clamped to `max_steer`: `tan(phi) / wheelbase`,
    /// per metre, positive to the left.
    pub fn curvature(&self, phi: f64) -> f64 {
        num::tan(phi.clamp(-self.max_steer, self.max_steer)) / self.wheelbase
    }

    /// The least radius of the rear axle's path, metres: infinity for a car that cannot steer.
    pub fn tightest(&self) -> f64 {
        1.0 / self.curvature(self.max_steer)
    }

    /// The configuration after `dt` seconds of the constant control `u`: a pure function, and the end of
    /// [`drive`](Drivable::drive). In each tick the body moves on its exact arc, the trailer's heading by a fixed-step
    /// Runge-Kutta integration against the closed form of the body's heading.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `q` has a trailer heading and the car no hitch or the reverse, or a number is not
    /// finite.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// let q = HitchCfg { body: Pose2::IDENTITY, trailer: None };
    /// let next = HITCH.step(&q, &CarCmd { v: 1.0, phi: 0.0 }, 0.05).unwrap();
    /// assert_eq!(next.body, Pose2::new(0.05, 0.0, 0.0)); // no control moves it sideways
    /// ```
    pub fn step(&self, q: &HitchCfg, u: &CarCmd, dt: f64) -> Result<HitchCfg, ConfigurationError> {
        Ok(self.drive(q, u, dt)?.at(1.0))
    }

    /// The frame of the trailer's axle: `d_h` behind the hitch along the trailer's heading. `None` without a trailer.
    pub fn trailer_axle(&self, q: &HitchCfg) -> Option<Pose2> {
        let hitch = Pose2 { theta: num::in_range(q.trailer?), ..q.body };
        let axle = hitch.transform(Point2::new(-self.hitch_len?, 0.0));
        Some(Pose2 { x: axle.x, y: axle.y, theta: hitch.theta })
    }
}

impl Robot for Hitch {
    type Configuration = HitchCfg;

    fn check(&self, q: &HitchCfg) -> Result<(), ConfigurationError> {
        match (q.trailer, self.hitch_len) {
            _ if !q.is_finite() => Err(ConfigurationError::NotFinite),
            (Some(_), None) => Err(ConfigurationError::TrailerWithoutHitch),
            (None, Some(_)) => Err(ConfigurationError::HitchWithoutTrailer),
            _ => Ok(()),
        }
    }

    /// The union of two rectangles. The chassis sits in the rear axle's frame `(x, y, theta)` and reaches from
    /// `-rear_overhang` to `wheelbase + front_overhang`. The trailer's frame is the hitch with the trailer's heading,
    /// `(x, y, psi)`; its box reaches from `-d_h - rear_overhang` to `-d_h + front_overhang`, so its axle's pose is
    /// `(x - d_h cos psi, y - d_h sin psi, psi)`. The steering angle appears nowhere: it is a control.
    ///
    /// A configuration in the wrong space gives a footprint that is not finite and fails safe.
    fn footprint(&self, q: &HitchCfg) -> Footprint {
        let mut body = q.body;
        let trailer = match (q.trailer, self.hitch_len) {
            (Some(psi), Some(hitch_len)) => {
                Some((Pose2 { theta: psi, ..q.body }, self.trailer_body.rectangle(hitch_len)))
            }
            (None, None) => None,
            _ => {
                body.x = f64::NAN;
                None
            }
        };
        let body = (body, self.body.rectangle());
        Footprint::by_number(1 + usize::from(trailer.is_some()), |k| {
            let (pose, Aabb { min, max }) = if k == 0 { body } else { trailer.unwrap_or(body) };
            Part::new(pose, Shape::Rectangle { min, max })
        })
    }

    fn sample(&self, min: Point2, max: Point2, stream: &mut Stream) -> HitchCfg {
        let body =
            Pose2 { x: stream.uniform(min.x, max.x), y: stream.uniform(min.y, max.y), theta: sample_angle(stream) };
        HitchCfg { body, trailer: self.hitch_len.map(|_| sample_angle(stream)) }
    }

    fn position(&self, q: &HitchCfg) -> Option<Point2> {
        Some(q.body.position())
    }

    /// Either part turns about the rear axle's middle, where the hitch is.
    fn jacobian(&self, q: &HitchCfg, part: usize, point: Point2) -> Option<PointJacobian> {
        let (turn, still) = (turning(point, q.body.position()), Vector2::zeros());
        let moves = [Vector2::x(), Vector2::y()];
        let turns: &[Vector2] = match (part, q.trailer) {
            (0, None) => &[turn],
            (0, Some(_)) => &[turn, still],
            (1, Some(_)) => &[still, turn],
            _ => return None,
        };
        Some(moves.into_iter().chain(turns.iter().copied()).collect())
    }

    /// Chassis: the translation plus the farthest chassis point from the rear axle times the turn. Trailer: the
    /// translation plus the farthest trailer point from the hitch times `|dpsi|`.
    fn edge_rates(&self, a: &HitchCfg, b: &HitchCfg) -> Result<PartRates, ConfigurationError> {
        let d = a.difference(b)?;
        let translation = num::hypot(d[0], d[1]);
        let rates = |turn: f64, reach: f64| Rates {
            speed: translation + reach * turn.abs(),
            acceleration: reach * turn * turn,
        };
        let mut parts: PartRates = PartRates::from([rates(d[2], farthest(self.body.rectangle()))]);
        if let (Some(dpsi), Some(hitch_len)) = (d.get(3), self.hitch_len) {
            parts.push(rates(*dpsi, farthest(self.trailer_body.rectangle(hitch_len))));
        }
        Ok(parts)
    }

    /// Chassis and trailer turn about the rear axle's middle.
    fn edge_linkage(&self, a: &HitchCfg, b: &HitchCfg) -> Option<Linkage> {
        let d = a.difference(b).ok()?;
        let part = |heading: f64, turn: f64, core: Aabb| TurningPart {
            hinge: 0.0,
            heading: num::in_range(heading),
            turn,
            core,
            radius: 0.0,
        };
        let mut parts = ShortList::from([part(a.body.theta, d[2], self.body.rectangle())]);
        if let (Some(psi), Some(hitch_len)) = (a.trailer, self.hitch_len) {
            parts.push(part(psi, *d.get(3)?, self.trailer_body.rectangle(hitch_len)));
        }
        Some(Linkage { origin: a.body.position(), travel: Vector2::new(d[0], d[1]), parts })
    }

    /// Whether the hitch folds by no more than the car's `jackknife`. True without a limit or without a trailer.
    fn is_within_limits(&self, q: &HitchCfg) -> bool {
        match (self.jackknife, q.hitch_angle()) {
            (Some(limit), Some(angle)) => angle.abs() <= limit,
            _ => true,
        }
    }

    fn edge_leaves(&self, a: &HitchCfg, b: &HitchCfg) -> Option<Leaving> {
        leaves_along_line(self.jackknife?, a, b)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::num::wrap;
    use crate::random::{Seed, Stream};

    #[test]
    fn a_trailer_heading_needs_a_hitch_and_the_reverse() {
        let body = Pose2::IDENTITY;
        let (with, without) = (HitchCfg { body, trailer: Some(0.0) }, HitchCfg { body, trailer: None });
        let u = CarCmd { v: 1.0, phi: 0.1 };
        assert_eq!(HITCH.step(&with, &u, 0.05), Err(ConfigurationError::TrailerWithoutHitch));
        let towing = HITCH.with_trailer();
        assert_eq!(towing.step(&without, &u, 0.05), Err(ConfigurationError::HitchWithoutTrailer));
        assert!(towing.step(&with, &u, 0.05).is_ok() && HITCH.step(&without, &u, 0.05).is_ok());
        assert!(!HITCH.footprint(&with).is_valid(), "a footprint in the wrong space fails safe");
        assert!(HITCH.step(&without, &CarCmd { v: f64::NAN, phi: 0.0 }, 0.05).is_err());
        assert!(towing.edge(&with, &without).is_err());
    }

    #[test]
    fn no_control_moves_it_sideways() {
        let mut s = Stream::new(Seed(7), "sideways");
        for _ in 0..500 {
            let q = HitchCfg { body: Pose2::new(1.0, 2.0, s.uniform(-PI, PI)), trailer: None };
            let u = CarCmd { v: s.uniform(-2.0, 2.0), phi: s.uniform(-2.0, 2.0) };
            let dt = 1e-4;
            let moved = HITCH.step(&q, &u, dt).unwrap().body.position() - q.body.position();
            let sideways = Pose2 { x: 0.0, y: 0.0, theta: -q.body.theta }.rotate(moved).y;
            // the lateral part of an arc is of second order in its length
            assert!(sideways.abs() <= 0.51 * (u.v * dt) * (u.v * dt) * HITCH.curvature(HITCH.max_steer) + 1e-15);
        }
    }

    #[test]
    fn the_trailer_follows_the_differential_equation() {
        // against an oracle with 10,000 midpoint steps on all four equations
        let towing = HITCH.with_trailer();
        let q = HitchCfg { body: Pose2::new(0.0, 0.0, 0.4), trailer: Some(1.3) };
        let u = CarCmd { v: -1.2, phi: 0.5 };
        let end = towing.step(&q, &u, 0.05).unwrap();
        let (mut x, mut y, mut th, mut psi) = (0.0, 0.0, 0.4, 1.3);
        let n = 10_000;
        let h = 0.05 / f64::from(n);
        let rate = u.v * towing.curvature(u.phi);
        for _ in 0..n {
            let (thm, psim) = (th + 0.5 * h * rate, psi + 0.5 * h * u.v / 2.0 * num::sin(th - psi));
            x += h * u.v * num::cos(thm);
            y += h * u.v * num::sin(thm);
            psi += h * u.v / 2.0 * num::sin(thm - psim);
            th += h * rate;
        }
        assert!((end.body.x - x).abs() < 1e-10 && (end.body.y - y).abs() < 1e-10);
        assert!((end.body.theta - th).abs() < 1e-12 && (end.trailer.unwrap() - psi).abs() < 1e-9);
    }

    #[test]
    fn the_two_rectangles_have_the_poses_of_exercise_2() {
        let towing = HITCH.with_trailer();
        let q = HitchCfg { body: Pose2::new(3.0, 4.0, 0.7), trailer: Some(-0.4) };
        let footprint = towing.footprint(&q);
        let [chassis, trailer] = footprint.parts() else { panic!("two parts") };
        let axle = towing.trailer_axle(&q).unwrap();
        assert!((axle.x - (3.0 - 2.0 * num::cos(-0.4))).abs() < 1e-15);
        assert!((axle.y - (4.0 - 2.0 * num::sin(-0.4))).abs() < 1e-15);
        // the front right corner of the chassis, and the rear right corner of the trailer, by hand
        let front = q.body.transform(Point2::new(2.5 + towing.body.front_overhang(2.5), -0.85));
        assert!((chassis.placed().core()[1] - front).norm() < 1e-14);
        let rear = axle.transform(Point2::new(-0.8, -0.75));
        assert!((trailer.placed().core()[0] - rear).norm() < 1e-14);
    }

    #[test]
    fn rates_bound_sampled_motion_with_and_without_a_trailer() {
        let mut s = Stream::new(Seed(8), "rates");
        for i in 0..300 {
            let towing = i % 2 == 0;
            let car = if towing { HITCH.with_trailer() } else { HITCH };
            let trailer = towing.then(|| s.uniform(-PI, PI));
            let q = HitchCfg { body: Pose2::new(0.0, 0.0, s.uniform(-PI, PI)), trailer };
            let u = CarCmd { v: s.uniform(-1.5, 1.5), phi: s.uniform(-0.6, 0.6) };
            let arc = car.drive(&q, &u, [0.05, 0.5][i % 3 % 2]).unwrap();
            let to = HitchCfg { body: Pose2::new(1.0, -0.5, 2.0), trailer: trailer.map(|p| wrap(p + 1.0)) };
            let line = car.edge(&q, &to).unwrap();
            check_rates(&arc);
            check_rates(&line);
        }
    }

    fn check_rates(motion: &impl Motion) {
        let parts = motion.footprint_at(0.0).parts().len();
        for i in 0..10 {
            let (s0, s1) = (f64::from(i) / 10.0, f64::from(i + 1) / 10.0);
            let (f0, f1, fm) = (motion.footprint_at(s0), motion.footprint_at(s1), motion.footprint_at(0.5 * (s0 + s1)));
            for k in 0..parts {
                let core = |f: &Footprint, v: usize| f.parts()[k].placed().core()[v];
                for v in 0..4 {
                    let (p0, p1, pm) = (core(&f0, v), core(&f1, v), core(&fm, v));
                    assert!((p1 - p0).norm() <= motion.bound(k, s0, s1) + 1e-12);
                    let stray = (pm - (p0 + (p1 - p0) * 0.5)).norm();
                    assert!(stray <= motion.sagitta(k, s0, s1) + 1e-12, "{stray}");
                }
            }
        }
    }
}
