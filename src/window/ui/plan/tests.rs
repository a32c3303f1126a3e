//! The planner at work, without its widget.

use std::sync::Arc;

use super::PlanState;
use super::paces::PACES;
use super::racer::PlanStage;
use motion_lab_core::collision::Collision;
use motion_lab_core::configuration::{AnyConfiguration, T2};
use motion_lab_core::cspace::CellState;
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::picture::{Drawing, Picture, Role};
use motion_lab_core::planning::{LeavePoint, NoPath};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::{PlannerName, Task};

/// The number of its pace of this many iterations a second.
fn pace(rate: f64) -> usize {
    PACES.iter().position(|(each, _)| *each == rate).unwrap()
}

#[test]
fn a_pace_is_so_many_iterations_a_second_whatever_the_frames() {
    for frames in [10_u32, 40, 60] {
        let mut plan = PlanState::default();
        // one whose first second finds no path: Dijkstra looks at the whole grid
        plan.set_planner(PlannerName::Dijkstra);
        plan.pace = pace(10.0);
        plan.playing = true;
        (0..frames).for_each(|_| plan.play(1.0 / f64::from(frames)));
        // the last may fall due a little after the second
        assert!((9..=10).contains(&plan.effort().iterations), "{frames}: {}", plan.effort().iterations);
    }
    let mut plan = PlanState::default();
    plan.pace = pace(1000.0);
    plan.set_planner(PlannerName::Dijkstra);
    plan.playing = true;
    plan.play(3600.0);
    assert!(plan.effort().iterations <= 100, "an hour's pause is not made up for");
}

#[test]
fn rrt_star_goes_on_to_improve_its_path_and_others_stop_at_theirs() {
    let mut plan = PlanState::default();
    plan.set_planner(PlannerName::RrtStar);
    while *plan.stage() == PlanStage::Growing {
        plan.step();
    }
    let (first, iterations) = (plan.lengths().unwrap().length, plan.effort().iterations);
    assert!(plan.racer().improves());
    (0..300).for_each(|_| plan.step());
    let better = plan.lengths().unwrap().length;
    assert_eq!(plan.effort().iterations, iterations + 300);
    assert!(better < first, "{better} {first}");
    plan.set_planner(PlannerName::InformedRrtStar);
    while *plan.stage() == PlanStage::Growing {
        plan.step();
    }
    assert!(plan.racer().improves());
    plan.set_planner(PlannerName::RrtConnect);
    while *plan.stage() == PlanStage::Growing {
        plan.step();
    }
    assert!(!plan.racer().improves() && *plan.stage() == PlanStage::Solved);
}

#[test]
fn a_planner_ends_at_its_bound_with_the_path_that_it_has_or_with_the_reason() {
    let mut plan = PlanState::default();
    assert_eq!(plan.racers[0].bound, 100_000);
    plan.set_planner(PlannerName::Dijkstra);
    plan.racers[0].bound = 40;
    (0..60).for_each(|_| plan.step());
    assert_eq!(plan.effort().iterations, 40);
    let PlanStage::Ended(reason) = plan.stage() else { panic!("{:?}", plan.stage()) };
    assert!(reason.to_string().starts_with("no path within the bound on iterations: 40 iterations"), "{reason}");
    plan.set_planner(PlannerName::RrtStar);
    while *plan.stage() == PlanStage::Growing {
        plan.step();
    }
    plan.racers[0].bound = plan.effort().iterations + 5;
    (0..20).for_each(|_| plan.step());
    assert!(
        *plan.stage() == PlanStage::Solved
            && plan.effort().iterations == plan.racers[0].bound
            && !plan.racer().improves()
    );
}

