//! `Occluder`, a segment with its shadow: what cannot be seen behind it from any place in a square.
//!
//! A scan that leaves out a hidden segment has to give the same bits. This is why it does.
//!
//! Let S be an occluder, H a segment that it hides or a part of it, o the sensor, anywhere in the square, and m the
//! margin. The corners of the square are in front of S's line, the ends of H behind it, each by m or more, and the line
//! from every corner to each end of H crosses S at least m within S's ends. On which side of a fixed point of S the
//! line from o to x passes is linear in o and in x. So from every place o to every point x of H the way crosses S, at
//! least m within its ends and at least m before x. A part is hidden whole by one occluder: two that share a corner
//! never hide together, because a ray through the corner may count as beside both of them.
//!
//! The kernel rounds. Let u = 2^-53, r and s the distances of H and S along a ray of direction d, p and q the ends of a
//! segment as seen from o, f a bound on the distance of S's farther end, L the length of S and D its line's distance.
//! The margin is [`MARGIN`] of the scene's size, which is at least L, and D L >= [`BROAD`] f^2.
//!
//! 1. A ray counts as meeting a segment where two rounded products say so, p x d >= 0 and d x q >= 0. They are off by
//!    at most 2.1 u |p|. So a ray that counts for H is within 3e-16 radians of one that meets it, and crosses S 0.99 m
//!    or more within its ends. There p x d is at least 0.99 m D / f for S, a million times its rounding: the ray counts
//!    for S as well.
//! 2. The inverse range of S is too low by at most 13 u f^2 / (D L), 2e-12 of itself. For the same reason S is never
//!    one of the doubtful segments, for which p x q is below 1e-8 of its two products.
//! 3. That of H can be far less exact, because o may lie near H's line. If H is not doubtful, it is too high by at most
//!    3e-7 F of itself, where F is the ratio of the distances of H's ends: 5e8 u for p x q, and 12e8 u F for d x (q -
//!    p), of whose terms |px py| <= (|px qy| + |py qx|) |p| / |q|. As F is at most [`STRETCH`], that is 3e-5.
//! 4. If H is doubtful, its inverse range may be anything up to that of its nearer end. H is then seen under an angle
//!    of less than 1.1e-8; an angle near a half turn would put o nearer to H than [`STRETCH`] allows. So the ray
//!    crosses the S that hides the nearer end's part, too, less than a quarter of m from where the line to that end
//!    does, because 1.1e-8 f^2 / D is at most 1.1e-5 L. By that s changes by at most 2.2e-5 of itself.
//! 5. The depth of H behind S's line is at least [`DEEPER`] of D, so r >= (1 + 1e-3) s. This outweighs 2, 3 and 4
//!    thirty times: S raises the ray higher than H does.
//! 6. Where S is left out because it is out of the sensor's reach, H is out of reach by a thousandth more.
//!
//! The occluder may be left out itself. Then what hides it raises the ray higher still, and so on. Each step goes up,
//! so they end, at a segment that is cast at. Hence no ray's greatest inverse range is that of a segment left out.
//!
//! The checks are rounded too, by less than a hundredth of m, for which the factors above leave room. The margin is
//! more than ten micrometres, so the rounding of the sensor's place to a square is nothing. What is not finite is not
//! here.

use crate::geometry::{Point2, Segment, Vector2, cross};
use crate::num::{greater, lesser, sqrt};

/// The margin by which something is hidden, as a fraction of the scene's size.
pub(super) const MARGIN: f64 = 5e-5;

/// Least product of an occluder's length and its line's distance, as a fraction of the square of its farther end's
/// distance.
const BROAD: f64 = 1e-3;

/// Least depth of a hidden segment behind the occluder's line, as a fraction of the distance in front of it.
const DEEPER: f64 = 1e-3;

/// Largest ratio of the distances of a hidden segment's farthest point and of its nearest.
const STRETCH: f64 = 100.0;

/// The number of equal parts of a segment that may be hidden by different ones.
const PARTS: u32 = 4;

/// A bit for each part of a segment.
pub(super) const ALL_PARTS: u32 = (1 << PARTS) - 1;

/// A square of places for the sensor, and the margin by which something is hidden from all of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewpoints {
    corners: [Point2; 4],
    centre: Point2,
    /// The distance of a corner from the centre, or a little more.
    radius: f64,
    margin: f64,
}

