//! Cells of the configuration space at their very corners and sides.

use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{Cell, CellMap, CellState, Slice};
use motion_lab_core::num::hypot;
use motion_lab_core::robots::AnyRobot;

use super::*;

/// The radius of a rover, metres.
const ROVER: f64 = 0.11;

/// The places of a rover in a world from `-corner` to `corner`, with a disc in it.
fn beside_a_disc(corner: [f64; 2], [x, y]: [f64; 2], radius: f64) -> Slice {
    let corner = Point2::new(corner[0], corner[1]);
    let disc = (Pose2::new(x, y, 0.0), Shape::Disc { radius });
    let scene = Scene::empty(Aabb { min: -corner, max: corner }).with_obstacle_at("the disc", disc.0, disc.1);
    let (rover, q) = AnyRobot::of_kind("rusty", &[0.0; 3]).unwrap();
    Slice::through(&Checker::new(scene, rover), &q).unwrap()
}

/// Of a disc, the corner of a cell that is in line with the disc's middle is the nearest or the farthest place. A cell
/// is grown by sixteen units in the last place of the greatest coordinate, which is 2^-50 m at 4 m and 2^-32 m at
/// 2^20 m.
#[test]
fn a_cell_is_proven_up_to_its_corner_and_no_farther() {
    let mut draws = Stream::new(Seed(52), "corners");
    for (side, unit) in [(4.0, 1.0 / f64::from(1 << 25) / f64::from(1 << 25)), (1048576.0, 1.0 / 4294967296.0)] {
        for _ in 0..100 {
            let middle = [draws.uniform(-2.0, 2.0), draws.uniform(-2.0, 2.0)];
            let half = [draws.uniform(1e-3, 0.3), draws.uniform(1e-3, 0.3)];
            let radius = draws.uniform(0.5, 2.0);
            for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
                let to_corner = [0, 1].map(|i| signs[i] * (half[i] + 16.0 * unit));
                let length = hypot(to_corner[0], to_corner[1]);
                // the cell beside a disc whose middle lies this far beyond the corner
                let judged = |beyond: f64| {
                    let at = [0, 1].map(|i| middle[i] + to_corner[i] * (1.0 + beyond / length));
                    beside_a_disc([side; 2], at, radius).judge(middle, half)
                };
                let touching = radius + ROVER;
                assert_eq!(judged(touching + 1e-9), CellState::Free, "a nanometre from the nearest corner");
                assert_ne!(judged(touching - 5e-12), CellState::Free, "the nearest corner is in contact");
                assert_eq!(judged(1e-9 - touching), CellState::Blocked, "the farthest corner is a nanometre deep");
                assert_ne!(judged(-5e-12 - touching), CellState::Blocked, "the farthest corner is free");
            }
        }
    }
}

/// Corners of a cell, middles of its sides and places on them.
fn rim(map: &CellMap, cell: &Cell, draws: &mut Stream) -> Vec<[f64; 2]> {
    let (middle, half) = map.place(cell);
    let at = |u: f64, v: f64| [middle[0] + u * half[0], middle[1] + v * half[1]];
    let mut places = Vec::new();
    for side in [-1.0, 1.0] {
        places.extend([at(side, -1.0), at(side, 1.0), at(side, 0.0), at(0.0, side)]);
        places.extend([at(side, draws.uniform(-1.0, 1.0)), at(draws.uniform(-1.0, 1.0), side)]);
    }
    places
}

#[test]
fn what_is_proven_of_a_cell_holds_at_its_corners_and_on_its_sides() {
    let mut draws = Stream::new(Seed(53), "rims");
    for (kind, start, scene) in [
        ("rusty", &[1.0, 1.0, 0.0][..], Scene::apartment()),
        ("hitch", &[6.5, 2.5, 0.4], Scene::lot()),
        ("hitch", &[6.5, 2.5, 0.4, -0.3], Scene::lot()),
        ("reach", &[0.8, 1.5], Scene::workbench()),
        ("reach3", &[0.3, 0.2, 0.1], Scene::workbench()),
    ] {
        let (robot, q) = AnyRobot::of_kind(kind, start).unwrap();
        let mut map = CellMap::new(Slice::through(&Checker::new(scene, robot), &q).unwrap(), 6);
        map.refine(u32::MAX);
        let (mut free, mut blocked) = (0, 0);
        for cell in map.leaves().filter(|cell| cell.state != CellState::Unknown) {
            for p in rim(&map, cell, &mut draws) {
                let is_free = map.slice().checker().is_free(&map.slice().at(p));
                assert_eq!(is_free, cell.state == CellState::Free, "{kind} at {p:?} of {cell:?}");
            }
            if cell.state == CellState::Free { free += 1 } else { blocked += 1 }
        }
        assert!(free > 100 && blocked > 30, "{kind}: {free} free, {blocked} blocked");
    }
}

/// All sides are powers of two, so places are exact.
#[test]
fn a_place_on_a_side_is_of_the_cell_to_its_right_or_above_and_at_the_end_of_the_last() {
    let mut map = CellMap::new(beside_a_disc([8.0, 2.0], [1.0, 0.5], 1.0), 6);
    map.refine(u32::MAX);
    let (max, mut last, mut proven) = ([8.0, 2.0], 0, 0);
    for cell in map.leaves() {
        let (middle, half) = map.place(cell);
        let [low, high] = [-1.0, 1.0].map(|sign| [0, 1].map(|i| middle[i] + sign * half[i]));
        let mut own = vec![low, [low[0], middle[1]], [middle[0], low[1]], middle];
        if high[0] == max[0] {
            own.extend([[high[0], low[1]], [high[0], middle[1]]]);
        }
        if high[1] == max[1] {
            own.extend([[low[0], high[1]], [middle[0], high[1]]]);
        }
        if high == max {
            own.push(high);
        }
        last += u32::from(own.len() > 4);
        proven += u32::from(cell.state != CellState::Unknown);
        for p in own {
            assert_eq!(map.state(p), cell.state, "{p:?} of {cell:?}");
        }
    }
    assert!(last > 8 && proven > 50, "{last} at the end, {proven} proven");
    for i in 0..2 {
        for beyond in [(-max[i]).next_down(), max[i].next_up(), f64::NAN] {
            let mut p = [-1.0, -1.0];
            p[i] = beyond;
            assert_eq!(map.state(p), CellState::Unknown, "{p:?} lies beyond the slice");
        }
    }
}

/// Three lines of the plane of an arm's angles: its own cells, and those over the edge.
#[test]
fn the_edges_of_a_torus_are_of_both_cells_that_meet_there() {
    let (arm, q) = AnyRobot::of_kind("reach", &[0.8, 1.5]).unwrap();
    let mut map = CellMap::new(Slice::through(&Checker::new(Scene::workbench(), arm), &q).unwrap(), 7);
    map.refine(u32::MAX);
    let pi = std::f64::consts::PI;
    let mut known = [0, 0];
    for k in 0..997 {
        let along = pi * (2.0 * (f64::from(k) + 0.5) / 997.0 - 1.0);
        for [left, right] in [[[-pi, along], [pi, along]], [[along, -pi], [along, pi]]] {
            let is_free = map.slice().checker().is_free(&AnyConfiguration::T2(T2::new(left[0], left[1])));
            for p in [left, right] {
                match map.state(p) {
                    CellState::Unknown => continue,
                    state => assert_eq!(state == CellState::Free, is_free, "{p:?}"),
                }
                known[usize::from(is_free)] += 1;
            }
        }
    }
    assert!(known[0] > 100 && known[1] > 1000, "{known:?}");
}
