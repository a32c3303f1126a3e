//! Cells and barriers of three dimensions: an arm of three links, a car, a car with a trailer; held against sampling, a
//! flood and numbers by hand.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{Barrier, CellMap, CellState, Slice};
use motion_lab_core::num::lesser;
use motion_lab_core::planning::hybrid::HybridAStar;
use motion_lab_core::planning::{CellDecomposition, Metric, cell_length_bound};
use motion_lab_core::robots::AnyRobot;

use super::*;

/// Places of the flood along each side: no end of a cell lies on one.
const FINE: usize = 96;

fn car(trailer: bool) -> AnyRobot {
    AnyRobot::Hitch(if trailer { HITCH.with_trailer() } else { HITCH })
}

fn parked(x: f64, y: f64, theta: f64, trailer: Option<f64>) -> AnyConfiguration {
    AnyConfiguration::Hitch(HitchCfg { body: Pose2::new(x, y, theta), trailer })
}

fn bent(turns: [f64; 3]) -> AnyConfiguration {
    AnyConfiguration::T3(Tn(turns))
}

/// A yard of 24 m by 10 m with a wall of half a metre across it, from x = 12 on, that has a gap of this width in its
/// middle.
fn yard(gap: f64) -> Scene {
    let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(24.0, 10.0) };
    let block = |scene: Scene, name: &str, low: f64, high: f64| {
        scene.with_obstacle(name, Shape::Rectangle { min: [12.0, low].into(), max: [12.5, high].into() })
    };
    let lower = block(Scene::empty(bounds), "lower", -5.0, 5.0 - 0.5 * gap);
    block(lower, "upper", 5.0 + 0.5 * gap, 15.0)
}

/// An arm of three links about the origin among posts about its first link.
fn posts(count: u32, radius: f64) -> (Scene, AnyRobot) {
    let bounds = Aabb { min: Point2::new(-3.0, -3.0), max: Point2::new(3.0, 3.0) };
    let arm = Reach::<3>::try_new(Point2::new(0.0, 0.0), [0.8, 0.4, 0.3], 0.05).unwrap();
    let post = |scene: Scene, k: u32| {
        let (sin, cos) = motion_lab_core::num::sin_cos(FRAC_PI_2 * (1.0 + 2.0 * f64::from(k)));
        let pose = Pose2::new(0.5 * cos, 0.5 * sin, 0.0);
        scene.with_obstacle_at(&format!("post {k}"), pose, Shape::Disc { radius })
    };
    ((0..count).fold(Scene::empty(bounds), post), AnyRobot::Reach3(arm))
}

/// What the planner by cells comes to, with its barrier.
fn decided(scene: &Scene, robot: AnyRobot, ends: [AnyConfiguration; 2]) -> (Result<(), NoPath>, Option<Barrier>) {
    let problem = Problem::try_new(Checker::new(scene.clone(), robot), ends[0], ends[1], Seed(1)).unwrap();
    let mut planner = CellDecomposition::new(problem);
    let end = solve(&mut planner, &Bounds::default()).map(|_| ());
    let barrier = planner.barrier().map(|(barrier, _)| barrier);
    (end, barrier)
}

/// A space as places of a lattice, and which of them the cells of a barrier close.
struct Lattice {
    min: [f64; 3],
    step: [f64; 3],
    wraps: [bool; 3],
}

impl Lattice {
    fn of(scene: &Scene, barrier: &Barrier) -> Self {
        let bounds = scene.bounds();
        let low = [bounds.min.x, bounds.min.y];
        let size = [bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y];
        let wraps = [0, 1, 2].map(|i| barrier.axes[i].wraps);
        let along = |i: usize, length: [f64; 2], angle: f64| if wraps[i] { angle } else { length[i] };
        let min = [0, 1, 2].map(|i| along(i, low, -PI));
        // a hair beside the middles, so that no place is where cells end
        let step = [0, 1, 2].map(|i| along(i, size, TAU) / FINE as f64);
        Lattice { min, step, wraps }
    }

