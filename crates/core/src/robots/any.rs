//! `AnyRobot`, one of the lab's robots, whichever it is.

use std::f64::consts::PI;

use super::{ConfigurationError, Hitch, Leaving, Linkage, PartRates, PointJacobian, Reach, Robot, Rusty};
use crate::configuration::{AnyConfiguration, Configuration, HitchCfg, RobotKind, Tn};
use crate::geometry::{Footprint, Part, Point2, Pose2, Segment, Shape};
use crate::num::{greater, hypot, lesser};
use crate::random::Stream;

/// One of the lab's robots as one type: for views, where the robot is chosen while the program runs.
///
/// ```
/// use motion_lab_core::collision::{Checker, Scene};
/// use motion_lab_core::robots::AnyRobot;
/// let (robot, q) = AnyRobot::of_kind("reach", &[2.0, 0.0]).unwrap();
/// assert!(Checker::new(Scene::workbench(), robot).is_free(&q));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyRobot {
    /// The rover.
    Rusty(Rusty),
    /// The two-link arm.
    Reach(Reach<2>),
    /// The three-link arm.
    Reach3(Reach<3>),
    /// The car, with a trailer or without.
    Hitch(Hitch),
}

impl AnyRobot {
    /// The robot of this kind, as worlds name it, and its configuration with these coordinates, angles wrapped; the car
    /// has its trailer when there are four. `None` for another kind or number, or a coordinate that is not finite.
    pub fn of_kind(kind: &str, coordinates: &[f64]) -> Option<(AnyRobot, AnyConfiguration)> {
        let model = AnyRobot::model(kind, None)?;
        let like = match &model {
            AnyRobot::Rusty(_) => AnyConfiguration::Pose(Pose2::IDENTITY),
            AnyRobot::Reach(_) => AnyConfiguration::T2(Tn([0.0; 2])),
            AnyRobot::Reach3(_) => AnyConfiguration::T3(Tn([0.0; 3])),
            AnyRobot::Hitch(_) => AnyConfiguration::Hitch(HitchCfg { body: Pose2::IDENTITY, trailer: None }),
        };
        let q = like.with_coordinates(coordinates)?;
        let wrapped = coordinates.iter().enumerate().fold(q, |q, (i, c)| q.with(i, *c));
        let robot = model.fitted(&wrapped);
        robot.check(&wrapped).ok()?;
        q.is_finite().then_some((robot, wrapped))
    }

    /// `q` if it is a configuration of this robot.
    pub fn like(&self, q: &AnyConfiguration) -> Option<AnyConfiguration> {
        self.check(q).is_ok().then_some(*q)
    }

    /// A configuration at a point, headings 0. An arm stays at its base: its first link points an eighth of a turn up,
    /// and its other joints are bent.
    pub fn home(&self, at: Point2) -> AnyConfiguration {
        match self {
            AnyRobot::Rusty(_) => AnyConfiguration::Pose(Pose2::new(at.x, at.y, 0.0)),
            AnyRobot::Reach(_) => AnyConfiguration::T2(Tn([0.25 * PI, 0.5 * PI])),
            AnyRobot::Reach3(_) => AnyConfiguration::T3(Tn([0.25 * PI, 0.25 * PI, 0.25 * PI])),
            AnyRobot::Hitch(car) => {
                let body = Pose2::new(at.x, at.y, 0.0);
                AnyConfiguration::Hitch(HitchCfg { body, trailer: car.hitch_len.map(|_| 0.0) })
            }
        }
    }

