use motion_lab_core::collision::Problem;
use motion_lab_core::configuration::Chart;
use motion_lab_core::planning::hybrid::HybridAStar;
use motion_lab_core::planning::{MARGIN, NoPath, PotentialField, Progress, RrtConnect};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::worlds::World;

use super::*;
use crate::plans::{LinePlanner, MadePlanner, Task};

#[derive(Default)]
struct Connects;

impl LinePlanner for Connects {
    fn for_problem<R: Robot<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
        Ok(Box::new(RrtConnect::new(problem)))
    }
}

#[derive(Default)]
struct Descends;

impl LinePlanner for Descends {
    fn for_problem<R: Robot<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
        Ok(Box::new(PotentialField::new(problem)))
    }
}

static CONNECTS: OwnPlanner = OwnPlanner::new("my-connect", "Mine", "As the lab's").by_lines::<Connects>();
static DRAWS: OwnPlanner = OwnPlanner::new("draws", "Draws", "As the lab's").by_lines::<Connects>().drawing_samples();
static DESCENDS: OwnPlanner = OwnPlanner::new("my-descent", "Down", "As the lab's").by_lines::<Descends>();
static DRIVES: OwnPlanner = OwnPlanner {
    car: Some(|problem| Ok(Box::new(HybridAStar::new(problem)))),
    ..OwnPlanner::new("my-drive", "Drives", "As the lab's")
};
static OF_DISCS: OwnPlanner = OwnPlanner {
    disc: Some(|problem| Ok(Box::new(RrtConnect::new(problem)))),
    ..OwnPlanner::new("my-disc", "Discs", "As the lab's")
};
static OF_THREE_LINKS: OwnPlanner = OwnPlanner {
    arm3: Some(|problem| Ok(Box::new(RrtConnect::new(problem)))),
    iterations: 77,
    ..OwnPlanner::new("my-three", "Three", "As the lab's")
};
static REFUSES: OwnPlanner = OwnPlanner {
    arm: Some(|_| Err(NoPath::Unsuited("it has no patience"))),
    ..OwnPlanner::new("my-no", "No", "Never")
};

fn task(kind: &str, world: World, start: &[f64], goal: &[f64]) -> Task {
    let [(robot, start), (_, goal)] = [start, goal].map(|q| AnyRobot::of_kind(kind, q).unwrap());
    Task::new(kind, robot, world, [start, goal])
}

fn tasks() -> [Task; 5] {
    [
        task("rusty", World::apartment(), &[1.5, 5.75, 0.3], &[9.75, 6.25, 0.0]),
        task("reach", World::workbench(), &[2.0, 0.0], &[3.1, 0.0]),
        task("reach3", World::workbench(), &[2.0, 0.0, 0.1], &[3.1, 0.0, 0.0]),
        task("hitch", World::lot(), &[6.5, 2.5, 0.0], &[6.75, 7.0, -1.5]),
        task("hitch", World::lot(), &[6.5, 2.5, 0.0, 0.0], &[6.75, 7.0, -1.5, -1.5]),
    ]
}

#[test]
fn planners_of_a_programs_own_stand_behind_the_labs_in_the_order_in_which_they_came() {
    let mut planners = Planners::default();
    assert_eq!(planners.all().collect::<Vec<_>>(), PlannerName::ALL);
    planners.register(&DRIVES).unwrap();
    planners.register(&CONNECTS).unwrap();
    let own: Vec<&str> = planners.all().skip(PlannerName::ALL.len()).map(PlannerName::id).collect();
    assert_eq!(own, ["my-drive", "my-connect"]);
    let mine = planners.named("my-connect").unwrap();
    assert_eq!((mine.title(), mine.words(), mine.iterations()), ("Mine", "As the lab's", 100_000));
    assert_eq!(planners.named("rrt").unwrap(), PlannerName::Rrt);
    assert_ne!(mine, PlannerName::Own(&DRIVES));
    let unknown = planners.named("my-conect").unwrap_err().to_string();
    assert!(unknown.starts_with("there is no planner \"my-conect\"; there are rrt-connect, rrt, "), "{unknown}");
    assert!(unknown.ends_with(", my-drive, my-connect; did you mean \"my-connect\"?"), "{unknown}");
    assert!(Planners::default().named("my-connect").is_err(), "nobody else has it");
}