    fn count() -> usize {
        FINE * FINE * FINE
    }

    fn place(number: usize) -> [usize; 3] {
        [number % FINE, number / FINE % FINE, number / FINE / FINE]
    }

    fn nearest(&self, q: &[f64]) -> usize {
        let at = |i: usize| (((q[i] - self.min[i]) / self.step[i]).floor() as usize).min(FINE - 1);
        at(0) + FINE * (at(1) + FINE * at(2))
    }

    /// The numbers of the cells that close each place.
    fn closed(&self, barrier: &Barrier) -> Vec<Vec<usize>> {
        let mut closed = vec![Vec::new(); Self::count()];
        for (number, cell) in barrier.cells.iter().enumerate() {
            let along = |i: usize| -> Vec<usize> {
                let is_within = |k: &usize| {
                    let off = self.min[i] + (*k as f64 + 0.4999) * self.step[i] - cell.middle[i];
                    let off = if self.wraps[i] { off - TAU * (off / TAU).round_ties_even() } else { off };
                    off.abs() <= cell.half[i]
                };
                (0..FINE).filter(is_within).collect()
            };
            let [first, second, third] = [0, 1, 2].map(along);
            for z in &third {
                for y in &second {
                    first.iter().for_each(|x| closed[x + FINE * (y + FINE * z)].push(number));
                }
            }
        }
        closed
    }

    /// Whether a flood past all cells but one gets from the one place to the other.
    fn joins(&self, closed: &[Vec<usize>], [from, to]: [usize; 2], without: Option<usize>) -> bool {
        let is_closed = |place: usize| closed[place].iter().any(|by| Some(*by) != without);
        assert!(!is_closed(from) && !is_closed(to), "an end is closed");
        let (mut is_reached, mut open) = (vec![false; closed.len()], vec![from]);
        is_reached[from] = true;
        while let Some(number) = open.pop() {
            let place = Self::place(number);
            for (i, at) in place.into_iter().enumerate() {
                for step in [1, FINE - 1] {
                    let other = (at + step) % FINE;
                    if !self.wraps[i] && other.abs_diff(at) != 1 {
                        continue;
                    }
                    let stride = FINE.pow(i as u32);
                    let other = number - at * stride + other * stride;
                    if !is_closed(other) && !std::mem::replace(&mut is_reached[other], true) {
                        open.push(other);
                    }
                }
            }
        }
        is_reached[to]
    }
}

/// Checks a barrier: its cells are in contact wherever one looks, of the car alone where it pulls a trailer; they part
/// the ends; and without any one of some of them they do not. The places of the flood are finer than the cells.
fn check(scene: &Scene, robot: AnyRobot, ends: [AnyConfiguration; 2], barrier: &Barrier) {
    let mut draws = Stream::new(Seed(7), "planning/spaces");
    assert_eq!(barrier.axes.len(), 3);
    for cell in &barrier.cells {
        assert!(cell.blocking.depth > cell.blocking.bound && cell.blocking.bound > 0.0, "{cell:?}");
        for corner in 0..12 {
            // the corners, and places within
            let side = |i: usize, unit: f64| if corner < 8 { f64::from(corner >> i & 1) } else { unit };
            let place = [0, 1, 2].map(|i| cell.middle[i] + (2.0 * side(i, draws.unit()) - 1.0) * cell.half[i]);
            let q = match robot {
                AnyRobot::Hitch(_) => parked(place[0], place[1], place[2], None),
                _ => bent(place),
            };
            let alone = match robot {
                AnyRobot::Hitch(_) => car(false),
                robot => robot,
            };
            let part = alone.footprint(&q).parts()[cell.blocking.part].clone();
            let touched = scene.touched(&Footprint::new([part]));
            assert!(touched.contains(&cell.blocking.obstacle), "{q} in {cell:?} is free");
        }
    }
    let lattice = Lattice::of(scene, barrier);
    assert!(
        barrier.cells.iter().all(|cell| (0..3).all(|i| cell.half[i] > 0.5 * lattice.step[i])),
        "no place in a cell"
    );
    let closed = lattice.closed(barrier);
    let places = ends.map(|q| lattice.nearest(&q.coordinates()));
    assert!(!lattice.joins(&closed, places, None), "a flood passes the barrier");
    for without in (0..barrier.cells.len()).step_by(barrier.cells.len().div_ceil(6)) {
        assert!(lattice.joins(&closed, places, Some(without)), "cell {without} parts nothing");
    }
}

