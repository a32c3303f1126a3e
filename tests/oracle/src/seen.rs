//! Scans of things as written, by rays cast by the textbook: Cramer's rule and clipping at half-planes, instead of the
//! library's pieces, segments and discs.

use std::f64::consts::TAU;

use motion_lab_core::geometry::Placed;
use motion_lab_core::num::{sin_cos, sqrt};
use motion_lab_core::prelude::*;
use motion_lab_core::worlds::SourceShape;

use crate::plain::{inside_by_crossings, point_distance};

/// A thing as written, in world coordinates.
#[derive(Clone, Debug)]
pub enum Seen {
    /// A wall.
    Wall(Point2, Point2),
    /// A polygon by its corners, convex or not.
    Outline(Vec<Point2>),
    /// All points within a radius of the convex polygon with these corners, counter-clockwise. One corner gives a disc,
    /// two a capsule.
    Round(Vec<Point2>, f64),
}

fn least(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

fn cross(u: Vector2, v: Vector2) -> f64 {
    u.x * v.y - u.y * v.x
}

/// The sides of a polygon; one segment for two corners, none for one.
fn sides(corners: &[Point2]) -> impl Iterator<Item = (Point2, Point2)> + '_ {
    let n = corners.len();
    (0..if n > 2 { n } else { n - 1 }).map(move |i| (corners[i], corners[(i + 1) % n]))
}

/// The distance along the ray to a segment, by Cramer's rule. A parallel segment is never met.
fn meets_side(o: Point2, d: Vector2, (a, b): (Point2, Point2)) -> f64 {
    let (u, w) = (b - a, a - o);
    let det = cross(d, u);
    let (t, s) = (cross(w, u) / det, cross(w, d) / det);
    if t >= 0.0 && (0.0..=1.0).contains(&s) { t } else { f64::INFINITY }
}

/// The distance along the ray to a convex counter-clockwise polygon, by clipping at its half-planes (Cyrus and Beck,
/// 1978).
fn enters(o: Point2, d: Vector2, corners: &[Point2]) -> f64 {
    let (mut from, mut to) = (0.0, f64::INFINITY);
    for (a, b) in sides(corners) {
        let (inside, rate) = (cross(b - a, o - a), cross(b - a, d));
        let at = -inside / rate;
        if rate > 0.0 && at > from {
            from = at;
        } else if rate < 0.0 && at < to {
            to = at;
        } else if rate == 0.0 && inside < 0.0 {
            return f64::INFINITY;
        }
    }
    if from <= to { from } else { f64::INFINITY }
}

/// The distance along the ray to a disc, by Pythagoras.
fn enters_disc(o: Point2, d: Vector2, centre: Point2, radius: f64) -> f64 {
    let (along, across) = ((centre - o).dot(&d), cross(centre - o, d));
    let half = radius * radius - across * across;
    if along > 0.0 && half >= 0.0 { along - sqrt(half) } else { f64::INFINITY }
}

impl Seen {
    /// The distance along the ray of this direction, from outside, to the thing; infinity for a miss.
    fn met(&self, o: Point2, d: Vector2) -> f64 {
        match self {
            Seen::Wall(a, b) => meets_side(o, d, (*a, *b)),
            Seen::Outline(corners) => sides(corners).fold(f64::INFINITY, |m, side| least(m, meets_side(o, d, side))),
            Seen::Round(core, radius) => {
                // a disc about every corner, a strip along every side, and the polygon itself
                let mut met = core.iter().fold(f64::INFINITY, |m, c| least(m, enters_disc(o, d, *c, *radius)));
                for (a, b) in sides(core) {
                    let normal = Vector2::new(a.y - b.y, b.x - a.x) * (radius / (b - a).norm());
                    met = least(met, enters(o, d, &[a - normal, b - normal, b + normal, a + normal]));
                }
                if core.len() > 2 { least(met, enters(o, d, core)) } else { met }
            }
        }
    }

    /// Whether a point is in the thing.
    pub fn holds(&self, p: Point2) -> bool {
        match self {
            Seen::Wall(..) => false,
            Seen::Outline(corners) => inside_by_crossings(corners, p),
            Seen::Round(core, radius) => point_distance(p, &Placed::new(core.clone(), *radius)) == 0.0,
        }
    }

