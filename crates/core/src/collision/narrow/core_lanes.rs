//! `CoreLanes`, the sides of a small core side by side: which vertex and which edge of two cores are nearest, found for
//! all of them at once.
//!
//! What is found so is rounded otherwise than [`cores_distance`](super::convex::cores_distance) rounds it. So it only
//! says which pairs cannot be nearest. The others are measured as there, and the least of them has the same bits.

use super::convex::{Closest, NearestPoints};
use crate::collision::LANES;
use crate::geometry::{Placed, Point2, Segment, largest_coordinate};
use crate::num::sqrt;

/// The error of a distance that is found side by side, in parts of the coordinates, and more: some twenty roundings,
/// each of 2^-53.
const ROUNDING: f64 = 1e-13;

/// A number for each side.
type Octad = [f64; LANES];

/// The edges of a core of at most eight vertices, of a segment there and back, twice. Lanes beyond the last hold the
/// first again.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoreLanes {
    /// The number of vertices; 0 before there is a core.
    count: usize,
    /// Where each edge begins, and where it leads from there, metres.
    at: [Octad; 2],
    along: [Octad; 2],
    /// The inverse square of its length; 0 of an edge without length.
    inverse: Octad,
}

/// The squares of the distances of at most eight points from at most eight edges.
#[derive(Clone, Copy, Debug)]
struct PairSquares {
    /// A row for each point, in it a column for each edge.
    rows: [Octad; LANES],
    /// The least of each column.
    least: Octad,
}

/// Room for two cores and for what lies between them, filled in for one piece after the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneRoom {
    /// An upper bound on the size of the shape's coordinates, metres.
    size: f64,
    own: CoreLanes,
    /// The outward unit normals of the shape's half-planes, each through where an edge begins: one along each side and,
    /// of a segment, one across each end. 0 of an edge without length.
    ahead: [Octad; 2],
    other: CoreLanes,
    from_other: PairSquares,
    from_own: PairSquares,
}

impl LaneRoom {
    /// Room for a shape's core, to be [set](Self::set).
    pub(crate) const EMPTY: Self = {
        let (nothing, two) = ([0.0; LANES], [[0.0; LANES]; 2]);
        let core = CoreLanes { count: 0, at: two, along: two, inverse: nothing };
        let squares = PairSquares { rows: [nothing; LANES], least: nothing };
        LaneRoom { size: 0.0, own: core, ahead: two, other: core, from_other: squares, from_own: squares }
    };

    /// Whether there is a core.
    #[inline]
    pub(crate) fn is_set(&self) -> bool {
        self.own.count > 0
    }

    /// Takes the shape's core; false where it has too many vertices.
    #[inline]
    pub(crate) fn set(&mut self, shape: &Placed) -> bool {
        self.size = largest_coordinate([shape]);
        if !self.own.set(shape.core()) {
            return false;
        }
        if self.own.is_narrow() {
            normals_four(&self.own, &mut self.ahead);
        } else {
            normals_eight(&self.own, &mut self.ahead);
        }
        if self.own.count == 2 {
            // across the ends
            let [x, y] = &mut self.ahead;
            for i in [2, 3] {
                (x[i], y[i]) = (y[i], -x[i]);
            }
        }
        true
    }

    /// An upper bound on the size of the shape's coordinates, metres.
    #[inline]
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// How far some points lie ahead of the half-plane of the shape that they are farthest ahead of, metres; rounded. A
    /// lower bound on the distance of their hull from the shape's core.
    #[inline]
    pub(crate) fn gap(&self, points: &[Point2]) -> f64 {
        let LaneRoom { own, ahead, .. } = self;
        if own.is_narrow() { gap_four(own, ahead, points) } else { gap_eight(own, ahead, points) }
    }

    /// Measures the shape's core, which this is, and another one that is disjoint; the coordinates of both are at most
    /// `size`. `None` where the other has too many vertices.
    #[inline]
    pub(crate) fn measure<'a>(
        &'a mut self,
        core: &'a [Point2],
        other: &'a [Point2],
        size: f64,
    ) -> Option<Measured<'a>> {
        if !self.other.set(other) {
            return None;
        }
        let least = self.own.measure(other, &mut self.from_own);
        let from_other = self.other.measure(core, &mut self.from_other);
        let distance = sqrt(if from_other < least { from_other } else { least });
        Some(Measured { room: self, core, other, distance, slack: ROUNDING * size })
    }
}

