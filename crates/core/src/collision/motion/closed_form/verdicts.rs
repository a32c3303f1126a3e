//! Verdicts in closed form: discs on lines and arcs, and parts that move without turning.

use super::disc_line::DiscLine;
use super::first_contact::{arc_clearance, arc_meets, translation_meets};
use crate::collision::motion::conservative_advancement::BRACKET;
use crate::collision::motion::place::At;
use crate::collision::motion::step::step_clearance;
use crate::collision::{Certificate, Collision, EdgeVerdict, HitBy, ObstacleId, ProvenStep, Scene, Witness};
use crate::geometry::{CircularArc, Footprint, Point2, Segment};
use crate::num::{greater, ulp};
use crate::robots::Motion;

/// The verdict that the motion hits, if there is contact at `contact_at`; the caller has proven it free up to
/// `free_until`.
fn hit<M: Motion>(scene: &Scene, motion: &M, free_until: f64, contact_at: f64) -> Option<EdgeVerdict> {
    let footprint = motion.footprint_at(contact_at);
    if !footprint.is_valid() {
        return Some(EdgeVerdict::Hit { free_until, contact_at, part: 0, by: HitBy::Obstacle(ObstacleId::UNKNOWN) });
    }
    let Witness { dist, part, obstacle, .. } = scene.witness(&footprint)?;
    (dist == 0.0).then_some(EdgeVerdict::Hit { free_until, contact_at, part, by: HitBy::Obstacle(obstacle) })
}

/// The bracket about a first contact at `s`: a little less than [`BRACKET`] of motion, so that its two ends fit in it.
fn bracket(s: f64, length: f64) -> (f64, f64) {
    let half = 0.45 * BRACKET / length;
    (s - half, if s + half < 1.0 { s + half } else { 1.0 })
}

/// The verdict on a motion none of whose parts turns. One step proves it free, or its first contact is where a vertex
/// comes within reach of an edge. `None` where neither can be proven.
pub(crate) fn straight<M: Motion>(
    scene: &Scene,
    motion: &M,
    start: &Footprint,
    certificate: Option<&mut Certificate>,
) -> Option<EdgeVerdict> {
    let end = motion.footprint_at(1.0);
    let prove = |to: f64, footprint: &Footprint| {
        let clearance = step_clearance(scene, motion, At::new(0.0, start), At::new(to, footprint));
        (clearance > 0.0).then_some(ProvenStep { from: 0.0, to, clearance })
    };
    // every proven step covers the start too, so the start needs no query of its own
    let (step, verdict) = if let Some(step) = prove(1.0, &end) {
        (step, EdgeVerdict::Free { clearance: step.clearance })
    } else {
        let first = translation_meets(scene, start, &end)?;
        let length = (0..start.parts().len()).fold(0.0, |w, k| greater(motion.bound(k, 0.0, 1.0), w));
        let (before, after) = bracket(first, length);
        if before <= 0.0 {
            return None;
        }
        let step = prove(before, &motion.footprint_at(before))?;
        (step, hit(scene, motion, before, after)?)
    };
    if let Some(c) = certificate {
        c.clear(0.0);
        c.push(step);
    }
    Some(verdict)
}

/// The verdict on a disc of this radius whose centre runs along a line; `None` where it takes a march.
pub(crate) fn linear(
    scene: &Scene,
    way: Segment,
    radius: f64,
    certificate: Option<&mut Certificate>,
) -> Option<EdgeVerdict> {
    let (step, verdict) = DiscLine::new(way, radius, scene)?.verdict(scene)?;
    if let Some(c) = certificate {
        c.clear(0.0);
        c.push(step);
    }
    Some(verdict)
}

