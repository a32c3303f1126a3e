//! Barriers: the blocked cells that part a start from a goal, held against sampling, other planners and numbers by
//! hand.

use std::f64::consts::{FRAC_PI_2, TAU};

use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{Barrier, CellMap, Slice};
use motion_lab_core::planning::{CellDecomposition, CellSides};
use motion_lab_core::robots::AnyRobot;

use super::*;

/// Cells of the finest level along a side, as the planner has them.
const FINE: usize = 128;

fn rover(radius: f64) -> AnyRobot {
    AnyRobot::Rusty(Rusty { body_radius: radius, ..RUSTY })
}

fn at(x: f64, y: f64) -> AnyConfiguration {
    AnyConfiguration::Pose(Pose2::new(x, y, 0.0))
}

fn turned(th1: f64, th2: f64) -> AnyConfiguration {
    AnyConfiguration::T2(Tn([th1, th2]))
}

fn square(side: f64) -> Scene {
    Scene::empty(Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(side, side) })
}

fn block(scene: Scene, name: &str, min: [f64; 2], max: [f64; 2]) -> Scene {
    scene.with_obstacle(name, Shape::Rectangle { min: min.into(), max: max.into() })
}

/// What the planner by cells comes to, and the barrier that its cells hold.
fn decided(scene: Scene, robot: AnyRobot, ends: [AnyConfiguration; 2]) -> (Result<(), NoPath>, Option<Barrier>) {
    let problem = Problem::try_new(Checker::new(scene, robot), ends[0], ends[1], Seed(1)).unwrap();
    let mut planner = CellDecomposition::new(problem);
    let end = solve(&mut planner, &Bounds::default()).map(|_| ());
    let barrier = planner.cells().and_then(|cells| Barrier::between(cells, &ends[0], &ends[1]));
    (end, barrier)
}

/// The slice cut into the finest cells, each with the cell of a barrier that closes it. Its middles lie on no cell's
/// side.
struct Flood {
    slice: Slice,
    closed_by: Vec<Option<usize>>,
}

impl Flood {
    fn past(slice: &Slice, barrier: &Barrier) -> Self {
        let mut flood = Flood { slice: slice.clone(), closed_by: vec![None; FINE * FINE] };
        for number in 0..FINE * FINE {
            let p = flood.middle(number);
            flood.closed_by[number] =
                barrier.cells.iter().position(|cell| (0..2).all(|k| flood.gap(p[k], cell.middle[k]) <= cell.half[k]));
        }
        flood
    }

    fn gap(&self, a: f64, b: f64) -> f64 {
        let gap = (a - b).abs();
        if self.slice.wraps() && gap > 0.5 * TAU { TAU - gap } else { gap }
    }

    fn middle(&self, number: usize) -> [f64; 2] {
        let (min, max) = (self.slice.min(), self.slice.max());
        let place = [number % FINE, number / FINE];
        [0, 1].map(|k| min[k] + (place[k] as f64 + 0.5) / FINE as f64 * (max[k] - min[k]))
    }

    /// The cells at whose sides or within which a place lies.
    fn cells_at(&self, p: &[f64]) -> Vec<usize> {
        let (min, max) = (self.slice.min(), self.slice.max());
        let is_at = |number: &usize| {
            let middle = self.middle(*number);
            let half = |k: usize| 0.5 / FINE as f64 * (max[k] - min[k]);
            (0..2).all(|k| self.gap(p[k], middle[k]) <= half(k) * (1.0 + 1e-9))
        };
        (0..FINE * FINE).filter(is_at).collect()
    }

    fn beside(&self, number: usize) -> Vec<usize> {
        let (column, row) = (number % FINE, number / FINE);
        let step = |i: usize, by: usize| {
            let to = (i + by) % FINE;
            (self.slice.wraps() || i.abs_diff(to) == 1).then_some(to)
        };
        let across = [1, FINE - 1].into_iter().filter_map(|by| step(column, by).map(|column| row * FINE + column));
        let along = [1, FINE - 1].into_iter().filter_map(|by| step(row, by).map(|row| row * FINE + column));
        across.chain(along).collect()
    }

