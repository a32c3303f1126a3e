//! `RoutePath`, the line of a route by arc length: straight pieces and arcs of circles.

use std::f64::consts::{FRAC_PI_2, PI};

use super::error::{MAX_ROUTE_POINTS, RouteError};
use crate::geometry::{Point2, Pose2, Shape, Tangent2};
use crate::num::{self, wrap};

/// A corner that turns by less than this goes straight on, radians.
const STRAIGHT: f64 = 1e-9;

/// A corner that turns by more than this turns back, radians.
const BACK: f64 = PI - 1e-3;

/// How far a side may fall short of its rounded corners by rounding, metres.
const ROUNDING: f64 = 1e-9;

/// A closed line with rounded corners, by its arc length. It begins where the first corner's arc ends.
///
/// ```
/// use motion_lab_core::geometry::Point2;
/// use motion_lab_core::worlds::Route;
/// let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
/// let path = Route { name: "round".into(), points, radius: 1.0, speed: 0.5 }.path().unwrap();
/// assert!((path.length() - (8.0 + std::f64::consts::TAU)).abs() < 1e-12);
/// let pose = path.at(1.0);
/// assert!((pose.x - 2.0).abs() < 1e-12 && pose.y.abs() < 1e-12 && pose.theta == 0.0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RoutePath {
    pieces: Vec<RoutePiece>,
    length: f64,
}

/// A straight piece or an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
struct RoutePiece {
    /// Arc length at its start, metres.
    from: f64,
    /// Where it starts, and which way it goes there.
    start: Pose2,
    length: f64,
    /// Its curvature, per metre, positive to the left; 0 of a straight piece.
    curvature: f64,
}

/// A corner: where its arc begins and ends, and the way out.
struct RoundedCorner {
    at: Point2,
    /// The direction of the side that leaves it, radians.
    out: f64,
    /// How much it turns, radians, positive to the left.
    turn: f64,
    /// How far before and after the corner its arc begins and ends, metres.
    cut: f64,
}

impl RoutePath {
    pub(super) fn try_new(points: &[Point2], radius: f64) -> Result<Self, RouteError> {
        let count = points.len();
        if !(3..=MAX_ROUTE_POINTS).contains(&count) {
            return Err(RouteError::Points(count));
        }
        let after = |i: usize| (i + 1) % count;
        let mut bearings = Vec::with_capacity(count);
        for (index, a) in points.iter().enumerate() {
            let b = points[after(index)];
            Shape::try_segment(*a, b).map_err(|source| RouteError::Side { index, source })?;
            bearings.push(num::atan2(b.y - a.y, b.x - a.x));
        }
        let corner = |i: usize| {
            let turn = wrap(bearings[i] - bearings[(i + count - 1) % count]);
            if turn.abs() > BACK {
                return Err(RouteError::TurnsBack(i));
            }
            let turn = if turn.abs() < STRAIGHT { 0.0 } else { turn };
            Ok(RoundedCorner { at: points[i], out: bearings[i], turn, cut: radius * num::tan(0.5 * turn.abs()) })
        };
        let corners: Vec<RoundedCorner> = (0..count).map(corner).collect::<Result<_, _>>()?;
        let mut path = RoutePath { pieces: Vec::with_capacity(2 * count), length: 0.0 };
        for (index, corner) in corners.iter().enumerate() {
            let next = &corners[after(index)];
            let length = num::hypot(next.at.x - corner.at.x, next.at.y - corner.at.y);
            let needed = corner.cut + next.cut;
            if needed > length + ROUNDING {
                return Err(RouteError::ShortSide { index, length, radius, needed });
            }
            let along = Pose2::new(corner.at.x, corner.at.y, corner.out);
            path.push(along.boxplus(&Tangent2::new(corner.cut, 0.0, 0.0)), length - needed, 0.0);
            let curvature = if next.turn < 0.0 { -1.0 / radius } else { 1.0 / radius };
            path.push(along.boxplus(&Tangent2::new(length - next.cut, 0.0, 0.0)), radius * next.turn.abs(), curvature);
        }
        Ok(path)
    }

    fn push(&mut self, start: Pose2, length: f64, curvature: f64) {
        if length > ROUNDING {
            self.pieces.push(RoutePiece { from: self.length, start, length, curvature });
            self.length += length;
        }
    }

    /// The length of one round, metres.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The point `s` metres from the beginning, round and round, with the heading of the line there. A negative `s`
    /// lies before the beginning; one that is not finite is taken for 0.
    pub fn at(&self, s: f64) -> Pose2 {
        let s = self.within(s);
        let piece = &self.pieces[self.pieces.partition_point(|piece| piece.from <= s).saturating_sub(1)];
        piece.at(s - piece.from)
    }

    /// The arc length `s` as one in `[0, length)`.
    pub fn within(&self, s: f64) -> f64 {
        let rest = s - (s / self.length).floor() * self.length;
        if rest >= 0.0 && rest < self.length { rest } else { 0.0 }
    }