    /// Its kind.
    pub const fn about(&self) -> &'static RobotKind {
        match self {
            AnyRobot::Rusty(_) => &RobotKind::RUSTY,
            AnyRobot::Reach(_) => &RobotKind::REACH,
            AnyRobot::Reach3(_) => &RobotKind::REACH3,
            AnyRobot::Hitch(_) => &RobotKind::HITCH,
        }
    }

    /// Its kind, as worlds name it.
    pub const fn kind(&self) -> &'static str {
        self.about().name
    }

    /// The robot's name in the book.
    pub const fn title(&self) -> &'static str {
        self.about().title
    }

    /// The name of part number `part` of its footprint: `link 2`, `the trailer`.
    pub fn part_name(&self, part: usize) -> String {
        match self {
            AnyRobot::Rusty(_) => "the disc".into(),
            AnyRobot::Reach(_) | AnyRobot::Reach3(_) => format!("link {}", part + 1),
            AnyRobot::Hitch(_) if part == 0 => "the chassis".into(),
            AnyRobot::Hitch(_) => "the trailer".into(),
        }
    }

    /// The point that stands for the robot and by which it is dragged: the rover's centre, the arm's tip, the car's
    /// rear axle. The origin for a configuration of another robot.
    pub fn reference(&self, q: &AnyConfiguration) -> Point2 {
        match (self, q) {
            (AnyRobot::Rusty(_), AnyConfiguration::Pose(pose)) => pose.position(),
            (AnyRobot::Reach(arm), AnyConfiguration::T2(q)) => arm.tip(q),
            (AnyRobot::Reach3(arm), AnyConfiguration::T3(q)) => arm.tip(q),
            (AnyRobot::Hitch(_), AnyConfiguration::Hitch(q)) => q.body.position(),
            _ => Point2::origin(),
        }
    }

    /// The robot's heading, radians, where its footprint does not show it: the rover's. `None` for the others.
    pub fn heading(&self, q: &AnyConfiguration) -> Option<f64> {
        match (self, q) {
            (AnyRobot::Rusty(_), AnyConfiguration::Pose(pose)) => Some(pose.theta),
            _ => None,
        }
    }

    /// The annulus that an arm's tip can reach: the position of joint 1, and the least and the greatest distance of the
    /// tip from it, metres. `|L1 - L2| <= d <= L1 + L2`, and for more links likewise. `None` for a robot that is not an
    /// arm.
    pub fn annulus(&self) -> Option<(Point2, [f64; 2])> {
        match self {
            AnyRobot::Reach(arm) => Some((arm.base, annulus(&arm.lengths))),
            AnyRobot::Reach3(arm) => Some((arm.base, annulus(&arm.lengths))),
            _ => None,
        }
    }

    /// The configuration after the [reference point](Self::reference) of `q` was dragged to `to`.
    ///
    /// A rover or a car moves there without turning. A two-link arm's tip goes there by inverse kinematics, on the
    /// elbow side asked for; from beyond the annulus it goes to the nearest point of the annulus. A three-link arm
    /// keeps its first joint angle and bends the other two in the same way. A point that is not finite, or a
    /// configuration of another robot, changes nothing.
    #[must_use]
    pub fn dragged(&self, q: &AnyConfiguration, to: Point2, elbow_down: bool) -> AnyConfiguration {
        if !(to.x.is_finite() && to.y.is_finite()) {
            return *q;
        }
        let bend = |th2: f64| if elbow_down { th2.abs() } else { -th2.abs() };
        match (self, q) {
            (AnyRobot::Rusty(_), AnyConfiguration::Pose(_)) | (AnyRobot::Hitch(_), AnyConfiguration::Hitch(_)) => {
                q.with(0, to.x).with(1, to.y)
            }
            (AnyRobot::Reach(arm), AnyConfiguration::T2(now)) => {
                let Some(tip) = clamped(arm, to) else {
                    // on the base itself, where every first angle is a solution: keep the present one
                    return AnyConfiguration::T2(Tn([now.th1(), bend(PI)]).wrapped());
                };
                on_side(arm.ik(tip), elbow_down).map_or(*q, AnyConfiguration::T2)
            }
            (AnyRobot::Reach3(arm), AnyConfiguration::T3(now)) => {
                let elbow = arm.fk(now)[1];
                let rest = Reach { base: elbow, lengths: [arm.lengths[1], arm.lengths[2]], link_radius: 0.0 };
                let tip = clamped(&rest, to);
                tip.and_then(|tip| on_side(arm.with_tip_at(tip, now.0[0]), elbow_down)).map_or(*q, AnyConfiguration::T3)
            }
            _ => *q,
        }
    }
}

/// The least and the greatest distance of the tip from the base.
fn annulus(lengths: &[f64]) -> [f64; 2] {
    let sum: f64 = lengths.iter().sum();
    let longest = lengths.iter().fold(0.0, |m, l| greater(*l, m));
    [greater(2.0 * longest - sum, 0.0), sum]
}