    /// Whether a flood from one place gets to the other past all cells of the barrier but one.
    fn joins(&self, from: &[f64], to: &[f64], without: Option<usize>) -> bool {
        let is_closed = |cell: usize| self.closed_by[cell].is_some_and(|by| Some(by) != without);
        let mut open = self.cells_at(from);
        assert!(!open.is_empty() && !open.iter().any(|cell| is_closed(*cell)), "an end is not closed");
        let mut is_reached = vec![false; FINE * FINE];
        open.iter().for_each(|cell| is_reached[*cell] = true);
        while let Some(cell) = open.pop() {
            for other in self.beside(cell) {
                if !is_closed(other) && !std::mem::replace(&mut is_reached[other], true) {
                    open.push(other);
                }
            }
        }
        self.cells_at(to).iter().any(|cell| is_reached[*cell])
    }
}

/// Checks a barrier by the exact query and by flooding: its cells are in contact wherever one looks, all of them part
/// the ends, and all but any one do not.
fn check(scene: &Scene, robot: AnyRobot, ends: [AnyConfiguration; 2], barrier: &Barrier) {
    let slice = Slice::through(&Checker::new(scene.clone(), robot), &ends[0]).unwrap();
    let [from, to] = ends.map(|q| slice.point(&q.in_chart()));
    assert_eq!((&barrier.start[..], &barrier.goal[..]), (&from[..], &to[..]));
    for cell in &barrier.cells {
        assert!(cell.blocking.depth > cell.blocking.bound && cell.blocking.bound > 0.0, "{cell:?}");
        for (u, v) in (0..25).map(|k| (f64::from(k % 5) / 2.0 - 1.0, f64::from(k / 5) / 2.0 - 1.0)) {
            let q = slice.at([cell.middle[0] + u * cell.half[0], cell.middle[1] + v * cell.half[1]]);
            let footprint = robot.footprint(&q);
            assert!(scene.intersects(&footprint), "{q} in {cell:?} is free");
            let part = Footprint::new([footprint.parts()[cell.blocking.part].clone()]);
            assert!(scene.touched(&part).contains(&cell.blocking.obstacle), "{q} in {cell:?} meets something else");
        }
    }
    let flood = Flood::past(&slice, barrier);
    assert!(!flood.joins(&from, &to, None), "a flood passes the barrier");
    for (without, cell) in barrier.cells.iter().enumerate() {
        assert!(flood.joins(&from, &to, Some(without)), "{cell:?} parts nothing");
    }
}

/// Whether samples a centimetre or so apart join the ends, each free by the exact query.
fn samples_join(scene: &Scene, robot: AnyRobot, side: f64, ends: [AnyConfiguration; 2]) -> bool {
    const SIDE: usize = 301;
    let step = side / (SIDE - 1) as f64;
    let place = |number: usize| at((number % SIDE) as f64 * step, (number / SIDE) as f64 * step);
    let is_free = |number: usize| !scene.intersects(&robot.footprint(&place(number)));
    let [from, to] = ends.map(|q| {
        let [column, row] = [0, 1].map(|k| (q.coordinates()[k] / step).round_ties_even() as usize);
        row * SIDE + column
    });
    let (mut open, mut is_seen) = (vec![from], vec![false; SIDE * SIDE]);
    while let Some(number) = open.pop() {
        let (column, row) = (number % SIDE, number / SIDE);
        let beside = [
            (column > 0).then(|| number - 1),
            (column + 1 < SIDE).then_some(number + 1),
            (row > 0).then(|| number - SIDE),
            (row + 1 < SIDE).then_some(number + SIDE),
        ];
        for other in beside.into_iter().flatten() {
            if !std::mem::replace(&mut is_seen[other], true) && is_free(other) {
                open.push(other);
            }
        }
        if number == to {
            return true;
        }
    }
    false
}

