//! Reach, a planar revolute arm pinned at its base.

use std::f64::consts::PI;

use super::robot::{sample_angle, turning};
use super::{ConfigurationError, Drivable, Linkage, PartRates, PointJacobian, Rates, Robot, TurningPart};
use crate::configuration::{Configuration, T2, Tn};
use crate::geometry::{Aabb, Footprint, Part, Point2, Pose2, Shape, ShapeError, SinCos, Vector2};
use crate::num::{self, greater, in_range, wrap};
use crate::random::Stream;
use crate::short_list::ShortList;

/// The joint positions of an arm: base, joints, tip.
pub type JointPoints = ShortList<Point2, 4>;

/// A planar arm of N revolute joints pinned at `base`. Joint angles are relative to the link before; there are no joint
/// limits, and links pass over one another, so an arm never collides with itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach<const N: usize> {
    /// The position of joint 1, metres.
    pub base: Point2,
    /// The lengths of the links, metres.
    pub lengths: [f64; N],
    /// The radius of each link's capsule, metres. 0 gives exact segments.
    pub link_radius: f64,
}

/// Why an arm's numbers are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("link {link}: {source}")]
pub struct ReachError {
    /// The number of the link, from 1.
    pub link: usize,
    /// What is wrong with it.
    pub source: ShapeError,
}

impl Reach<2> {
    /// The arm of Choset's Example 3.8.1: two links of 1 m at the origin, without thickness.
    pub const fn choset() -> Self {
        Reach { base: Point2::new(0.0, 0.0), lengths: [1.0, 1.0], link_radius: 0.0 }
    }

    /// The same arm with capsule links of 3 cm radius: the one on the Workbench.
    pub const fn workbench() -> Self {
        Reach { base: Point2::new(0.0, 0.0), lengths: [1.0, 1.0], link_radius: 0.03 }
    }

    /// Inverse kinematics: the configurations whose tip is at `tip`, elbow-down (`th2 >= 0`) first.
    ///
    /// - Strictly inside the annulus `|L1 - L2| < |tip - base| < L1 + L2`: both `Some`, and distinct.
    /// - On its boundary, to within 16 ulps of the largest of 1, the coordinates involved and `L1 + L2`:
    ///   `[Some, None]`. The two solutions coincide there; exactly one `None` says that the arm is straight or folded.
    /// - Outside: `[None, None]`. A tip that [`fk`](Self::fk) produced is never outside.
    /// - At the base itself, which only an arm with `L1 = L2` reaches, every `th1` folds the arm onto the base. Of
    ///   these infinitely many solutions the one with `th1 = 0`, `th2 = pi` is returned.
    /// - A tip that is not finite gives `[None, None]`.
    ///
    /// With `d = |tip - base|` the law of cosines in half-angle form is
    /// `tan^2(th2 / 2) = ((L1 + L2)^2 - d^2) / (d^2 - (L1 - L2)^2)`, which keeps its digits near both boundaries.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// let arm = Reach::<2>::choset();
    /// let [down, up] = arm.ik(Point2::new(0.0, 2.0_f64.sqrt()));
    /// assert!((down.unwrap().th2() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    /// assert!(up.unwrap().th2() < 0.0);
    /// assert_eq!(arm.ik(Point2::new(2.0, 0.0)), [Some(T2::new(0.0, 0.0)), None]); // straight: one solution
    /// assert_eq!(arm.ik(Point2::new(2.1, 0.0)), [None, None]);
    /// ```
    pub fn ik(&self, tip: Point2) -> [Option<T2>; 2] {
        let [l1, l2] = self.lengths;
        let to_tip = tip - self.base;
        let d = num::hypot(to_tip.x, to_tip.y);
        let (outer, inner) = (l1 + l2, (l1 - l2).abs());
        let scale = [tip.x, tip.y, self.base.x, self.base.y, outer].iter().fold(1.0, |m, x| greater(m, x.abs()));
        let tolerance = 16.0 * num::ulp(scale);
        if !d.is_finite() || d > outer + tolerance || d < inner - tolerance {
            return [None, None];
        }
        let bearing = num::atan2(to_tip.y, to_tip.x);
        if d >= outer - tolerance {
            return [Some(Tn([wrap(bearing), 0.0])), None];
        }
        if d <= inner + tolerance {
            let th1 = if inner == 0.0 && d == 0.0 {
                0.0
            } else if l1 >= l2 {
                bearing
            } else {
                bearing + PI
            };
            return [Some(Tn([wrap(th1), PI])), None];
        }
        let bend = 2.0 * num::atan2(num::sqrt((outer - d) * (outer + d)), num::sqrt((d - inner) * (d + inner)));
        let solve = |th2: f64| {
            let (s, c) = num::sin_cos(th2);
            Tn([wrap(bearing - num::atan2(l2 * s, l1 + l2 * c)), wrap(th2)])
        };
        [Some(solve(bend)), Some(solve(-bend))]
    }
}

