//! Rusty, a disc-shaped rover with two driven wheels.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::robot::sample_angle;
use super::{ConfigurationError, Drivable, Motion, PartRates, PointJacobian, Rates, Robot};
use crate::configuration::{Configuration, DiscSizes, R2};
use crate::geometry::{CircularArc, Footprint, Point2, Pose2, Segment, Shape, ShapeError, Tangent2, Vector2};
use crate::num;
use crate::random::Stream;

/// Rusty as the simulator drives it: a disc with a heading, in SE(2), commanded by forward speed and turn rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rusty {
    /// Radius of the disc, metres.
    pub body_radius: f64,
    /// Distance between the two wheels, metres.
    pub track: f64,
    /// Radius of a wheel, metres.
    pub wheel_radius: f64,
    /// Encoder counts per turn of a wheel.
    pub counts_per_turn: f64,
    /// Greatest slip of a wheel: the ground it covers in a tick is its rolled length times a factor drawn from
    /// `[1 - max_slip, 1 + max_slip]`.
    pub max_slip: f64,
    /// Greatest forward speed, metres per second.
    pub max_speed: f64,
    /// Greatest turn rate, radians per second.
    pub max_turn_rate: f64,
}

/// The lab's Rusty.
pub const RUSTY: Rusty = Rusty {
    body_radius: DiscSizes::RUSTY.radius,
    track: DiscSizes::RUSTY.track,
    wheel_radius: DiscSizes::RUSTY.wheel_radius,
    counts_per_turn: 360.0,
    max_slip: 0.05,
    max_speed: 0.6,
    max_turn_rate: 2.5,
};

/// Rusty's control: forward speed and turn rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RustyCmd {
    /// Forward speed, metres per second.
    pub v: f64,
    /// Turn rate, radians per second, counter-clockwise positive.
    pub omega: f64,
}

/// How far the two wheels turn in a step, radians. This is what the encoders see, whether or not the body moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelTurns {
    /// The left wheel.
    pub left: f64,
    /// The right wheel.
    pub right: f64,
}

/// The factors between a wheel's rolled length and the ground it covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSlip {
    /// The left wheel.
    pub left: f64,
    /// The right wheel.
    pub right: f64,
}

impl WheelSlip {
    /// No slip at all.
    pub const NONE: WheelSlip = WheelSlip { left: 1.0, right: 1.0 };
}

/// Whole encoder counts of the two wheels since the start, forward positive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EncoderCounts {
    /// The left wheel.
    pub left: i64,
    /// The right wheel.
    pub right: i64,
}

impl Default for Rusty {
    fn default() -> Self {
        RUSTY
    }
}

impl Rusty {
    /// The command limited to the rover's greatest speed and turn rate.
    pub fn limited(&self, u: &RustyCmd) -> RustyCmd {
        RustyCmd {
            v: u.v.clamp(-self.max_speed, self.max_speed),
            omega: u.omega.clamp(-self.max_turn_rate, self.max_turn_rate),
        }
    }

    /// How far the wheels turn under the limited command `u` in `dt` seconds.
    ///
    /// Differential drive: the wheels' speeds over ground are `v -+ omega track / 2`.
    pub fn wheel_turns(&self, u: &RustyCmd, dt: f64) -> WheelTurns {
        let u = self.limited(u);
        let half = 0.5 * self.track * u.omega;
        WheelTurns { left: (u.v - half) * dt / self.wheel_radius, right: (u.v + half) * dt / self.wheel_radius }
    }

    /// The body's speed and turn rate when the wheels turn by `turns` in `dt` seconds and slip by `slip`.
    pub fn command_of(&self, turns: &WheelTurns, slip: &WheelSlip, dt: f64) -> RustyCmd {
        let left = turns.left * self.wheel_radius * slip.left;
        let right = turns.right * self.wheel_radius * slip.right;
        RustyCmd { v: 0.5 * (left + right) / dt, omega: (right - left) / self.track / dt }
    }

