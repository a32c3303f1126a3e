//! The cells of planes, held against samples. Those of spaces of three coordinates are in `tests/planning/spaces.rs`.

use std::f64::consts::PI;

use super::*;
use crate::configuration::AnyConfiguration;
use crate::cspace::tests::arm;
use crate::robots::AnyRobot;

fn map(thick: bool, finest: u32) -> CellMap {
    let (checker, q) = arm(thick);
    CellMap::new(Slice::through(&checker, &q).unwrap(), finest)
}

/// Compares every sample of a dense raster with what is proven of its cell. Returns the number of samples in proven
/// cells.
fn compare(map: &CellMap, side: u32) -> usize {
    let slice = map.slice();
    let mut proven = 0;
    for k in 0..side * side {
        // off every grid line, but on the slice's least edges as well
        let part = |i: u32| if i == 0 { 0.0 } else { (f64::from(i) + 0.317) / f64::from(side) };
        let (u, v) = (part(k % side), part(k / side));
        let p = [
            slice.min()[0] + u * (slice.max()[0] - slice.min()[0]),
            slice.min()[1] + v * (slice.max()[1] - slice.min()[1]),
        ];
        let is_free = slice.checker().is_free(&slice.at(p));
        match map.state(p) {
            CellState::Free => assert!(is_free, "{p:?} is in a cell proven free"),
            CellState::Blocked => assert!(!is_free, "{p:?} is in a cell proven blocked"),
            CellState::Unknown => continue,
        }
        proven += 1;
    }
    proven
}

#[test]
fn dense_samples_never_contradict_a_proven_cell() {
    for thick in [false, true] {
        let mut map = map(thick, 7);
        assert_eq!(compare(&map, 8), 0, "nothing is known at first");
        while map.refine(500) {
            compare(&map, 40);
        }
        let proven = compare(&map, 160);
        let unknown = map.progress().unknown;
        let share = 1.0 - proven as f64 / 25600.0;
        assert!((share - unknown).abs() < 0.02, "{unknown} of the area, {share} of the samples");
        assert!(unknown < 0.35, "{unknown}");
    }
}

#[test]
fn the_other_robots_cells_hold_too() {
    for (kind, start, world, most) in [
        ("rusty", &[1.0, 1.0, 0.0][..], crate::collision::Scene::apartment(), 0.25),
        ("hitch", &[6.5, 2.5, 0.4], crate::collision::Scene::lot(), 0.35),
        ("hitch", &[6.5, 2.5, 0.4, -0.3], crate::collision::Scene::lot(), 0.4),
        ("reach3", &[0.3, 0.2, 0.1], crate::collision::Scene::workbench(), 0.3),
    ] {
        let (robot, q) = AnyRobot::of_kind(kind, start).unwrap();
        let checker = crate::collision::Checker::new(world, robot);
        let mut map = CellMap::new(Slice::through(&checker, &q).unwrap(), 7);
        map.refine(u32::MAX);
        compare(&map, 120);
        let progress = map.progress();
        assert!(progress.done && progress.unknown < most, "{kind} {progress:?}");
        assert!(progress.free > 0.0 && progress.blocked > 0.0, "{kind} {progress:?}");
    }
}

#[test]
fn rusty_sees_the_obstacles_grown_by_its_radius() {
    let (robot, q) = AnyRobot::of_kind("rusty", &[1.0, 1.0, 0.0]).unwrap();
    let pillar = crate::geometry::Shape::Disc { radius: 0.5 };
    let bounds = crate::geometry::Aabb { min: [-2.0, -2.0].into(), max: [2.0, 2.0].into() };
    let scene = crate::collision::Scene::empty(bounds).with_obstacle("the pillar", pillar);
    let mut map = CellMap::new(Slice::through(&crate::collision::Checker::new(scene, robot), &q).unwrap(), 8);
    map.refine(u32::MAX);
    let grown = 0.5 + 0.11; // the pillar's radius and Rusty's
    let cell = 4.0 / 256.0 * 1.5;
    for k in 0..64 {
        let (s, c) = crate::num::sin_cos(f64::from(k) * PI / 32.0);
        assert_eq!(map.state([(grown - cell) * c, (grown - cell) * s]), CellState::Blocked, "{k}");
        assert_eq!(map.state([(grown + cell) * c, (grown + cell) * s]), CellState::Free, "{k}");
    }
}