    /// The thing with every point mapped.
    pub fn map(&self, f: impl Fn(Point2) -> Point2) -> Self {
        let all = |points: &[Point2]| points.iter().map(|p| f(*p)).collect();
        match self {
            Seen::Wall(a, b) => Seen::Wall(f(*a), f(*b)),
            Seen::Outline(corners) => Seen::Outline(all(corners)),
            Seen::Round(core, radius) => Seen::Round(all(core), *radius),
        }
    }

    /// The thing as a shape in a frame; it must be convex.
    pub fn body(&self) -> (Pose2, Shape) {
        let shape = match self {
            Seen::Wall(a, b) => Shape::try_segment(*a, *b),
            Seen::Outline(corners) => Shape::try_polygon(corners),
            Seen::Round(core, radius) => match core[..] {
                [c] => return (Pose2 { x: c.x, y: c.y, theta: 0.0 }, Shape::try_disc(*radius).unwrap()),
                [a, b] => Shape::try_capsule(a, b, *radius),
                _ => Ok(Shape::Hull { vertices: core[..].into(), radius: *radius }),
            },
        };
        (Pose2::IDENTITY, shape.unwrap())
    }

    /// The points of a wall, or the shape, as text of a world file.
    fn written(&self) -> String {
        let list =
            |points: &[Point2]| points.iter().map(|p| format!("({:?}, {:?})", p.x, p.y)).collect::<Vec<_>>().join(", ");
        match self {
            Seen::Wall(a, b) => list(&[*a, *b]),
            Seen::Outline(corners) => format!("Polygon([{}])", list(corners)),
            Seen::Round(core, radius) if core.len() == 1 => format!("Disc(center: {}, radius: {radius:?})", list(core)),
            Seen::Round(core, radius) => format!("Rounded(points: [{}], radius: {radius:?})", list(core)),
        }
    }
}

/// The world with these things: each an obstacle of its own, or with `union` all but the walls as one union.
pub fn world_of(things: &[Seen], union: bool) -> World {
    let (walls, solids): (Vec<&Seen>, Vec<&Seen>) = things.iter().partition(|t| matches!(t, Seen::Wall(..)));
    let items = |list: Vec<String>, field: &str| -> String {
        list.iter().enumerate().map(|(i, text)| format!("(name: \"{field} {i}\", {field}: {text}),")).collect()
    };
    let walls = walls.iter().map(|w| format!("[{}]", w.written())).collect();
    let solids: Vec<String> = solids.iter().map(|s| s.written()).collect();
    let solids = if union && !solids.is_empty() { vec![format!("Union([{}])", solids.join(", "))] } else { solids };
    let text = format!(
        "World(version: 1, name: \"things\", bounds: (min: (-9, -9), max: (9, 9)), walls: [{}], obstacles: [{}])",
        items(walls, "points"),
        items(solids, "shape")
    );
    World::parse("things.ron", &text).unwrap()
}

/// The things of a world, as written.
pub fn things_of(world: &World) -> Vec<Seen> {
    let piece = |pose: &Pose2, shape: &Shape| {
        let (sin, cos) = sin_cos(pose.theta);
        let at = |p: &Point2| Point2::new(pose.x + cos * p.x - sin * p.y, pose.y + sin * p.x + cos * p.y);
        match shape {
            Shape::Disc { radius } => Seen::Round(vec![pose.position()], *radius),
            Shape::Segment { a, b } => Seen::Wall(at(a), at(b)),
            Shape::Capsule { a, b, radius } => Seen::Round(vec![at(a), at(b)], *radius),
            Shape::Rectangle { min, max } => {
                let corners = [(min.x, min.y), (max.x, min.y), (max.x, max.y), (min.x, max.y)];
                Seen::Outline(corners.iter().map(|&(x, y)| at(&Point2::new(x, y))).collect())
            }
            Shape::Polygon(polygon) => Seen::Outline(polygon.vertices().iter().map(at).collect()),
            Shape::Hull { vertices, radius } => Seen::Round(vertices.iter().map(at).collect(), *radius),
        }
    };
    let written = world.obstacles.iter().flat_map(|obstacle| obstacle.written());
    let thing = |written: SourceShape<'_>| match written {
        SourceShape::Outline(points) => Seen::Outline(points.to_vec()),
        SourceShape::Piece((pose, shape)) => piece(pose, shape),
    };
    written.map(thing).collect()
}

