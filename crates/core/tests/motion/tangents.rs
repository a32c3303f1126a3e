//! Motions that graze: exactly tangent, in numbers that hold without rounding. Touching is contact, so every query
//! finds them in contact; moved away by a nanometre, all are free.

use std::f64::consts::FRAC_PI_2;

use motion_lab_core::collision::{Certificate, MarchOptions, Surroundings, march};
use motion_lab_core::geometry::Placed;
use motion_lab_core::num::tan;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{CarBody, TrailerBody};

use oracle::grazing::{Grazed, HAIR, about_a_circle, beside_a_line, outline, round, wall};
use oracle::seen::{Seen, world_of};

fn scene_of(thing: &Seen) -> Scene {
    Scene::of_world(&world_of(std::slice::from_ref(thing), false))
}

/// Checks that no query finds the motion free with the thing in place, and that every query does with it a hair away.
/// `place` maps the thing into the scene.
fn check(at: &str, grazed: &Grazed, place: impl Fn(Point2) -> Point2, free: impl Fn(&Scene) -> Vec<bool>) {
    let Grazed { what, thing, away } = grazed;
    let touched = free(&scene_of(&thing.map(&place)));
    assert!(touched.iter().all(|f| !f), "{what}, {at}: it touches, and is said to be free: {touched:?}");
    let off = free(&scene_of(&thing.map(|p| place(p + away))));
    assert!(off.iter().all(|f| *f), "{what}, {at}: it is a hair off, and not said to be free: {off:?}");
}

/// Whether a motion is free by every query about motions, among obstacles and among the same shapes as other robots.
fn judged<R: Robot>(scene: &Scene, robot: &R, motion: &impl Motion<Configuration = R::Configuration>) -> Vec<bool> {
    let others: Vec<Placed> = scene.pieces().map(|(_, piece)| piece.clone()).collect();
    let nothing = Scene::empty(scene.bounds());
    let (options, mut certificate) = (MarchOptions::default(), Certificate::new());
    let verdicts = [
        Checker::new(scene.clone(), robot.clone()).motion_verdict(motion),
        march(scene, motion, options, None),
        march(scene, motion, options, Some(&mut certificate)),
        march(&Surroundings { scene: &nothing, others: &others }, motion, options, None),
    ];
    verdicts.iter().map(|verdict| verdict.is_free()).collect()
}

/// Whether an edge is free, there and back, by every query about edges.
fn edges<R: Robot>(scene: &Scene, robot: &R, a: R::Configuration, b: R::Configuration) -> Vec<bool> {
    let checker = Checker::new(scene.clone(), robot.clone());
    let mut certificate = Certificate::new();
    let mut free = Vec::new();
    for (from, to) in [(a, b), (b, a)] {
        free.extend(judged(scene, robot, &robot.edge(&from, &to).unwrap()));
        free.push(checker.edge_free(&from, &to));
        free.push(checker.edge(&from, &to).unwrap().is_free());
        free.push(checker.edge_certified(&from, &to, &mut certificate).unwrap().is_free());
    }
    free
}

/// A symmetry of the lattice: an optional mirror in the x axis, then quarter turns.
#[derive(Clone, Copy, Debug)]
struct Symmetry {
    mirror: bool,
    quarters: u8,
}

impl Symmetry {
    fn all() -> impl Iterator<Item = Symmetry> {
        (0..8).map(|i| Symmetry { mirror: i > 3, quarters: i % 4 })
    }

    fn point(self, p: Point2) -> Point2 {
        let y = if self.mirror { -p.y } else { p.y };
        match self.quarters {
            0 => Point2::new(p.x, y),
            1 => Point2::new(-y, p.x),
            2 => Point2::new(-p.x, -y),
            _ => Point2::new(y, -p.x),
        }
    }

    fn angle(self, angle: f64) -> f64 {
        let mirrored = if self.mirror { -angle } else { angle };
        mirrored + f64::from(self.quarters) * FRAC_PI_2
    }
}

