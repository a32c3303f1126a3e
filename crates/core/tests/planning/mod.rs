//! Planners: what they return is proven, and an oracle that shares no geometry with the library agrees.

mod barriers;
mod bounds;
mod bugs;
mod cells;
mod ends;
mod own;
mod paths;
mod planner;
mod shortest;
mod spaces;
mod tangents;
mod tools;

use motion_lab_core::collision::DiscChecker;
use motion_lab_core::geometry::{Aabb, Placed};
use motion_lab_core::planning::{
    Bound, Bounds, Bug1, Bug2, GridSearch, LinePath, NoPath, Planner, PotentialField, Prm, Progress, Rrt, RrtConnect,
    RrtStar, TangentGraph, VisibilityGraph, length_bound, solve,
};
use motion_lab_core::prelude::*;

use oracle::arm::{arm_clearance, obstacles};
use oracle::fixtures::count_from_env;
use oracle::sweep;

/// The variable that says how many seeds every planner solves.
const PLANS: &str = "MOTION_LAB_PLANS";

/// Reach round the post of the Workbench: both ends are free, the line between them hits the post.
fn round_the_post(seed: u64) -> Problem<Reach<2>> {
    let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    Problem::try_new(checker, T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(seed)).unwrap()
}

/// A disc in the Apartment, between two places drawn from the seed that are well away from all obstacles.
fn across_the_apartment(seed: u64) -> Problem<RustyDisc> {
    let checker = Checker::new(Scene::apartment(), RustyDisc::default());
    let mut places = Stream::new(Seed(seed), "planning/places");
    let bounds = checker.scene().bounds();
    let mut place = || loop {
        let q = checker.robot().sample(bounds.min, bounds.max, &mut places);
        if checker.distance(&q) > 0.3 {
            return q;
        }
    };
    let (start, goal) = (place(), place());
    Problem::try_new(checker, start, goal, Seed(seed)).unwrap()
}

/// A disc of 10 cm in a room of 4 by 4 metres with these walls.
fn room(walls: &[[f64; 4]]) -> DiscChecker {
    let bounds = Aabb { min: Point2::new(-2.0, -2.0), max: Point2::new(2.0, 2.0) };
    let wall = |scene: Scene, (i, [a, b, c, d]): (usize, &[f64; 4])| {
        scene.with_obstacle(&format!("wall {i}"), Shape::Segment { a: Point2::new(*a, *b), b: Point2::new(*c, *d) })
    };
    let scene = walls.iter().enumerate().fold(Scene::empty(bounds), wall);
    Checker::new(scene, RustyDisc::try_new(0.1).unwrap())
}

/// The least clearance of a disc along straight lines, by the oracle's distances.
fn disc_clearance(scene: &Scene, radius: f64, corners: &[R2]) -> f64 {
    let pieces = obstacles(scene);
    let line = |ends: &[R2]| {
        let (a, way) = (ends[0].0, ends[1].0 - ends[0].0);
        let at = |s: f64| vec![Placed::new([a + way * s], radius)];
        sweep::clearance(at, way.norm(), &pieces, sweep::MICROMETRE).at_most
    };
    corners.windows(2).map(line).fold(f64::INFINITY, |m, c| if c < m { c } else { m })
}

/// Every planner for any robot.
fn planners<R: Robot<Configuration: motion_lab_core::configuration::Chart>>(
    problem: &Problem<R>,
) -> Vec<Box<dyn Planner<R>>> {
    vec![
        Box::new(RrtConnect::new(problem.clone())),
        Box::new(Rrt::new(problem.clone())),
        Box::new(RrtStar::new(problem.clone())),
        Box::new(RrtStar::informed(problem.clone())),
        Box::new(Prm::new(problem.clone())),
        Box::new(GridSearch::a_star(problem.clone())),
        Box::new(GridSearch::dijkstra(problem.clone())),
    ]
}

/// Every planner for discs.
fn planners_of_discs<R: Robot<Configuration: motion_lab_core::configuration::Chart>>(
    problem: &Problem<R>,
) -> Vec<Box<dyn Planner<R>>> {
    let mut all = planners(problem);
    all.push(Box::new(VisibilityGraph::new(problem.clone())));
    all.push(Box::new(TangentGraph::new(problem.clone())));
    all.push(Box::new(Bug1::try_new(problem).unwrap()));
    all.push(Box::new(Bug2::try_new(problem).unwrap()));
    all
}

/// Solves a problem and checks the ends and what the path claims of its clearance.
fn solved<R: Robot, P: Planner<R> + ?Sized>(
    planner: &mut P,
    seed: u64,
    oracle: impl Fn(&[R::Configuration]) -> f64,
) -> LinePath<R> {
    let path = match solve(planner, &Bounds::default()) {
        Ok(path) => path,
        Err(reason) => panic!("{} with seed {seed}: {reason}", planner.name()),
    };
    let (name, problem) = (planner.name(), planner.problem());
    assert!(path.start() == problem.start() && path.goal() == problem.goal(), "{name}");
    let (sampled, claimed) = (oracle(&path.corners()), path.clearance());
    assert!(claimed > 0.0 && sampled >= claimed - 1e-9, "{name} with seed {seed}: {sampled} m, claimed {claimed} m");
    path
}

