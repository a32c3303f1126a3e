//! Shapes and scenes for several tests.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use motion_lab_core::collision::Scene;
use motion_lab_core::geometry::{Aabb, Footprint, Part, Placed, Point2, Pose2, Shape, convex_hull};
use motion_lab_core::num::sin_cos;
use motion_lab_core::random::Stream;
use motion_lab_core::worlds::{Obstacle, ObstacleKind, World};

/// The kinds of shapes of robots and worlds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Disc,
    Segment,
    Capsule,
    Rectangle,
    Polygon,
}

pub const KINDS: [Kind; 5] = [Kind::Disc, Kind::Segment, Kind::Capsule, Kind::Rectangle, Kind::Polygon];

/// A random kind.
pub fn random_kind(s: &mut Stream) -> Kind {
    KINDS[s.below(5) as usize]
}

/// A shape in its frame and the frame's pose: a part of a footprint, or an obstacle.
pub type Body = (Pose2, Shape);

pub const PLANE: Aabb = Aabb { min: Point2::new(-50.0, -50.0), max: Point2::new(50.0, 50.0) };

/// A shape with integer vertices and radius, so that contact is a question about integers.
#[derive(Clone, Debug)]
pub struct LatticeShape {
    pub kind: Kind,
    /// A disc's centre, two ends, two opposite corners, or a polygon's corners.
    pub points: Vec<[i32; 2]>,
    pub radius: i32,
}

impl LatticeShape {
    /// The same shape with every vertex mapped by `f`, which must keep right angles along the axes.
    pub fn map(&self, f: impl Fn([i32; 2]) -> [i32; 2]) -> Self {
        LatticeShape { points: self.points.iter().map(|p| f(*p)).collect(), ..self.clone() }
    }

    pub fn shifted(&self, by: [i32; 2]) -> Self {
        self.map(|p| [p[0] + by[0], p[1] + by[1]])
    }

    /// The shape on a lattice of step `unit` (a power of two). The frame sits at the first vertex, unturned, so that no
    /// vertex is rounded on its way into the world.
    pub fn body(&self, unit: f64) -> Body {
        let at = self.points[0];
        let p = |i: usize| {
            let d = [self.points[i][0] - at[0], self.points[i][1] - at[1]];
            Point2::new(f64::from(d[0]) * unit, f64::from(d[1]) * unit)
        };
        let radius = f64::from(self.radius) * unit;
        let shape = match self.kind {
            Kind::Disc => Shape::try_disc(radius).unwrap(),
            Kind::Segment => Shape::try_segment(p(0), p(1)).unwrap(),
            Kind::Capsule => Shape::try_capsule(p(0), p(1), radius).unwrap(),
            Kind::Rectangle => Shape::try_rectangle(p(0), p(1)).unwrap(),
            Kind::Polygon => Shape::try_polygon(&(0..self.points.len()).map(p).collect::<Vec<_>>()).unwrap(),
        };
        (Pose2 { x: f64::from(at[0]) * unit, y: f64::from(at[1]) * unit, theta: 0.0 }, shape)
    }
}

/// A random shape on the integer points of `[-range, range]^2`.
pub fn lattice_shape(s: &mut Stream, kind: Kind, range: i32) -> LatticeShape {
    let coordinate = |s: &mut Stream| s.below(2 * range as u64 + 1) as i32 - range;
    let point = |s: &mut Stream| [coordinate(s), coordinate(s)];
    let radius = match kind {
        Kind::Disc => 1 + s.below(5) as i32,
        Kind::Capsule => s.below(6) as i32,
        _ => 0,
    };
    loop {
        let points: Vec<[i32; 2]> = match kind {
            Kind::Disc => vec![point(s)],
            Kind::Segment | Kind::Capsule | Kind::Rectangle => vec![point(s), point(s)],
            Kind::Polygon => {
                let cloud: Vec<Point2> = (0..3 + s.below(5))
                    .map(|_| point(s))
                    .map(|p| Point2::new(f64::from(p[0]), f64::from(p[1])))
                    .collect();
                convex_hull(&cloud).iter().map(|p| [p.x as i32, p.y as i32]).collect()
            }
        };
        let sound = match kind {
            Kind::Disc => true,
            Kind::Segment | Kind::Capsule => points[0] != points[1],
            Kind::Rectangle => points[0][0] != points[1][0] && points[0][1] != points[1][1],
            Kind::Polygon => points.len() > 2,
        };
        if sound {
            return LatticeShape { kind, points, radius };
        }
    }
}