#[test]
fn a_planner_without_a_name_of_its_own_or_for_no_robot_is_refused() {
    let named = |id: &'static str| -> &'static OwnPlanner { Box::leak(Box::new(OwnPlanner { id, ..CONNECTS })) };
    let mut planners = Planners::default();
    planners.register(&CONNECTS).unwrap();
    for taken in ["my-connect", "rrt-star"] {
        assert_eq!(planners.register(named(taken)), Err(PlannerError::Taken(taken.into())));
    }
    for id in [
        "",
        "Mine",
        "-mine",
        "2rrt",
        "my planner",
        "a,b",
        "a/b",
        "..",
        "naïve",
        "a23456789-123456789-123456789-123456789-1",
    ] {
        assert_eq!(planners.register(named(id)), Err(PlannerError::Id(id.into())), "{id}");
    }
    planners.register(named("a23456789-123456789-123456789-123456789-")).unwrap();
    static NOBODYS: OwnPlanner = OwnPlanner::new("nobodys", "Nobody's", "For no robot");
    assert_eq!(planners.register(&NOBODYS), Err(PlannerError::NoRobot("nobodys".into())));
    assert_eq!(planners.all().count(), PlannerName::ALL.len() + 2, "what was refused is not there");
}

#[test]
fn each_is_made_for_the_robots_that_it_has_a_maker_for() {
    let suited = |own: &'static OwnPlanner| {
        tasks().map(|task| {
            let name = PlannerName::Own(own);
            let attempt = task.attempt(name, Seed(3));
            let is_made = !matches!(attempt, Err(NoPath::Unsuited(_)));
            assert_eq!(name.suits(&task.robot).is_ok(), is_made, "{} for {}", own.id, task.name);
            is_made
        })
    };
    assert_eq!(suited(&CONNECTS), [true, true, true, false, false]);
    assert_eq!(suited(&DRIVES), [false, false, false, true, true]);
    assert_eq!(suited(&OF_DISCS), [true, false, false, false, false]);
    assert_eq!(suited(&OF_THREE_LINKS), [false, false, true, false, false]);
    // each is made for a robot, and has a name
    let mut planners = Planners::default();
    for own in [&CONNECTS, &DRIVES, &OF_DISCS, &OF_THREE_LINKS, &REFUSES] {
        planners.register(own).unwrap();
        assert_eq!(PlannerName::Own(own).plans_for_cars_alone(), own.id == "my-drive", "{}", own.id);
    }
    assert_eq!(planners.named("my-three").unwrap().iterations(), 77);
    let for_cars: Vec<&str> =
        PlannerName::ALL.into_iter().filter(|n| n.plans_for_cars_alone()).map(PlannerName::id).collect();
    assert_eq!(for_cars, ["hybrid-a-star"]);
    let refused = tasks()[1].attempt(PlannerName::Own(&REFUSES), Seed(1)).err();
    assert_eq!(refused, Some(NoPath::Unsuited("it has no patience")));
}

#[test]
fn a_planner_of_ones_own_does_what_the_labs_does_by_the_same_means() {
    let pairs = [
        (&CONNECTS, PlannerName::RrtConnect, &tasks()[1]),
        (&CONNECTS, PlannerName::RrtConnect, &tasks()[0]),
        (&CONNECTS, PlannerName::RrtConnect, &tasks()[2]),
        (&DRIVES, PlannerName::HybridAStar, &tasks()[4]),
        (&DRIVES, PlannerName::HybridAStar, &tasks()[3]),
    ]
    .map(|(own, name, task)| (own, name, Task { clearance: Some(0.002), ..task.clone() }));
    for (own, labs, task) in pairs {
        let [own, labs] = [PlannerName::Own(own), labs].map(|name| {
            let mut attempt = task.attempt(name, Seed(2005)).unwrap();
            while attempt.step() == Progress::Growing {}
            let lengths = attempt.lengths();
            assert!(lengths.clearance > 0.002 && attempt.verify() == Some(Ok(lengths.clearance)), "{}", task.name);
            (lengths, attempt.effort(), attempt.drawn().corners)
        });
        assert_eq!(own, labs, "{}", task.name);
    }
}

#[test]
fn one_that_joins_samples_keeps_the_usual_margin_and_no_other_does() {
    let task = &tasks()[1];
    for (own, kept) in [(&DRAWS, MARGIN), (&CONNECTS, 0.0), (&DESCENDS, 0.0)] {
        assert_eq!(task.usual_clearance(PlannerName::Own(own).draws_samples()), kept, "{}", own.id);
    }
}