#[test]
fn the_ends_are_points_of_the_slice() {
    let mut plan = PlanState::default();
    assert!(plan.cells(1).is_some());
    let at = |over: &Picture, id: &str| match over.items.iter().find(|item| item.id == id).unwrap().drawing {
        Drawing::Mark { at, .. } => [at.x, at.y],
        _ => panic!("a mark"),
    };
    let over = plan.over_cells().unwrap();
    assert_eq!((at(&over, "start"), at(&over, "goal")), ([2.0, 0.0], [3.1, 0.0]));
    assert!(Arc::ptr_eq(&over, &plan.over_cells().unwrap()), "where nothing happens nothing is drawn");
    plan.move_end(1, AnyConfiguration::T2(T2::new(2.9, 0.0)));
    assert_eq!(at(&plan.over_cells().unwrap(), "goal"), [2.9, 0.0]);
}

#[test]
fn the_cells_are_those_of_the_robot_as_it_is_planned_for() {
    let mut plan = PlanState::default();
    let (robot, start) = AnyRobot::of_kind("rusty", &[1.0, 1.0, 0.0]).unwrap();
    plan.take(Task::new("Rusty", robot, cell(), [start, start.with(1, 0.8)]));
    let (cells, _) = plan.cells(1).unwrap();
    let slice = cells.map().slice();
    // a rover of 11 cm is planned 2 cm larger
    let judged = [0.115, 0.125, 0.135].map(|from_the_wall| slice.judge([2.0 - from_the_wall, 1.0], [1e-6; 2]));
    assert_eq!(judged, [CellState::Blocked, CellState::Blocked, CellState::Free]);
}

/// A world of two rooms without a door.
fn cell() -> World {
    let shut = r#"World(version: 1, name: "Cell", bounds: (min: (0, 0), max: (4, 2)),
        walls: [(name: "the wall", points: [(2, 0), (2, 2)]),
            (name: "the rest", points: [(0, 0), (4, 0), (4, 2), (0, 2)], closed: true)],
        robots: [(name: "Rusty", kind: "rusty", start: [1, 1, 0])])"#;
    World::parse("cell.ron", shut).unwrap()
}

#[test]
fn a_rejected_motion_is_seen_at_a_slow_pace_and_never_flickers_at_a_fast_one() {
    let mut plan = PlanState::default();
    plan.set_planner(PlannerName::Rrt);
    let mut seen = 0;
    while *plan.stage() == PlanStage::Growing {
        plan.step();
        seen += u32::from(plan.drawn().rejected.is_some());
    }
    assert!(seen > 0, "step by step");
    plan.restart();
    (plan.playing, plan.pace) = (true, pace(30.0));
    while plan.playing {
        plan.play(1.0 / 30.0);
        assert!(plan.drawn().rejected.is_none() || !plan.playing);
    }
}

#[test]
fn what_is_no_problem_is_said_and_mended_by_another_end() {
    let mut plan = PlanState::default();
    let in_the_block = AnyConfiguration::T2(T2::new(0.785, 0.785));
    plan.move_end(0, in_the_block);
    assert!(matches!(plan.stage(), PlanStage::Ended(NoPath::Problem(_))), "{:?}", plan.stage());
    let names =
        |plan: &PlanState| plan.over.items.iter().any(|item| item.id == "touched/name" && item.name == "the block");
    assert!(names(&plan), "what an end touches is marked");
    plan.step();
    assert_eq!(plan.effort().iterations, 0);
    plan.move_end(0, AnyConfiguration::T2(T2::new(2.0, 0.0)));
    assert_eq!(*plan.stage(), PlanStage::Growing);
    // a robot in a world where it can't go anywhere but has room: every planner ends within its bound
    let world = cell();
    let (robot, start) = AnyRobot::of_resident(&world.robots[0]).unwrap();
    plan.take(Task::new("Rusty", robot, world, [start, start.with(0, 3.0)]));
    plan.set_planner(PlannerName::CellDecomposition);
    while *plan.stage() == PlanStage::Growing {
        plan.step();
    }
    assert!(matches!(plan.stage(), PlanStage::Ended(NoPath::Unreachable { .. })), "{:?}", plan.stage());
    assert!(plan.command().is_none() && plan.file().is_none() && plan.played().is_none());
}

