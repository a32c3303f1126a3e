//! Shortest paths of a disc, compared with lengths worked out by hand and with what other planners find.

use std::sync::Arc;

use motion_lab_core::num::{acos, atan2};
use motion_lab_core::planning::{Ball, CellDecomposition, Metric};
use motion_lab_core::robots::AnyRobot;

use super::*;

/// How much less a bound may be than what it bounds, metres.
const SHARP: f64 = 2e-8;

fn length(path: &LinePath<RustyDisc>) -> f64 {
    path.length(&Metric::unit(&path.start()))
}

/// The length of the tangent from a point to a circle of a radius, its centre at `way` from the point, and the angle by
/// which it rises when it passes the circle on the left.
fn tangent(way: [f64; 2], radius: f64) -> (f64, f64) {
    let square = way[0] * way[0] + way[1] * way[1];
    let length = (square - radius * radius).sqrt();
    (length, atan2(way[1], way[0]) + atan2(radius, length))
}

fn in_scene(scene: Scene, radius: f64, start: [f64; 2], goal: [f64; 2]) -> Problem<RustyDisc> {
    let checker = Checker::new(scene, RustyDisc::try_new(radius).unwrap());
    Problem::try_new(checker, R2::new(start[0], start[1]), R2::new(goal[0], goal[1]), Seed(1)).unwrap()
}

fn among(walls: &[[f64; 4]], start: [f64; 2], goal: [f64; 2]) -> Problem<RustyDisc> {
    in_scene(Scene::clone(room(walls).scene()), 0.1, start, goal)
}

/// Checks the bound and the path of a problem whose shortest path has this length.
fn is_shortest(problem: &Problem<RustyDisc>, by_hand: f64) {
    let bound = length_bound(problem).unwrap();
    assert!(bound <= by_hand && bound > by_hand - SHARP, "bound {bound}, by hand {by_hand}");
    let path = solve(&mut TangentGraph::new(problem.clone()), &Bounds::default()).unwrap();
    let found = length(&path);
    assert!(found >= bound && found < by_hand + 1e-3, "path {found}, by hand {by_hand}");
    let radius = problem.checker().robot().radius;
    assert!(disc_clearance(problem.checker().scene(), radius, &path.corners()) > 2e-6);
}

#[test]
fn the_shortest_way_is_as_long_as_worked_out_by_hand() {
    is_shortest(&among(&[], [-1.5, -1.0], [1.5, 1.0]), 13.0_f64.sqrt());
    // round the end of a wall that stands on x = 0
    let (line, rise) = tangent([1.0, 0.5], 0.1);
    is_shortest(&among(&[[0.0, -2.0, 0.0, 0.5]], [-1.0, 0.0], [1.0, 0.0]), 2.0 * (line + 0.1 * rise));
    // between two walls, over the first and under the second: an inner tangent through the origin
    let walls = [[-0.5, -2.0, -0.5, 0.3], [0.5, -0.3, 0.5, 2.0]];
    let ((line, rise), (inner, fall)) = (tangent([1.0, 0.3], 0.1), tangent([0.5, 0.3], 0.1));
    is_shortest(&among(&walls, [-1.5, 0.0], [1.5, 0.0]), 2.0 * (line + 0.1 * (rise + fall) + inner));
    // over a square: an outer tangent along its side
    let square = Shape::try_rectangle(Point2::new(-0.5, -0.5), Point2::new(0.5, 0.5)).unwrap();
    let scene = room(&[]).scene().clone().with_obstacle("square", square);
    let (line, rise) = tangent([1.0, 0.5], 0.1);
    is_shortest(&in_scene(scene, 0.1, [-1.5, 0.0], [1.5, 0.0]), 2.0 * (line + 0.1 * rise) + 1.0);
    // round a disc of 50 cm, at 60 cm from its centre
    let scene = room(&[]).scene().clone().with_obstacle("disc", Shape::Disc { radius: 0.5 });
    let (line, arc) = (0.8, std::f64::consts::PI - 2.0 * acos(0.6));
    is_shortest(&in_scene(scene, 0.1, [-1.0, 0.0], [1.0, 0.0]), 2.0 * line + 0.6 * arc);
}

