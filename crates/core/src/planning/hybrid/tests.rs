//! Hybrid A* in the Lot and among walls, judged by what the car drives.

use std::f64::consts::{FRAC_PI_2, PI};

use super::*;
use crate::collision::{Checker, Collision, GoalRegion, Problem, Scene};
use crate::configuration::HitchCfg;
use crate::geometry::{Point2, Pose2, Segment};
use crate::num::{hypot, wrap};
use crate::planning::{Bounds, CertifiedPath, NoPath, Planner, solve};
use crate::random::Seed;
use crate::robots::{HITCH, Hitch, HitchArc, Motion, Robot};

fn problem(scene: Scene, car: Hitch, start: [f64; 4], goal: [f64; 4]) -> Problem<Hitch> {
    let at = |[x, y, theta, psi]: [f64; 4]| HitchCfg {
        body: Pose2::new(x, y, theta),
        trailer: car.hitch_len.map(|_| wrap(psi)),
    };
    Problem::try_new(Checker::new(scene, car), at(start), at(goal), Seed(1)).unwrap()
}

/// The trailer and the rear of the car in bay 2 of the Lot, from the resident's start.
fn bay_2() -> Problem<Hitch> {
    let goal = [6.75, 7.0, -FRAC_PI_2, -FRAC_PI_2];
    problem(Scene::lot(), HITCH.with_trailer(), [6.5, 2.5, 0.0, 0.0], goal)
}

/// Checks a path tick by tick by the car's own equation of motion, and that no place along it touches anything.
fn check(problem: &Problem<Hitch>, planner: &HybridAStar, path: &CertifiedPath<HitchArc>) {
    let (scene, car) = (problem.checker().scene(), problem.checker().robot());
    let mut q = problem.start();
    let mut ticks = 0;
    for m in planner.moves() {
        let control = m.control(car);
        assert!(control.v.abs() <= car.max_speed && control.phi.abs() <= car.max_steer, "{m:?}");
        for _ in 0..m.ticks {
            q = car.step(&q, &control, 0.05).unwrap();
            assert!(!scene.intersects(&car.footprint(&q)), "{q}");
            ticks += 1;
        }
    }
    assert_eq!(q, path.goal(), "the moves are the path, bit for bit");
    assert!(ticks > 20);
    let goal = problem.goal();
    let off = hypot(q.body.x - goal.body.x, q.body.y - goal.body.y);
    let angles = [Some(wrap(q.body.theta - goal.body.theta)), q.trailer.zip(goal.trailer).map(|(a, b)| wrap(a - b))];
    assert!(off <= 0.1 && angles.into_iter().flatten().all(|angle| angle.abs() <= 0.05), "{q} for {goal}");
    assert!(path.verify(scene).unwrap() > 0.0);
}

#[test]
fn the_trailer_is_parked_in_bay_2() {
    let problem = bay_2();
    let mut planner = HybridAStar::new(problem.clone());
    let path = solve(&mut planner, &Bounds::default()).unwrap();
    check(&problem, &planner, &path);
    // the trailer stands within the bay's marks, 5.5 to 8 m and 5.25 to 10 m
    let footprint = problem.checker().robot().footprint(&path.goal());
    for corner in footprint.parts()[1].placed().core() {
        assert!((5.5..8.0).contains(&corner.x) && (5.25..10.0).contains(&corner.y), "{corner}");
    }
    assert!(planner.growth().effort().edges < 100_000, "{:?}", planner.growth().effort());
    // stepped again, it is the same
    let mut again = HybridAStar::new(problem);
    solve(&mut again, &Bounds::default()).unwrap();
    assert_eq!(again.moves(), planner.moves());
}

#[test]
fn a_car_parks_in_every_bay_and_turns_among_walls() {
    for (i, x) in [4.25, 6.75, 9.25, 11.75].into_iter().enumerate() {
        let problem = problem(Scene::lot(), HITCH, [6.5, 2.5, 0.0, 0.0], [x, 8.875, -FRAC_PI_2, 0.0]);
        let mut planner = HybridAStar::new(problem.clone());
        let path = solve(&mut planner, &Bounds::default()).unwrap_or_else(|why| panic!("bay {}: {why}", i + 1));
        check(&problem, &planner, &path);
    }
    // around the end of a wall, to the opposite heading
    let wall = |x0, y0, x1, y1| Segment::new(Point2::new(x0, y0), Point2::new(x1, y1));
    let walls = [
        wall(-2.0, -6.0, 22.0, -6.0),
        wall(22.0, -6.0, 22.0, 12.0),
        wall(22.0, 12.0, -2.0, 12.0),
        wall(-2.0, 12.0, -2.0, -6.0),
        wall(-2.0, 3.0, 14.0, 3.0),
    ];
    let problem = problem(Scene::of_walls(&walls), HITCH, [2.0, 0.0, 0.0, 0.0], [6.0, 6.5, PI, 0.0]);
    let mut planner = HybridAStar::new(problem.clone());
    let path = solve(&mut planner, &Bounds::default()).unwrap();
    check(&problem, &planner, &path);
}

/// All places from a line on, whatever the headings.
#[derive(Debug)]
struct EastOf(f64);

impl GoalRegion<HitchCfg> for EastOf {
    fn contains(&self, q: &HitchCfg) -> bool {
        q.body.x >= self.0
    }
}