#[test]
fn a_files_plan_says_what_it_is_and_its_words_go_nowhere() {
    let mut plan = PlanState::default();
    let file = r#"{"version": 1, "world": {"name": "Workbench"}, "robot": {"kind": "reach", "name": "x; rm #"},
        "start": [2, 0], "goal": [3.1, 0], "legs": [{"kind": "chart line", "from": [2, 0], "to": [3.1, 0]}]}"#;
    plan.read("own.json", file, &World::workbench()).unwrap();
    assert_eq!((plan.task().name.as_str(), plan.command()), ("Reach", None));
    let drawn = plan.drawn().path.len();
    plan.step();
    assert!(drawn > 1 && plan.drawn().path.len() == drawn, "no planner is at work here");
    let captured = plan.captured();
    // between two free configurations the straight line sweeps the post, 0.6 to 0.9 m from the base: with the first
    // link, which is 1 m long
    let words = "It fails: leg 0 hits the post with part 0.";
    assert_eq!(captured.figure.description, format!("A path from a file. {words}"));
    assert!(plan.described().ends_with(words.trim_end_matches('.')), "{}", plan.described());
    assert!(plan.over.items.iter().any(|item| item.id == "rejected/witness"), "where it hits is drawn");
    let notes: Vec<_> = captured.notes.iter().map(|(name, _)| *name).collect();
    assert_eq!(notes, ["File", "Robot", "World"]);
    assert!(!plan.described().contains("RRT"), "{}", plan.described());
    // moved ends make it a task again, of a robot that commands know
    plan.move_end(1, AnyConfiguration::T2(T2::new(3.0, 0.0)));
    assert!(plan.command().unwrap().contains("--robot Reach --world workbench --from 2,0 --to 3,0"));
    let growing = plan.captured().figure.description;
    assert_eq!(growing, "RRT-Connect at seed 2005: no path so far.");
}

/// Rusty's way across the Apartment by its sensor, at a seed at which a lying one misjudges a leave point.
fn by_sensor() -> PlanState {
    let mut plan = PlanState::default();
    let (robot, start) = AnyRobot::of_kind("rusty", &[1.5, 5.75, 0.0]).unwrap();
    let goal = start.with(0, 9.75).with(1, 6.25);
    plan.take(Task::new("Rusty", robot, World::apartment(), [start, goal]));
    plan.set_seed(Seed(2034));
    plan.set_planner(PlannerName::Bug1Sensor);
    plan
}

#[test]
fn a_switch_makes_the_sensor_lie_and_a_misjudged_leave_point_is_drawn_and_said() {
    let mut plan = by_sensor();
    let mut walked = |lies: bool| -> (PlanState, Vec<LeavePoint>) {
        plan.set_sensor_lies(lies);
        assert_eq!(plan.effort().iterations, 0, "it begins anew");
        (plan.playing, plan.pace) = (true, pace(f64::INFINITY));
        while plan.playing {
            plan.play(0.1);
        }
        let points = plan.drawn().sensed.as_ref().unwrap().leave_points.clone();
        (plan.clone(), points)
    };
    let ids = |plan: &PlanState| plan.over.items.iter().map(|item| item.id.clone()).collect::<Vec<String>>();
    let (exact, points) = walked(false);
    assert!(*exact.stage() == PlanStage::Solved && points.iter().all(|point| !point.is_misjudged()), "{points:?}");
    assert!(exact.described().ends_with("round 1: left where the boundary comes nearest"), "{}", exact.described());
    assert!(!ids(&exact).iter().any(|id| id.starts_with("misjudged/")));
    assert!(exact.command().unwrap().contains("--planner bug1-sensor --robot Rusty --world apartment"));

    let (lying, points) = walked(true);
    assert!(points[0].is_too_far() && lying.described().contains("farther from the goal"), "{}", lying.described());
    let drawn = ids(&lying);
    for id in ["readings", "present/0", "left/1", "nearest/1", "misjudged/1", "left/2"] {
        assert!(drawn.iter().any(|each| each == id), "{id} of {drawn:?}");
    }
    let at = |id: &str| match lying.over.items.iter().find(|item| item.id == id).unwrap().drawing {
        Drawing::Mark { at, .. } => at,
        _ => panic!("a mark"),
    };
    assert_eq!((at("left/1"), Some(at("nearest/1"))), (points[0].at, points[0].nearest));
    assert!(lying.command().is_none(), "the command's sensor is exact");
    // the switch stays with another task, and asks nothing of other planners
    let mut other = lying.clone();
    other.take(Task::new("Rusty", other.task().robot, World::apartment(), [other.end_at(1), other.end_at(0)]));
    assert!(other.sensor_lies() && other.is_by_sensor());
    other.set_planner(PlannerName::Rrt);
    assert!(other.command().is_some());
}