#[test]
fn a_gap_narrower_than_the_car_is_a_barrier_whatever_its_heading() {
    // the car is 1.7 m wide; a rover a tenth of that passes
    let scene = yard(1.0);
    for trailer in [None, Some(0.0)] {
        let ends = [[4.0, 5.0, 0.0], [18.0, 5.0, 0.0]].map(|[x, y, theta]| parked(x, y, theta, trailer));
        let (end, barrier) = decided(&scene, car(trailer.is_some()), ends);
        assert!(matches!(end, Err(NoPath::Unreachable { .. })), "{end:?}");
        let barrier = barrier.unwrap();
        assert_eq!(&barrier.start[..], &[4.0, 5.0, 0.0], "the trailer is left out");
        check(&scene, car(trailer.is_some()), ends, &barrier);
        let names: Vec<&str> =
            barrier.cells.iter().filter_map(|cell| scene.obstacle_name(cell.blocking.obstacle)).collect();
        assert!(["lower", "upper"].iter().all(|name| names.contains(name)), "either block is needed");
    }
}

#[test]
fn a_gap_wider_than_the_car_is_no_barrier_and_cells_do_not_say_how_to_drive() {
    let ends = [[4.0, 5.0, 0.0], [18.0, 5.0, 0.0]].map(|[x, y, theta]| parked(x, y, theta, None));
    let (end, barrier) = decided(&yard(3.0), car(false), ends);
    assert!(matches!(end, Err(NoPath::JoinedByCells { cells }) if cells > 10), "{end:?}");
    assert_eq!(barrier, None);
    let said = end.unwrap_err().to_string();
    assert!(said.starts_with("undecided: ") && said.contains("how a car drives"), "{said}");
}

#[test]
fn what_is_undecided_in_space_says_the_sides_of_its_cells() {
    // a centimetre more than the car
    let ends = [[4.0, 5.0, 0.0], [18.0, 5.0, 0.0]].map(|[x, y, theta]| parked(x, y, theta, None));
    let (end, barrier) = decided(&yard(1.71), car(false), ends);
    let Err(NoPath::Undecided { sides }) = end else { panic!("{end:?}") };
    let turn = TAU / 128.0;
    assert_eq!(sides.0, [(0.1875, "m"), (0.078125, "m"), (turn, "rad")]);
    assert_eq!(sides.to_string(), "0.1875 by 0.078125 m by 0.049087 rad");
    assert_eq!(barrier, None);
}

#[test]
fn posts_about_the_first_link_part_the_turns_of_the_shoulder_whatever_the_others_do() {
    let ends = [bent([0.0, 0.3, -0.3]), bent([PI - 0.1, 0.2, 0.4])];
    let (scene, arm) = posts(2, 0.15);
    let (end, barrier) = decided(&scene, arm, ends);
    assert!(matches!(end, Err(NoPath::Unreachable { .. })), "{end:?}");
    let barrier = barrier.unwrap();
    assert!(barrier.axes.iter().all(|axis| axis.wraps));
    check(&scene, arm, ends, &barrier);
    // with one post the arm turns round the other way
    let (scene, arm) = posts(1, 0.15);
    let problem = Problem::try_new(Checker::new(scene, arm), ends[0], ends[1], Seed(1)).unwrap();
    let mut planner = CellDecomposition::new(problem);
    let path = solve(&mut planner, &Bounds::default()).unwrap();
    assert!(planner.barrier().is_none() && path.corners().len() > 3);
    // by way of the lower half, where no post stands
    assert!(path.corners().iter().any(|q| (q.coordinates()[0] + FRAC_PI_2).abs() < 0.2), "through a post");
}

