//! The answers of eight intervals at once against those of the ladder alone: of random edges, and of edges that graze
//! an obstacle by anything from a nanometre to a centimetre.
//!
//! The variable `MOTION_LAB_LANES` multiplies the number of edges. At 1 some 28,000 are compared, at 400 more than
//! eleven million.

use std::f64::consts::PI;

use super::rung::decide;
use crate::collision::motion::decide::is_free_by_ladder;
use crate::collision::{Collision, Scene};
use crate::configuration::{Configuration, HitchCfg, Tn};
use crate::geometry::{Aabb, Point2, Pose2, Shape, Vector2, convex_hull};
use crate::random::{Seed, Stream};
use crate::robots::{CarBody, ChartLine, HITCH, Hitch, Motion, Reach, Robot, TrailerBody};

fn times(edges: u64) -> u64 {
    std::env::var("MOTION_LAB_LANES").ok().and_then(|n| n.parse().ok()).unwrap_or(1) * edges
}

/// Where something stands and how large it is, metres: the world's centre, and what a metre is multiplied by.
#[derive(Clone, Copy)]
struct Frame {
    centre: Point2,
    scale: f64,
}

impl Frame {
    fn point(&self, draws: &mut Stream, range: f64) -> Point2 {
        let mut at = || self.scale * draws.uniform(-range, range);
        self.centre + Vector2::new(at(), at())
    }
}

/// Small and large robots, near the origin and far from it.
fn frames() -> Vec<Frame> {
    let at = |x: f64, scale: f64| Frame { centre: Point2::new(x, -0.7 * x), scale };
    vec![at(0.0, 1.0), at(0.0, 1.0), at(1e3, 1.0), at(9e4, 1.0), at(0.0, 0.01), at(3.0, 100.0)]
}

/// A box, a wall, a thick wall, a disc, a polygon or a rounded one, about the origin.
fn obstacle(draws: &mut Stream, scale: f64) -> Shape {
    let kind = draws.below(6);
    let mut side = |least: f64, most: f64| scale * draws.uniform(least, most);
    let p = Point2::new;
    match kind {
        0 => Shape::Rectangle { min: p(-side(0.05, 0.3), -side(0.05, 0.3)), max: p(side(0.05, 0.3), side(0.05, 0.3)) },
        1 => Shape::Segment { a: p(-side(0.05, 0.8), 0.0), b: p(side(0.05, 0.8), side(0.0, 0.1)) },
        2 => Shape::Capsule { a: p(-side(0.05, 0.8), 0.0), b: p(side(0.05, 0.8), 0.0), radius: side(0.01, 0.2) },
        3 => Shape::Disc { radius: side(0.02, 0.4) },
        _ => {
            let corners: Vec<Point2> = (0..7).map(|_| p(side(-0.4, 0.4), side(-0.4, 0.4))).collect();
            let radius = if kind == 4 { 0.0 } else { side(0.01, 0.1) };
            Shape::Hull { vertices: convex_hull(&corners)[..].into(), radius }
        }
    }
}

fn pose(draws: &mut Stream, frame: Frame, range: f64) -> Pose2 {
    let at = frame.point(draws, range);
    Pose2::new(at.x, at.y, draws.uniform(-PI, PI))
}

fn scene(draws: &mut Stream, frame: Frame, range: f64, count: usize) -> Scene {
    let bounds = Aabb { min: frame.centre, max: frame.centre };
    (0..count).fold(Scene::empty(bounds), |scene, _| {
        let (at, shape) = (pose(draws, frame, range), obstacle(draws, frame.scale));
        scene.with_obstacle_at("obstacle", at, shape)
    })
}

/// What was compared.
#[derive(Default)]
struct Compared {
    free: u64,
    hit: u64,
    undecided: u64,
}

impl Compared {
    /// Compares one edge; where it is called free, no place of many along it is in contact.
    fn compare<R: Robot>(&mut self, scene: &Scene, edge: &ChartLine<R>) {
        let sure = decide(scene, &edge.linkage().unwrap());
        let Some(free) = sure else {
            self.undecided += 1;
            return;
        };
        let at = || format!("{:?} in {:?}", edge, scene.pieces().collect::<Vec<_>>());
        assert_eq!(free, is_free_by_ladder(scene, edge), "{}", at());
        if !free {
            self.hit += 1;
            return;
        }
        self.free += 1;
        if self.free.is_multiple_of(8) {
            let touched = (0..=100).any(|i| scene.intersects(&edge.footprint_at(f64::from(i) / 100.0)));
            assert!(!touched, "{}", at());
        }
    }

    fn edges(&self) -> u64 {
        self.free + self.hit + self.undecided
    }
}

