//! Lengths of paths, compared with those worked out by hand.

use motion_lab_core::num::{atan2, lesser};
use motion_lab_core::planning::Metric;

use super::*;

fn length(path: &LinePath<RustyDisc>) -> f64 {
    path.length(&Metric::unit(&path.start()))
}

/// From one side of a wall's end to the other, at (-1, 0) and (1, 0): the wall stands on x = 0 up to y = 0.5.
fn round_an_end() -> Problem<RustyDisc> {
    Problem::try_new(room(&[[0.0, -2.0, 0.0, 0.5]]), R2::new(-1.0, 0.0), R2::new(1.0, 0.0), Seed(1)).unwrap()
}

/// The shortest way round that end for a disc of 10 cm: two tangents and an arc.
///
/// The end is `d = sqrt(1.25)` from either place, so a tangent is `sqrt(d^2 - r^2)` long; it rises by `atan(1/2)` and
/// `asin(r / d)` more, and the arc turns by twice that.
fn by_hand() -> f64 {
    let (r, d) = (0.1, 1.25_f64.sqrt());
    let tangent = (d * d - r * r).sqrt();
    2.0 * tangent + 2.0 * r * (atan2(0.5, 1.0) + atan2(r, tangent))
}

#[test]
fn the_visibility_graph_takes_the_shortest_way() {
    let path = solve(&mut VisibilityGraph::new(round_an_end()), &Bounds::default()).unwrap();
    let (found, shortest) = (length(&path), by_hand());
    assert!(found >= shortest && found < 1.005 * shortest, "{found} {shortest}");
    // it goes about the wall's end at the millimetre that the planner keeps, and that is what is proven
    let seen = disc_clearance(round_an_end().checker().scene(), 0.1, &path.corners());
    for clearance in [path.clearance(), seen] {
        assert!((clearance - 1e-3).abs() < 1e-5, "{clearance}");
    }
}

/// The lengths of a planner's path as it is stepped so often.
fn lengths(mut planner: impl Planner<RustyDisc>, steps: usize) -> Vec<f64> {
    let mut lengths = Vec::new();
    for _ in 0..steps {
        planner.step();
        lengths.extend(planner.path().map(length));
    }
    assert!(lengths.windows(2).all(|pair| pair[1] <= pair[0]), "a path got longer");
    lengths
}

#[test]
fn rrt_star_and_prm_tend_to_the_shortest_way_and_never_get_longer() {
    for lengths in [lengths(RrtStar::new(round_an_end()), 4000), lengths(Prm::new(round_an_end()), 4000)] {
        let (first, last, shortest) = (lengths[0], lengths[lengths.len() - 1], by_hand());
        assert!(last >= shortest && last < 1.05 * shortest && last < first, "{first} {last} {shortest}");
    }
}

#[test]
fn a_roadmap_s_path_is_its_shortest_way_whenever_that_is_looked_for() {
    // by relaxing each of the roadmap's edges again and again (Bellman, 1958; Ford, 1956)
    let mut planner = Prm::new(round_an_end());
    // fewer than 200 nodes: it is looked for at each
    for _ in 0..180 {
        planner.step();
    }
    let nodes = planner.growth().nodes();
    let mut lengths = vec![f64::INFINITY; nodes.len()];
    lengths[0] = 0.0;
    let metric = Metric::unit(&nodes[0].at);
    for _ in 0..nodes.len() {
        for [a, b] in planner.growth().edges() {
            let length = metric.distance(&nodes[a].at, &nodes[b].at);
            lengths[a] = lesser(lengths[a], lengths[b] + length);
            lengths[b] = lesser(lengths[b], lengths[a] + length);
        }
    }
    let found = length(planner.path().unwrap());
    assert!((found - lengths[1]).abs() < 1e-9, "{found} {}", lengths[1]);
}

#[test]
fn a_star_and_dijkstra_find_the_grids_shortest_way() {
    // 8 steps of 0.25 m along x and 4 along y: 4 diagonals and 4 straight steps
    let problem =
        |walls: &[[f64; 4]]| Problem::try_new(room(walls), R2::new(-1.0, 0.0), R2::new(1.0, 1.0), Seed(1)).unwrap();
    for has_heuristic in [true, false] {
        let path = solve(&mut GridSearch::of(problem(&[]), 0.25, has_heuristic), &Bounds::default()).unwrap();
        assert!((length(&path) - (1.0 + 2.0_f64.sqrt())).abs() < 1e-12, "{}", length(&path));
    }
    let walls = [[0.0, -2.0, 0.0, 0.9], [0.0, 1.2, 0.0, 2.0], [0.5, 0.6, 0.5, 2.0]];
    let mut efforts = Vec::new();
    let lengths = [true, false].map(|has_heuristic| {
        let mut planner = GridSearch::of(problem(&walls), 0.05, has_heuristic);
        let path = solve(&mut planner, &Bounds::default()).unwrap();
        efforts.push(planner.growth().effort().iterations);
        length(&path)
    });
    assert!((lengths[0] - lengths[1]).abs() < 1e-9, "both are shortest: {lengths:?}");
    assert!(efforts[0] < efforts[1], "the heuristic saves work: {efforts:?}");
}