/// Number of kinds of things: wall, rectangle, convex and concave polygon, disc, capsule, rounded polygon, union.
pub const KINDS: usize = 8;
pub const CONCAVE: usize = 3;
pub const UNION: usize = 7;

/// A thing of a kind, about as large as `size`, in a frame.
pub fn thing(kind: usize, frame: &Pose2, size: f64) -> Vec<Seen> {
    let (sin, cos) = sin_cos(frame.theta);
    let at = |(x, y): (f64, f64)| {
        let (x, y) = (size * x, size * y);
        Point2::new(frame.x + cos * x - sin * y, frame.y + sin * x + cos * y)
    };
    let all = |corners: &[(f64, f64)]| corners.iter().map(|c| at(*c)).collect::<Vec<_>>();
    let rectangle = || Seen::Outline(all(&[(-0.9, -0.3), (0.8, -0.3), (0.8, 0.5), (-0.9, 0.5)]));
    let capsule = || Seen::Round(all(&[(-0.9, 0.0), (0.9, 0.2)]), 0.25 * size);
    let one = match kind {
        0 => Seen::Wall(at((-1.0, 0.1)), at((0.9, -0.2))),
        1 => rectangle(),
        2 => Seen::Outline(all(&[(-0.8, -0.6), (0.5, -0.7), (1.0, 0.1), (0.2, 0.9), (-0.7, 0.5)])),
        CONCAVE => {
            let (outside, bay) = (
                [(-1.0, -0.7), (1.0, -0.7), (1.0, 0.8), (0.5, 0.8)],
                [(0.5, -0.2), (-0.4, -0.2), (-0.4, 0.6), (-1.0, 0.6)],
            );
            let mut corners = all(&[outside, bay].concat());
            if frame.theta > 0.0 {
                corners.reverse(); // a file may have either orientation
            }
            Seen::Outline(corners)
        }
        4 => Seen::Round(vec![at((0.0, 0.0))], 0.7 * size),
        5 => capsule(),
        6 => Seen::Round(all(&[(-0.7, -0.5), (0.8, -0.3), (0.1, 0.7)]), 0.3 * size),
        _ => {
            let above = capsule().map(|p| p + Vector2::new(0.0, size));
            return vec![rectangle(), Seen::Round(vec![at((0.9, 0.4))], 0.5 * size), above];
        }
    };
    vec![one]
}

/// The counts of some scans, ray by ray.
#[derive(Debug, Default)]
pub struct Tally {
    pub rays: usize,
    pub hits: usize,
    /// Rays whose range differs a nanoradian aside.
    pub grazed: usize,
    /// Rays from inside something.
    pub inside: usize,
}

/// The distance to the first thing on the ray of this bearing, metres; infinity for none.
pub fn cast(things: &[Seen], o: Point2, bearing: f64) -> f64 {
    let (sin, cos) = sin_cos(bearing);
    things.iter().fold(f64::INFINITY, |m, t| least(m, t.met(o, Vector2::new(cos, sin))))
}

/// Checks a scan ray by ray. A ray that grazes a corner may read any range between those a nanoradian to either side.
pub fn check(things: &[Seen], max_range: f64, pose: &Pose2, ranges: &[f64], tally: &mut Tally) {
    let o = pose.position();
    tally.rays += ranges.len();
    if things.iter().any(|t| t.holds(o)) {
        tally.inside += ranges.len();
        assert!(ranges.iter().all(|r| *r == 0.0), "inside, from {pose:?} at {things:?}: {ranges:?}");
        return;
    }
    for (k, &range) in ranges.iter().enumerate() {
        let bearing = pose.theta + TAU * k as f64 / ranges.len() as f64;
        let met = [-1e-9, 0.0, 1e-9].map(|aside| cast(things, o, bearing + aside));
        let (near, far) =
            (met.into_iter().fold(f64::INFINITY, least), met.into_iter().fold(0.0, |m, t| -least(-m, -t)));
        let slack = 1e-9 * (1.0 + range);
        let right = if range.is_infinite() {
            far > max_range * (1.0 - 1e-9)
        } else {
            near - slack <= range && range <= far + slack && range <= max_range * (1.0 + 1e-9)
        };
        assert!(right, "ray {k} of {} from {pose:?} reads {range}, not {near} to {far}: {things:?}", ranges.len());
        tally.hits += usize::from(range.is_finite());
        tally.grazed += usize::from(near.is_finite() && far - near > 1e-6 * (1.0 + near));
    }
}