impl CoreLanes {
    /// Takes a core; false where it has too many vertices.
    #[inline]
    fn set(&mut self, core: &[Point2]) -> bool {
        let mut put = |i: usize, from: &Point2, to: &Point2| {
            (self.at[0][i], self.at[1][i]) = (from.x, from.y);
            (self.along[0][i], self.along[1][i]) = (to.x, to.y);
        };
        match core {
            // there and back, twice
            [p, q] => [(p, q), (q, p), (q, p), (p, q)].into_iter().enumerate().for_each(|(i, (a, b))| put(i, a, b)),
            [p, q, r, s] => {
                [(p, q), (q, r), (r, s), (s, p)].into_iter().enumerate().for_each(|(i, (a, b))| put(i, a, b));
            }
            [] => return false,
            _ if core.len() > LANES => return false,
            [first, rest @ ..] => {
                let mut from = first;
                for (i, to) in rest.iter().chain([first]).enumerate() {
                    put(i, from, to);
                    from = to;
                }
                let second = rest.first().unwrap_or(first);
                (core.len()..LANES).for_each(|i| put(i, first, second));
            }
        }
        self.count = core.len();
        if self.is_narrow() {
            turn_four(self)
        } else {
            turn_eight(self)
        }
        true
    }

    /// Whether half of the lanes are enough.
    #[inline]
    fn is_narrow(&self) -> bool {
        self.count <= 4
    }

    /// Measures at most eight points from every edge; returns the least square.
    #[inline]
    fn measure(&self, points: &[Point2], squares: &mut PairSquares) -> f64 {
        if self.is_narrow() { squares_four(self, points, squares) } else { squares_eight(self, points, squares) }
    }
}

/// Two disjoint cores, and what lies between the vertices of either and the edges of the other.
pub(crate) struct Measured<'a> {
    room: &'a LaneRoom,
    core: &'a [Point2],
    other: &'a [Point2],
    /// The distance, metres; rounded.
    pub(crate) distance: f64,
    /// What it may be off by, metres.
    pub(crate) slack: f64,
}

impl Measured<'_> {
    /// The distance, bit for bit that of [`cores_distance`](super::convex::cores_distance), if it is less than `limit`,
    /// and a pair of nearest points; where several are as near, one of them.
    #[inline]
    pub(crate) fn nearest(&self, limit: f64) -> Option<NearestPoints> {
        let reach = self.distance + 4.0 * self.slack;
        let square = reach * reach;
        let mut closest = Closest::new(limit, f64::INFINITY);
        each_within(&self.room.from_other, square, self.core, self.other, |p, edge| {
            closest.look(p, edge, |p, foot| (p, foot));
        });
        if self.core.len() > 1 {
            each_within(&self.room.from_own, square, self.other, self.core, |q, edge| {
                closest.look(q, edge, |q, foot| (foot, q));
            });
        }
        closest.found()
    }
}

/// Calls `look` with each point and each edge of a core that are not farther apart.
#[inline(always)]
fn each_within(
    squares: &PairSquares,
    square: f64,
    points: &[Point2],
    core: &[Point2],
    mut look: impl FnMut(Point2, Segment),
) {
    let count = if core.len() <= 2 { 1 } else { core.len() };
    for (i, least) in squares.least.iter().enumerate().take(count) {
        if *least <= square {
            let edge = Segment { a: core[i], b: core[if i + 1 < core.len() { i + 1 } else { 0 }] };
            for (p, row) in points.iter().zip(&squares.rows) {
                if row[i] <= square {
                    look(*p, edge);
                }
            }
        }
    }
}

/// Makes the vectors of edges whose ends are given.
#[inline(always)]
fn turned<const WIDTH: usize>(lanes: &mut CoreLanes) {
    let CoreLanes { at: [x, y], along: [to_x, to_y], inverse, .. } = lanes;
    for i in 0..WIDTH {
        let (ux, uy) = (to_x[i] - x[i], to_y[i] - y[i]);
        let square = ux * ux + uy * uy;
        (to_x[i], to_y[i]) = (ux, uy);
        inverse[i] = if square > f64::MIN_POSITIVE { 1.0 / square } else { 0.0 };
    }
}

