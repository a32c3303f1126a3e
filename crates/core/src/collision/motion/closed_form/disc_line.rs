//! `DiscLine`, a disc whose centre runs along a line: its first contact and its clearance in closed form.

use smallvec::SmallVec;

use super::time_of_impact::point_meets;
use crate::collision::broad::frames::CentredLine;
use crate::collision::motion::conservative_advancement::BRACKET;
use crate::collision::narrow::convex::edges;
use crate::collision::{EdgeVerdict, HitBy, ObstacleId, ProvenStep, Scene};
use crate::geometry::{Aabb, Placed, Point2, Segment, Vector2, cross};
use crate::num::{greater, lesser, sqrt, ulp};

/// Largest number of pieces in contact; with more the caller falls back to the march.
const MAX_CONTACTS: usize = 16;

/// A disc whose centre runs along a straight line.
pub(crate) struct DiscLine {
    way: SegmentTerms,
    radius: f64,
    /// The larger of 1 and the line's largest coordinate in size, metres.
    size: f64,
}

/// A segment, of the line or of a piece, with the values that its distances are computed from.
#[derive(Clone, Copy)]
struct SegmentTerms {
    a: Point2,
    b: Point2,
    u: Vector2,
    /// Its squared length, and the inverse of that; 0 for a point.
    square: f64,
    inverse: f64,
}

impl SegmentTerms {
    fn new(a: Point2, b: Point2) -> Self {
        let u = b - a;
        let square = u.norm_squared();
        SegmentTerms { a, b, u, square, inverse: if square > 0.0 { 1.0 / square } else { 0.0 } }
    }

    /// The squared distance from `p`.
    #[inline]
    fn squared_distance(&self, p: Point2) -> f64 {
        let w = p - self.a;
        let s = w.dot(&self.u) * self.inverse;
        let s = if s > 0.0 { if s < 1.0 { s } else { 1.0 } } else { 0.0 };
        (w - self.u * s).norm_squared()
    }

    /// The squared distance between two legs; 0 where they cross.
    #[inline]
    fn squared_distance_to(&self, other: &SegmentTerms) -> f64 {
        let side = |leg: &SegmentTerms, p: Point2| cross(leg.u, p - leg.a);
        let across = |leg: &SegmentTerms, of: &SegmentTerms| (side(of, leg.a) > 0.0) != (side(of, leg.b) > 0.0);
        if across(self, other) && across(other, self) {
            return 0.0;
        }
        lesser(
            lesser(self.squared_distance(other.a), self.squared_distance(other.b)),
            lesser(other.squared_distance(self.a), other.squared_distance(self.b)),
        )
    }
}

/// What a search among the pieces found.
struct PieceSearch {
    /// The least distance of the line from a piece that the disc does not touch, less the piece's radius, metres.
    least: f64,
    /// The square of the length of the longest edge measured.
    longest: f64,
    /// The pieces that the disc touches along the line, or may touch.
    touched: SmallVec<[u32; MAX_CONTACTS]>,
    /// Whether only the march can decide: too many pieces are touched, or a distance is NaN.
    unclear: bool,
}

impl DiscLine {
    /// The disc of this radius on this line; `None` where the line is so short or the disc so small that rounding could
    /// decide, where a coordinate or the radius is too large, or the scene holds a shape that is not valid.
    pub(crate) fn new(way: Segment, radius: f64, scene: &Scene) -> Option<Self> {
        let size = Aabb { min: way.a, max: way.a }.merged(&Aabb { min: way.b, max: way.b }).size();
        let way = SegmentTerms::new(way.a, way.b);
        let largest = greater(size, scene.size);
        let sound = radius > 1e-7 * largest && radius < 1e6 && largest < 1e6 && way.square > 1e-18 * size * size;
        sound.then_some(DiscLine { way, radius, size })
    }

    /// The verdict, and the step that proves the motion as far as it is free; `None` where it takes a march.
    pub(crate) fn verdict(&self, scene: &Scene) -> Option<(ProvenStep, EdgeVerdict)> {
        let radius = self.radius;
        let found = self.search(scene);
        if found.unclear {
            return None;
        }
        let slack = self.rounding_bound(&found);
        if found.touched.is_empty() {
            let clearance = found.least - radius - slack;
            let step = ProvenStep { from: 0.0, to: 1.0, clearance };
            return (clearance > 0.0).then_some((step, EdgeVerdict::Free { clearance }));
        }
        let pieces = || found.touched.iter().map(|&piece| (piece, &scene.pieces[piece as usize]));
        let mut first = 1.0;
        for (_, piece) in pieces() {
            first = lesser(point_meets(self.way.a, self.way.u, piece.core(), radius + piece.radius())?, first);
        }
        // a little less than the bracket, so that its two ends fit in it
        let half = 0.45 * BRACKET / sqrt(self.way.square);
        let (free_until, contact_at) = (first - half, if first + half < 1.0 { first + half } else { 1.0 });
        if free_until <= 0.0 {
            return None;
        }
        // off by some ulps from where the footprint is placed
        let at = |s: f64| self.way.a + self.way.u * s;
        let (before, after) = (at(free_until), at(contact_at));
        let (mut clearance, mut obstacle) = (BRACKET, None);
        for (piece, shape) in pieces() {
            let (nearer, farther) = (point_gap(after, shape) - radius, point_gap(before, shape) - radius);
            // Along a line, the distance from a point or a segment is a convex function: where it still falls, it has
            // fallen all the way. The distance from a polygon's boundary is not: the line may begin inside.
            let falls = shape.core().len() <= 2 && nearer < farther - slack;
            let least = if falls { farther } else { gap(&SegmentTerms::new(self.way.a, before), shape).0 - radius };
            clearance = lesser(least - slack, clearance);
            // certainly in contact, or certainly apart
            if nearer < -slack {
                let owner = scene.owners[piece as usize];
                obstacle = Some(obstacle.map_or(owner, |o: u32| o.min(owner)));
            } else if nearer <= slack {
                return None;
            }
        }
        if clearance <= 0.0 {
            return None;
        }
        let obstacle = ObstacleId(obstacle?);
        let step = ProvenStep { from: 0.0, to: free_until, clearance };
        Some((step, EdgeVerdict::Hit { free_until, contact_at, part: 0, by: HitBy::Obstacle(obstacle) }))
    }