/// The goal itself lies behind a wall, so that no shot leads to it; its region begins before the wall.
#[test]
fn the_moves_of_a_path_that_ends_in_a_region_are_those_of_the_path() {
    let wall = |x0, y0, x1, y1| Segment::new(Point2::new(x0, y0), Point2::new(x1, y1));
    let walls = [wall(0.0, 0.0, 30.0, 0.0), wall(0.0, 12.0, 30.0, 12.0), wall(20.0, 0.0, 20.0, 12.0)];
    for x in [4.0, 6.0, 9.5, 14.0] {
        let problem = problem(Scene::of_walls(&walls), HITCH, [3.0, 6.0, 0.1, 0.0], [24.0, 6.0, 0.0, 0.0]);
        let problem = problem.try_with_region(std::sync::Arc::new(EastOf(x))).unwrap();
        let mut planner = HybridAStar::new(problem.clone());
        let path = solve(&mut planner, &Bounds::default()).unwrap();
        let ends = |q, m: CarMove| m.drive(&HITCH, &q).unwrap().at(1.0);
        assert_eq!(planner.moves().into_iter().fold(problem.start(), ends), path.goal(), "from {x} m on");
        assert!(path.goal().body.x >= x && planner.moves().len() == path.legs().len());
    }
}

#[test]
fn what_has_no_path_ends_within_its_bound() {
    // a garage of four walls around the goal
    let wall = |x0, y0, x1, y1| Segment::new(Point2::new(x0, y0), Point2::new(x1, y1));
    let mut walls = vec![wall(0.0, 0.0, 30.0, 0.0), wall(30.0, 0.0, 30.0, 12.0)];
    walls.extend([wall(30.0, 12.0, 0.0, 12.0), wall(0.0, 12.0, 0.0, 0.0), wall(15.0, 0.0, 15.0, 12.0)]);
    let problem = problem(Scene::of_walls(&walls), HITCH, [5.0, 6.0, 0.0, 0.0], [24.0, 6.0, 0.0, 0.0]);
    let mut planner = HybridAStar::new(problem);
    let Err(NoPath::Exhausted { effort, .. }) = solve(&mut planner, &Bounds::of_iterations(300)) else {
        panic!("there is no path, and more than 300 configurations to expand");
    };
    assert_eq!(effort.iterations, 300);
    assert!(planner.path().is_none() && planner.moves().is_empty());
}

#[test]
fn moves_over_a_length_are_right_to_half_a_unit() {
    for length in [3.0, -3.0, 0.0749, 0.075, -0.0751, 1e-5, 12.3456] {
        let driven: f64 = CarMove::over(&HITCH, length, 128).map(|m| m.length(&HITCH)).sum();
        assert!((driven - length).abs() <= 0.5 * 1.5 * 0.05 / 128.0 + 1e-12, "{driven} for {length}");
    }
    let q = HitchCfg { body: Pose2::IDENTITY, trailer: None };
    let m = CarMove { speed: -64, steering: 32, ticks: 3 };
    let by_hand = HITCH.step(&q, &crate::robots::CarCmd { v: -0.75, phi: 0.15 }, 0.15).unwrap();
    assert_eq!(m.drive(&HITCH, &q).unwrap().at(1.0), by_hand);
}

/// The poses in which a problem is the same, seen by somebody who stands elsewhere: none of them along an axis.
#[test]
fn a_shot_is_the_same_wherever_the_goal_lies_and_whichever_way_it_points() {
    let car = HITCH.with_trailer();
    let bounds = crate::geometry::Aabb { min: Point2::new(-90.0, -90.0), max: Point2::new(90.0, 90.0) };
    // seen from the goal: before it, beside its line, turned and folded, and a metre too far away for as many moves
    for [x, y, theta, psi] in
        [[4.0, 0.1, 0.0, 0.0], [8.0, 0.4, 0.0, 0.0], [12.0, 0.5, 0.1, 0.05], [16.0, 0.0, 0.0, 0.0]]
    {
        let seen_from = |goal: Pose2| {
            let turned = |angle: f64| Some(wrap(angle + goal.theta));
            let q = HitchCfg { body: goal.compose(&Pose2::new(x, y, theta)), trailer: turned(psi) };
            let goal = HitchCfg { body: goal, trailer: turned(0.0) };
            let settings = HybridSettings::default();
            let problem = Problem::try_new(Checker::new(Scene::empty(bounds), car), q, goal, Seed(1)).unwrap();
            let problem = problem.try_with_region(std::sync::Arc::new(settings.around(goal))).unwrap();
            shots::shots(&problem, &q, &settings).into_iter().map(|shot| shot.moves).collect::<Vec<_>>()
        };
        let expected = seen_from(Pose2::IDENTITY);
        let backs = |moves: &Vec<CarMove>| moves.iter().all(|m| m.speed < 0);
        assert_eq!(expected.iter().any(|moves| backs(moves) && moves.len() > 5), x < 13.0, "{expected:?}");
        for goal in [[30.0, -20.0, 0.7], [-17.0, 5.0, 2.5], [8.0, 44.0, -2.0], [-3.0, -3.0, FRAC_PI_2]] {
            let found = seen_from(Pose2::new(goal[0], goal[1], goal[2]));
            assert_eq!(found.len(), expected.len(), "{x} {y} from {goal:?}");
            for (a, b) in found.iter().flatten().zip(expected.iter().flatten()) {
                // a unit of the steering may be rounded the other way
                let is_near = a.steering.abs_diff(b.steering) <= 1 && a.speed.abs_diff(b.speed) <= 1;
                assert!(is_near && a.ticks == b.ticks, "{a:?} {b:?} at {x} {y} from {goal:?}");
            }
        }
    }
}