/// The unit vectors to the right of edges.
#[inline(always)]
fn normals<const WIDTH: usize>(lanes: &CoreLanes, [x, y]: &mut [Octad; 2]) {
    let CoreLanes { along: [ux, uy], inverse, .. } = lanes;
    for i in 0..WIDTH {
        let root = sqrt(inverse[i]);
        (x[i], y[i]) = (uy[i] * root, -ux[i] * root);
    }
}

/// [`LaneRoom::gap`] by as many lanes.
#[inline(always)]
fn gap<const WIDTH: usize>(lanes: &CoreLanes, [nx, ny]: &[Octad; 2], points: &[Point2]) -> f64 {
    let CoreLanes { at: [x, y], .. } = lanes;
    let mut least = [f64::INFINITY; WIDTH];
    for p in points {
        for i in 0..WIDTH {
            let height = (p.x - x[i]) * nx[i] + (p.y - y[i]) * ny[i];
            least[i] = if height < least[i] { height } else { least[i] };
        }
    }
    // the greatest
    -least_of(least.map(|height| -height))
}

/// [`CoreLanes::measure`] by as many lanes.
#[inline(always)]
fn squares<const WIDTH: usize>(lanes: &CoreLanes, points: &[Point2], squares: &mut PairSquares) -> f64 {
    let CoreLanes { at: [x, y], along: [ux, uy], inverse, .. } = lanes;
    let mut least = [f64::INFINITY; WIDTH];
    for (p, row) in points.iter().zip(&mut squares.rows) {
        for i in 0..WIDTH {
            let (wx, wy) = (p.x - x[i], p.y - y[i]);
            let part = (wx * ux[i] + wy * uy[i]) * inverse[i];
            let part = if part > 0.0 { part } else { 0.0 };
            let part = if part < 1.0 { part } else { 1.0 };
            let (dx, dy) = (wx - part * ux[i], wy - part * uy[i]);
            row[i] = dx * dx + dy * dy;
            least[i] = if row[i] < least[i] { row[i] } else { least[i] };
        }
    }
    squares.least[..WIDTH].copy_from_slice(&least);
    least_of(least)
}

/// The least of four or eight numbers.
#[inline(always)]
fn least_of<const WIDTH: usize>(mut of: [f64; WIDTH]) -> f64 {
    let mut width = WIDTH;
    while width > 1 {
        width /= 2;
        for i in 0..width {
            of[i] = if of[i] < of[i + width] { of[i] } else { of[i + width] };
        }
    }
    of[0]
}

/// Compiles a loop over lanes for four and for eight of them, and for several instruction sets.
macro_rules! by_width {
    ($four:ident, $eight:ident, $loop:ident, ($($name:ident: $of:ty),*) $(-> $to:ty)?) => {
        #[cfg_attr(
            not(baseline),
            multiversion::multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))
        )]
        fn $four($($name: $of),*) $(-> $to)? {
            $loop::<4>($($name),*)
        }

        #[cfg_attr(
            not(baseline),
            multiversion::multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))
        )]
        fn $eight($($name: $of),*) $(-> $to)? {
            $loop::<8>($($name),*)
        }
    };
}