    /// Whether the disc touches nothing along the line; `None` where it comes so near to contact that rounding could
    /// decide.
    pub(crate) fn is_free(&self, scene: &Scene) -> Option<bool> {
        // more than a verdict subtracts, see `slack`
        let slack = 1e-12 * (self.size + scene.size + self.radius);
        let SegmentTerms { a, b, u, square, inverse } = self.way;
        let (mut free, mut clear) = (true, true);
        let mut look = |piece: usize| {
            let piece = &scene.pieces[piece];
            let (reach, square) = (self.radius + piece.radius(), squares(&self.way, piece).0);
            free = square >= (reach - slack) * (reach - slack);
            clear &= square > (reach + slack) * (reach + slack);
            !free
        };
        if let Some(frames) = &scene.frames {
            let length = sqrt(square);
            let line = CentredLine { middle: a + u * 0.5, direction: u * (length * inverse), half: 0.5 * length };
            let mut near = frames.near(line, self.radius, self.size + scene.size);
            while near != 0 && !look(near.trailing_zeros() as usize) {
                near &= near - 1;
            }
        } else {
            let way = Aabb { min: a, max: a }.merged(&Aabb { min: b, max: b });
            scene.index.each_near(&way, self.radius + slack, look);
        }
        if clear || !free { Some(free) } else { None }
    }

    /// Finds all pieces that the disc touches along the line, or else the distance of the nearest.
    fn search(&self, scene: &Scene) -> PieceSearch {
        let mut found = PieceSearch { least: f64::INFINITY, longest: 0.0, touched: SmallVec::new(), unclear: false };
        let (a, b) = (self.way.a, self.way.b);
        let extent = Aabb { min: a, max: a }.merged(&Aabb { min: b, max: b }).grown(64.0 * ulp(self.size));
        // a piece farther from the line than this is certainly not touched
        let near = self.radius + BRACKET;
        // which pieces are measured decides on the longest edge, and by it on the last bits of a clearance
        let whole = scene.whole();
        whole.index.nearest(&extent, f64::INFINITY, |number| {
            let piece = whole.piece(number);
            let (distance, longest) = gap(&self.way, &scene.pieces[piece]);
            found.longest = greater(longest, found.longest);
            if distance > near {
                found.least = lesser(distance, found.least);
            } else if found.touched.len() < MAX_CONTACTS && distance <= near {
                found.touched.push(piece as u32);
            } else {
                found.unclear = true;
            }
            if found.touched.is_empty() { greater(found.least, near) } else { near }
        });
        found
    }

    /// An upper bound on the rounding of a distance and of its proof, metres.
    ///
    /// A foot is off by at most 8 roundings of the displacements it is computed from, none longer than the line, the
    /// longest edge and the distance together. The verifier of certificates subtracts 32 ulps of the largest coordinate
    /// or 1 itself, and the distance that it asks for may be off by 16 more.
    fn rounding_bound(&self, found: &PieceSearch) -> f64 {
        let least = if found.least.is_finite() { found.least } else { 0.0 };
        let longest = greater(sqrt(found.longest), sqrt(self.way.square));
        16.0 * f64::EPSILON * (least + longest) + 48.0 * ulp(self.size + self.radius + least)
    }
}

/// The distance of a leg from a piece's core, less the piece's radius, metres, and the square of the length of the
/// core's longest edge. The core's distance is 0 where they cross or the core holds the leg's beginning. Rounded.
fn gap(leg: &SegmentTerms, piece: &Placed) -> (f64, f64) {
    let (square, longest) = squares(leg, piece);
    (sqrt(square) - piece.radius(), longest)
}

/// The squares of a leg's distance from a piece's core, as [`gap`] has it, and of the core's longest edge.
#[inline]
fn squares(leg: &SegmentTerms, piece: &Placed) -> (f64, f64) {
    let core = piece.core();
    if let [a, b] = core {
        let edge = SegmentTerms::new(*a, *b);
        return (edge.squared_distance_to(leg), edge.square);
    }
    let (mut least, mut longest) = (f64::INFINITY, 0.0);
    let mut inside = core.len() > 2;
    for Segment { a, b } in edges(core) {
        let edge = SegmentTerms::new(a, b);
        least = lesser(edge.squared_distance_to(leg), least);
        longest = greater(edge.square, longest);
        inside &= cross(edge.u, leg.a - a) >= 0.0;
    }
    (if inside { 0.0 } else { least }, longest)
}

/// The distance of a point from the boundary of a piece's core, less the piece's radius, metres. Rounded.
fn point_gap(p: Point2, piece: &Placed) -> f64 {
    let core = piece.core();
    let least = match core {
        [a, b] => SegmentTerms::new(*a, *b).squared_distance(p),
        _ => edges(core).fold(f64::INFINITY, |least, e| lesser(SegmentTerms::new(e.a, e.b).squared_distance(p), least)),
    };
    sqrt(least) - piece.radius()
}