#[test]
fn the_barrier_of_a_corridor_lies_in_the_wall_that_closes_it_grown_by_the_radius() {
    // a corridor 1 m wide, closed from x = 1.8 to 2.2
    let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(4.0, 1.0) };
    let scene = block(Scene::empty(bounds), "the wall", [1.8, -1.0], [2.2, 2.0]);
    let ends = [at(0.5, 0.5), at(3.5, 0.5)];
    let (end, barrier) = decided(scene.clone(), rover(0.1), ends);
    assert!(matches!(end, Err(NoPath::Unreachable { .. })), "{end:?}");
    let barrier = barrier.unwrap();
    for cell in &barrier.cells {
        let [left, right] = [-1.0, 1.0].map(|side| cell.middle[0] + side * cell.half[0]);
        assert!(left > 1.7 && right < 2.3, "{cell:?}");
        assert_eq!(scene.obstacle_name(cell.blocking.obstacle), Some("the wall"));
        // within the wall, straight out is the nearest way out
        let out = 0.3 - (cell.middle[0] - 2.0).abs();
        assert!(cell.blocking.depth <= out && cell.blocking.depth > out - 1e-9, "{cell:?}: {out} m");
    }
    let names: Vec<(&str, bool)> = barrier.axes.iter().map(|axis| (axis.name.as_str(), axis.wraps)).collect();
    assert_eq!(names, [("x", false), ("y", false)]);
    check(&scene, rover(0.1), ends, &barrier);
}

#[test]
fn the_least_number_of_cells_is_the_one_by_hand() {
    // Cells of 1 m: at x = 3.5 the disc of 0.5 m is 1.5 m deep in the wall, and 0.5 m at x = 2.5 and 4.5; the corner of
    // a cell is 0.71 m off. Cells of 2 m about x = 3 are 1 m deep, and their corners 1.41 m off. So one column closes.
    let wall = block(square(8.0), "the wall", [2.5, -1.0], [4.5, 9.0]);
    let map = |scene: &Scene| {
        let slice = Slice::through(&Checker::new(scene.clone(), rover(0.5)), &at(1.0, 1.0)).unwrap();
        let mut map = CellMap::new(slice, 3);
        map.refine(u32::MAX);
        map
    };
    let ends = [at(1.0, 1.0), at(7.0, 7.0)];
    let barrier = Barrier::between(&map(&wall), &ends[0], &ends[1]).unwrap();
    let columns: Vec<[f64; 2]> = barrier.cells.iter().map(|cell| [cell.middle[0], cell.middle[1]]).collect();
    let mut expected: Vec<[f64; 2]> = (0..8).map(|k| [3.5, f64::from(k) + 0.5]).collect();
    expected.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let mut sorted = columns;
    sorted.sort_by(|a, b| a[1].total_cmp(&b[1]));
    assert_eq!(sorted, expected);
    // a disc about the middle of a cell of 2 m, 2 m deep there: one cell in place of two
    let knob = wall.with_obstacle_at("the knob", Pose2::new(3.0, 3.0, 0.0), Shape::Disc { radius: 1.5 });
    let barrier = Barrier::between(&map(&knob), &ends[0], &ends[1]).unwrap();
    assert_eq!(barrier.cells.len(), 7);
    let coarse = &barrier.cells[0];
    assert!(coarse.middle[..] == [3.0, 3.0] && coarse.half.iter().all(|half| (1.0..1.0 + 1e-12).contains(half)));
    assert!((coarse.blocking.depth - 2.0).abs() < 1e-9 && (coarse.blocking.bound - 2.0_f64.sqrt()).abs() < 1e-9);
    // on the same side there is nothing to part
    assert_eq!(Barrier::between(&map(&knob), &ends[0], &at(1.0, 7.0)), None);
    // nor is anything known of a map that has judged nothing
    let slice = Slice::through(&Checker::new(knob, rover(0.5)), &ends[0]).unwrap();
    assert_eq!(Barrier::between(&CellMap::new(slice, 3), &ends[0], &ends[1]), None);
}

