//! Lengths over cells that are made by hand or by a seed, held against those by hand and by sight.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::cspace::CellState;
use crate::num::{cos, greater, hypot, sin};
use crate::planning::planners::cells::norm::LengthMeasure;
use crate::random::{Seed, Stream};

fn cells<const N: usize>(
    side: usize,
    size: [f64; N],
    wraps: [bool; N],
    mut is_blocked: impl FnMut([f64; N]) -> bool,
) -> CellStates<N> {
    let steps = size.map(|size| size / side as f64);
    let min = size.map(|size| -0.5 * size);
    let mut cells = CellStates { states: vec![CellState::Unknown; side.pow(N as u32)], side, min, steps, wraps };
    for number in 0..cells.states.len() {
        if is_blocked(cells.middle(number)) {
            cells.states[number] = CellState::Blocked;
        }
    }
    cells
}

/// The greatest bound of some rounds over a plane, as the planner's has them.
fn bound<const N: usize>(
    cells: &CellStates<N>,
    measure: LengthMeasure,
    plane: [usize; 2],
    ends: [[f64; N]; 2],
) -> Option<f64> {
    let lengths = CellLengths::new(cells);
    let (mut along, mut longest) = (lengths.straight(ends), 0.0);
    for _ in 0..4 {
        let norm = CellNorm::for_path(measure, plane, cells.steps, along);
        let (length, changes) = lengths.bound(&norm, ends, [0.0; N])?;
        longest = greater(length, longest);
        along = std::array::from_fn(|i| 0.5 * (along[i] + changes[i]));
    }
    Some(longest)
}

fn is_just_below(bound: f64, length: f64, share: f64) -> bool {
    bound <= length * (1.0 + 1e-12) && bound >= length * (1.0 - share)
}

#[test]
fn in_the_open_a_bound_is_the_length_in_every_direction() {
    // cells that are long, wide and square
    for size in [[4.0, 1.0], [1.0, 3.0], [2.0, 2.0]] {
        let open = cells(64, size, [false; 2], |_| false);
        for k in 0..24 {
            let angle = TAU * (f64::from(k) + 0.3) / 24.0;
            let goal = [0.4 * size[0] * cos(angle), 0.4 * size[1] * sin(angle)];
            let start = [0.013, -0.007];
            let length = hypot(goal[0] - start[0], goal[1] - start[1]);
            let bound = bound(&open, LengthMeasure::Joints, [0, 1], [start, goal]).unwrap();
            assert!(is_just_below(bound, length, 0.03), "{size:?} {angle}: {bound} {length}");
        }
    }
    let open = cells(32, [TAU; 3], [true; 3], |_| false);
    let ends = [[3.0, 0.3, -0.3], [-3.0, 1.2, 0.4]];
    let length = hypot(hypot(TAU - 6.0, 0.9), 0.7);
    for plane in [[0, 1], [0, 2], [1, 2]] {
        let bound = bound(&open, LengthMeasure::Joints, plane, ends).unwrap();
        assert!(is_just_below(bound, length, 0.08), "over the end of a turn, {plane:?}: {bound} {length}");
    }
}

#[test]
fn round_a_wall_a_bound_is_a_taut_string_s_length() {
    let wall = cells(128, [4.0, 4.0], [false; 2], |[x, y]| x.abs() < 0.25 && y < 0.5);
    let ends = [[-1.0, 0.0], [1.0, 0.0]];
    let string = 2.0 * hypot(0.75, 0.5) + 0.5;
    let over = bound(&wall, LengthMeasure::Joints, [0, 1], ends).unwrap();
    assert!(is_just_below(over, string, 0.05), "{over} {string}");
    // shut, of cells of one row, and over the ends of a turn where there are no ends
    let mut shut = cells(128, [4.0, 4.0], [false; 2], |[x, _]| x > 0.0 && x < 0.03);
    assert_eq!(bound(&shut, LengthMeasure::Joints, [0, 1], ends), None);
    shut.wraps = [true, false];
    let round = bound(&shut, LengthMeasure::Joints, [0, 1], [[-1.0, 0.0], [1.0, 0.0]]).unwrap();
    assert!(is_just_below(round, 2.0, 1e-9), "{round}");
}