    /// The arc length, in `[0, length)`, of a nearest point of the line; of several the first.
    pub fn nearest(&self, p: Point2) -> f64 {
        let (mut least, mut best) = (f64::INFINITY, 0.0);
        for piece in &self.pieces {
            for ahead in piece.candidates(p) {
                let at = piece.at(ahead);
                let distance = num::hypot(at.x - p.x, at.y - p.y);
                if distance < least {
                    (least, best) = (distance, piece.from + ahead);
                }
            }
        }
        self.within(best)
    }

    /// The line as points, the last of which is the first again: the ends of the straight pieces, and points of the
    /// arcs such that no chord strays from its arc by more than `stray` metres.
    pub fn outline(&self, stray: f64) -> Vec<Point2> {
        let mut points = Vec::with_capacity(2 * self.pieces.len() + 1);
        for piece in &self.pieces {
            let count = if piece.curvature == 0.0 { 1 } else { chords(piece.length, piece.curvature.abs(), stray) };
            points.extend((0..count).map(|k| piece.at(piece.length * f64::from(k) / f64::from(count)).position()));
        }
        points.extend(points.first().copied());
        points
    }
}

/// How many chords of an arc keep within `stray` of it, at most 64.
fn chords(length: f64, curvature: f64, stray: f64) -> u32 {
    // a chord of length c strays by about c^2 curvature / 8
    let chord = num::sqrt(8.0 * stray / curvature);
    let count = (length / chord).ceil();
    if count >= 64.0 { 64 } else { (count as u32).max(1) }
}

impl RoutePiece {
    fn at(&self, ahead: f64) -> Pose2 {
        self.start.boxplus(&Tangent2::new(ahead, 0.0, ahead * self.curvature))
    }

    /// Lengths along the piece among which is that of its point nearest `p`: its ends, and the foot of `p` if it lies
    /// between them.
    fn candidates(&self, p: Point2) -> impl Iterator<Item = f64> + use<> {
        let foot = if self.curvature == 0.0 {
            let (sin, cos) = num::sin_cos(self.start.theta);
            (p.x - self.start.x) * cos + (p.y - self.start.y) * sin
        } else {
            let centre = self.start.transform(Point2::new(0.0, 1.0 / self.curvature));
            let side = if self.curvature > 0.0 { -FRAC_PI_2 } else { FRAC_PI_2 };
            let turned = num::atan2(p.y - centre.y, p.x - centre.x) - (self.start.theta + side);
            wrap(turned) / self.curvature
        };
        let inside = (0.0..=self.length).contains(&foot).then_some(foot);
        [Some(0.0), inside, Some(self.length)].into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{SQRT_2, TAU};

    use super::*;
    use crate::random::{Seed, Stream};
    use crate::worlds::Route;

    fn route(points: &[(f64, f64)], radius: f64) -> Result<RoutePath, RouteError> {
        let points = points.iter().map(|&(x, y)| Point2::new(x, y)).collect();
        Route { name: "round".into(), points, radius, speed: 1.0 }.path()
    }

    const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];