impl Viewpoints {
    /// The square with this centre and this half side, metres, widened by the margin to each side.
    pub(super) fn new(centre: Point2, half: f64, margin: f64) -> Self {
        let half = half + margin;
        let corner = |x: f64, y: f64| Point2::new(centre.x + x * half, centre.y + y * half);
        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        // the square root of 2, and a little more
        Viewpoints { corners, centre, radius: 1.4143 * half + margin, margin }
    }

    /// The distance of a segment from the centre.
    pub(super) fn distance(&self, s: &Segment) -> f64 {
        sqrt((s.closest_point(self.centre) - self.centre).norm_squared())
    }

    /// A lower bound on the distance of a place in the square from a segment that has this distance from the centre.
    pub(super) fn least_distance(&self, from_centre: f64) -> f64 {
        from_centre - self.radius
    }

    /// An upper bound on the distance of a segment's farther end from a place in the square.
    fn farthest(&self, s: &Segment) -> f64 {
        let [a, b] = [s.a, s.b].map(|end| (end - self.centre).norm_squared());
        sqrt(greater(a, b)) + self.radius
    }

    /// Whether a segment at this distance from the centre may be left out where something hides it.
    pub(super) fn may_lose(&self, s: &Segment, distance: f64) -> bool {
        (s.b - s.a).norm_squared() > self.margin * self.margin
            && self.farthest(s) <= STRETCH * self.least_distance(distance)
    }
}

/// A segment's shadow: the points that it hides from every place in a square.
///
/// Three lines bound it: one behind the segment, and one through each of its ends, less the margin, from that corner of
/// the square from which the line turns inward most.
#[derive(Clone, Copy, Debug)]
pub(super) struct Occluder {
    origin: Point2,
    /// The direction along the segment, and the one away from the square.
    along: Vector2,
    away: Vector2,
    /// Least depth of a point in the shadow, metres.
    depth: f64,
    /// How far along the segment the shadow begins and ends, and by how much more for each metre of depth.
    low: (f64, f64),
    high: (f64, f64),
}

impl Occluder {
    /// The segment as an occluder; `None` where the square is not all in front of it.
    pub(super) fn new(s: &Segment, view: &Viewpoints) -> Option<Self> {
        let (direction, margin, far) = (s.b - s.a, view.margin, view.farthest(s));
        let length = sqrt(direction.norm_squared());
        let along = direction / length;
        let turned = if cross(direction, view.centre - s.a) > 0.0 { -1.0 } else { 1.0 };
        let away = Vector2::new(-along.y, along.x) * turned;
        let mut front = (f64::INFINITY, 0.0);
        let (mut low, mut high) = ((margin, f64::NEG_INFINITY), (length - margin, f64::INFINITY));
        for corner in view.corners {
            let (at, distance) = ((corner - s.a).dot(&along), -(corner - s.a).dot(&away));
            front = (lesser(distance, front.0), greater(distance, front.1));
            low.1 = greater((low.0 - at) / distance, low.1);
            high.1 = lesser((high.0 - at) / distance, high.1);
        }
        let is_broad = length > 2.0 * margin && front.0 >= margin && front.0 * length >= BROAD * far * far;
        let depth = greater(margin, DEEPER * front.1);
        is_broad.then_some(Occluder { origin: s.a, along, away, depth, low, high })
    }

    /// The parts of a segment that lie in the shadow, a bit each of [`ALL_PARTS`]. A part does where both its ends do.
    pub(super) fn shaded(&self, s: &Segment) -> u32 {
        // both ends side by side, so that the compiler may work on both at once
        let [x, y] = [[s.a.x, s.b.x].map(|x| x - self.origin.x), [s.a.y, s.b.y].map(|y| y - self.origin.y)];
        let [mut behind, mut after, mut before] = [[0.0; 2]; 3];
        for end in 0..2 {
            let depth = x[end] * self.away.x + y[end] * self.away.y;
            let at = x[end] * self.along.x + y[end] * self.along.y;
            behind[end] = depth - self.depth;
            after[end] = at - (self.low.0 + self.low.1 * depth);
            before[end] = (self.high.0 + self.high.1 * depth) - at;
        }
        let is_outside = |[a, b]: [f64; 2]| (a < 0.0) & (b < 0.0);
        if is_outside(behind) | is_outside(after) | is_outside(before) {
            return 0;
        }
        let inside = |share: f64| {
            let is_inside = |[a, b]: [f64; 2]| a + (b - a) * share >= 0.0;
            u32::from(is_inside(behind) & is_inside(after) & is_inside(before))
        };
        let ends = (0..=PARTS).fold(0, |ends, k| ends | inside(f64::from(k) / f64::from(PARTS)) << k);
        ends & ends >> 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Seed, Stream};

