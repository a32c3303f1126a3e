//! One rule for all planners: paths lie within the world's bounds.

use motion_lab_core::configuration::Configuration;
use motion_lab_core::planning::{CellDecomposition, Growth, PathError, Search, accepted, called_free};
use motion_lab_core::robots::AnyRobot;

use super::*;

/// From the left half of the room to the right one, past a wall on x = 0 from its lower side up to this height.
fn past_a_wall(up_to: f64) -> Problem<RustyDisc> {
    Problem::try_new(room(&[[0.0, -2.0, 0.0, up_to]]), R2::new(-1.0, -1.0), R2::new(1.0, -1.0), Seed(1)).unwrap()
}

/// A square room of 4 m from -2 to 2 holds a point.
fn is_inside(q: &R2) -> bool {
    q.0.x.abs() <= 2.0 && q.0.y.abs() <= 2.0
}

#[test]
fn no_planner_goes_round_the_end_of_a_wall_that_leaves_the_world() {
    let problem = past_a_wall(2.0);
    let mut all = planners_of_discs(&problem);
    all.push(Box::new(PotentialField::new(problem.clone())));
    let mut refused = 0;
    for mut planner in all {
        let end = solve(planner.as_mut(), &Bounds::of_iterations(3000));
        assert!(end.is_err(), "{} leaves the world: {:?}", planner.name(), end.map(|path| path.corners()));
        assert!(planner.growth().nodes().iter().all(|node| is_inside(&node.at)), "{}", planner.name());
        refused += 1;
    }
    assert_eq!(refused, 12);
    // and one proves it
    let at = |x: f64| AnyRobot::of_kind("rusty", &[x, -1.0, 0.0]).unwrap();
    let checker = Checker::new(problem.checker().shared_scene(), at(0.0).0);
    let cells = Problem::try_new(checker, at(-1.0).1, at(1.0).1, Seed(1)).unwrap();
    let end = solve(&mut CellDecomposition::new(cells), &Bounds::default());
    assert!(matches!(end, Err(NoPath::Unreachable { .. })), "{end:?}");
}

#[test]
fn planners_pass_between_a_walls_end_and_the_side_of_the_world() {
    // 0.3 m are left for a centre that keeps 0.1 m, its radius, from the wall
    let problem = past_a_wall(1.7);
    for mut planner in planners_of_discs(&problem) {
        let path = solve(planner.as_mut(), &Bounds::default());
        let path = path.unwrap_or_else(|reason| panic!("{}: {reason}", planner.name()));
        assert!(path.corners().iter().all(is_inside), "{}", planner.name());
        // it has to pass the wall's line above its end
        let over = path.corners().iter().map(|q| q.0.y).fold(-2.0, |m, y| if y > m { y } else { m });
        assert!((1.7..=2.0).contains(&over), "{}: {over}", planner.name());
    }
}

#[test]
fn ends_outside_are_refused_by_name_and_the_sides_belong_to_the_world() {
    let at = |start: [f64; 2], goal: [f64; 2]| {
        let [start, goal] = [start, goal].map(|[x, y]| R2::new(x, y));
        Problem::try_new(room(&[]), start, goal, Seed(1)).map_err(|error| error.to_string())
    };
    assert!(at([-2.0, 2.0], [2.0, 0.0]).is_ok());
    let sides = "lies outside the world, which reaches from (-2, -2) to (2, 2)";
    assert_eq!(at([0.0, 0.0], [1100.0, 1.0]).unwrap_err(), format!("the goal (1100, 1) {sides}"));
    assert_eq!(at([0.0, -2.000_001], [1.0, 1.0]).unwrap_err(), format!("the start (0, -2.000001) {sides}"));
    // an arm is where it is mounted, whatever the bounds
    let nowhere = Scene::empty(Aabb::new(Point2::new(8.0, 8.0), Point2::new(9.0, 9.0)));
    let arm = Checker::new(nowhere, Reach::<2>::workbench());
    assert!(Problem::try_new(arm, T2::new(0.0, 0.0), T2::new(1.0, 0.0), Seed(1)).is_ok());
}

#[test]
fn a_path_that_leaves_the_world_is_not_accepted() {
    struct Outward(Search<RustyDisc>);
    impl Planner<RustyDisc> for Outward {
        fn name(&self) -> &'static str {
            "outward"
        }
        fn search(&self) -> &Search<RustyDisc> {
            &self.0
        }
        fn search_mut(&mut self) -> &mut Search<RustyDisc> {
            &mut self.0
        }
        fn advance(&mut self) {
            let (start, goal) = (self.0.problem.start(), self.0.problem.goal());
            let corners = [start, R2::new(-1.0, 2.5), R2::new(1.0, 2.5), goal];
            self.0.path = LinePath::through(self.0.problem.checker(), &corners).ok();
        }
    }
    let mut planner = Outward(Search::from_start(past_a_wall(2.0)));
    assert_eq!(planner.step(), Progress::Solved, "its path is free");
    assert_eq!(accepted(&planner).unwrap_err(), PathError::Outside(0));
    assert!(matches!(solve(&mut planner, &Bounds::default()), Err(NoPath::Refused(PathError::Outside(0)))));
    // nor is one that is only called free
    assert_eq!(called_free(&planner).unwrap_err(), PathError::Outside(0));
}

#[test]
fn a_potential_field_gets_where_nothing_is_in_its_way() {
    let problem = Problem::try_new(room(&[]), R2::new(-1.0, -1.0), R2::new(1.0, -1.0), Seed(1)).unwrap();
    let path = solve(&mut PotentialField::new(problem), &Bounds::of_iterations(3000)).unwrap();
    assert!(path.corners().iter().all(is_inside));
}

#[test]
fn an_arc_of_a_car_is_held_where_it_reaches_farthest() {
    // half a circle to the left from the origin: its rear axle comes as far as its radius, at half the way
    let car = HITCH.without_trailer();
    let radius = car.tightest();
    let control = CarCmd { v: car.max_speed, phi: car.max_steer };
    let start = HitchCfg { body: Pose2::IDENTITY, trailer: None };
    let arc = car.drive(&start, &control, std::f64::consts::PI * radius / car.max_speed).unwrap();
    let asked = |beyond: f64| {
        let max = Point2::new(radius + beyond, 3.0 * radius);
        let bounds = Aabb { min: Point2::new(-1.0, -1.0), max };
        Growth::new().ask(&Checker::new(Scene::empty(bounds), car), arc.clone())
    };
    assert!(asked(1e-6) && !asked(-1e-6));
    let ends = arc.at(1.0).coordinates();
    assert!(ends[0].abs() < 1e-6 && (ends[1] - 2.0 * radius).abs() < 1e-6, "{ends:?}");
}