    /// Whole counts for accumulated wheel turns, rounded toward minus infinity.
    pub fn counts(&self, turned: &WheelTurns) -> EncoderCounts {
        let count = |angle: f64| (angle / TAU * self.counts_per_turn).floor() as i64;
        EncoderCounts { left: count(turned.left), right: count(turned.right) }
    }

    /// The distance travelled according to the encoders, metres: the mean of what both wheels have rolled. It leaves
    /// out slip and walls.
    pub fn travelled(&self, counts: &EncoderCounts) -> f64 {
        0.5 * (counts.left + counts.right) as f64 / self.counts_per_turn * TAU * self.wheel_radius
    }
}

impl Robot for Rusty {
    type Configuration = Pose2;

    fn check(&self, q: &Pose2) -> Result<(), ConfigurationError> {
        if q.is_finite() { Ok(()) } else { Err(ConfigurationError::NotFinite) }
    }

    fn footprint(&self, q: &Pose2) -> Footprint {
        Footprint::disc(q.position(), self.body_radius)
    }

    fn sample(&self, min: Point2, max: Point2, stream: &mut Stream) -> Pose2 {
        Pose2 { x: stream.uniform(min.x, max.x), y: stream.uniform(min.y, max.y), theta: sample_angle(stream) }
    }

    fn position(&self, q: &Pose2) -> Option<Point2> {
        Some(q.position())
    }

    /// A disc moves, as a set, exactly as its centre does: the length of the edge, in a straight line.
    fn edge_rates(&self, a: &Pose2, b: &Pose2) -> Result<PartRates, ConfigurationError> {
        Ok(PartRates::from([Rates { speed: num::hypot(b.x - a.x, b.y - a.y), acceleration: 0.0 }]))
    }

    /// The point moves as the centre does: the contact point of a turning disc slides along it.
    fn jacobian(&self, _q: &Pose2, part: usize, _point: Point2) -> Option<PointJacobian> {
        (part == 0).then(|| PointJacobian::from([Vector2::x(), Vector2::y(), Vector2::zeros()]))
    }

    fn disc_line(&self, a: &Pose2, b: &Pose2) -> Option<(Segment, f64)> {
        Some((Segment::new(a.position(), b.position()), self.body_radius))
    }
}

/// Rusty's motion over one step: an exact circular arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RustyArc {
    robot: Rusty,
    start: Pose2,
    ahead: f64,
    turn: f64,
    /// Where it ends: whoever judges the arc and whoever drives it ask for that.
    end: Pose2,
}

impl Motion for RustyArc {
    type Configuration = Pose2;

    fn at(&self, s: f64) -> Pose2 {
        if s == 0.0 {
            return self.start;
        }
        if s == 1.0 {
            return self.end;
        }
        self.start.boxplus(&Tangent2::new(s * self.ahead, 0.0, s * self.turn))
    }

    fn footprint_at(&self, s: f64) -> Footprint {
        self.robot.footprint(&self.at(s))
    }

    fn rates(&self, _part: usize) -> Rates {
        // uniform motion on a circle: speed |ds|, centripetal acceleration |ds dtheta|
        Rates { speed: self.ahead.abs(), acceleration: (self.ahead * self.turn).abs() }
    }

    fn disc_arc(&self) -> Option<(CircularArc, f64)> {
        let to_centre = self.ahead / self.turn; // to the left when positive
        if !(to_centre.is_finite() && to_centre != 0.0) {
            return None;
        }
        let centre = self.start.transform(Point2::new(0.0, to_centre));
        let side = if to_centre > 0.0 { -FRAC_PI_2 } else { FRAC_PI_2 };
        let start = num::wrap(self.start.theta + side);
        Some((CircularArc { centre, radius: to_centre.abs(), start, turn: self.turn }, self.robot.body_radius))
    }
}

impl Drivable for Rusty {
    type Control = RustyCmd;
    type Drive = RustyArc;