/// The point of the arm's annulus nearest to `to`; `None` where it folds onto its base and no direction is nearest.
fn clamped(arm: &Reach<2>, to: Point2) -> Option<Point2> {
    let out = to - arm.base;
    let d = hypot(out.x, out.y);
    let [inner, outer] = annulus(&arm.lengths);
    let wanted = greater(inner, lesser(d, outer));
    if d == 0.0 || wanted == 0.0 {
        return None;
    }
    Some(if wanted == d { to } else { arm.base + out * (wanted / d) })
}

/// The one of two solutions that is on this elbow side; on the annulus' boundary the only one.
fn on_side<T>([down, up]: [Option<T>; 2], elbow_down: bool) -> Option<T> {
    if elbow_down { down } else { up.or(down) }
}

/// Evaluates `$body` with `$robot` bound to the robot that it is, and each `$q` to that robot's own configuration;
/// `$other` where one is a configuration of another robot.
macro_rules! of_its_own {
    ($any:expr, $robot:ident, ($($q:ident),+) => $body:expr, $other:expr) => {
        match ($any, $($q),+) {
            (AnyRobot::Rusty($robot), $(AnyConfiguration::Pose($q)),+) => $body,
            (AnyRobot::Reach($robot), $(AnyConfiguration::T2($q)),+) => $body,
            (AnyRobot::Reach3($robot), $(AnyConfiguration::T3($q)),+) => $body,
            (AnyRobot::Hitch($robot), $(AnyConfiguration::Hitch($q)),+) => $body,
            _ => $other,
        }
    };
}

/// Every method is that of the robot itself, those that the trait gives too: `tests/motion/any_robot.rs` compares them.
impl Robot for AnyRobot {
    type Configuration = AnyConfiguration;

    fn check(&self, q: &AnyConfiguration) -> Result<(), ConfigurationError> {
        of_its_own!(self, robot, (q) => robot.check(q), Err(ConfigurationError::OtherRobot))
    }

    /// The robot's footprint. A configuration of another robot gives one that is not finite and fails safe.
    fn footprint(&self, q: &AnyConfiguration) -> Footprint {
        let nowhere = || Footprint::new([Part::new(Pose2::IDENTITY, Shape::Disc { radius: f64::NAN })]);
        of_its_own!(self, robot, (q) => robot.footprint(q), nowhere())
    }

    fn edge_rates(&self, a: &AnyConfiguration, b: &AnyConfiguration) -> Result<PartRates, ConfigurationError> {
        of_its_own!(self, robot, (a, b) => robot.edge_rates(a, b), Err(ConfigurationError::OtherRobot))
    }

    fn position(&self, q: &AnyConfiguration) -> Option<Point2> {
        of_its_own!(self, robot, (q) => robot.position(q), None)
    }

    fn disc_line(&self, a: &AnyConfiguration, b: &AnyConfiguration) -> Option<(Segment, f64)> {
        of_its_own!(self, robot, (a, b) => robot.disc_line(a, b), None)
    }

    fn edge_linkage(&self, a: &AnyConfiguration, b: &AnyConfiguration) -> Option<Linkage> {
        of_its_own!(self, robot, (a, b) => robot.edge_linkage(a, b), None)
    }

    fn jacobian(&self, q: &AnyConfiguration, part: usize, point: Point2) -> Option<PointJacobian> {
        of_its_own!(self, robot, (q) => robot.jacobian(q, part, point), None)
    }

    fn is_within_limits(&self, q: &AnyConfiguration) -> bool {
        of_its_own!(self, robot, (q) => robot.is_within_limits(q), true)
    }

    fn edge_leaves(&self, a: &AnyConfiguration, b: &AnyConfiguration) -> Option<Leaving> {
        of_its_own!(self, robot, (a, b) => robot.edge_leaves(a, b), None)
    }