#[test]
fn samples_do_not_contradict_what_is_proven_of_cells_in_space() {
    let lot = Checker::new(Scene::lot(), car(false));
    let (scene, arm) = posts(2, 0.15);
    for (checker, least) in [(lot, 0.2), (Checker::new(scene, arm), 0.3)] {
        let slice = Slice::space(&checker).unwrap();
        let mut map = CellMap::new(slice.clone(), 5);
        map.refine(u32::MAX);
        let progress = map.progress();
        assert!(progress.done && progress.free > 0.05 && progress.blocked > 0.05, "{progress:?}");
        assert!((progress.free + progress.blocked + progress.unknown - 1.0).abs() < 1e-12);
        let raster = map.raster(5);
        let (mut draws, mut proven) = (Stream::new(Seed(3), "planning/space samples"), 0);
        for _ in 0..20_000 {
            let part = [draws.unit(), draws.unit(), draws.unit()];
            let p = [0, 1, 2].map(|i| slice.min()[i] + part[i] * (slice.max()[i] - slice.min()[i]));
            let [column, row, layer] = part.map(|u| (32.0 * u) as usize);
            let state = map.state(p);
            assert_eq!(raster[column + 32 * (row + 32 * layer)], state, "{p:?}");
            let is_free = checker.is_free(&slice.at(p));
            assert!(if is_free { state != CellState::Blocked } else { state != CellState::Free }, "{p:?} {state:?}");
            proven += usize::from(state != CellState::Unknown);
        }
        let share = proven as f64 / 20_000.0;
        assert!(share > least && (share - progress.free - progress.blocked).abs() < 0.02, "{share} {progress:?}");
    }
}

#[test]
fn no_path_is_shorter_than_the_bound_that_cells_prove() {
    let mut draws = Stream::new(Seed(11), "planning/cell bounds");
    let (mut met, mut nearest) = ([0; 3], f64::INFINITY);
    for round in 0..24 {
        let kind = round % 3;
        let (scene, robot, ends) = match kind {
            0 => {
                let turns = [2.0 + 0.2 * draws.unit(), 3.1 - 0.2 * draws.unit()];
                let ends = turns.map(|turn| AnyConfiguration::T2(Tn([turn, 0.4 * draws.unit()])));
                (Scene::workbench(), AnyRobot::Reach(Reach::workbench()), ends)
            }
            1 => {
                let (scene, arm) = posts(1, 0.12);
                let ends =
                    [[0.1, 0.3, -0.3], [3.0, 0.2, 0.4]].map(|turns| bent(turns.map(|turn| turn - 0.2 * draws.unit())));
                (scene, arm, ends)
            }
            _ => {
                let ends = [4.0, 18.0].map(|x| parked(x, 5.0 + draws.unit(), 0.4 * draws.unit(), None));
                (yard(2.6 + draws.unit()), car(false), ends)
            }
        };
        let problem = Problem::try_new(Checker::new(scene, robot), ends[0], ends[1], Seed(round)).unwrap();
        let near = if kind == 2 { &[0.1, 0.1, 0.05][..] } else { &[] };
        let bound = cell_length_bound(&problem, near).unwrap();
        let straight = Metric::unit(&ends[0]).distance(&ends[0], &ends[1]);
        let length = match (robot, ends) {
            (AnyRobot::Hitch(car), [AnyConfiguration::Hitch(start), AnyConfiguration::Hitch(goal)]) => {
                let scene = problem.checker().scene().clone();
                let own = Problem::try_new(Checker::new(scene, car), start, goal, Seed(round)).unwrap();
                let Ok(path) = solve(&mut HybridAStar::new(own), &Bounds::of_iterations(3000)) else { continue };
                let arcs = path.legs().iter().map(|leg| leg.motion());
                arcs.map(|arc| (arc.control().v * arc.seconds()).abs()).sum()
            }
            _ => {
                let path = solve(&mut RrtConnect::new(problem.clone()), &Bounds::default()).unwrap();
                assert!(bound > 0.999 * straight, "round {round}: {bound} is shorter than the straight line");
                path.length(&Metric::unit(&ends[0]))
            }
        };
        assert!(bound <= length, "round {round}: {bound} {length}");
        nearest = lesser(length / bound, nearest);
        met[kind as usize] += 1;
    }
    assert!(met.iter().all(|met| *met > 4) && nearest < 1.05, "{met:?} {nearest}");
}