impl Reach<3> {
    /// The redundant variant: links of 0.6, 0.5 and 0.4 m with 3 cm capsules at the origin.
    pub const fn redundant() -> Self {
        Reach { base: Point2::new(0.0, 0.0), lengths: [0.6, 0.5, 0.4], link_radius: 0.03 }
    }

    /// The configurations with this first joint angle and this tip: links 2 and 3 re-solved by the two-link inverse
    /// kinematics about the end of link 1, elbow-down first. Walking `th1` moves the arm while the tip stays.
    pub fn with_tip_at(&self, tip: Point2, th1: f64) -> [Option<Tn<3>>; 2] {
        let [l1, l2, l3] = self.lengths;
        let (s, c) = num::sin_cos(th1);
        let elbow = Point2::new(self.base.x + l1 * c, self.base.y + l1 * s);
        let rest = Reach { base: elbow, lengths: [l2, l3], link_radius: self.link_radius };
        rest.ik(tip).map(|q| q.map(|q| Tn([th1, q.th1() - th1, q.th2()]).wrapped()))
    }
}

/// A link at a configuration.
#[derive(Clone, Copy)]
struct PlacedLink {
    /// Its frame: the origin at its proximal end, the x axis along it.
    pose: Pose2,
    /// The sine and the cosine of the frame's angle.
    sin_cos: SinCos,
    length: f64,
}

impl PlacedLink {
    fn end(&self) -> Point2 {
        self.pose.transform_by(self.sin_cos, Point2::new(self.length, 0.0))
    }
}

impl<const N: usize> Reach<N> {
    /// The arm with these links; a `link_radius` of exactly 0 gives segments.
    ///
    /// # Errors
    /// [`ReachError`] names the link whose length or radius, or the base coordinate, is not finite or out of range.
    pub fn try_new(base: Point2, lengths: [f64; N], link_radius: f64) -> Result<Self, ReachError> {
        for (i, &length) in lengths.iter().enumerate() {
            let end = Point2::new(base.x + length, base.y);
            Shape::try_capsule(base, end, link_radius).map_err(|source| ReachError { link: i + 1, source })?;
        }
        Ok(Reach { base, lengths, link_radius })
    }

    /// Forward kinematics: the N + 1 points base, joints, tip, in metres.
    ///
    /// Link k leaves joint k at the absolute heading `th1 + .. + thk`; one running heading and one running position
    /// give the product of the N rigid motions "turn by the joint angle, then go the link's length ahead".
    pub fn fk(&self, q: &Tn<N>) -> JointPoints {
        let links = self.links(q);
        let tip = links.last().map_or(self.base, PlacedLink::end);
        links.iter().map(|link| link.pose.position()).chain([tip]).collect()
    }

    /// The position of the tip, metres.
    pub fn tip(&self, q: &Tn<N>) -> Point2 {
        self.links(q).last().map_or(self.base, |link| link.end())
    }