/// A random shape, turned and placed anywhere in `[-range, range]^2`.
pub fn random_body(s: &mut Stream, kind: Kind, range: f64) -> Body {
    let pose = Pose2::new(s.uniform(-range, range), s.uniform(-range, range), s.uniform(-PI, PI));
    let length = s.uniform(0.05, 2.0);
    let radius = s.uniform(0.01, 0.8);
    let point = |x, y| Point2::new(x, y);
    let shape = match kind {
        Kind::Disc => Shape::try_disc(radius),
        Kind::Segment => Shape::try_segment(point(0.0, 0.0), point(length, s.uniform(-1.0, 1.0))),
        Kind::Capsule => Shape::try_capsule(point(0.0, 0.0), point(length, 0.0), 0.3 * radius),
        Kind::Rectangle => Shape::try_rectangle(point(-0.3 * length, -radius), point(length, radius)),
        Kind::Polygon => Shape::try_polygon(&convex_corners(s, length)),
    };
    (pose, shape.unwrap())
}

/// The corners of a convex polygon inscribed in an ellipse, counter-clockwise.
pub fn convex_corners(s: &mut Stream, size: f64) -> Vec<Point2> {
    let n = 3 + s.below(5);
    let (start, flat) = (s.uniform(0.0, TAU), s.uniform(0.3, 1.0));
    (0..n)
        .map(|k| {
            let angle = start + TAU * (k as f64 + s.uniform(0.0, 0.8)) / n as f64;
            let (sin, cos) = sin_cos(angle);
            Point2::new(size * cos, flat * size * sin)
        })
        .collect()
}

/// The footprint made of these bodies.
pub fn footprint_of(bodies: &[Body]) -> Footprint {
    Footprint::new(bodies.iter().map(|(pose, shape)| Part::new(*pose, shape.clone())))
}

/// The scene with each of these bodies as an obstacle, in this order.
pub fn scene_of(bodies: &[Body]) -> Scene {
    let obstacles = bodies
        .iter()
        .enumerate()
        .map(|(i, body)| Obstacle::new(format!("obstacle {i}"), ObstacleKind::Solid, vec![body.clone()]));
    Scene::of_world(&World {
        name: "fixture".into(),
        bounds: PLANE,
        obstacles: obstacles.collect(),
        doors: vec![],
        routes: vec![],
        places: vec![],
        marks: vec![],
        robots: vec![],
    })
}

/// The Apartment.
pub fn apartment() -> Scene {
    Scene::of_world(&World::apartment())
}

/// The Workbench.
pub fn workbench() -> Scene {
    Scene::of_world(&World::workbench())
}

/// The Lot.
pub fn lot() -> Scene {
    Scene::of_world(&World::lot())
}

/// The body as a placed shape.
pub fn placed(body: &Body) -> Placed {
    body.1.place(&body.0)
}

/// The number in the environment variable `name`, or `count` where it is not set.
pub fn count_from_env(name: &str, count: u64) -> u64 {
    std::env::var(name).ok().map_or(count, |text| text.parse().unwrap_or_else(|_| panic!("{name} must be a number")))
}

/// The text of a world of `n` rovers a metre apart, `wide` in a row, and as many walls as rows.
pub fn grid(n: usize, wide: usize) -> String {
    let rows = n.div_ceil(wide);
    let mut text = format!(
        "World(\n    version: 1,\n    name: \"crowd\",\n    bounds: (min: (-1, -1), max: ({wide}, {rows})),\n    walls: [\n"
    );
    for row in 0..rows {
        let y = row as f64 + 0.5;
        writeln!(text, "        (name: \"wall of row {row}\", points: [(-0.5, {y}), ({wide}.5, {y})]),").unwrap();
    }
    text += "    ],\n    robots: [\n";
    for k in 0..n {
        let (x, y) = (k % wide, k / wide);
        writeln!(text, "        (name: \"rover {k}\", kind: \"rusty\", start: [{x}, {y}, 0]),").unwrap();
    }
    text + "    ],\n)\n"
}