    /// The square of side 4 with corners of radius 1, counter-clockwise, by hand: on each side 2 m straight, then a
    /// quarter of a circle about the point 1 m in from both sides.
    fn square_by_hand(s: f64) -> (Point2, f64) {
        let quarter = 2.0 + 0.25 * TAU;
        let (side, rest) = ((s / quarter).floor(), s % quarter);
        let turn = num::greater(0.0, rest - 2.0);
        let (x, y) = if rest <= 2.0 { (1.0 + rest, 0.0) } else { (3.0 + num::sin(turn), 1.0 - num::cos(turn)) };
        // the side's own frame is the first one's, turned about the square's middle
        let (x, y) = (x - 2.0, y - 2.0);
        let (sin, cos) = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][side as usize % 4];
        (Point2::new(2.0 + cos * x - sin * y, 2.0 + sin * x + cos * y), wrap(0.25 * TAU * side + turn))
    }

    #[test]
    fn a_square_is_what_it_is_by_hand_there_and_back() {
        let path = route(&SQUARE, 1.0).unwrap();
        assert!((path.length() - 8.0 - TAU).abs() < 1e-12);
        let reversed: Vec<(f64, f64)> = SQUARE.iter().rev().copied().collect();
        let back = route(&reversed, 1.0).unwrap();
        for k in 0..1000 {
            let s = path.length() * f64::from(k) / 1000.0;
            let (p, theta) = square_by_hand(s);
            let found = path.at(s);
            assert!((found.position() - p).norm() < 1e-12 && wrap(found.theta - theta).abs() < 1e-12, "{s} {found}");
            let round = path.at(s + 7.0 * path.length());
            assert!((round.position() - p).norm() < 1e-11, "the eighth round is the first");
            assert!((path.at(s - path.length()).position() - p).norm() < 1e-12);
            // the other way round it passes the same points, facing back
            let s = back.nearest(p);
            let met = back.at(s);
            assert!((met.position() - p).norm() < 1e-9 && (wrap(met.theta - theta).abs() - PI).abs() < 1e-6);
        }
        assert_eq!(path.at(f64::NAN), path.at(0.0));
        assert_eq!(path.at(f64::INFINITY), path.at(0.0));
    }

    #[test]
    fn the_nearest_point_is_that_of_a_fine_search() {
        let path = route(&[(0.0, 0.0), (6.0, 1.0), (5.0, 4.0), (2.5, 2.0), (0.0, 5.0)], 0.4).unwrap();
        let mut draws = Stream::new(Seed(1), "nearest");
        for _ in 0..300 {
            let p = Point2::new(draws.uniform(-2.0, 8.0), draws.uniform(-2.0, 7.0));
            let off = |s: f64| (path.at(s).position() - p).norm();
            let searched =
                (0..5000).map(|k| off(path.length() * f64::from(k) / 5000.0)).fold(f64::INFINITY, num::lesser);
            let found = off(path.nearest(p));
            assert!(found <= searched + 1e-12 && found >= searched - 0.01, "{p}: {found} {searched}");
        }
    }

    #[test]
    fn the_line_has_no_jumps_and_its_outline_lies_on_it() {
        let path = route(&[(0.0, 0.0), (6.0, 1.0), (5.0, 4.0), (2.5, 2.0), (0.0, 5.0)], 0.4).unwrap();
        let step = path.length() / 10_000.0;
        for k in 0..10_000 {
            let (a, b) = (path.at(step * f64::from(k)), path.at(step * f64::from(k + 1)));
            // a chord is no longer than the way, and little shorter
            let chord = (b.position() - a.position()).norm();
            assert!(chord <= step + 1e-12 && chord >= step * (1.0 - 1e-5), "{a} {b}");
            assert!(wrap(b.theta - a.theta).abs() <= step / 0.4 + 1e-12, "no sharper than its corners");
        }
        let outline = path.outline(1e-3);
        assert_eq!(outline.first(), outline.last());
        for pair in outline.windows(2) {
            let middle = pair[0] + (pair[1] - pair[0]) * 0.5;
            let near = path.at(path.nearest(middle)).position();
            assert!((near - middle).norm() <= 1.01e-3, "{middle}");
        }
    }

    #[test]
    fn a_point_on_a_side_is_no_corner_and_a_corner_may_take_all_of_a_side() {
        let with = route(&[(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)], 1.0).unwrap();
        let without = route(&SQUARE, 1.0).unwrap();
        assert!((with.length() - without.length()).abs() < 1e-12);
        // a circle: the corners leave nothing straight
        let circle = route(&SQUARE, 2.0).unwrap();
        assert!((circle.length() - 2.0 * TAU).abs() < 1e-9);
        assert!(
            (0..100).all(|k| ((circle.at(f64::from(k)).position() - Point2::new(2.0, 2.0)).norm() - 2.0).abs() < 1e-9)
        );
        assert!((circle.at(circle.nearest(Point2::new(9.0, 9.0))).x - (2.0 + SQRT_2)).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_route_is_refused() {
        let refused = |points: &[(f64, f64)], radius| route(points, radius).unwrap_err().to_string();
        assert_eq!(refused(&SQUARE[..2], 1.0), "2 points: a route has 3 to 1000");
        assert!(refused(&[(0.0, 0.0); 1001], 1.0).starts_with("1001 points"));
        assert!(refused(&[(0.0, 0.0), (4.0, 0.0), (4.0, 0.0)], 0.1).starts_with("from points[1] on: length 0 m"));
        assert!(refused(&[(0.0, 0.0), (f64::NAN, 0.0), (4.0, 0.0)], 0.1).starts_with("from points[0] on: "));
        assert_eq!(refused(&[(0.0, 0.0), (4.0, 0.0), (2.0, 0.0)], 0.1), "points[0]: the route turns back on itself");
        // the tangent of an eighth of a turn is 1, but for rounding
        let short = refused(&SQUARE, 2.5);
        assert!(
            short.starts_with("from points[0] on: a side of 4 m, but its corners of radius 2.5 m take "),
            "{short}"
        );
        assert!(route(&SQUARE, 2.001).is_err());
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(refused(&SQUARE, radius).starts_with("radius "), "{radius}");
        }
        let points = SQUARE.map(|(x, y)| Point2::new(x, y)).to_vec();
        for speed in [0.0, -1.0, f64::NAN, 10.5] {
            let route = Route { name: "round".into(), points: points.clone(), radius: 1.0, speed };
            assert!(route.path().unwrap_err().to_string().starts_with("speed "), "{speed}");
        }
    }
}
