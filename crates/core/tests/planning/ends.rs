//! What planners say where there is no path.

use motion_lab_core::collision::GoalRegion;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::planning::CellDecomposition;
use motion_lab_core::planning::hybrid::HybridAStar;
use motion_lab_core::robots::AnyRobot;

use super::*;

/// A closed box about the origin, in which the start is.
const BOX: [[f64; 4]; 4] =
    [[-0.5, -0.5, 0.5, -0.5], [0.5, -0.5, 0.5, 0.5], [0.5, 0.5, -0.5, 0.5], [-0.5, 0.5, -0.5, -0.5]];

#[test]
fn an_end_in_contact_is_no_problem_to_begin_with() {
    let refused = Problem::try_new(room(&BOX), R2::new(0.0, 0.45), R2::new(1.0, 1.0), Seed(1)).unwrap_err();
    assert_eq!(NoPath::from(refused).to_string(), "the start would overlap wall 2");
}

#[test]
fn a_goal_that_cannot_be_reached_ends_every_planner_in_bounded_time() {
    let ends = [(R2::new(0.1, 0.2), R2::new(1.5, -1.2)), (R2::new(1.5, -1.2), R2::new(0.1, 0.2))];
    for (start, goal) in ends {
        let problem = Problem::try_new(room(&BOX), start, goal, Seed(1)).unwrap();
        for mut planner in planners_of_discs(&problem) {
            let is_bug = planner.name().starts_with("bug");
            let bounds = Bounds::of_iterations(if is_bug { 30_000 } else { 3000 });
            let reason = solve(planner.as_mut(), &bounds).unwrap_err();
            let expected = match planner.name() {
                "a-star" | "dijkstra" | "visibility-graph" | "tangent-graph" => {
                    matches!(reason, NoPath::NoneInGraph { nodes } if nodes > 1)
                }
                "bug1" | "bug2" => reason == NoPath::Enclosed { kept: 0.00625 },
                _ => {
                    matches!(reason, NoPath::Exhausted { bound: Bound::Iterations, effort } if effort.iterations == 3000)
                }
            };
            assert!(expected, "{}: {reason:?}", planner.name());
            let again = planner.step();
            let ended = again == Progress::Ended(reason);
            assert!(ended || again == Progress::Growing, "{}: {again:?} after its end", planner.name());
        }
    }
}

#[test]
fn a_trap_is_a_local_minimum_that_can_be_shown() {
    // open toward the start: the field pulls into it
    let trap = [[0.0, -0.6, 0.6, -0.6], [0.6, -0.6, 0.6, 0.6], [0.6, 0.6, 0.0, 0.6]];
    let problem = Problem::try_new(room(&trap), R2::new(-1.5, 0.0), R2::new(1.5, 0.0), Seed(1)).unwrap();
    let mut planner = PotentialField::new(problem.clone());
    let Err(NoPath::LocalMinimum { node }) = solve(&mut planner, &Bounds::of_iterations(3000)) else { panic!() };
    let at = planner.growth().at(node).0;
    assert!(at.x > 0.0 && at.x < 0.5 && at.y.abs() < 0.01, "in front of the wall between it and the goal: {at}");
    assert!(planner.growth().effort().iterations < 1000);
    // without the trap it gets there
    let free = Problem::try_new(room(&[]), problem.start(), problem.goal(), Seed(1)).unwrap();
    let path = solve(&mut PotentialField::new(free), &Bounds::of_iterations(3000)).unwrap();
    let length = path.corners().windows(2).map(|ends| (ends[1].0 - ends[0].0).norm()).sum::<f64>();
    assert!((length - 3.0).abs() < 1e-9, "straight: {length}");
    // a wall beside the way bends it
    let beside = Problem::try_new(room(&[[0.0, -1.0, 0.0, -0.05]]), problem.start(), problem.goal(), Seed(1)).unwrap();
    let path = solve(&mut PotentialField::new(beside.clone()), &Bounds::of_iterations(3000)).unwrap();
    assert!(disc_clearance(beside.checker().scene(), 0.1, &path.corners()) > 0.0 && path.legs().len() > 3);
}