#[test]
fn the_robot_and_its_readings_are_drawn_where_it_is() {
    let mut plan = by_sensor();
    (0..40).for_each(|_| plan.step());
    let here = plan.drawn().edges.last().unwrap().last().copied().unwrap();
    let here = plan.task().robot.reference(&here);
    let readings = plan.over.items.iter().find(|item| item.id == "readings").unwrap();
    let Drawing::Rays { from, ends } = &readings.drawing else { panic!("rays") };
    assert_eq!((readings.role, *from), (Role::Sensor, here));
    // an exact reading lies on a wall
    assert!(ends.len() > 20 && ends.iter().all(|p| from_walls(&plan, *p) < 1e-9), "{ends:?}");
    plan.set_sensor_lies(true);
    (0..40).for_each(|_| plan.step());
    let readings = plan.over.items.iter().find(|item| item.id == "readings").unwrap();
    let Drawing::Rays { ends, .. } = &readings.drawing else { panic!("rays") };
    let off = ends.iter().filter(|p| from_walls(&plan, **p) > 1e-3).count();
    assert!(2 * off > ends.len(), "{off} of {}", ends.len());
}

/// The distance of a point from the world's walls, metres.
fn from_walls(plan: &PlanState, p: Point2) -> f64 {
    plan.task().scene.distance(&Footprint::disc(p, 0.0))
}

/// The rover crosses the Apartment: no planner's path is shorter than the bound, and the tangent graph's is within a
/// millimetre of it.
#[test]
fn a_rovers_path_stands_beside_the_length_that_none_undercuts() {
    let [(robot, start), (_, goal)] =
        [[1.5, 5.75, 0.0], [9.75, 6.25, 0.0]].map(|q| AnyRobot::of_kind("rusty", &q).unwrap());
    let mut plan = PlanState::of(Task::new("Rusty", robot, World::apartment(), [start, goal]));
    let mut bounds = Vec::new();
    for (planner, more) in [(PlannerName::TangentGraph, 1e-3), (PlannerName::RrtConnect, 20.0)] {
        plan.set_planner(planner);
        while *plan.stage() == PlanStage::Growing {
            plan.step();
        }
        let (length, bound) = (plan.lengths().unwrap().length, plan.length_bound().unwrap());
        assert!(length > bound && length < bound + more, "{planner:?}: {length} {bound}");
        bounds.push(bound);
    }
    assert_eq!(bounds[0], bounds[1], "whatever the planner");
}

/// The chapter's arm goes round the post: straight it would turn by 1.1 rad. A space of three dimensions takes longer
/// than a frame, so that nobody asks.
#[test]
fn an_arm_of_two_links_has_a_bound_and_one_of_three_none_in_the_window() {
    let mut plan = PlanState::default();
    while *plan.stage() == PlanStage::Growing {
        plan.step();
    }
    let (length, bound) = (plan.lengths().unwrap().length, plan.length_bound().unwrap());
    assert!(bound > 1.5 && bound < length, "{bound} {length}");
    let [(robot, start), (_, goal)] =
        [[2.0, 0.0, 0.0], [2.1, 0.0, 0.0]].map(|q| AnyRobot::of_kind("reach3", &q).unwrap());
    let plan = PlanState::of(Task::new("Reach3", robot, World::workbench(), [start, goal]));
    assert_eq!(plan.length_bound(), None);
}

/// The default task with these planners, the first of them in front.
fn race_of(planners: &[PlannerName]) -> PlanState {
    let mut plan = PlanState::default();
    plan.race(planners, planners[0]);
    plan
}