    /// The definition, at many places of the square and many points of the part.
    #[test]
    fn the_way_to_a_shaded_part_crosses_the_occluder_within_its_ends() {
        let mut draws = Stream::new(Seed(1), "occluder");
        let mut shaded_parts = 0;
        for _ in 0..20_000 {
            let mut point = || Point2::new(draws.uniform(0.0, 4.0), draws.uniform(0.0, 4.0));
            let (s, h) = (Segment::new(point(), point()), Segment::new(point(), point()));
            let (centre, half, margin) = (point(), 0.125, 1e-3);
            let view = Viewpoints::new(centre, half, margin);
            let Some(occluder) = Occluder::new(&s, &view) else { continue };
            let shaded = occluder.shaded(&h);
            shaded_parts += shaded.count_ones();
            let along = (s.b - s.a) / s.length();
            for part in (0..PARTS).filter(|part| shaded >> part & 1 != 0) {
                for k in 0..36 * 5 {
                    let share = |i: u32| f64::from(i) / 5.0;
                    let turn = |i: u32| 2.0 * share(i) - 1.0;
                    // all of the square, and beyond it as far as it was widened
                    let (i, j) = ((half + margin) * turn(k % 6), (half + margin) * turn(k / 6 % 6));
                    let o = Point2::new(centre.x + i, centre.y + j);
                    let x = h.a + (h.b - h.a) * ((f64::from(part) + share(k / 36) * 1.25) / f64::from(PARTS));
                    let (front, behind) = (cross(along, o - s.a), cross(along, x - s.a));
                    assert!(front * behind < 0.0 && front.abs() >= 0.99 * margin && behind.abs() >= 0.99 * margin);
                    let crossing = o + (x - o) * (front / (front - behind));
                    let at = (crossing - s.a).dot(&along);
                    assert!(at >= 0.99 * margin && at <= s.length() - 0.99 * margin, "{at} of {}", s.length());
                    assert!(behind.abs() >= 0.99 * DEEPER * front.abs());
                }
            }
        }
        assert!(shaded_parts > 3000, "{shaded_parts}");
    }

    /// Nothing is hidden by a wall through the square, by one seen along its line, or by a short one far off; the wall
    /// itself and one that begins on it are not hidden either.
    #[test]
    fn what_is_seen_askew_or_touches_the_square_hides_nothing() {
        let view = Viewpoints::new(Point2::new(0.0, 0.0), 0.125, 1e-3);
        let wall = |ax, ay, bx, by| Segment::new(Point2::new(ax, ay), Point2::new(bx, by));
        for s in
            [wall(-1.0, 0.1, 1.0, 0.1), wall(1.0, 0.1, 3.0, 0.1), wall(3.0, 0.0, 3.0, 1e-3), wall(1.0, 1.0, 1.0, 1.0)]
        {
            assert!(Occluder::new(&s, &view).is_none(), "{s:?}");
        }
        let s = wall(1.0, -1.0, 1.0, 1.0);
        let occluder = Occluder::new(&s, &view).unwrap();
        assert_eq!(occluder.shaded(&s), 0);
        assert_eq!(occluder.shaded(&wall(2.0, -1.0, 2.0, 1.0)), ALL_PARTS);
        // the part that begins on the wall can be seen, the others cannot
        assert_eq!(occluder.shaded(&wall(1.0, 0.0, 2.0, 0.0)), ALL_PARTS & !1);
        assert_eq!(occluder.shaded(&wall(1.0, 1.0, 2.0, 1.0)), ALL_PARTS & !1);
        assert_eq!(occluder.shaded(&wall(2.0, 2.2, 3.0, 3.3)), 0);
        assert!(view.may_lose(&s, view.distance(&s)) && !view.may_lose(&wall(0.2, 0.2, 30.0, 0.2), 0.28));
    }
}