#[test]
fn an_end_on_the_sides_of_cells_is_parted_from_each_of_them() {
    // the start is the middle of the square, at a corner of four cells on every level
    let ring = [([3.0, 3.0], [3.4, 5.0]), ([4.6, 3.0], [5.0, 5.0]), ([3.0, 3.0], [5.0, 3.4]), ([3.0, 4.6], [5.0, 5.0])];
    let scene = ring.iter().fold(square(8.0), |scene, (min, max)| block(scene, "ring", *min, *max));
    let corner = at(8.0, 8.0);
    for ends in [[at(4.0, 4.0), corner], [corner, at(4.0, 4.0)], [at(4.0, 4.0), at(4.0, 8.0)]] {
        let (end, barrier) = decided(scene.clone(), rover(0.25), ends);
        assert!(matches!(end, Err(NoPath::Unreachable { .. })), "{end:?}");
        check(&scene, rover(0.25), ends, &barrier.unwrap());
    }
    let within = Slice::through(&Checker::new(scene, rover(0.25)), &corner).unwrap();
    let mut map = CellMap::new(within, 7);
    map.refine(u32::MAX);
    assert_eq!(Barrier::between(&map, &at(3.2, 4.0), &corner), None, "a start in a blocked cell");
    assert_eq!(Barrier::between(&map, &at(9.0, 4.0), &corner), None, "a start outside");
}

/// Two posts hard by the first link, at half a metre, that part its turns.
fn two_posts() -> Scene {
    let post = |scene: Scene, (name, y): (&str, f64)| {
        scene.with_obstacle_at(name, Pose2::new(0.0, y, 0.0), Shape::Disc { radius: 0.1 })
    };
    [("up", 0.5), ("down", -0.5)].into_iter().fold(Scene::empty(Scene::workbench().bounds()), post)
}

#[test]
fn on_a_torus_a_barrier_goes_round_twice() {
    let arm = AnyRobot::Reach(Reach::workbench());
    for ends in [[turned(0.0, 0.0), turned(3.1, 0.0)], [turned(-3.1, 0.1), turned(0.2, -3.0)]] {
        let (end, barrier) = decided(two_posts(), arm, ends);
        assert!(matches!(end, Err(NoPath::Unreachable { .. })), "{end:?}");
        let barrier = barrier.unwrap();
        check(&two_posts(), arm, ends, &barrier);
        // either post alone leaves the way round over the other
        for post in 0..2 {
            assert!(barrier.cells.iter().any(|cell| cell.blocking.obstacle.0 == post), "{post}");
        }
        assert!(barrier.axes.iter().all(|axis| axis.wraps));
        // the first link meets a post where the sine of its angle from it is at most 0.13 m by 0.5 m
        for cell in barrier.cells.iter().filter(|cell| cell.blocking.part == 0) {
            let off = (cell.middle[0].abs() - FRAC_PI_2).abs() + cell.half[0];
            assert!(off < 0.2631, "{cell:?}");
        }
    }
    let one = two_posts().bounds();
    let one = Scene::empty(one).with_obstacle_at("up", Pose2::new(0.0, 0.5, 0.0), Shape::Disc { radius: 0.1 });
    let (end, barrier) = decided(one, arm, [turned(0.0, 0.0), turned(3.1, 0.0)]);
    assert!(end.is_ok() && barrier.is_none());
}

#[test]
fn angles_beyond_half_a_turn_are_where_they_are() {
    // the same way as from 0 to 0.3, beside the posts; and the same as from 0 to 3.1, between them
    let arm = AnyRobot::Reach(Reach::workbench());
    for turns in [-1.0, 3.0] {
        let start = turned(turns * TAU, 0.0);
        let (end, barrier) = decided(two_posts(), arm, [start, turned(0.3, 0.0)]);
        assert!(!matches!(end, Err(NoPath::Unreachable { .. })) && barrier.is_none(), "{turns} turns: {end:?}");
        let (end, barrier) = decided(two_posts(), arm, [start, turned(3.1, 0.0)]);
        assert!(matches!(end, Err(NoPath::Unreachable { .. })), "{turns} turns: {end:?}");
        check(&two_posts(), arm, [start, turned(3.1, 0.0)], &barrier.unwrap());
    }
}