#[test]
fn a_disc_that_grazes_on_a_line_touches() {
    for grazed in &beside_a_line() {
        for symmetry in Symmetry::all() {
            // along the lattice, and along its 3-4-5 diagonals, where everything is larger by a quarter; near the
            // origin and far off
            for ((a, b), scale) in [((4.0, 0.0), 1.0), ((4.0, 3.0), 1.25)] {
                for far in [Vector2::new(0.0, 0.0), Vector2::new(1024.0, -768.0)] {
                    let place = |p: Point2| {
                        let q = symmetry.point(p);
                        Point2::new(0.25 * (a * q.x - b * q.y), 0.25 * (b * q.x + a * q.y)) + far
                    };
                    let thing = match &grazed.thing {
                        Seen::Round(core, radius) => Seen::Round(core.clone(), scale * radius),
                        thing => thing.clone(),
                    };
                    let (disc, at) =
                        (RustyDisc { radius: 0.25 * scale }, format!("{symmetry:?}, {scale} times, {far:?}"));
                    let (from, to) = (place(Point2::new(-3.0, 0.0)), place(Point2::new(5.0, 0.0)));
                    let scaled = Grazed { thing, ..*grazed };
                    check(&at, &scaled, place, |scene| edges(scene, &disc, R2(from), R2(to)));
                    let [a, b] = [from, to].map(|p| Footprint::disc(p, disc.radius));
                    assert!(scene_of(&scaled.thing.map(place)).swept(&a, &b), "{}, {at}", grazed.what);
                }
            }
        }
    }
}

#[test]
fn an_arm_whose_tip_grazes_touches() {
    let o = Point2::origin();
    let (one, two, three) = (
        Reach { base: o, lengths: [1.0], link_radius: 0.25 },
        Reach { base: o, lengths: [1.0, 1.0], link_radius: 0.25 },
        Reach { base: o, lengths: [0.5, 0.75, 1.0], link_radius: 0.25 },
    );
    for (i, symmetry) in Symmetry::all().enumerate() {
        let (from, to) = [(-0.4, 1.3), (-0.17, 1.01), (-1.1, 0.95)][i % 3];
        let (a, b) = (symmetry.angle(from), symmetry.angle(to));
        let (place, at) = (|p: Point2| symmetry.point(p), format!("{symmetry:?} from {from} to {to}"));
        for grazed in &about_a_circle(1.25, 2.5) {
            let [q, p] = [a, b].map(|angle| Tn([angle]).wrapped());
            check(&at, grazed, place, |scene| edges(scene, &one, q, p));
            // the sweep of one link is its edge; it may err to contact by a micrometre
            let [f, g] = [q, p].map(|q| one.footprint(&q));
            assert!(scene_of(&grazed.thing.map(place)).swept(&f, &g), "{}, {at}", grazed.what);
            let off = grazed.thing.map(|p| place(p + grazed.away * 2048.0));
            assert!(!scene_of(&off).swept(&f, &g), "{}, two micrometres off, {at}", grazed.what);
        }
        for grazed in &about_a_circle(2.25, 2.5) {
            check(&at, grazed, place, |scene| edges(scene, &two, T2::new(a, 0.0), T2::new(b, 0.0)));
        }
        for grazed in &about_a_circle(2.5, 3.75) {
            let [q, p] = [a, b].map(|angle| Tn([angle, 0.0, 0.0]).wrapped());
            check(&at, grazed, place, |scene| edges(scene, &three, q, p));
        }
        // the second link about the elbow at (1, 0), the first along x
        let (first, sign) = (symmetry.angle(0.0), if symmetry.mirror { -1.0 } else { 1.0 });
        let about_elbow = |p: Point2| place(p + Vector2::new(1.0, 0.0));
        for grazed in about_a_circle(1.25, 2.5).iter().filter(|grazed| grazed.what.ends_with("3-4-5")) {
            let [q, p] = [0.5, to + 0.2].map(|turn| T2::new(first, sign * turn));
            check(&at, grazed, about_elbow, |scene| edges(scene, &two, q, p));
        }
    }
}