    /// The arc driven at exactly this speed and turn rate: limits and slip are applied by [`Rusty::wheel_turns`] and
    /// [`Rusty::command_of`] before.
    fn drive(&self, q: &Pose2, u: &RustyCmd, dt: f64) -> Result<RustyArc, ConfigurationError> {
        self.check(q)?;
        let (ahead, turn) = (u.v * dt, u.omega * dt);
        if !(ahead.is_finite() && turn.is_finite()) {
            return Err(ConfigurationError::ControlNotFinite);
        }
        let start = q.in_chart();
        Ok(RustyArc { robot: *self, start, ahead, turn, end: start.boxplus(&Tangent2::new(ahead, 0.0, turn)) })
    }
}

/// Rusty as a planner sees it: a disc whose configuration is its centre, a point of R^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RustyDisc {
    /// Radius of the disc, metres.
    pub radius: f64,
}

impl Default for RustyDisc {
    fn default() -> Self {
        RustyDisc { radius: RUSTY.body_radius }
    }
}

impl RustyDisc {
    /// A disc of this radius.
    ///
    /// # Errors
    /// [`ShapeError::Radius`] when the radius is out of range.
    pub fn try_new(radius: f64) -> Result<Self, ShapeError> {
        Shape::try_disc(radius)?;
        Ok(RustyDisc { radius })
    }
}

impl Robot for RustyDisc {
    type Configuration = R2;

    fn check(&self, q: &R2) -> Result<(), ConfigurationError> {
        if q.is_finite() { Ok(()) } else { Err(ConfigurationError::NotFinite) }
    }

    fn footprint(&self, q: &R2) -> Footprint {
        Footprint::disc(Point2::new(q.0.x, q.0.y), self.radius)
    }

    fn sample(&self, min: Point2, max: Point2, stream: &mut Stream) -> R2 {
        R2::new(stream.uniform(min.x, max.x), stream.uniform(min.y, max.y))
    }

    fn position(&self, q: &R2) -> Option<Point2> {
        Some(q.0)
    }

    fn edge_rates(&self, a: &R2, b: &R2) -> Result<PartRates, ConfigurationError> {
        Ok(PartRates::from([Rates { speed: num::hypot(b.0.x - a.0.x, b.0.y - a.0.y), acceleration: 0.0 }]))
    }

    fn jacobian(&self, _q: &R2, part: usize, _point: Point2) -> Option<PointJacobian> {
        (part == 0).then(|| PointJacobian::from([Vector2::x(), Vector2::y()]))
    }

    fn disc_line(&self, a: &R2, b: &R2) -> Option<(Segment, f64)> {
        Some((Segment::new(a.0, b.0), self.radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheels_and_body_agree() {
        let u = RustyCmd { v: 0.4, omega: -1.2 };
        let dt = 0.05;
        let back = RUSTY.command_of(&RUSTY.wheel_turns(&u, dt), &WheelSlip::NONE, dt);
        assert!((back.v - u.v).abs() < 1e-15 && (back.omega - u.omega).abs() < 1e-14);
        let fast = RUSTY.wheel_turns(&RustyCmd { v: 9.0, omega: 0.0 }, dt);
        assert_eq!(fast, RUSTY.wheel_turns(&RustyCmd { v: RUSTY.max_speed, omega: 0.0 }, dt));
    }

    #[test]
    fn encoders_count_rotation_not_motion() {
        // one full turn of each wheel is counts_per_turn counts, minus sign going backwards
        let counts = RUSTY.counts(&WheelTurns { left: TAU, right: -TAU });
        assert_eq!(counts, EncoderCounts { left: 360, right: -360 });
    }

    #[test]
    fn the_arc_is_a_circle_about_the_turning_centre() {
        let q = Pose2::new(1.0, 2.0, 0.3);
        let arc = RUSTY.drive(&q, &RustyCmd { v: 0.5, omega: 2.0 }, 1.0).unwrap();
        let centre = q.transform(Point2::new(0.0, 0.25));
        for i in 0..=10 {
            let p = arc.at(f64::from(i) / 10.0).position();
            assert!(((p - centre).norm() - 0.25).abs() < 1e-15);
        }
        assert_eq!(arc.at(0.0), q);
        assert!(RUSTY.drive(&q, &RustyCmd { v: f64::NAN, omega: 0.0 }, 1.0).is_err());
    }
}