/// An edge whose least clearance from the shape is about `gap`, or that overlaps it by as much: the shape is moved
/// along the line between the nearest points.
fn grazing<R: Robot>(draws: &mut Stream, frame: Frame, edge: &ChartLine<R>, gap: f64) -> Option<Scene> {
    let (at, shape) = (pose(draws, frame, 2.5), obstacle(draws, frame.scale));
    let empty = Scene::empty(Aabb { min: frame.centre, max: frame.centre });
    let alone = empty.clone().with_obstacle_at("obstacle", at, shape.clone());
    let distance = |s: f64| alone.distance(&edge.footprint_at(s));
    let (mut nearest, mut width) = (0.5, 0.5);
    while width > 1e-6 {
        let tried = (-10..=10).map(|i| (nearest + width * f64::from(i) / 10.0).clamp(0.0, 1.0));
        nearest = tried.min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap();
        width *= 0.2;
    }
    let witness = alone.witness(&edge.footprint_at(nearest))?;
    if witness.dist == 0.0 {
        return None;
    }
    let by = (witness.on_robot - witness.on_obstacle) * ((witness.dist - gap) / witness.dist);
    Some(empty.with_obstacle_at("obstacle", Pose2 { x: at.x + by.x, y: at.y + by.y, ..at }, shape))
}

/// Compares random edges of a robot among a few obstacles, then edges that graze one.
fn compare<R: Robot>(
    name: &str,
    range: f64,
    robot: impl Fn(Frame) -> R,
    draw: impl Fn(&mut Stream, Frame) -> [R::Configuration; 2],
) {
    let mut draws = Stream::new(Seed(40), name);
    let (mut random, mut near) = (Compared::default(), Compared::default());
    for _ in 0..times(5) {
        for frame in frames() {
            let robot = robot(frame);
            let count = draws.below(12) as usize;
            let scene = scene(&mut draws, frame, range, count);
            for i in 0..200 {
                let [a, b] = draw(&mut draws, frame);
                let b = a.interpolate(&b, [1.0, 0.3, 0.1, 0.01][i % 4]).unwrap();
                random.compare(&scene, &robot.edge(&a, &b).unwrap());
            }
            for i in 0..40 {
                let [a, b] = draw(&mut draws, frame);
                let b = a.interpolate(&b, [1.0, 0.3, 0.1, 0.01][i % 4]).unwrap();
                let edge = robot.edge(&a, &b).unwrap();
                let size = [0.0, 1e-9, 1e-7, 1e-5, 3e-5, 1e-4, 1e-3, 1e-2][draws.below(8) as usize];
                let gap = frame.scale * size * draws.uniform(-1.0, 1.0);
                if let Some(scene) = grazing(&mut draws, frame, &edge, gap) {
                    near.compare(&scene, &edge);
                }
            }
        }
    }
    let counts = |of: &Compared| format!("{} free, {} hit, {} undecided", of.free, of.hit, of.undecided);
    println!("{name}: random {}; near {}", counts(&random), counts(&near));
    assert!(random.free > 300 && random.hit > 300, "{name}: random {}", counts(&random));
    assert!(20 * random.undecided < random.edges(), "{name}: random {}", counts(&random));
    assert!(near.free > 50 && near.hit > 25, "{name}: near {}", counts(&near));
}

fn angles<const N: usize>(draws: &mut Stream) -> Tn<N> {
    Tn([0.0; N].map(|_: f64| draws.uniform(-PI, PI)))
}

#[test]
fn an_arm_of_two_links_is_answered_as_by_the_ladder() {
    let arm = |frame: Frame| Reach {
        base: frame.centre,
        lengths: [frame.scale, 0.8 * frame.scale],
        link_radius: 0.03 * frame.scale,
    };
    compare("reach", 2.0, arm, |draws, _| [angles::<2>(draws), angles(draws)]);
}

#[test]
fn bare_links_and_arms_of_three_are_answered_as_by_the_ladder() {
    let arm = |frame: Frame| Reach {
        base: frame.centre,
        lengths: [0.6, 0.5, 0.4].map(|l| l * frame.scale),
        link_radius: 0.0,
    };
    compare("reach3", 1.6, arm, |draws, _| [angles::<3>(draws), angles(draws)]);
}

fn car(scale: f64) -> Hitch {
    let CarBody { length, width, rear_overhang } = HITCH.body;
    let TrailerBody { front_overhang, rear_overhang: behind, width: wide } = HITCH.trailer_body;
    Hitch {
        body: CarBody { length: length * scale, width: width * scale, rear_overhang: rear_overhang * scale },
        trailer_body: TrailerBody {
            front_overhang: front_overhang * scale,
            rear_overhang: behind * scale,
            width: wide * scale,
        },
        ..HITCH
    }
}

fn places(draws: &mut Stream, frame: Frame, tows: bool) -> [HitchCfg; 2] {
    let body = pose(draws, frame, 4.0);
    let mut turn = || draws.uniform(-1.5, 1.5);
    let (psi, then) = (
        body.theta + turn(),
        Pose2::new(body.x + frame.scale * turn(), body.y + frame.scale * turn(), body.theta + turn()),
    );
    let to = HitchCfg { body: then, trailer: tows.then_some(psi + turn()) };
    [HitchCfg { body, trailer: tows.then_some(psi) }, to]
}