#[test]
fn a_plane_of_a_cars_space_has_no_barrier_since_it_may_turn() {
    let (car, q) = AnyRobot::of_kind("hitch", &[6.5, 2.5, 0.0]).unwrap();
    let mut map = CellMap::new(Slice::through(&Checker::new(Scene::lot(), car), &q).unwrap(), 7);
    map.refine(u32::MAX);
    assert_eq!(Barrier::between(&map, &q, &q.with(0, 7.0)), None);
}

#[test]
fn what_is_undecided_says_how_small_its_cells_are() {
    // a gap of a millimetre more than the rover: cells of 8 m / 128 and 2 m / 128 are too coarse for it
    let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(8.0, 2.0) };
    let lower = block(Scene::empty(bounds), "lower", [3.9, -1.0], [4.1, 0.9]);
    let scene = block(lower, "upper", [3.9, 1.101], [4.1, 3.0]);
    let (end, barrier) = decided(scene, rover(0.1), [at(1.0, 1.0), at(7.0, 1.0)]);
    let reason = end.unwrap_err();
    assert_eq!(reason, NoPath::Undecided { sides: CellSides(vec![(0.0625, "m"), (0.015625, "m")]) });
    assert_eq!(reason.to_string(), "undecided: cells of 0.0625 by 0.015625 m are proven neither free nor blocked");
    assert!(barrier.is_none());
}

/// Boxes and discs here and there in a square of 6 m.
fn generated(seed: u64) -> Scene {
    let mut draws = Stream::new(Seed(seed), "planning/barriers");
    (0..18).fold(square(6.0), |scene, k| {
        let (x, y) = (draws.uniform(0.0, 6.0), draws.uniform(0.0, 6.0));
        let size = [draws.uniform(0.05, 0.9), draws.uniform(0.05, 0.9)];
        let pose = Pose2::new(x, y, draws.uniform(-3.0, 3.0));
        let shape = if k % 3 == 0 {
            Shape::Disc { radius: size[0] }
        } else {
            Shape::Rectangle { min: [-size[0], -size[1]].into(), max: size.into() }
        };
        scene.with_obstacle_at(&format!("obstacle {k}"), pose, shape)
    })
}

#[test]
fn in_generated_worlds_nothing_gets_past_a_barrier_and_no_cell_of_it_is_spare() {
    let robot = rover(0.2);
    let (mut none, mut paths, mut cells) = (0, 0, 0);
    for seed in 0..count_from_env(PLANS, 40) {
        let scene = generated(seed);
        let mut draws = Stream::new(Seed(seed), "planning/barriers/ends");
        let mut place = || loop {
            let q = at(draws.uniform(0.0, 6.0), draws.uniform(0.0, 6.0));
            if scene.distance(&robot.footprint(&q)) > 0.05 {
                return q;
            }
        };
        let ends = [place(), place()];
        let (end, barrier) = decided(scene.clone(), robot, ends);
        match end {
            Ok(()) => {
                assert!(barrier.is_none() && samples_join(&scene, robot, 6.0, ends), "{seed}");
                paths += 1;
            }
            Err(NoPath::Unreachable { .. }) => {
                let barrier = barrier.unwrap();
                check(&scene, robot, ends, &barrier);
                assert!(!samples_join(&scene, robot, 6.0, ends), "{seed}: samples get across");
                let problem = Problem::try_new(Checker::new(scene, robot), ends[0], ends[1], Seed(seed)).unwrap();
                let other = solve(&mut RrtConnect::new(problem), &Bounds::of_iterations(1000));
                assert!(matches!(other, Err(NoPath::Exhausted { .. })), "{seed}: another planner gets across");
                none += 1;
                cells += barrier.cells.len();
            }
            Err(reason) => assert!(matches!(reason, NoPath::Undecided { .. }) && barrier.is_none(), "{reason}"),
        }
    }
    assert!(none >= 8 && paths >= 8 && cells > 10 * none, "{none} without a path, {paths} with one, {cells} cells");
}