#[test]
fn where_cells_prove_that_there_is_no_path_the_bound_is_infinite() {
    let ends = [[4.0, 5.0, 0.0], [18.0, 5.0, 0.0]].map(|[x, y, theta]| parked(x, y, theta, Some(theta)));
    let problem = |gap: f64| Problem::try_new(Checker::new(yard(gap), car(true)), ends[0], ends[1], Seed(1)).unwrap();
    assert_eq!(cell_length_bound(&problem(1.0), &[]), Some(f64::INFINITY));
    let straight = cell_length_bound(&problem(3.0), &[]).unwrap();
    assert!(straight <= 14.0 && straight > 13.99, "{straight}");
    // a disc has a bound of its own
    let rover = AnyRobot::Rusty(Rusty { body_radius: 0.2, ..RUSTY });
    let [start, goal] = [4.0, 18.0].map(|x| AnyConfiguration::Pose(Pose2::new(x, 5.0, 0.0)));
    let rover = Problem::try_new(Checker::new(yard(1.0), rover), start, goal, Seed(1)).unwrap();
    assert_eq!(cell_length_bound(&rover, &[]), None);
}

#[test]
fn ends_that_are_all_but_one_are_no_proof_and_no_bound_beyond_their_distance() {
    let yard = yard(3.0);
    for (x, trailer) in [(1e-170, None), (1e-12, Some(0.0)), (1e-7, None), (0.0, None)] {
        let [start, goal] = [0.0, x].map(|x| parked(x, 5.0, 0.0, trailer));
        let problem = Problem::try_new(Checker::new(yard.clone(), car(trailer.is_some())), start, goal, Seed(1));
        let bound = cell_length_bound(&problem.unwrap(), &[]).unwrap();
        assert!(bound >= 0.0 && bound <= x, "{x}: {bound}");
    }
    let arm = Checker::new(Scene::workbench(), AnyRobot::Reach(Reach::workbench()));
    for x in [1e-300, 1e-13, 1e-9, 1e-7, 1e-5] {
        let turns = [1.7, 1.7 + x];
        let ends = turns.map(|turn| AnyConfiguration::T2(Tn([turn, 0.3])));
        let bound = cell_length_bound(&Problem::try_new(arm.clone(), ends[0], ends[1], Seed(1)).unwrap(), &[]).unwrap();
        assert!(bound >= 0.0 && bound <= turns[1] - turns[0], "{x}: {bound}");
    }
    // what is no distance counts as none
    let ends = [4.0, 18.0].map(|x| parked(x, 5.0, 0.0, None));
    let problem = Problem::try_new(Checker::new(yard, car(false)), ends[0], ends[1], Seed(1)).unwrap();
    let bound = |reach: f64| cell_length_bound(&problem, &[reach; 3]).unwrap();
    assert!([-1.0, f64::NAN, f64::NEG_INFINITY].iter().all(|reach| bound(*reach) == bound(0.0)));
    assert_eq!(bound(f64::INFINITY), 0.0);
}