#[test]
fn a_car_and_a_trailer_are_answered_as_by_the_ladder() {
    compare("car", 6.0, |frame| car(frame.scale), |draws, frame| places(draws, frame, false));
    let towing = |frame: Frame| Hitch { hitch_len: Some(2.0 * frame.scale), ..car(frame.scale) };
    compare("trailer", 6.0, towing, |draws, frame| places(draws, frame, true));
}

/// What is said of an edge of a bare link of one metre that stays where it is, along the x axis, in this scene.
fn at_rest(radius: f64, obstacle: Shape) -> Option<bool> {
    let arm = Reach { base: Point2::origin(), lengths: [1.0], link_radius: radius };
    let edge = arm.edge(&Tn([0.0]), &Tn([0.0])).unwrap();
    decide(&Scene::empty(Aabb::new(Point2::origin(), Point2::origin())).with_obstacle("it", obstacle), &edge.linkage()?)
}

#[test]
fn what_is_near_the_border_is_left_to_the_ladder() {
    let p = Point2::new;
    let wall = |y: f64| Shape::Rectangle { min: p(-1.0, y), max: p(2.0, y + 0.5) };
    let post = |y: f64| Shape::Rectangle { min: p(0.4, y), max: p(0.6, y + 3.0) };
    let ball = |y: f64| Shape::Hull { vertices: [p(0.5, y + 0.25)].into(), radius: 0.25 };
    let rail = |y: f64| Shape::Capsule { a: p(-0.5, y + 0.1), b: p(1.5, y + 0.1), radius: 0.1 };
    // off the end of the link, which reaches to 1 m
    let ahead = |y: f64| Shape::Rectangle { min: p(1.0 + y, -0.1), max: p(1.5 + y, 0.1) };
    for (shape, radius) in
        [(&wall as &dyn Fn(f64) -> Shape, 0.0), (&post, 0.0), (&wall, 0.25), (&ball, 0.25), (&rail, 0.0)]
    {
        let answers = [1e-3, 1e-5, 0.0, -1e-5, -1e-3].map(|gap| at_rest(radius, shape(radius + gap)));
        assert_eq!(answers, [Some(true), None, None, None, Some(false)], "{:?}", shape(0.0));
    }
    let answers = [0.031, 0.029, 0.0, -1e-5, -1e-3].map(|gap| at_rest(0.03, ahead(gap)));
    assert_eq!(answers, [Some(true), None, None, None, Some(false)], "its round end is left to the ladder");
}

#[test]
fn what_is_no_valid_shape_is_left_to_the_ladder() {
    let (p, bounds) = (Point2::new, Aabb::new(Point2::origin(), Point2::origin()));
    let arm = Reach { base: p(0.0, 0.0), lengths: [1.0, 1.0], link_radius: 0.1 };
    let of = |arm: Reach<2>, scene: &Scene| decide(scene, &arm.edge_linkage(&Tn([0.0; 2]), &Tn([0.1; 2]))?);
    let empty = Scene::empty(bounds);
    assert_eq!(of(arm, &empty), Some(true));
    for bad in [f64::NAN, f64::INFINITY, 1e7] {
        for arm in [
            Reach { base: p(bad, 0.0), ..arm },
            Reach { base: p(0.0, bad), ..arm },
            Reach { lengths: [bad, 1.0], ..arm },
            Reach { lengths: [1.0, bad], ..arm },
            Reach { link_radius: bad, ..arm },
        ] {
            assert_eq!(of(arm, &empty), None, "{arm:?}");
        }
    }
    assert_eq!(of(Reach { link_radius: -0.1, ..arm }, &empty), None);
    let towing = Hitch { trailer_body: TrailerBody { rear_overhang: f64::NAN, ..HITCH.trailer_body }, ..HITCH };
    let q = HitchCfg { body: Pose2::IDENTITY, trailer: Some(0.0) };
    assert_eq!(decide(&empty, &towing.with_trailer().edge_linkage(&q, &q).unwrap()), None);
    // a dart is no convex polygon, and neither is a star, though it turns left at every corner
    let dart = [p(8.0, 8.0), p(9.0, 8.2), p(8.3, 8.3), p(8.2, 9.0)];
    let star = [0, 2, 4, 1, 3].map(|k| {
        let (sin, cos) = crate::num::sin_cos(f64::from(k) * 0.4 * PI);
        p(9.0 + cos, 9.0 + sin)
    });
    for corners in [&dart[..], &star[..]] {
        assert_eq!(
            of(arm, &empty.clone().with_obstacle("bent", Shape::Hull { vertices: corners.into(), radius: 0.0 })),
            None
        );
    }
    for radius in [f64::NAN, -1.0, 1e7] {
        assert_eq!(
            of(arm, &empty.clone().with_obstacle_at("bad", Pose2::new(9.0, 9.0, 0.0), Shape::Disc { radius })),
            None
        );
    }
}