#[test]
fn a_car_or_trailer_whose_corner_grazes_on_the_spot_touches() {
    // corners at (3, 4) and (3, -4) from the rear axle; of the trailer at (-4, 3) and (-4, -3) from the hitch
    let car = Hitch { body: CarBody { length: 4.0, width: 8.0, rear_overhang: 1.0 }, ..HITCH };
    let towing = Hitch {
        body: CarBody { length: 1.0, width: 0.5, rear_overhang: 0.5 },
        trailer_body: TrailerBody { front_overhang: 1.0, rear_overhang: 2.0, width: 6.0 },
        hitch_len: Some(2.0),
        ..HITCH
    };
    for symmetry in Symmetry::all().step_by(3) {
        let (place, at) = (|p: Point2| symmetry.point(p), format!("{symmetry:?}"));
        let body = |theta: f64| Pose2::new(0.0, 0.0, symmetry.angle(theta));
        for grazed in &about_a_circle(5.0, 7.5) {
            let [a, b] = [-0.3, 2.2].map(|theta| HitchCfg { body: body(theta), trailer: None });
            check(&at, grazed, place, |scene| edges(scene, &car, a, b));
            // the two corners pass the x axis at 2.498 rad to either side, and the 3-4-5 direction 0.927 rad beyond:
            // all within this half turn
            let [a, b] = [2.3, 4.9].map(|psi| HitchCfg { body: body(0.0), trailer: Some(body(psi).theta) });
            check(&at, grazed, place, |scene| edges(scene, &towing, a, b));
        }
    }
}

/// The things about the circle, moved so that its centre is at `centre`.
fn moved(grazed: &Grazed, centre: Vector2) -> Grazed {
    Grazed { thing: grazed.thing.map(|p| p + centre), ..*grazed }
}

#[test]
fn a_rover_or_a_car_that_grazes_on_an_arc_touches() {
    // a circle of radius 5 about (0, 5): the body reaches out to 6.25 and in to 3.75
    let rover = Rusty { body_radius: 1.25, ..RUSTY };
    let centre = Vector2::new(0.0, 5.0);
    let inward = |what, thing| Grazed { what, thing, away: Vector2::new(-0.75 * HAIR, -HAIR) };
    let mut cases: Vec<Grazed> = about_a_circle(6.25, 7.5).iter().map(|grazed| moved(grazed, centre)).collect();
    cases.extend([
        inward("a disc inside", round(&[(1.5, 7.0)], 1.25)),
        inward("a wall's end inside", wall((0.0, 5.0), (2.25, 8.0))),
        inward("a corner inside", outline(&[(2.25, 8.0), (0.0, 5.0), (1.0, 5.0)])),
        inward("a rounded corner inside", round(&[(1.5, 7.0), (0.0, 6.0), (0.5, 5.5)], 1.25)),
    ]);
    // forward and backward to either side: the arc's images by the mirror and by half a turn
    for (v, omega, quarters, mirror) in
        [(17.5, 3.5, 0, false), (17.5, -3.5, 0, true), (-17.5, 3.5, 2, false), (-17.5, -3.5, 2, true)]
    {
        let symmetry = Symmetry { mirror, quarters };
        let arc = rover.drive(&Pose2::IDENTITY, &RustyCmd { v, omega }, 1.0).unwrap();
        for grazed in &cases {
            let at = format!("at {v} m/s and {omega} rad/s");
            check(&at, grazed, |p| symmetry.point(p), |scene| judged(scene, &rover, &arc));
        }
    }
    // the car turns about (0, 1), and its outer front corner, 3 m ahead and 3 m to the right, goes round at 5 m
    let car = Hitch { wheelbase: tan(0.5), body: CarBody { length: 4.0, width: 6.0, rear_overhang: 1.0 }, ..HITCH };
    let start = HitchCfg { body: Pose2::IDENTITY, trailer: None };
    for (phi, mirror) in [(0.5, false), (-0.5, true)] {
        let symmetry = Symmetry { mirror, quarters: 0 };
        let ahead = car.drive(&start, &CarCmd { v: 2.2, phi }, 1.0).unwrap();
        for grazed in &about_a_circle(5.0, 7.5) {
            let grazed = moved(grazed, Vector2::new(0.0, 1.0));
            check("ahead", &grazed, |p| symmetry.point(p), |scene| judged(scene, &car, &ahead));
        }
        let back = car.drive(&start, &CarCmd { v: -2.2, phi }, 1.0).unwrap();
        let below = Grazed { what: "a wall", thing: wall((-9.0, -4.0), (9.0, -4.0)), away: Vector2::new(0.0, -HAIR) };
        check("back", &below, |p| symmetry.point(p), |scene| judged(scene, &car, &back));
    }
}
