//! The worlds of the table, random but the same at every run.

use std::f64::consts::PI;

use motion_lab::collision::{Collision, Scene};
use motion_lab::geometry::{Aabb, Footprint, Placed, Point2, Pose2, Segment, Shape};
use motion_lab::num;
use motion_lab::random::{Seed, Stream};
use motion_lab::worlds::{Obstacle, ObstacleKind, World};

/// Number of poses, configurations or edges that a row goes through.
pub const CASES: usize = 256;

pub fn draws(name: &str) -> Stream {
    Stream::new(Seed(7), name)
}

/// Walls of 0.2 to `longest` metres in a square.
pub fn walls(count: usize, side: f64, longest: f64) -> Scene {
    Scene::of_walls(&wall_segments(count, side, longest))
}

/// The segments of [`walls`].
pub fn wall_segments(count: usize, side: f64, longest: f64) -> Vec<Segment> {
    let mut s = draws("walls");
    (0..count)
        .map(|_| {
            let a = Point2::new(s.uniform(0.0, side), s.uniform(0.0, side));
            let (sin, cos) = num::sin_cos(s.uniform(-PI, PI));
            let length = s.uniform(0.2, longest);
            Segment::new(a, Point2::new(a.x + length * cos, a.y + length * sin))
        })
        .collect()
}

/// Boxes of 0.1 to 0.5 m at random headings, one per square metre of a square about the origin, and none within `clear`
/// metres of the origin.
pub fn boxes(count: usize, clear: f64) -> Scene {
    let half = 0.5 * (count as f64).sqrt();
    let mut s = draws("boxes");
    let mut pieces = Vec::new();
    while pieces.len() < count {
        let pose = Pose2::new(s.uniform(-half, half), s.uniform(-half, half), s.uniform(-PI, PI));
        let (w, h) = (s.uniform(0.05, 0.25), s.uniform(0.05, 0.25));
        if num::hypot(pose.x, pose.y) > clear + 0.4 {
            let shape = Shape::try_rectangle(Point2::new(-w, -h), Point2::new(w, h)).expect("a rectangle");
            pieces.push((pose, shape));
        }
    }
    let corner = Point2::new(half, half);
    let obstacles = pieces
        .into_iter()
        .enumerate()
        .map(|(i, piece)| Obstacle::new(format!("box {i}"), ObstacleKind::Solid, vec![piece]));
    Scene::of_world(&World {
        name: "boxes".into(),
        bounds: Aabb { min: Point2::new(-half, -half), max: corner },
        obstacles: obstacles.collect(),
        doors: vec![],
        routes: vec![],
        places: Vec::new(),
        marks: Vec::new(),
        robots: Vec::new(),
    })
}

/// The arm's scenes by their numbers of obstacles.
pub fn arm_scenes() -> Vec<(usize, Scene)> {
    vec![(3, Scene::workbench()), (100, boxes(100, 0.2)), (10_000, boxes(10_000, 0.2))]
}

/// Rectangles of 0.2 to 2 m a side at random headings in a square.
pub fn rectangles(count: usize, side: f64) -> Vec<(Pose2, Point2, Point2)> {
    let mut s = draws("rectangles");
    let mut rectangle = || {
        let pose = Pose2::new(s.uniform(0.0, side), s.uniform(0.0, side), s.uniform(-PI, PI));
        let (w, h) = (s.uniform(0.1, 1.0), s.uniform(0.1, 1.0));
        (pose, Point2::new(-w, -h), Point2::new(w, h))
    };
    (0..count).map(|_| rectangle()).collect()
}

pub fn pieces(scene: &Scene) -> impl Iterator<Item = &Placed> {
    scene.pieces().map(|(_, piece)| piece)
}

/// Poses at points more than 2 cm from all obstacles.
pub fn free_points(scene: &Scene, from: f64, to: f64) -> Vec<Pose2> {
    let mut s = draws("points");
    let mut points = Vec::new();
    while points.len() < CASES {
        let pose = Pose2::new(s.uniform(from, to), s.uniform(from, to), s.uniform(-PI, PI));
        if !scene.intersects(&Footprint::disc(pose.position(), 0.02)) {
            points.push(pose);
        }
    }
    points
}