by_width!(turn_four, turn_eight, turned, (lanes: &mut CoreLanes));
by_width!(normals_four, normals_eight, normals, (lanes: &CoreLanes, ahead: &mut [Octad; 2]));
by_width!(gap_four, gap_eight, gap, (lanes: &CoreLanes, ahead: &[Octad; 2], points: &[Point2]) -> f64);
by_width!(squares_four, squares_eight, squares, (lanes: &CoreLanes, points: &[Point2], room: &mut PairSquares) -> f64);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::narrow::convex::{cores_contact, cores_distance, edges, point_segment};
    use crate::geometry::{Vertices, convex_hull};
    use crate::random::{Seed, Stream};

    /// A core of one to eight vertices; every other one with vertices on a lattice, where vertices, edges and whole
    /// sides are equally near.
    fn core(draws: &mut Stream, is_lattice: bool, at: f64) -> Vertices {
        let count = [1, 2, 3, 4, 6, 8][draws.below(6) as usize];
        let mut x = || if is_lattice { draws.below(4) as f64 } else { draws.uniform(0.0, 3.0) };
        let points: Vec<Point2> = (0..count).map(|_| Point2::new(at + x(), x())).collect();
        convex_hull(&points)
    }

    #[test]
    fn cores_that_are_measured_side_by_side_have_the_distance_of_one_pair_after_the_other() {
        let mut draws = Stream::new(Seed(47), "core lanes");
        let (mut apart, mut parted) = ([0; 2], 0);
        for i in 0..20_000 {
            let far = [0.0, 300.0][usize::from(i % 7 == 0)];
            let a = core(&mut draws, i % 2 == 0, far);
            let b = core(&mut draws, i % 2 == 0, far + [2.0, 3.0, 3.5][i % 3]);
            let mut room = LaneRoom::EMPTY;
            assert!(!room.is_set() && room.set(&Placed::new(a.clone(), 0.0)) && room.is_set());
            let gap = room.gap(&b);
            if cores_contact(&a, &b).is_some() {
                assert!(gap < 1e-12, "{gap}: {a:?} {b:?}");
                continue;
            }
            let exact = cores_distance(&a, &b, f64::INFINITY).unwrap().dist;
            assert!(gap <= exact + 1e-12, "{gap} of {exact}: {a:?} {b:?}");
            parted += u32::from(gap > 0.5 * exact);
            let size = 8.0 + far;
            let measured = room.measure(&a, &b, size).unwrap();
            assert!((measured.distance - exact).abs() <= measured.slack, "{a:?} {b:?}");
            for limit in [f64::INFINITY, 1.5 * exact, exact, 0.5 * exact] {
                let bits = |found: Option<NearestPoints>| found.map(|n| n.dist.to_bits());
                let (ours, theirs) = (measured.nearest(limit), cores_distance(&a, &b, limit));
                assert_eq!(bits(ours), bits(theirs), "{a:?} {b:?} within {limit}");
                if let Some(found) = ours {
                    assert!(((found.on_a - found.on_b).norm() - exact).abs() < 1e-12);
                    let on = |core: &[Point2], p: Point2| edges(core).any(|edge| point_segment(p, edge).0 < 1e-12);
                    assert!(on(&a, found.on_a) && on(&b, found.on_b), "{found:?}: {a:?} {b:?}");
                }
            }
            // whose vertex is nearest
            let is_of_a = b.iter().all(|q| edges(&a).all(|e| point_segment(*q, e).0 > exact));
            apart[usize::from(is_of_a)] += 1;
        }
        assert!(apart[0] > 5000 && apart[1] > 1000 && parted > 5000, "{apart:?}, {parted} parted");
    }

    #[test]
    fn a_core_of_more_vertices_has_no_lanes() {
        let polygon = |count: u32| -> Vec<Point2> {
            let turn = |k: u32| crate::num::sin_cos(std::f64::consts::TAU * f64::from(k) / f64::from(count));
            (0..count).map(|k| Point2::new(turn(k).1, turn(k).0)).collect()
        };
        let square = [0.0, 1.0].map(|x| Point2::new(3.0, x));
        let mut room = LaneRoom::EMPTY;
        assert!(!room.set(&Placed::new(Vertices::from(polygon(9)), 0.0)));
        assert!(room.set(&Placed::new(Vertices::from(polygon(8)), 0.0)));
        assert!(room.measure(&polygon(8), &polygon(9), 4.0).is_none());
        assert!((room.measure(&polygon(8), &square, 4.0).unwrap().distance - 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_least_of_eight_numbers_and_of_four_is_found_in_every_lane() {
        for i in 0..LANES {
            let mut of = [3.0; LANES];
            of[i] = -2.0;
            assert_eq!(least_of(of), -2.0, "{i}");
            assert_eq!(least_of([of[i % 4], 5.0, of[(i + 1) % 8], 4.0]), least_of([of[(i + 1) % 8], of[i % 4]]), "{i}");
        }
    }
}