#[test]
fn the_number_of_cells_is_estimated_within_a_factor_of_three_from_half_of_the_levels_on() {
    for thick in [false, true] {
        let mut whole = map(thick, 9);
        whole.refine(u32::MAX);
        let all = whole.progress().judged;
        assert_eq!(whole.expected(), all, "nothing is left to estimate");
        let mut map = map(thick, 9);
        while map.refine(100) {
            let ProofProgress { judged, .. } = map.progress();
            assert!(map.expected() > judged, "cells are left");
            if judged > 1000 {
                assert!((all / 3..=3 * all).contains(&map.expected()), "{} of {all} at {judged}", map.expected());
            }
        }
    }
}

#[test]
fn refining_in_pieces_is_refining_at_once() {
    let (mut pieces, mut whole) = (map(false, 6), map(false, 6));
    for budget in [1, 7, 100, 0, 392] {
        pieces.refine(budget);
    }
    whole.refine(500);
    assert_eq!(pieces.progress(), whole.progress());
    assert_eq!(pieces.raster(6), whole.raster(6));
    assert!(whole.refine(1) && !whole.refine(u32::MAX) && whole.progress().done);
}

#[test]
fn an_image_shows_what_the_cells_say() {
    let mut map = map(false, 6);
    map.refine(900);
    for level in [3, 6, 9] {
        let image = map.raster(level);
        let side = 1_usize << std::cmp::min(level, 6);
        assert_eq!(image.len(), side * side);
        for (k, state) in image.iter().enumerate() {
            let at = |i: usize| PI * (2.0 * (i as f64 + 0.5) / side as f64 - 1.0);
            let truth = map.state([at(k % side), at(k / side)]);
            assert!(*state == truth || (*state == CellState::Unknown && level < 6), "{k}: {state:?} {truth:?}");
        }
    }
    let areas: f64 = map.leaves().map(|leaf| 1.0 / f64::from(1_u32 << (2 * leaf.level))).sum();
    assert_eq!(areas, 1.0, "the leaves tile the slice");
}

#[test]
fn edges_of_the_square_are_one() {
    let slice = map(false, 3).slice().clone();
    assert!(slice.wraps());
    assert_eq!(slice.at([-PI, 0.3]), slice.at([PI, 0.3]));
    assert!((slice.distance([3.0, 0.0], [-3.0, 0.0]) - (2.0 * PI - 6.0)).abs() < 1e-12);
    assert!(slice.holds(&AnyConfiguration::T2(crate::configuration::T2::new(1.0, 2.0))));
    let (car, q) = AnyRobot::of_kind("hitch", &[6.5, 2.5, 0.4]).unwrap();
    let slice = Slice::through(&crate::collision::Checker::new(crate::collision::Scene::lot(), car), &q).unwrap();
    assert!(slice.holds(&q.with(0, 3.0)) && !slice.holds(&q.with(2, 0.5)), "another heading, another slice");
}
#[test]
fn neighbours_overlap_in_real_numbers_and_cover_the_whole_slice() {
    // sides that no power of two divides, so that places are rounded
    let (robot, q) = AnyRobot::of_kind("rusty", &[1.0, 1.0, 0.0]).unwrap();
    let bounds = crate::geometry::Aabb { min: [-0.1, 0.7].into(), max: [1234.7, 8.3].into() };
    let scene = crate::collision::Scene::empty(bounds);
    let rover = Slice::through(&crate::collision::Checker::new(scene, robot), &q).unwrap();
    for slice in [rover, map(false, 3).slice().clone()] {
        let map = CellMap::new(slice, MAX_LEVEL);
        // in units of 2^-60, to within one
        let exact = |x: f64| {
            (x * f64::from(1_u32 << 30)) as i128 * (1 << 30)
                + ((x * f64::from(1_u32 << 30)).fract() * f64::from(1_u32 << 30)) as i128
        };
        for level in [1, 7, MAX_LEVEL] {
            let ends = |index: u32| {
                let cell = Cell { level, index: [index; 2], state: CellState::Unknown };
                let (middle, half) = map.place(&cell);
                let half = map.slice().grown(half);
                [0, 1].map(|i| [exact(middle[i]) - exact(half[i]), exact(middle[i]) + exact(half[i])])
            };
            let last = (1 << level) - 1;
            for i in 0..2 {
                for index in 0..last {
                    assert!(ends(index)[i][1] > ends(index + 1)[i][0], "level {level}, {index}");
                }
                // a turn is 2.5e-16 more than twice the double nearest to half a turn: 283 units
                let beyond = if map.slice().wraps() { 283 } else { 0 };
                let [first, end] = [ends(0)[i][0], ends(last)[i][1]];
                let [min, max] = [map.slice().min()[i], map.slice().max()[i]].map(exact);
                assert!(first + beyond < min && end > max + beyond, "level {level}");
            }
        }
    }
}