/// The verdict on a disc of this radius whose centre runs along an arc; `None` where it takes a march.
pub(crate) fn circular<M: Motion>(scene: &Scene, motion: &M, arc: &CircularArc, radius: f64) -> Option<EdgeVerdict> {
    let far = Point2::new(arc.centre.x.abs() + arc.radius, arc.centre.y.abs() + arc.radius);
    // the arc's own rounding, that of the distance to it and that of the footprint placed on it
    let slack = 128.0 * ulp(greater(greater(far.x, far.y) + radius, 1.0));
    let proven = |until: f64| arc_clearance(scene, arc, until, radius) - slack;
    let whole = proven(1.0);
    if whole > 0.0 {
        return Some(EdgeVerdict::Free { clearance: whole });
    }
    let (before, after) = bracket(arc_meets(scene, arc, radius)?, arc.length());
    if before <= 0.0 || proven(before) <= 0.0 {
        return None;
    }
    hit(scene, motion, before, after)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    use super::*;
    use crate::collision::motion::conservative_advancement::march;
    use crate::collision::motion::decide::verdict;
    use crate::collision::{Checker, DiscChecker, MarchOptions};
    use crate::configuration::{HitchCfg, R2};
    use crate::geometry::{Pose2, Segment, Shape};
    use crate::num;
    use crate::random::{Seed, Stream};
    use crate::robots::{Drivable, HITCH, RUSTY, Robot, RustyCmd, RustyDisc};

    fn wall(a: (f64, f64), b: (f64, f64)) -> Scene {
        Scene::of_walls(&[Segment::new(Point2::new(a.0, a.1), Point2::new(b.0, b.1))])
    }

    /// The verdict by closed form alone.
    fn closed<M: Motion>(scene: &Scene, motion: &M) -> EdgeVerdict {
        let found = match (motion.disc_line(), motion.disc_arc()) {
            (Some((way, radius)), _) => linear(scene, way, radius, None),
            (None, Some((arc, radius))) => circular(scene, motion, &arc, radius),
            (None, None) => straight(scene, motion, &motion.footprint_at(0.0), None),
        };
        found.expect("a closed form decides")
    }

    fn expect_hit(verdict: EdgeVerdict, at: f64, length: f64) {
        let EdgeVerdict::Hit { free_until, contact_at, .. } = verdict else { panic!("{verdict:?}") };
        assert!(free_until < at && at < contact_at, "{at} outside {verdict:?}");
        assert!((contact_at - free_until) * length <= BRACKET, "{verdict:?}");
    }

    #[test]
    fn a_disc_on_a_line_meets_a_side_and_an_end() {
        let disc = RustyDisc { radius: 0.25 };
        let scene = wall((3.0, 0.0), (3.0, 2.0));
        let line = |y: f64| disc.edge(&R2::new(0.0, y), &R2::new(8.0, y)).unwrap();
        // the wall's side, then the circle about its lower end: x = 3 - sqrt(0.25^2 - 0.15^2)
        expect_hit(closed(&scene, &line(1.0)), 2.75 / 8.0, 8.0);
        expect_hit(closed(&scene, &line(-0.15)), 2.8 / 8.0, 8.0);
        // passing below it leaves the exact clearance
        let EdgeVerdict::Free { clearance } = closed(&scene, &line(-0.75)) else { panic!() };
        // 48 ulps of 8.75 m and 16 roundings of as much are subtracted
        assert!((clearance - 0.5).abs() < 1.2e-13 && clearance <= 0.5, "{clearance}");
    }

    #[test]
    fn a_car_that_only_slides_meets_a_post_with_its_side_and_a_wall_with_its_corner() {
        // an edge of the chart may move the car sideways: its chassis is then a rectangle in translation
        let car = Checker::new(Scene::empty(Scene::lot().bounds()), HITCH);
        let at = |x: f64, y: f64| HitchCfg { body: Pose2::new(x, y, 0.0), trailer: None };
        let edge = car.robot().edge(&at(0.0, 0.0), &at(0.0, 4.0)).unwrap();
        let half = 0.5 * HITCH.body.width;
        let post = Scene::empty(Scene::lot().bounds()).with_obstacle_at(
            "post",
            Pose2::new(0.3, 3.0, 0.0),
            Shape::Disc { radius: 0.1 },
        );
        expect_hit(closed(&post, &edge), (3.0 - 0.1 - half) / 4.0, 4.0);
        // a slanting wall y = 3 + x / 2 comes down to the left: the rear left corner meets it
        let slanting = wall((-9.0, -1.5), (9.0, 7.5));
        let rear = HITCH.footprint(&at(0.0, 0.0)).parts()[0].placed().bounds().min.x;
        expect_hit(closed(&slanting, &edge), (3.0 + 0.5 * rear - half) / 4.0, 4.0);
    }

    #[test]
    fn a_disc_on_an_arc_meets_walls_where_trigonometry_says() {
        // a left turn of radius 1 about (0, 1), from (0, 0) heading along x; half a circle
        let arc = RUSTY.drive(&Pose2::IDENTITY, &RustyCmd { v: PI, omega: PI }, 1.0).unwrap();
        let r = RUSTY.body_radius;
        // centre (sin f, 1 - cos f): the wall x = 0.8 is met at sin f = 0.8 - r
        expect_hit(closed(&wall((0.8, -3.0), (0.8, 3.0)), &arc), asin(0.8 - r) / PI, PI);
        // ... and the ceiling y = 1.5 at cos f = -(0.5 - r)
        expect_hit(closed(&wall((-3.0, 1.5), (3.0, 1.5)), &arc), num::acos(r - 0.5) / PI, PI);
        // a point of the circle itself at f = 90 degrees is met at a chord of r: 2 sin(d / 2) = r
        let before = 2.0 * asin(0.5 * r);
        expect_hit(closed(&wall((1.0, 1.0), (9.0, 1.0)), &arc), (FRAC_PI_2 - before) / PI, PI);
        // to the right the same, mirrored
        let right = RUSTY.drive(&Pose2::IDENTITY, &RustyCmd { v: PI, omega: -PI }, 1.0).unwrap();
        expect_hit(closed(&wall((1.0, -1.0), (9.0, -1.0)), &right), (FRAC_PI_2 - before) / PI, PI);
    }

    #[test]
    fn a_free_arc_has_its_exact_clearance() {
        let r = RUSTY.body_radius;
        let free = |scene: &Scene, turn: f64| {
            let arc = RUSTY.drive(&Pose2::IDENTITY, &RustyCmd { v: turn, omega: turn }, 1.0).unwrap();
            let EdgeVerdict::Free { clearance } = closed(scene, &arc) else { panic!() };
            clearance
        };
        let cases = [
            (wall((1.5, -3.0), (1.5, 3.0)), TAU, 0.5 - r),       // beside the circle
            (wall((0.0, 1.0), (0.2, 1.0)), TAU, 0.8 - r),        // inside it, an end nearest
            (wall((-3.0, -0.3), (3.0, -0.3)), 1.0, 0.3 - r),     // nearest at the start
            (wall((-3.0, 2.0), (3.0, 2.0)), FRAC_PI_2, 1.0 - r), // nearest at the end
            // the circle would cross it, the arc does not
            (wall((-0.5, 0.5), (-0.5, 1.5)), FRAC_PI_2, num::hypot(0.5, 0.5) - r),
        ];
        for (i, (scene, turn, exact)) in cases.iter().enumerate() {
            let clearance = free(scene, *turn);
            assert!((clearance - exact).abs() < 1e-12 && clearance <= *exact, "case {i}: {clearance} {exact}");
        }
    }

    fn asin(x: f64) -> f64 {
        FRAC_PI_2 - num::acos(x)
    }

    #[test]
    fn random_arcs_and_lines_agree_with_the_march_and_with_samples() {
        let scene = Scene::apartment();
        let disc = DiscChecker::new(scene.clone(), RustyDisc::default());
        let mut draws = Stream::new(Seed(3), "arcs");
        let (mut free, mut hits, mut decided) = (0, 0, 0);
        while free + hits < 600 {
            let q = Pose2::new(draws.uniform(0.0, 12.0), draws.uniform(0.0, 8.0), draws.uniform(-PI, PI));
            if !disc.is_free(&R2::new(q.x, q.y)) {
                continue;
            }
            let u = RustyCmd { v: draws.uniform(-3.0, 3.0), omega: draws.uniform(-4.0, 4.0) };
            let motion = RUSTY.drive(&q, &u, 1.0).unwrap();
            let (arc, radius) = motion.disc_arc().unwrap();
            decided += usize::from(circular(&scene, &motion, &arc, radius).is_some());
            let quick = verdict(&scene, &motion, MarchOptions::default().budget, None);
            let slow = march(&scene, &motion, MarchOptions::default(), None);
            let sampled = |until: f64| {
                (0..=400)
                    .map(|i| scene.distance(&motion.footprint_at(until * f64::from(i) / 400.0)))
                    .fold(f64::INFINITY, num::lesser)
            };
            match (quick, slow) {
                (EdgeVerdict::Free { clearance }, EdgeVerdict::Free { .. }) => {
                    free += 1;
                    let least = sampled(1.0);
                    // between two samples the distance falls by at most half the way between them
                    assert!(clearance <= least && clearance >= least - arc.length() / 800.0, "{clearance} {least}");
                }
                (
                    EdgeVerdict::Hit { free_until, contact_at, .. },
                    EdgeVerdict::Hit { free_until: f, contact_at: c, .. },
                ) => {
                    hits += 1;
                    assert!(free_until < c && f < contact_at, "the brackets overlap: {quick:?} {slow:?}");
                    assert!(sampled(free_until) > 0.0);
                    assert!(scene.intersects(&motion.footprint_at(contact_at)));
                }
                _ => panic!("{quick:?} {slow:?}"),
            }
        }
        assert!(free > 50 && hits > 50, "{free} {hits}");
        assert!(decided > 590, "closed forms decide nearly all: {decided} of 600");
    }
    #[test]
    fn nearly_every_disc_line_is_decided_without_a_march() {
        let scene = Scene::apartment();
        let mut draws = Stream::new(Seed(4), "lines");
        let (mut decided, mut free) = (0, 0);
        for _ in 0..1000 {
            let mut at = || Point2::new(draws.uniform(0.0, 12.0), draws.uniform(0.0, 8.0));
            let way = Segment::new(at(), at());
            if scene.intersects(&Footprint::disc(way.a, 0.11)) {
                decided += 1; // every verdict begins with the start, which is in contact
                continue;
            }
            let verdict = linear(&scene, way, 0.11, None);
            decided += usize::from(verdict.is_some());
            free += usize::from(verdict.is_some_and(|v| v.is_free()));
        }
        assert!(decided > 990 && free > 20, "{decided} decided, {free} of them free");
    }
}