#[test]
fn a_rival_without_a_path_keeps_its_place_among_the_others() {
    let mut alone = race_of(&[PlannerName::Rrt]);
    while *alone.stage() == PlanStage::Growing {
        alone.step();
    }
    // at this seed one tree comes to the goal before two have met
    let mut race = race_of(&[PlannerName::RrtStar, PlannerName::RrtConnect, PlannerName::Rrt]);
    assert_eq!(race.drawn().rivals, [vec![], vec![]]);
    while race.racers[2].stage == PlanStage::Growing {
        race.step();
    }
    assert_eq!(race.racers[1].stage, PlanStage::Growing);
    assert_eq!(race.drawn().rivals, [vec![], alone.drawn().path.clone()]);
}

#[test]
fn planners_race_as_each_would_go_alone_until_the_last_has_its_path() {
    let names = [PlannerName::RrtConnect, PlannerName::Rrt, PlannerName::RrtStar];
    let alone = names.map(|name| {
        let mut plan = race_of(&[name]);
        while *plan.stage() == PlanStage::Growing {
            plan.step();
        }
        (plan.effort(), plan.lengths(), plan.drawn().path.clone())
    });
    let mut race = race_of(&names);
    (race.playing, race.pace) = (true, PACES.len() - 1);
    while race.playing {
        race.play(1.0);
    }
    let iterations: Vec<u64> = race.racers.iter().map(|racer| racer.effort().iterations).collect();
    let [connect, rrt, star] = alone.clone().map(|(effort, ..)| effort.iterations);
    assert_eq!(iterations, [connect, rrt, star], "who has a path waits for the others");
    for (i, (effort, lengths, path)) in alone.iter().enumerate() {
        race.bring(i);
        assert_eq!((race.planner(), race.effort(), race.lengths()), (names[i], *effort, *lengths));
        assert_eq!(race.drawn().path, *path);
        let others = alone.iter().enumerate().filter(|(other, _)| *other != i).map(|(_, (.., path))| path.clone());
        assert_eq!(race.drawn().rivals, others.collect::<Vec<_>>(), "the others' paths stay in sight");
    }
    // a run that plays the path of the one in front shows it alone
    race.is_played_by(&Arc::new(motion_lab_sim::tour::TourConfig::default()), vec![]);
    let played = race.over_world("Workbench").expect("it is drawn there");
    let has = |id: &str| played.items.iter().any(|item| item.id.starts_with(id));
    assert_eq!(["path", "rival", "growth"].map(has), [true, false, false]);
    // played on, only the one that improves its path does anything
    race.step();
    let after: Vec<u64> = race.racers.iter().map(|racer| racer.effort().iterations).collect();
    assert_eq!(after, [connect, rrt, star + 1]);
    race.move_end(1, race.end_at(0).with(0, 3.0));
    assert!(race.racers.iter().all(|racer| racer.grows() && racer.effort().iterations == 0), "all begin anew");
}

#[test]
fn a_race_has_each_planner_once_and_those_alone_that_suit_the_robot() {
    let [connect, rrt, prm] = [PlannerName::RrtConnect, PlannerName::Rrt, PlannerName::Prm];
    let mut plan = race_of(&[connect, rrt, prm, PlannerName::RrtStar]);
    assert_eq!(plan.racing().collect::<Vec<_>>(), [connect, rrt, prm], "three at most");
    plan.bring(1);
    plan.set_planner(prm);
    assert_eq!((plan.racing().collect::<Vec<_>>(), plan.planner()), (vec![connect, prm], prm));
    plan.bring(7);
    assert_eq!(plan.planner(), prm, "there is no eighth");
    // a planner of an arm plans for no car
    plan.race(&[PlannerName::CellDecomposition, prm], prm);
    let (car, start) = AnyRobot::of_resident(&World::lot().robots[0]).expect("the lab's");
    plan.take(Task::new("Hitch", car, World::lot(), [start, start.with(0, 8.0)]));
    assert_eq!(plan.racing().collect::<Vec<_>>(), [PlannerName::CellDecomposition]);
}
