use super::*;
use motion_lab_core::planning::Progress;

fn tasks() -> [Task; 5] {
    let task = |kind: &str, world: World, start: &[f64], goal: &[f64]| {
        let [(robot, start), (_, goal)] = [start, goal].map(|q| AnyRobot::of_kind(kind, q).unwrap());
        Task::new(kind, robot, world, [start, goal])
    };
    [
        task("reach", World::workbench(), &[2.0, 0.0], &[3.1, 0.0]),
        task("reach3", World::workbench(), &[2.0, 0.0, 0.1], &[3.1, 0.0, 0.0]),
        task("rusty", World::apartment(), &[1.5, 5.75, 0.3], &[9.75, 6.25, 0.0]),
        task("hitch", World::lot(), &[6.5, 2.5, 0.0], &[6.75, 7.0, -1.5]),
        task("hitch", World::lot(), &[6.5, 2.5, 0.0, 0.0], &[6.75, 7.0, -1.5, -1.5]),
    ]
}

#[test]
fn planners_are_offered_to_the_robots_that_they_plan_for() {
    for name in PlannerName::ALL {
        let mut offered = 0;
        for task in tasks() {
            let suits = name.suits(&task.robot).is_ok();
            let unsuited = match task.attempt(name, Seed(3)) {
                Err(reason) => matches!(reason, NoPath::Unsuited(_)),
                Ok(mut attempt) => (0..3).any(|_| matches!(attempt.step(), Progress::Ended(NoPath::Unsuited(_)))),
            };
            assert_eq!(suits, !unsuited, "{} for {}", name.id(), task.name);
            offered += u32::from(suits);
        }
        assert!(offered > 0, "{}", name.id());
    }
    for task in tasks() {
        assert!(PlannerName::default_for(&task.robot).suits(&task.robot).is_ok());
    }
}

#[test]
fn a_path_verifies_once_more_with_the_clearance_that_it_has() {
    for task in &tasks()[..3] {
        let mut attempt = task.attempt(PlannerName::RrtConnect, Seed(2005)).unwrap();
        assert_eq!(attempt.verify(), None, "there is no path yet");
        while attempt.step() == Progress::Growing {}
        let clearance = attempt.lengths().clearance;
        assert!(clearance > 0.0 && attempt.verify() == Some(Ok(clearance)), "{}", task.name);
    }
    // the black box finds its way through the post
    let [(robot, start), (_, goal)] = [[2.2, 0.5], [2.9, 0.5]].map(|q| AnyRobot::of_kind("reach", &q).unwrap());
    let task = Task::new("Reach", robot, World::workbench(), [start, goal]);
    let task = Task { checker: CheckerName::PARRY, ..task };
    let mut attempt = task.attempt(PlannerName::RrtConnect, Seed(2005)).unwrap();
    while attempt.step() == Progress::Growing {}
    assert!(attempt.verify().is_none() && attempt.judged().is_some());
}

#[test]
fn planners_that_draw_samples_keep_a_millimetre_where_start_and_goal_have_more() {
    use PlannerName::{InformedRrtStar, Prm, Rrt, RrtConnect, RrtStar};
    let text = "World(version: 1, name: \"hall\", bounds: (min: (0, 0), max: (4, 4)), \
                walls: [(name: \"floor\", points: [(0, 0), (4, 0)])], robots: [])";
    // the rover has 0.11 m and a tube of 0.02 m
    let task = |start: f64, goal: f64| {
        let [(robot, start), (_, goal)] =
            [[1.0, start, 0.0], [3.0, goal, 0.0]].map(|q| AnyRobot::of_kind("rusty", &q).unwrap());
        Task::new("Rusty", robot, World::parse("hall.ron", text).unwrap(), [start, goal])
    };
    for name in PlannerName::ALL {
        let kept = if matches!(name, RrtConnect | Rrt | RrtStar | InformedRrtStar | Prm) { 1e-3 } else { 0.0 };
        assert_eq!(task(0.132, 0.132).usual_clearance(name.draws_samples()), kept, "{}", name.id());
        assert_eq!(task(0.1305, 2.0).usual_clearance(name.draws_samples()), 0.0, "{}", name.id());
        assert_eq!(task(2.0, 0.1305).usual_clearance(name.draws_samples()), 0.0, "{}", name.id());
        let unproven = Task { checker: CheckerName::PARRY, ..task(2.0, 2.0) };
        assert_eq!(unproven.usual_clearance(name.draws_samples()), 0.0, "{}", name.id());
    }
    // half a millimetre is enough for a path, unless more is asked for
    assert!(task(0.1305, 2.0).attempt(RrtConnect, Seed(1)).is_ok());
    let asked = Task { clearance: Some(1e-3), ..task(0.1305, 2.0) };
    let refused = asked.attempt(RrtConnect, Seed(1)).err();
    assert!(matches!(refused, Some(NoPath::Problem(ProblemError::Clearance { end: "start", .. }))), "{refused:?}");
}

#[test]
fn what_is_drawn_is_what_was_grown_and_the_path_begins_and_ends_where_it_is_asked_to() {
    let mut refusing = 0;
    for task in tasks() {
        let mut attempt = task.attempt(PlannerName::default_for(&task.robot), Seed(3)).unwrap();
        let mut rejected = 0;
        let refused = |attempt: &dyn PlanAttempt| attempt.effort().edges - attempt.effort().free;
        let mut before = 0;
        while attempt.step() == Progress::Growing {
            let now = refused(attempt.as_ref());
            let drawn = attempt.drawn();
            assert!(now > before || drawn.rejected.is_none(), "{}: an old one is shown again", task.name);
            before = now;
            assert!(drawn.path.is_empty() && drawn.corners.is_empty());
            if let Some(refused) = drawn.rejected.as_ref().filter(|_| rejected < 20) {
                rejected += 1;
                let touches = refused.witness.is_some_and(|w| w.dist == 0.0);
                let within = task.robot.is_within_limits(&refused.at);
                assert!(touches || !within, "{}: {refused:?}", task.name);
            }
            assert!(attempt.effort().iterations < 20_000, "{}", task.name);
        }
        let drawn = attempt.drawn();
        refusing += u32::from(rejected > 0);
        assert_eq!(drawn.edges.len(), attempt.growth().1.len(), "{}", task.name);
        let near =
            |a: &AnyConfiguration, b: &AnyConfiguration| a.difference(b).unwrap().iter().take(2).all(|d| d.abs() < 0.3);
        let (first, last) = (drawn.path.first().unwrap(), drawn.path.last().unwrap());
        assert!(near(first, &task.start) && near(last, &task.goal), "{}: {first} {last}", task.name);
        assert_eq!((drawn.corners.first(), drawn.corners.last()), (Some(first), Some(last)));
    }
    // a car on a free lot may be refused nothing
    assert!(refusing >= 3, "{refusing}");
}

#[test]
fn who_plays_lives_alone_in_the_tasks_world() {
    let [reach, .., trailer] = tasks();
    let (world, name) = Task { name: "Reach".into(), ..reach.clone() }.alone();
    assert_eq!((name.as_str(), world.robots.len(), &world.obstacles), ("Reach", 1, &World::workbench().obstacles));
    let (world, name) = trailer.alone();
    assert_eq!((name.as_str(), world.robots.len()), ("Hitch", 1), "the lot's own car");
    let empty = Task { world: Arc::new(World { robots: vec![], ..World::workbench() }), ..reach };
    let (world, name) = empty.alone();
    assert_eq!((name.as_str(), &world.robots[0].start[..]), ("Reach", &[2.0, 0.0][..]), "a new one at the start");
}