/// A wall that stands on the disc, radially, is gone round at its end: no arc slips through it, however thin and short
/// it is.
#[test]
fn an_arc_goes_through_no_wall_that_stands_on_it() {
    let disc = room(&[]).scene().clone().with_obstacle("disc", Shape::Disc { radius: 0.5 });
    let spike = Shape::Segment { a: Point2::new(0.0, 0.5), b: Point2::new(0.0, 0.53) };
    // 3 cm above the disc: the rim about its end is 3 cm above the disc's rim
    let spiked = disc.clone().with_obstacle("spike", spike);
    let below = Shape::Segment { a: Point2::new(0.0, -0.5), b: Point2::new(0.0, -2.0) };
    let problem = in_scene(spiked.with_obstacle("below", below), 0.1, [-1.0, 0.0], [1.0, 0.0]);
    let plain = in_scene(disc, 0.1, [-1.0, 0.0], [1.0, 0.0]);
    let (bound, without) = (length_bound(&problem).unwrap(), length_bound(&plain).unwrap());
    // from the left: a tangent to the disc's rim, an arc, the outer tangent to the end's rim, and the same mirrored
    let outer = (0.53_f64 * 0.53 - 0.5 * 0.5).sqrt();
    let turn = acos(0.5 / 0.53);
    let rise = std::f64::consts::FRAC_PI_2 - acos(0.6);
    let by_hand = 2.0 * (0.8 + 0.6 * (rise - turn) + outer + 0.1 * turn);
    assert!(without < bound - 1e-3 && (bound - by_hand).abs() < SHARP, "{without} {bound} {by_hand}");
    is_shortest(&problem, by_hand);
}

#[test]
fn there_is_no_bound_where_there_is_no_path() {
    let gate = |gap: f64| [[0.0, -2.0, 0.0, -0.5 * gap], [0.0, 0.5 * gap, 0.0, 2.0]];
    let bound = |walls: &[[f64; 4]]| length_bound(&among(walls, [-1.0, 0.2], [1.0, 0.2])).unwrap();
    // a gap that is a micrometre wider or narrower than the disc
    let (line, rise) = tangent([1.0, -0.1], -0.1);
    let through = 2.0 * (line - 0.1 * rise);
    let found = bound(&gate(0.2 + 1e-6));
    assert!((found - through).abs() < 1e-5, "{found} {through}");
    assert_eq!(bound(&gate(0.2 - 1e-6)), f64::INFINITY);
    // the centre keeps within the bounds, whose side is at 2 m
    assert_eq!(bound(&[[0.0, -2.0, 0.0, 1.900_001]]), f64::INFINITY);
    assert!(bound(&[[0.0, -2.0, 0.0, 1.899_999]]) < 5.0);
    let refused = solve(&mut TangentGraph::new(among(&gate(0.2 - 1e-6), [-1.0, 0.2], [1.0, 0.2])), &Bounds::default());
    assert!(matches!(refused, Err(NoPath::NoneInGraph { nodes }) if nodes == 6), "{refused:?}");
}

/// A gap that leaves 20 micrometres on either side, less than the planner keeps at first: the way round is longer.
#[test]
fn the_planner_keeps_less_where_more_leads_the_long_way_round() {
    let gap = 0.1 + 2e-5;
    let walls = [[0.0, -1.5, 0.0, -gap], [0.0, gap, 0.0, 2.0]];
    let problem = among(&walls, [-1.0, 0.0], [1.0, 0.0]);
    is_shortest(&problem, 2.0);
    let path = solve(&mut TangentGraph::new(problem), &Bounds::default()).unwrap();
    assert!(path.clearance() < 2e-5 + 1e-9);
    // an end that has less clearance than that, or less than the planner keeps at last
    for hair in [1e-5, 2e-6] {
        let near = among(&[[0.0, -2.0, 0.0, 0.5]], [-0.1 - hair, 0.0], [0.1 + hair, 0.0]);
        let path = solve(&mut TangentGraph::new(near.clone()), &Bounds::default()).unwrap();
        // up along the wall and half round its end
        let by_hand = 1.0 + 0.1 * std::f64::consts::PI;
        assert!((length(&path) - by_hand).abs() < 1e-3 && length(&path) >= length_bound(&near).unwrap());
    }
}

/// A disc a nanometre from a wall could only go along it by arcs of thousands of lines.
#[test]
fn an_end_at_a_hairs_breadth_has_a_bound_and_no_path_of_endless_lines() {
    let near = among(&[[0.0, -2.0, 0.0, 0.5]], [-0.1 - 1e-9, 0.0], [0.1 + 1e-9, 0.0]);
    let refused = solve(&mut TangentGraph::new(near.clone()), &Bounds::default());
    assert!(matches!(refused, Err(NoPath::NoneInGraph { .. })), "{refused:?}");
    let by_hand = 1.0 + 0.1 * std::f64::consts::PI;
    assert!((length_bound(&near).unwrap() - by_hand).abs() < SHARP);
}

/// Cut corners make a path of many legs of one of few; where they gain nothing the legs stay.
#[test]
fn a_path_that_is_shortest_already_is_not_cut_into_more_legs() {
    let problem = among(&[[0.0, -2.0, 0.0, 0.5]], [-1.0, 0.0], [1.0, 0.0]);
    let (checker, metric) = (problem.checker(), Metric::unit(&problem.start()));
    let path = solve(&mut TangentGraph::new(problem.clone()), &Bounds::default()).unwrap();
    let short = path.shortened(checker, &metric, &mut Stream::new(Seed(1), "shorten"));
    assert!(short.legs().len() <= path.legs().len(), "{} {}", short.legs().len(), path.legs().len());
    // a path of two legs round the end has its corner cut
    let around = LinePath::through(checker, &[problem.start(), R2::new(0.0, 1.5), problem.goal()]).unwrap();
    let short = around.shortened(checker, &metric, &mut Stream::new(Seed(1), "shorten"));
    assert!(length(&short) < 1.05 * length(&path) && length(&short) >= length_bound(&problem).unwrap());
    assert!(short.verify(checker.scene()).unwrap() > 0.0);
}

