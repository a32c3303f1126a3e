//! The walk by its sensor, and the planner, against what geometry says.

use super::rover::{KEEP, NOISE};
use super::{Bug1Sensor, Bug1Walk, WalkEnd};
use motion_lab_core::collision::{Checker, Problem, Scene};
use motion_lab_core::configuration::R2;
use motion_lab_core::geometry::{Aabb, Point2, Shape};
use motion_lab_core::planning::{Bounds, NoPath, Planner, Progress, RoundEnd, solve};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::RustyDisc;

/// A seed at which the noisy sensor misjudges a leave point on the way across the Apartment.
const MISJUDGES: u64 = 2034;

fn across_the_apartment(seed: u64, lies: bool) -> Bug1Sensor {
    let checker = Checker::new(Scene::apartment(), RustyDisc { radius: 0.13 });
    let problem = Problem::try_new(checker, R2::new(1.5, 5.75), R2::new(9.75, 6.25), Seed(seed)).unwrap();
    Bug1Sensor::new(problem, lies.then(|| (NOISE, Stream::new(Seed(seed), "bug1/beam"))))
}

#[test]
fn round_a_disc_it_leaves_where_the_line_from_the_centre_to_the_goal_says() {
    let bounds = Aabb { min: Point2::new(-3.0, -3.0), max: Point2::new(3.0, 3.0) };
    let scene = Scene::empty(bounds).with_obstacle("the disc", Shape::Disc { radius: 0.5 });
    let goal = Point2::new(1.5, 1.2);
    let mut walk = Bug1Walk::new(&Checker::new(scene, RustyDisc::default()), [Point2::new(-2.0, -1.1), goal], None);
    let mut before = walk.at();
    let end = loop {
        let end = walk.step();
        // the last step back to a leave point is the longest
        assert!((walk.at() - before).norm() < 0.1001, "a step at a time");
        before = walk.at();
        if let Some(end) = end {
            break end;
        }
    };
    let [point] = walk.leave_points() else { panic!("one round: {:?}", walk.leave_points()) };
    // the goal's direction, 1.5 to 1.2, on the circle that it walks
    let circle = 0.5 + KEEP;
    let expected = Point2::from(goal.coords * (circle / motion_lab_core::num::hypot(1.5, 1.2)));
    let off = |place: Point2| (place - expected).norm();
    assert!(off(point.at) < 0.12 && off(point.nearest.unwrap()) < 0.06, "{point:?}, {expected}");
    assert!(end == WalkEnd::Reached && point.leaving == RoundEnd::Free && !point.is_misjudged());
    assert_eq!((walk.rounds(), walk.bumps()), (1, 0));
}

#[test]
fn the_exact_sensor_leaves_where_it_should_and_the_noisy_one_does_not_at_some_seed() {
    let mut exact = across_the_apartment(MISJUDGES, false);
    let path = solve(&mut exact, &Bounds::default()).unwrap();
    assert_eq!((path.start(), path.goal()), (R2::new(1.5, 5.75), R2::new(9.75, 6.25)));
    let points = exact.sensed().unwrap().leave_points;
    assert!(!points.is_empty() && points.iter().all(|point| !point.is_misjudged()), "{points:?}");

    let mut noisy = across_the_apartment(MISJUDGES, true);
    let path = solve(&mut noisy, &Bounds::default()).unwrap();
    assert!(path.clearance() > 0.0);
    let [wrong, right] = noisy.sensed().unwrap().leave_points[..] else { panic!("two rounds") };
    assert!(wrong.is_misjudged() && !right.is_misjudged(), "{wrong} {right}");
    // what the excess says, by the places themselves
    let [left, nearest] =
        [wrong.at, wrong.nearest.unwrap()].map(|p| motion_lab_core::num::hypot(p.x - 9.75, p.y - 6.25));
    assert!((left - nearest - wrong.excess).abs() < 1e-12 && wrong.excess > 1.0, "{left} {nearest} {}", wrong.excess);
    // both come from the same round, so the exact walker's place is near where the judge's is
    assert!((points[0].at - wrong.nearest.unwrap()).norm() < 0.2, "{points:?} {wrong:?}");
    assert!(noisy.growth().effort().iterations > exact.growth().effort().iterations, "a round more");
}

#[test]
fn who_gives_up_says_why() {
    let corner = |x: f64, y: f64| Point2::new(1.5 + 0.6 * x, 0.6 * y);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let bounds = Aabb { min: Point2::new(-3.0, -3.0), max: Point2::new(3.0, 3.0) };
    let wall = |scene: Scene, i: usize| {
        let shape = Shape::Segment { a: corners[i], b: corners[(i + 1) % 4] };
        scene.with_obstacle(&format!("wall {i}"), shape)
    };
    let checker = Checker::new((0..4).fold(Scene::empty(bounds), wall), RustyDisc::default());
    let problem = Problem::try_new(checker, R2::new(-2.0, 0.05), R2::new(1.5, 0.0), Seed(1)).unwrap();
    let Err(NoPath::Enclosed { kept }) = solve(&mut Bug1Sensor::new(problem.clone(), None), &Bounds::default()) else {
        panic!("the goal is walled in")
    };
    assert!((kept - 0.09).abs() < 1e-12, "{kept}");
    let noise = Some((NOISE, Stream::new(Seed(1), "bug1/beam")));
    let mut noisy = Bug1Sensor::new(problem, noise);
    let reason = solve(&mut noisy, &Bounds::default()).unwrap_err();
    assert!(matches!(reason, NoPath::GaveUp(_)), "a noisy sensor proves nothing: {reason}");
    assert_eq!(noisy.step(), Progress::Ended(reason), "it has ended");
    // at this seed the sensor loses the leave point
    let reason = solve(&mut across_the_apartment(2023, true), &Bounds::default()).unwrap_err();
    assert!(reason.to_string().starts_with("the robot gave up: it never came back to where"), "{reason}");
}

#[test]
fn who_would_walk_out_of_the_world_gives_up() {
    // a wall from the lower side of the world to the upper one; the only way leads around an end of it
    let bounds = Aabb { min: Point2::new(-2.0, -2.0), max: Point2::new(2.0, 2.0) };
    let wall = Shape::Segment { a: Point2::new(0.0, -2.0), b: Point2::new(0.0, 2.0) };
    let checker = Checker::new(Scene::empty(bounds).with_obstacle("wall", wall), RustyDisc::default());
    let problem = Problem::try_new(checker, R2::new(-1.0, 0.5), R2::new(1.0, 0.5), Seed(1)).unwrap();
    let mut planner = Bug1Sensor::new(problem, None);
    let reason = solve(&mut planner, &Bounds::default()).unwrap_err();
    assert!(reason.to_string().contains("its way leads out of the world"), "{reason}");
    assert!(planner.growth().nodes().iter().all(|node| bounds.contains(node.at.0)));
}