#[test]
fn a_car_drives_as_far_as_it_turns_or_moves() {
    let radius = 3.0;
    let yard = cells(32, [16.0, 8.0, TAU], [false, false, true], |_| false);
    let bound = |goal| bound(&yard, LengthMeasure::Driven(radius), [0, 1], [[0.0; 3], goal]).unwrap();
    for (goal, length) in [([0.0, 0.0, 3.0], 3.0 * radius), ([5.0, 2.0, 0.0], hypot(5.0, 2.0))] {
        assert!(is_just_below(bound(goal), length, 0.02), "{goal:?}: {} {length}", bound(goal));
    }
    // both: the longer of the two, of which mixtures are tried
    let both = bound([5.0, 2.0, -1.0]);
    assert!(is_just_below(both, hypot(5.0, 2.0), 0.15) && both > 3.0 * radius * 0.5, "{both}");
}

#[test]
fn a_path_that_may_end_beside_the_goal_may_be_shorter_by_as_much_and_not_past_a_wall() {
    let bound_by = |side: usize, is_blocked: &dyn Fn([f64; 2]) -> bool, reach: f64| {
        let cells = cells(side, [4.0, 4.0], [false; 2], is_blocked);
        let ends = [[-1.0, 0.0], [1.0, 0.0]];
        let norm = CellNorm::for_path(LengthMeasure::Joints, [0, 1], cells.steps, [1.0, 0.0]);
        CellLengths::new(&cells).bound(&norm, ends, [reach; 2]).map(|(length, _)| length)
    };
    let bound = |is_blocked: &dyn Fn([f64; 2]) -> bool, reach: f64| bound_by(128, is_blocked, reach);
    let open = bound(&|_| false, 0.25).unwrap();
    assert!(open <= 1.75 && open > 1.71, "{open}");
    // before a wall that the end may lie beyond, on the goal's side nothing is reached
    let before = bound(&|[x, _]| x > 0.9 && x < 0.95, 0.25).unwrap();
    assert!(before <= 1.75 && before > 1.71, "{before}");
    assert_eq!(bound(&|[x, _]| x > 0.6 && x < 0.7, 0.25), None);
    // by less than a cell
    let coarse = bound_by(16, &|_| false, 0.1).unwrap();
    assert!(coarse <= 1.9 && coarse > 1.7, "{coarse}");
}

/// Whether a straight line between two corners of cells passes open cells alone.
fn sees(cells: &CellStates<2>, a: [usize; 2], b: [usize; 2]) -> bool {
    let along = [0, 1].map(|i| b[i] as f64 - a[i] as f64);
    let mut cuts = vec![0.0, 1.0];
    for i in [0, 1] {
        let (low, high) = (a[i].min(b[i]), a[i].max(b[i]));
        cuts.extend((low + 1..high).map(|line| (line as f64 - a[i] as f64) / along[i]));
    }
    cuts.sort_unstable_by(f64::total_cmp);
    cuts.windows(2).filter(|pair| pair[1] > pair[0] + 1e-9).all(|pair| {
        let t = 0.5 * (pair[0] + pair[1]);
        let p = [0, 1].map(|i| a[i] as f64 + t * along[i]);
        // along a side the cells on either hand
        let sides = |i: usize| if along[i] == 0.0 { vec![p[i] - 0.5, p[i] + 0.5] } else { vec![p[i]] };
        let is_open = |x: f64, y: f64| {
            let is_in = |x: f64| x > 0.0 && x < cells.side as f64;
            is_in(x) && is_in(y) && cells.states[x as usize + cells.side * y as usize] != CellState::Blocked
        };
        sides(0).iter().any(|x| sides(1).iter().any(|y| is_open(*x, *y)))
    })
}