/// The room is 4 m wide: a step is a fifth of half of it in each of two coordinates, and an iteration goes a quarter.
#[test]
fn an_iteration_of_the_potential_field_goes_a_quarter_of_a_step() {
    let problem = Problem::try_new(room(&[]), R2::new(-1.5, 0.0), R2::new(1.5, 0.0), Seed(1)).unwrap();
    let path = solve(&mut PotentialField::new(problem), &Bounds::of_iterations(3000)).unwrap();
    let lengths: Vec<f64> = path.corners().windows(2).map(|ends| (ends[1].0 - ends[0].0).norm()).collect();
    let quarter = 0.25 * 0.2 * 8.0_f64.sqrt();
    let (last, before) = lengths.split_last().unwrap();
    assert!(*last <= 4.0 * quarter + 1e-12 && before.len() > 10, "{lengths:?}");
    assert!(before.iter().all(|length| (length - quarter).abs() < 1e-12), "{lengths:?}");
}

#[test]
fn planners_of_discs_refuse_an_arm() {
    let problem = round_the_post(1);
    assert!(matches!(Bug1::try_new(&problem), Err(NoPath::Unsuited(_))));
    assert!(matches!(Bug2::try_new(&problem), Err(NoPath::Unsuited(_))));
    assert!(length_bound(&problem).is_none());
    let others: [Box<dyn Planner<_>>; 2] =
        [Box::new(VisibilityGraph::new(problem.clone())), Box::new(TangentGraph::new(problem))];
    for mut planner in others {
        let refused = solve(planner.as_mut(), &Bounds::default());
        assert!(matches!(refused, Err(NoPath::Unsuited(_))), "{}", planner.name());
    }
}

/// The arm on the Workbench, between two configurations.
fn reaching(scene: Scene, start: [f64; 2], goal: [f64; 2]) -> Problem<AnyRobot> {
    let at = |q: [f64; 2]| AnyRobot::of_kind("reach", &q).unwrap();
    let (arm, from) = at(start);
    Problem::try_new(Checker::new(scene, arm), from, at(goal).1, Seed(1)).unwrap()
}

#[test]
fn cells_prove_that_a_goal_is_out_of_reach_or_find_the_way() {
    let rover = |q: [f64; 3]| AnyRobot::of_kind("rusty", &q).unwrap();
    let (robot, inside) = rover([0.1, 0.2, 1.0]);
    let boxed = Checker::new(room(&BOX).shared_scene(), robot);
    let problem = |from, to| Problem::try_new(boxed.clone(), from, to, Seed(1)).unwrap();
    let outside = rover([1.5, -1.2, 0.0]).1;
    for problem in [problem(inside, outside), problem(outside, inside)] {
        let refused = solve(&mut CellDecomposition::new(problem), &Bounds::default()).unwrap_err();
        assert!(matches!(refused, NoPath::Unreachable { cells } if cells > 0), "{refused}");
    }
    // both outside: there is a way, which every planner finds
    let round = problem(outside, rover([-1.0, 1.0, 2.0]).1);
    let path = solve(&mut CellDecomposition::new(round), &Bounds::default()).unwrap();
    let corners: Vec<R2> = path.corners().iter().map(|q| R2::new(q.coordinates()[0], q.coordinates()[1])).collect();
    assert!(disc_clearance(boxed.scene(), 0.11, &corners) > 0.0 && corners.len() > 10);
    // the arm round the post
    let path =
        solve(&mut CellDecomposition::new(reaching(Scene::workbench(), [2.0, 0.0], [3.1, 0.0])), &Bounds::default());
    let corners = |path: LinePath<AnyRobot>| -> Vec<T2> {
        let arm = |q: &AnyConfiguration| T2::from_coordinates(&q.coordinates()).unwrap();
        path.corners().iter().map(arm).collect()
    };
    assert!(arm_clearance(&corners(path.unwrap())) > 0.0);
    // two posts hard by the first link part the turns of the shoulder
    let bounds = Scene::workbench().bounds();
    let post = |scene: Scene, (name, y): (&str, f64)| {
        scene.with_obstacle_at(name, Pose2::new(0.0, y, 0.0), Shape::Disc { radius: 0.1 })
    };
    let posts = [("up", 0.5), ("down", -0.5)].into_iter().fold(Scene::empty(bounds), post);
    let refused = solve(&mut CellDecomposition::new(reaching(posts, [0.0, 0.0], [3.1, 0.0])), &Bounds::default());
    assert!(matches!(refused, Err(NoPath::Unreachable { .. })), "{refused:?}");
    // a car's cells give no path, not even where it stays
    let (car, q) = AnyRobot::of_kind("hitch", &[6.5, 2.5, 0.0]).unwrap();
    let parking = Problem::try_new(Checker::new(Scene::lot(), car), q, q, Seed(1)).unwrap();
    let refused = solve(&mut CellDecomposition::new(parking), &Bounds::default());
    assert!(matches!(refused, Err(NoPath::JoinedByCells { cells: 1 })), "{refused:?}");
}