    fn sample(&self, min: Point2, max: Point2, stream: &mut Stream) -> AnyConfiguration {
        match self {
            AnyRobot::Rusty(r) => r.sample(min, max, stream).into(),
            AnyRobot::Reach(r) => r.sample(min, max, stream).into(),
            AnyRobot::Reach3(r) => r.sample(min, max, stream).into(),
            AnyRobot::Hitch(r) => r.sample(min, max, stream).into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Seed;

    #[test]
    fn it_answers_as_the_robot_it_is() {
        let mut s = Stream::new(Seed(3), "any");
        let starts: [(&str, &[f64]); 5] = [
            ("rusty", &[1.0, 2.0, 0.3]),
            ("reach", &[0.1, 0.2]),
            ("reach3", &[0.1, 0.2, 0.3]),
            ("hitch", &[1.0, 2.0, 0.3]),
            ("hitch", &[1.0, 2.0, 0.3, 0.4]),
        ];
        for (kind, start) in starts {
            let (robot, q) = AnyRobot::of_kind(kind, start).unwrap();
            assert_eq!(&q.coordinates()[..], start, "{kind}");
            assert!(robot.check(&q).is_ok() && robot.footprint(&q).is_valid());
            let drawn = robot.sample(Point2::new(-1.0, -1.0), Point2::new(1.0, 1.0), &mut s);
            assert_eq!(drawn.coordinates().len(), start.len(), "{kind}");
            assert_eq!(robot.edge_rates(&q, &drawn).unwrap().len(), robot.footprint(&q).parts().len());
            let stranger = if kind == "reach" { AnyConfiguration::Pose(Pose2::IDENTITY) } else { T2_ZERO };
            assert_eq!(robot.check(&stranger), Err(ConfigurationError::OtherRobot));
            assert!(!robot.footprint(&stranger).is_valid(), "and it fails safe");
        }
        assert_eq!(AnyRobot::of_kind("hitch", &[1.0]), None);
        assert_eq!(AnyRobot::of_kind("reach", &[f64::NAN, 0.0]), None);
        assert_eq!(AnyRobot::of_kind("x-own", &[1.0]), None);
    }

    const T2_ZERO: AnyConfiguration = AnyConfiguration::T2(Tn([0.0; 2]));

    #[test]
    fn a_dragged_tip_follows_keeps_its_elbow_and_stops_at_the_annulus() {
        let arm = AnyRobot::Reach(Reach { base: Point2::new(1.0, 0.0), lengths: [1.0, 0.4], link_radius: 0.0 });
        for elbow_down in [true, false] {
            let to = Point2::new(1.3, 0.9);
            let q = arm.dragged(&T2_ZERO, to, elbow_down);
            assert!((arm.reference(&q) - to).norm() < 1e-12);
            assert_eq!(q.coordinates()[1] > 0.0, elbow_down);
            for (to, expected) in [
                (Point2::new(1.0, 9.0), Point2::new(1.0, 1.4)), // straight
                (Point2::new(1.1, 0.0), Point2::new(1.6, 0.0)), // folded
            ] {
                let q = arm.dragged(&q, to, elbow_down);
                assert!((arm.reference(&q) - expected).norm() < 1e-9, "{to} {}", arm.reference(&q));
            }
        }
        let even = AnyRobot::Reach(Reach::choset());
        let q = even.dragged(&AnyConfiguration::T2(Tn([0.7, 1.0])), Point2::origin(), false);
        assert_eq!(q.coordinates()[0], 0.7, "on its base it keeps its first angle");
        assert!((even.reference(&q) - Point2::origin()).norm() < 1e-12);
        assert_eq!(even.dragged(&q, Point2::new(f64::NAN, 0.0), true), q);
    }

    #[test]
    fn other_robots_are_dragged_without_turning() {
        let (car, q) = AnyRobot::of_kind("hitch", &[1.0, 2.0, 0.3, 0.4]).unwrap();
        assert_eq!(&car.dragged(&q, Point2::new(5.0, 6.0), true).coordinates()[..], [5.0, 6.0, 0.3, 0.4]);
        let (arm, q) = AnyRobot::of_kind("reach3", &[0.3, 0.5, 0.6]).unwrap();
        let to = Point2::new(0.8, 0.9);
        let moved = arm.dragged(&q, to, true);
        assert!((arm.reference(&moved) - to).norm() < 1e-12);
        assert_eq!(moved.coordinates()[0], 0.3);
    }
}