    /// The Jacobian of the tip: its velocity per unit of each joint's rate, metres per radian.
    ///
    /// Joint k turns all beyond it, so the column is the vector from joint k to the tip, turned a quarter of a turn.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// let columns = Reach::<2>::choset().tip_jacobian(&T2::new(0.0, 0.0)); // stretched out along x
    /// assert_eq!(columns, [Vector2::new(0.0, 2.0), Vector2::new(0.0, 1.0)]);
    /// ```
    pub fn tip_jacobian(&self, q: &Tn<N>) -> [Vector2; N] {
        let (joints, tip) = (self.fk(q), self.tip(q));
        std::array::from_fn(|joint| turning(tip, joints[joint]))
    }

    /// The absolute heading of the last link, radians: with [`tip`](Self::tip) the position-and-orientation map.
    pub fn heading(&self, q: &Tn<N>) -> f64 {
        self.links(q).last().map_or(0.0, |link| link.pose.theta)
    }

    /// The links at a configuration, from the base on.
    fn links(&self, q: &Tn<N>) -> [PlacedLink; N] {
        let (mut at, mut heading) = (self.base, 0.0);
        std::array::from_fn(|k| {
            heading = wrap(heading + in_range(q.0[k]));
            let pose = Pose2 { x: at.x, y: at.y, theta: heading };
            let link = PlacedLink { pose, sin_cos: SinCos::of(heading), length: self.lengths[k] };
            at = link.end();
            link
        })
    }
}

impl<const N: usize> Robot for Reach<N> {
    type Configuration = Tn<N>;

    fn check(&self, q: &Tn<N>) -> Result<(), ConfigurationError> {
        if q.is_finite() { Ok(()) } else { Err(ConfigurationError::NotFinite) }
    }

    /// One capsule per link, part 0 the one at the base.
    fn footprint(&self, q: &Tn<N>) -> Footprint {
        let links = self.links(q);
        Footprint::by_number(N, |k| {
            let PlacedLink { pose, sin_cos, length } = links[k];
            let shape = Shape::Capsule { a: Point2::origin(), b: Point2::new(length, 0.0), radius: self.link_radius };
            Part::new_by(pose, sin_cos, shape)
        })
    }

    /// The joints up to a link's own turn its points; those beyond do not move them.
    fn jacobian(&self, q: &Tn<N>, part: usize, point: Point2) -> Option<PointJacobian> {
        let joints = self.fk(q);
        let column = |joint| if joint <= part { turning(point, joints[joint]) } else { Vector2::zeros() };
        (part < N).then(|| (0..N).map(column).collect())
    }

    fn sample(&self, _min: Point2, _max: Point2, stream: &mut Stream) -> Tn<N> {
        Tn([0.0; N].map(|_: f64| sample_angle(stream)))
    }

    /// A point of link k is a sum of pieces of links 1 to k, each turning at its own constant absolute rate
    /// `w_j = dth1 + .. + dthj`. So its speed is at most the sum of `L_j |w_j|`, which is never more than the sum over
    /// joints of (lengths from that joint on) times `|dth|`, and its acceleration at most the sum of `L_j w_j^2`.
    fn edge_rates(&self, a: &Tn<N>, b: &Tn<N>) -> Result<PartRates, ConfigurationError> {
        let d = a.difference(b)?;
        let (mut turn, mut rates) = (0.0, Rates::default());
        let parts: [Rates; N] = std::array::from_fn(|k| {
            turn += d[k];
            rates.speed += self.lengths[k] * turn.abs();
            rates.acceleration += self.lengths[k] * turn * turn;
            rates
        });
        Ok(PartRates::from_slice(&parts))
    }

