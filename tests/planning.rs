//! Planners: what they return is proven, and an oracle that shares no geometry with the library agrees.

use motion_lab::planning::{Bound, Bounds, NoPath, Planner, Progress, RrtConnect, solve};
use motion_lab::prelude::*;

use crate::oracle::arm::arm_clearance;

/// Reach round the post of the Workbench: both ends are free, the line between them hits the post.
pub fn round_the_post(seed: u64) -> Problem<Reach<2>> {
    let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    Problem::try_new(checker, T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(seed)).unwrap()
}

#[test]
fn rrt_connect_goes_round_the_post_whatever_the_seed() {
    for seed in 0..200 {
        let problem = round_the_post(seed);
        let path = solve(&mut RrtConnect::new(problem.clone()), &Bounds::default()).unwrap();
        assert_eq!((path.start(), path.goal()), (problem.start(), problem.goal()));
        let clearance = arm_clearance(&path.corners());
        assert!(clearance >= path.clearance() - 1e-9 && path.clearance() > 0.0, "seed {seed}: {clearance}");
    }
}

#[test]
fn a_bound_ends_the_search_and_is_named() {
    let mut planner = RrtConnect::new(round_the_post(1));
    let bounds = Bounds { edges: 3, ..Bounds::default() };
    let Err(NoPath::Exhausted { bound: Bound::Edges, effort }) = solve(&mut planner, &bounds) else { panic!() };
    assert!((3..=4).contains(&effort.edges), "an iteration asks about two edges at most: {effort:?}");
    let Err(NoPath::Exhausted { bound: Bound::Iterations, effort }) = solve(&mut planner, &Bounds::of_iterations(7))
    else {
        panic!()
    };
    assert_eq!(effort.iterations, 7, "it goes on from where it was");
}

#[test]
fn growth_shows_every_node_edge_and_rejection() {
    let mut planner = RrtConnect::new(round_the_post(1));
    let mut rejections = 0;
    let mut seen = 0;
    while planner.step() == Progress::Growing {
        let growth = planner.growth();
        let checker = planner.problem().checker();
        for [from, to] in growth.edges() {
            assert!(checker.edge_free(&growth.at(from), &growth.at(to)) && planner.motion(from, to).is_some());
        }
        let rejected = growth.effort().edges - growth.effort().free;
        if rejected > seen {
            seen = rejected;
            rejections += 1;
            let shown = growth.rejection(checker).unwrap();
            assert!(!checker.is_free(&shown.at) && shown.witness.unwrap().dist == 0.0);
            assert!(shown.by.unwrap().obstacle().is_some());
        }
    }
    assert!(rejections > 5, "{rejections}");
}
