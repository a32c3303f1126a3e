//! What the robots are asked about: configurations, edges between two, arcs of cars.

use motion_lab::collision::{CarChecker, Checker, Collision, Scene};
use motion_lab::geometry::{Footprint, Point2, Pose2};
use motion_lab::prelude::*;

use crate::worlds::{CASES, draws, free_points};

/// Pairs of configurations of a robot, and what judges the edges between them.
pub struct Pairs<R: Robot> {
    pub checker: Checker<R>,
    pub pairs: Vec<[R::Configuration; 2]>,
}

impl<R: Robot> Pairs<R> {
    /// Pairs from free to free.
    fn drawn(checker: Checker<R>, mut draw: impl FnMut(&mut Stream, &R) -> [R::Configuration; 2]) -> Self {
        let mut s = draws("certified edges");
        let drawn = std::iter::repeat_with(|| draw(&mut s, checker.robot()));
        let pairs = drawn.filter(|pair| pair.iter().all(|q| checker.is_free(q))).take(CASES).collect();
        Pairs { checker, pairs }
    }
}

/// Edges of a disc in a square, up to 2 m each way, that begin free.
pub fn disc(scene: Scene, side: f64) -> Pairs<RustyDisc> {
    let starts = free_points(&scene, 0.1 * side, 0.9 * side);
    let checker = Checker::new(scene, RustyDisc::default());
    let mut s = draws("disc edges");
    let edges = starts.iter().cycle().map(|p| {
        let a = R2::new(p.x, p.y);
        [a, R2::new(p.x + s.uniform(-2.0, 2.0), p.y + s.uniform(-2.0, 2.0))]
    });
    let pairs = edges.filter(|[a, _]| checker.is_free(a)).take(CASES).collect();
    Pairs { checker, pairs }
}

/// Edges of an arm, up to 0.5 rad in each joint.
pub fn arm(scene: Scene) -> Pairs<Reach<2>> {
    Pairs::drawn(Checker::new(scene, Reach::<2>::workbench()), |s, arm| {
        let o = Point2::origin();
        let a = arm.sample(o, o, s);
        [a, T2::new(a.0[0] + s.uniform(-0.5, 0.5), a.0[1] + s.uniform(-0.5, 0.5))]
    })
}

/// Edges of a car, up to a metre each way and 0.5 rad.
pub fn car(scene: Scene) -> Pairs<Hitch> {
    let (min, max) = (scene.bounds().min, scene.bounds().max);
    Pairs::drawn(Checker::new(scene, HITCH), |s, car| {
        let a = car.sample(min, max, s);
        let mut b = a;
        b.body = Pose2::new(
            a.body.x + s.uniform(-1.0, 1.0),
            a.body.y + s.uniform(-1.0, 1.0),
            a.body.theta + s.uniform(-0.5, 0.5),
        );
        [a, b]
    })
}

/// Footprints of an arm that meet nothing.
pub fn free_arms(scene: &Scene) -> Vec<Footprint> {
    let arm = Reach::<2>::workbench();
    let mut s = draws("arm");
    let draw = std::iter::repeat_with(|| arm.footprint(&arm.sample(Point2::origin(), Point2::origin(), &mut s)));
    draw.filter(|footprint| !scene.intersects(footprint)).take(CASES).collect()
}

/// Where a car of the Lot drives for a second from, with what command, and where it comes to.
pub type Drives = Vec<(HitchCfg, CarCmd, HitchCfg)>;

/// Drives of a second from free configurations in the Lot, and what judges them.
pub fn drives(car: Hitch) -> (CarChecker, Drives) {
    let lot = CarChecker::new(Scene::lot(), car);
    let (min, max) = (lot.scene().bounds().min, lot.scene().bounds().max);
    let mut draws = Stream::new(Seed(1), "arcs");
    let mut drives = Drives::new();
    while drives.len() < CASES {
        let mut q = car.sample(min, max, &mut draws);
        if let Some(psi) = &mut q.trailer {
            *psi = q.body.theta + draws.uniform(-0.5, 0.5);
        }
        let u = CarCmd { v: if draws.unit() < 0.5 { -1.0 } else { 1.0 }, phi: draws.uniform(-0.6, 0.6) };
        if lot.is_free(&q) {
            drives.push((q, u, car.drive(&q, &u, 1.0).expect("of this car").at(1.0)));
        }
    }
    (lot, drives)
}