    /// Each link turns about the end of the one before, at the sum of the rates of the joints up to it.
    fn edge_linkage(&self, a: &Tn<N>, b: &Tn<N>) -> Option<Linkage> {
        let d = a.difference(b).ok()?;
        let (mut heading, mut turn, mut hinge) = (0.0, 0.0, 0.0);
        let parts: [TurningPart; N] = std::array::from_fn(|k| {
            heading = wrap(heading + in_range(a.0[k]));
            turn += d[k];
            let core = Aabb { min: Point2::origin(), max: Point2::new(self.lengths[k], 0.0) };
            let part = TurningPart { hinge, heading, turn, core, radius: self.link_radius };
            hinge = self.lengths[k];
            part
        });
        Some(Linkage { origin: self.base, travel: Vector2::zeros(), parts: ShortList::from_slice(&parts) })
    }
}

impl<const N: usize> Drivable for Reach<N> {
    type Control = Option<Tn<N>>;
    type Drive = super::ChartLine<Self>;

    /// The chart line to the configuration commanded for the end of the step; `None` stays. The arm has no dynamics:
    /// its joints are where the command puts them.
    fn drive(&self, q: &Tn<N>, u: &Option<Tn<N>>, _dt: f64) -> Result<Self::Drive, ConfigurationError> {
        self.edge(q, &u.unwrap_or(*q))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Seed, Stream};
    use crate::robots::Motion;

    #[test]
    fn fk_is_the_product_of_the_rigid_motions() {
        let arm = Reach { base: Point2::new(0.3, -0.4), lengths: [0.6, 0.5, 0.4], link_radius: 0.0 };
        let mut s = Stream::new(Seed(4), "fk");
        for _ in 0..500 {
            let q = Tn([s.uniform(-PI, PI), s.uniform(-PI, PI), s.uniform(-PI, PI)]);
            let mut frame = Pose2::new(0.3, -0.4, 0.0);
            let mut expected = vec![frame.position()];
            for (angle, length) in q.0.iter().zip(arm.lengths) {
                frame = frame.compose(&Pose2::new(0.0, 0.0, *angle)).compose(&Pose2::new(length, 0.0, 0.0));
                expected.push(frame.position());
            }
            let points = arm.fk(&q);
            assert_eq!(points.len(), 4);
            for (p, e) in points.iter().zip(&expected) {
                assert!((p - e).norm() < 1e-15 * 8.0, "{q} {p} {e}");
            }
            assert!(wrap(arm.heading(&q) - q.0.iter().sum::<f64>()).abs() < 1e-14);
        }
    }

    #[test]
    fn ik_of_every_tip_that_fk_produces_at_any_lengths() {
        let mut s = Stream::new(Seed(5), "ik");
        for i in 0..20_000 {
            let lengths = match i % 4 {
                0 => [1.0, 1.0],
                1 => [0.7, 0.4],
                2 => [0.25, 1.3],
                _ => [s.uniform(0.01, 3.0), s.uniform(0.01, 3.0)],
            };
            let base = if i % 3 == 0 { Point2::origin() } else { Point2::new(s.uniform(-9.0, 9.0), 3.3) };
            let arm = Reach { base, lengths, link_radius: 0.0 };
            // straight and folded arms often: the boundaries of the annulus
            let th2 = [0.0, PI, 1e-9, PI - 1e-9, s.uniform(-PI, PI), s.uniform(-PI, PI)][i % 6];
            let q = T2::new(s.uniform(-PI, PI), th2);
            let tip = arm.tip(&q);
            let [down, up] = arm.ik(tip);
            let down = down.unwrap_or_else(|| panic!("{lengths:?} {q:?} has no inverse"));
            assert!(down.th2() >= 0.0);
            for solution in [Some(down), up].into_iter().flatten() {
                assert!((arm.tip(&solution) - tip).norm() < 1e-12, "{lengths:?} {q:?} {solution:?}");
            }
            if let Some(up) = up {
                assert!(up.th2() < 0.0 && up != down, "inside the annulus the two are distinct");
            }
            if th2 == 0.0 || th2 == PI {
                assert_eq!(up, None, "{lengths:?} {q:?}: one solution on the boundary");
            }
        }
    }