#[test]
fn rrt_connect_goes_round_the_post_whatever_the_seed() {
    for seed in 0..1000 {
        solved(&mut RrtConnect::new(round_the_post(seed)), seed, arm_clearance);
    }
}

#[test]
fn every_planner_goes_round_the_post() {
    for seed in 0..count_from_env(PLANS, 40) {
        for mut planner in planners(&round_the_post(seed)) {
            solved(planner.as_mut(), seed, arm_clearance);
        }
    }
}

#[test]
fn every_planner_crosses_the_apartment() {
    let scene = Scene::apartment();
    let mut detours = 0;
    let count = count_from_env(PLANS, 25);
    for seed in 0..count {
        let problem = across_the_apartment(seed);
        detours += u64::from(!problem.checker().edge_free(&problem.start(), &problem.goal()));
        for mut planner in planners_of_discs(&problem) {
            solved(planner.as_mut(), seed, |corners| disc_clearance(&scene, 0.11, corners));
        }
    }
    assert!(5 * detours > 3 * count, "{detours}: for the others the straight line would do");
}

#[test]
fn a_seed_gives_the_same_growth_at_any_number_of_threads() {
    let corners = |seed: u64| {
        let problem = across_the_apartment(seed);
        let grow = |mut planner: Box<dyn Planner<RustyDisc>>| {
            (0..400).for_each(|_| _ = planner.step());
            let nodes: Vec<R2> = planner.growth().nodes().iter().map(|node| node.at).collect();
            (nodes, planner.growth().edges().collect::<Vec<_>>(), planner.growth().effort())
        };
        planners_of_discs(&problem).into_iter().map(grow).collect::<Vec<_>>()
    };
    let once = corners(3);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert!(pool.install(|| corners(3)) == once);
    }
    assert!(once.iter().all(|(nodes, edges, effort)| nodes.len() > 1 && !edges.is_empty() && effort.edges > 0));
    assert_ne!(corners(4)[0], once[0]);
}

#[test]
fn a_bound_ends_the_search_and_is_named() {
    let mut planner = RrtConnect::new(round_the_post(1));
    let bounds = Bounds { edges: 3, ..Bounds::default() };
    let Err(NoPath::Exhausted { bound: Bound::Edges, effort }) = solve(&mut planner, &bounds) else { panic!() };
    assert!((3..=4).contains(&effort.edges), "an iteration asks about two edges at most: {effort:?}");
    let bounds = Bounds { samples: 2, ..Bounds::default() };
    let Err(NoPath::Exhausted { bound: Bound::Samples, effort }) = solve(&mut planner, &bounds) else { panic!() };
    assert_eq!(effort.samples, 2, "it goes on from where it was");
    let ended = solve(&mut planner, &Bounds::of_iterations(7)).unwrap_err();
    assert!(matches!(ended, NoPath::Exhausted { bound: Bound::Iterations, .. }), "{ended}");
}

#[test]
fn growth_shows_every_node_edge_and_rejection() {
    let problem = round_the_post(1);
    for mut planner in planners(&problem) {
        let (mut rejections, mut seen) = (0, 0);
        while planner.step() == Progress::Growing {
            let (growth, checker) = (planner.growth(), planner.problem().checker());
            let rejected = growth.effort().edges - growth.effort().free;
            if rejected > seen && rejections < 40 {
                (seen, rejections) = (rejected, rejections + 1);
                let shown = growth.rejection(checker).unwrap();
                assert!(!checker.is_free(&shown.at) && shown.witness.unwrap().dist == 0.0, "{}", planner.name());
                assert!(shown.by.unwrap().obstacle().is_some());
            }
        }
        let (growth, checker) = (planner.growth(), problem.checker());
        for [from, to] in growth.edges() {
            // the edges of the goal's tree are asked about toward the goal
            let (a, b) = (growth.at(from), growth.at(to));
            assert!(checker.edge_free(&a, &b) || checker.edge_free(&b, &a), "{}", planner.name());
            assert!(planner.motion(from, to).is_some());
        }
        assert!(rejections > 0 && growth.effort().iterations > 0, "{}: {rejections}", planner.name());
    }
}

/// Kuffner and LaValle's Connect: a tree comes toward a node of the other a step at a time, as far as the way is free.
/// Ours begins with the start's tree and the goal; a wall on x = 0 stops the disc of 10 cm at x = -0.1.
#[test]
fn a_tree_of_rrt_connect_comes_nearer_step_by_step_as_far_as_it_can() {
    let problem =
        Problem::try_new(room(&[[0.0, -2.5, 0.0, 1.5]]), R2::new(-1.7, -1.0), R2::new(1.6, -1.0), Seed(3)).unwrap();
    let mut planner = RrtConnect::new(problem);
    // a fifth of half the room in each of two coordinates
    let step = 0.2 * 8.0_f64.sqrt();
    for count in 1..=3 {
        planner.step();
        let nodes = planner.growth().nodes();
        assert_eq!(nodes.len(), 2 + usize::min(count, 2), "a third step would end at the wall");
        let last = nodes.last().unwrap().at.0;
        let expected = Point2::new(-1.7 + step * count.min(2) as f64, -1.0);
        assert!((last - expected).norm() < 1e-12, "{last}, not {expected}");
    }
}