#[test]
fn from_a_place_to_itself_is_no_way_at_all() {
    let here = R2::new(0.5, 0.5);
    let problem = Problem::try_new(room(&[[0.0, -2.0, 0.0, 0.5]]), here, here, Seed(1)).unwrap();
    for mut planner in planners_of_discs(&problem) {
        let path = solve(planner.as_mut(), &Bounds::default());
        let path = path.unwrap_or_else(|reason| panic!("{}: {reason}", planner.name()));
        let length = path.length(&motion_lab_core::planning::Metric::unit(&here));
        assert!(length == 0.0 && length.is_sign_positive(), "{}: {length} m", planner.name());
        assert!((path.start(), path.goal()) == (here, here) && path.legs().len() == 1, "{}", planner.name());
    }
    // by cells, which plans for a robot of any kind: not out to the middle of the cell and back
    let here = AnyConfiguration::Pose(Pose2::new(0.5, 0.5, 0.0));
    let checker = Checker::new(room(&[[0.0, -2.0, 0.0, 0.5]]).shared_scene(), AnyRobot::Rusty(RUSTY));
    let mut cells = CellDecomposition::new(Problem::try_new(checker, here, here, Seed(1)).unwrap());
    let path = solve(&mut cells, &Bounds::default()).unwrap();
    assert!(path.legs().len() == 1 && path.length(&motion_lab_core::planning::Metric::unit(&here)) == 0.0);
}

/// Planners of an arm, of a car and of a car with a trailer: the way is one leg in which nothing moves, from the start
/// to the start, bit for bit.
#[test]
fn a_robot_of_any_kind_that_is_there_already_stays() {
    let still = |name: &str, starts: bool, ends: bool, legs: usize, moves: f64| {
        assert!(starts && ends && legs == 1 && moves == 0.0, "{name}: {starts} {ends}, {legs} legs, {moves} m");
    };
    let here = T2::new(2.0, -0.0);
    let arm = Problem::try_new(round_the_post(1).checker().clone(), here, here, Seed(1)).unwrap();
    for mut planner in planners(&arm) {
        let path = solve(planner.as_mut(), &Bounds::default()).unwrap();
        let most = path.legs()[0].motion().rates(1).speed;
        still(planner.name(), path.start() == here, path.goal() == here, path.legs().len(), most);
    }
    let path =
        solve(&mut CellDecomposition::new(reaching(Scene::workbench(), [2.0, 0.0], [2.0, 0.0])), &Bounds::default());
    let path = path.unwrap();
    still("cells", path.start() == path.goal(), true, path.legs().len(), path.legs()[0].motion().rates(1).speed);
    for (car, trailer) in [(HITCH, None), (HITCH.with_trailer(), Some(0.3))] {
        let here = HitchCfg { body: Pose2::new(6.5, 2.5, 0.1), trailer };
        // also where only the goal's region holds it, which is not where the goal is
        let beside = HitchCfg { body: Pose2::new(6.5625, 2.4375, 0.125), trailer: trailer.map(|psi| psi - 0.03) };
        for goal in [here, beside] {
            let problem = Problem::try_new(Checker::new(Scene::lot(), car), here, goal, Seed(1)).unwrap();
            let mut planner = HybridAStar::new(problem);
            let path = solve(&mut planner, &Bounds::of_iterations(1)).unwrap();
            let arc = path.legs()[0].motion();
            still("hybrid", path.start() == here, path.goal() == here, path.legs().len(), arc.rates(0).speed);
            // a script can hold it: the wheels straight ahead for a tick
            assert_eq!((arc.control(), arc.seconds()), (CarCmd { v: 0.0, phi: 0.0 }, 0.05));
            assert!(planner.moves().is_empty() && planner.growth().nodes().len() == 1);
        }
    }
}

/// The places within half a metre of one.
#[derive(Debug)]
struct HalfMetre(R2);

impl GoalRegion<R2> for HalfMetre {
    fn contains(&self, q: &R2) -> bool {
        (q.0 - self.0.0).norm() <= 0.5
    }
}

#[test]
fn a_start_in_the_region_of_a_goal_is_the_whole_path_of_a_tree() {
    let (start, goal) = (R2::new(0.5, 0.5), R2::new(0.75, 0.25));
    let problem = Problem::try_new(room(&[]), start, goal, Seed(1)).unwrap();
    let problem = problem.try_with_region(std::sync::Arc::new(HalfMetre(goal))).unwrap();
    let path = solve(&mut Rrt::new(problem), &Bounds::of_iterations(1)).unwrap();
    assert_eq!(path.corners(), [start, start]);
}