    #[test]
    fn ik_outside_the_annulus_and_at_the_base() {
        let arm = Reach { base: Point2::origin(), lengths: [0.7, 0.4], link_radius: 0.0 };
        assert_eq!(arm.ik(Point2::new(0.0, 1.1 + 1e-9)), [None, None]);
        assert_eq!(arm.ik(Point2::new(0.3 - 1e-9, 0.0)), [None, None]);
        assert_eq!(arm.ik(Point2::new(f64::NAN, 0.0)), [None, None]);
        assert!(matches!(arm.ik(Point2::new(0.0, 1.1)), [Some(_), None]));
        assert!(matches!(arm.ik(Point2::new(0.3, 0.0)), [Some(_), None]));
        assert!(matches!(arm.ik(Point2::new(0.3 + 1e-9, 0.0)), [Some(_), Some(_)]));
        let even = Reach::<2>::choset();
        assert_eq!(even.ik(Point2::origin()), [Some(T2::new(0.0, PI)), None]);
        let longer_second = Reach { base: Point2::origin(), lengths: [0.4, 0.7], link_radius: 0.0 };
        let [Some(q), None] = longer_second.ik(Point2::new(0.3, 0.0)) else { panic!("one solution") };
        assert!((longer_second.tip(&q) - Point2::new(0.3, 0.0)).norm() < 1e-15);
    }

    #[test]
    fn links_end_where_fk_says() {
        let arm = Reach::<3>::redundant();
        let q = Tn([0.4, -1.1, 2.0]);
        let points = arm.fk(&q);
        for (k, part) in arm.footprint(&q).parts().iter().enumerate() {
            assert_eq!(part.placed().core(), &[points[k], points[k + 1]]);
        }
    }

    #[test]
    fn bound_is_never_more_than_the_chapters() {
        let arm = Reach::<2>::workbench();
        let mut s = Stream::new(Seed(6), "bound");
        for _ in 0..1000 {
            let a = T2::new(s.uniform(-PI, PI), s.uniform(-PI, PI));
            let b = T2::new(s.uniform(-PI, PI), s.uniform(-PI, PI));
            let line = arm.edge(&a, &b).unwrap();
            let d = a.difference(&b).unwrap();
            let joints = 2.0 * d[0].abs() + 1.0 * d[1].abs();
            assert!(line.bound(1, 0.0, 1.0) <= joints + 1e-12);
            // and it holds: no sampled point of either link moves farther
            for part in 0..2 {
                for i in 0..16 {
                    let (s0, s1) = (f64::from(i) / 16.0, f64::from(i + 1) / 16.0);
                    let (f0, f1) = (line.footprint_at(s0), line.footprint_at(s1));
                    let mid = line.footprint_at(0.5 * (s0 + s1));
                    for v in 0..2 {
                        let (p0, p1) = (f0.parts()[part].placed().core()[v], f1.parts()[part].placed().core()[v]);
                        let pm = mid.parts()[part].placed().core()[v];
                        assert!((p1 - p0).norm() <= line.bound(part, s0, s1) + 1e-12);
                        let chord = p0 + (p1 - p0) * 0.5;
                        assert!((pm - chord).norm() <= line.sagitta(part, s0, s1) + 1e-12);
                    }
                }
            }
        }
    }

    #[test]
    fn constructors_refuse_bad_arms() {
        let o = Point2::origin();
        assert_eq!(Reach::try_new(o, [1.0, 0.0], 0.0).unwrap_err().link, 2);
        assert!(Reach::try_new(o, [1.0, f64::NAN], 0.0).is_err());
        assert!(Reach::try_new(o, [1.0, 1.0], -1.0).is_err());
        assert!(Reach::try_new(Point2::new(f64::INFINITY, 0.0), [1.0], 0.0).is_err());
        assert!(Reach::try_new(o, [1.0, 1.0], 0.0).is_ok());
    }
}