/// The shortest way between two corners by all corners that see each other.
fn by_sight(cells: &CellStates<2>, from: [usize; 2], to: [usize; 2]) -> f64 {
    let side = cells.side + 1;
    let corner = |number: usize| [number % side, number / side];
    let mut lengths = vec![f64::INFINITY; side * side];
    let mut open = Queue::new();
    lengths[from[0] + side * from[1]] = 0.0;
    open.push(0.0, from[0] + side * from[1]);
    let mut is_done = vec![false; side * side];
    while let Some(number) = open.pop() {
        if std::mem::replace(&mut is_done[number], true) {
            continue;
        }
        let at = corner(number);
        for other in (0..side * side).filter(|other| *other != number) {
            let next = corner(other);
            let step = hypot(
                cells.steps[0] * (next[0] as f64 - at[0] as f64),
                cells.steps[1] * (next[1] as f64 - at[1] as f64),
            );
            if lengths[number] + step < lengths[other] && sees(cells, at, next) {
                lengths[other] = lengths[number] + step;
                open.push(lengths[other], other);
            }
        }
    }
    lengths[to[0] + side * to[1]]
}

#[test]
fn no_way_by_sight_is_shorter_than_the_bound() {
    let mut draws = Stream::new(Seed(5), "planning/cell lengths");
    let (mut met, mut least) = (0, 1.0);
    for round in 0..60 {
        let size = [1.0 + 2.0 * draws.unit(), 1.0 + 2.0 * draws.unit()];
        let share = 0.1 + 0.3 * draws.unit();
        let maze = cells(10, size, [false; 2], |_| draws.unit() < share);
        let ends = [[0, 0], [10, 10]]
            .map(|[x, y]| [maze.min[0] + x as f64 * maze.steps[0], maze.min[1] + y as f64 * maze.steps[1]]);
        // the ends' own cells are open
        if [0, 99].iter().any(|cell| maze.states[*cell] == CellState::Blocked) {
            continue;
        }
        let length = by_sight(&maze, [0, 0], [10, 10]);
        let Some(bound) = bound(&maze, LengthMeasure::Joints, [0, 1], ends) else {
            assert_eq!(length, f64::INFINITY, "maze {round}: no way is said");
            continue;
        };
        assert!(bound <= length * (1.0 + 1e-12), "maze {round}: {bound} {length}");
        least = lesser(bound / length, least);
        met += 1;
    }
    assert!(met > 25 && least > 0.85, "{met} {least}");
}

#[test]
fn a_norm_is_nowhere_longer_than_what_it_measures() {
    let mut draws = Stream::new(Seed(6), "planning/norms");
    for _ in 0..20_000 {
        let mut some = |scale: f64| [draws.unit(), draws.unit(), draws.unit()].map(|u| scale * u);
        let (steps, along, cells) = (some(1.0).map(|step| step + 0.01), some(1.0), some(5.0));
        let d: [f64; 3] = std::array::from_fn(|i| cells[i] * steps[i]);
        let joints = CellNorm::for_path(LengthMeasure::Joints, [0, 2], steps, along);
        let length = hypot(hypot(d[0], d[1]), d[2]);
        assert!(joints.length(cells) <= length * (1.0 + 1e-12), "{steps:?} {along:?} {cells:?}");
        let driven = CellNorm::for_path(LengthMeasure::Driven(PI), [0, 1], steps, along);
        let length = greater(hypot(d[0], d[1]), PI * d[2]);
        assert!(driven.length(cells) <= length * (1.0 + 1e-12), "{steps:?} {along:?} {cells:?}");
        // a norm: by way of another place it is no shorter
        let part = some(1.0);
        let [one, two] = [0, 1].map(|k| {
            joints.length(std::array::from_fn::<_, 3, _>(|i| cells[i] * if k == 0 { part[i] } else { 1.0 - part[i] }))
        });
        assert!(joints.length(cells) <= (one + two) * (1.0 + 1e-12), "{steps:?} {along:?} {cells:?} {part:?}");
    }
}