#[test]
fn a_bound_is_that_of_a_goal_not_of_a_region() {
    let problem = among(&[], [-1.0, 0.0], [1.0, 0.0]);
    let region = Ball { centre: problem.goal(), radius: 0.5, metric: Metric::unit(&problem.goal()) };
    assert!(length_bound(&problem.try_with_region(Arc::new(region)).unwrap()).is_none());
}

/// A world of walls, discs and rectangles by a seed; many of them touch or cross.
fn cluttered(stream: &mut Stream, size: f64) -> Scene {
    let bounds = Aabb { min: Point2::new(-size, -size), max: Point2::new(size, size) };
    let mut scene = Scene::empty(bounds);
    for i in 0..18 {
        let [x, y] = [(); 2].map(|()| stream.uniform(-size, size));
        let [a, b] = [(); 2].map(|()| stream.uniform(0.05, 0.5) * size);
        let pose = Pose2::new(x, y, stream.uniform(-3.0, 3.0));
        let shape = match i % 3 {
            0 => Shape::Segment { a: Point2::new(0.0, 0.0), b: Point2::new(2.0 * a, 0.0) },
            1 => Shape::Disc { radius: 0.5 * a },
            _ => Shape::try_rectangle(Point2::new(0.0, 0.0), Point2::new(a, b)).unwrap(),
        };
        scene = scene.with_obstacle_at(&format!("obstacle {i}"), pose, shape);
    }
    scene
}

/// The same problem for the rover, at heading 0.
fn as_rover(problem: &Problem<RustyDisc>) -> Problem<AnyRobot> {
    let (scene, disc) = (problem.checker().shared_scene(), problem.checker().robot());
    let rover = AnyRobot::Rusty(Rusty { body_radius: disc.radius, ..Rusty::default() });
    let [start, goal] = [problem.start(), problem.goal()].map(|q| Pose2::new(q.0.x, q.0.y, 0.0).into());
    Problem::try_new(Checker::new(scene, rover), start, goal, Seed(1)).unwrap()
}

/// In worlds from centimetres to a hundred metres: the path is as short as the bound tells, no other planner's is
/// shorter than the bound, and where cells prove that there is no path the bound is infinite, and the other way round.
#[test]
fn in_cluttered_worlds_no_planner_undercuts_the_bound() {
    let (mut bent, mut parted) = (0, 0);
    for seed in 0..count_from_env("MOTION_LAB_TANGENTS", 48) {
        let mut stream = Stream::new(Seed(seed), "planning/tangents");
        let size = [0.5, 2.0, 10.0, 100.0][(seed % 4) as usize];
        let checker = Checker::new(cluttered(&mut stream, size), RustyDisc::try_new(0.03 * size).unwrap());
        let mut place = || loop {
            let q = R2::new(stream.uniform(-size, size), stream.uniform(-size, size));
            if checker.distance(&q) > 1e-3 * size {
                return q;
            }
        };
        let (start, goal) = (place(), place());
        let problem = Problem::try_new(checker.clone(), start, goal, Seed(seed)).unwrap();
        let bound = length_bound(&problem).unwrap();
        let path = solve(&mut TangentGraph::new(problem.clone()), &Bounds::default());
        match &path {
            Ok(path) => {
                let found = length(path);
                assert!(found >= bound && found <= bound + 1e-3 + 1e-4 * size, "seed {seed}: {found} {bound}");
                assert!(disc_clearance(checker.scene(), 0.03 * size, &path.corners()) > 1e-6, "seed {seed}");
                bent += u32::from(path.legs().len() > 1);
            }
            Err(reason) => assert!(bound == f64::INFINITY, "seed {seed}: {reason}, {bound}"),
        }
        let others: [Box<dyn Planner<RustyDisc>>; 2] =
            [Box::new(VisibilityGraph::new(problem.clone())), Box::new(RrtStar::new(problem.clone()))];
        for mut other in others {
            if let Ok(other) = solve(other.as_mut(), &Bounds::of_iterations(300)) {
                assert!(length(&other) >= bound, "seed {seed}: {} {bound}", length(&other));
            }
        }
        match solve(&mut CellDecomposition::new(as_rover(&problem)), &Bounds::of_iterations(3000)) {
            Ok(_) => assert!(bound.is_finite(), "seed {seed}: there is a path"),
            Err(NoPath::Unreachable { .. }) => {
                assert!(bound == f64::INFINITY && path.is_err(), "seed {seed}: there is no path");
                parted += 1;
            }
            Err(_) => {}
        }
    }
    assert!(bent > 15 && parted > 2, "{bent} {parted}: the others tell nothing");
}
