//! What an address says of a plan: read back as written, and refused by name.

use super::super::*;
use motion_lab_core::configuration::{AnyConfiguration, Configuration, HitchCfg};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::robots::{AnyRobot, HITCH, Hitch};
use motion_lab_sim::plans::{PlannerName, Task};

fn refusal(query: &str) -> String {
    let ReadLink { link, run, view } = Link::read(query);
    assert_eq!((run, link.plan), (Ok(()), None), "what is wrong of it costs no run: {query}");
    view.unwrap_err().to_string()
}

#[test]
fn a_plan_reads_back_as_it_was_written() {
    let task = Task::round_the_post();
    let plan = LinkedPlan::of(&task, PlannerName::RrtStar, Seed(7)).unwrap();
    // the chapter's question
    assert_eq!((plan.world, plan.robot.as_str()), ("workbench", "Reach"));
    assert_eq!((&plan.from[..], &plan.to[..]), (&[2.0, 0.0][..], &[3.1, 0.0][..]));
    let link = Link { widget: Some(Widget::Plan), plan: Some(plan), ..Link::default() };
    let query = link.query().unwrap();
    assert_eq!(
        query,
        "v=1&seed=2005&widget=plan&plan=workbench,Reach&from=2,0&to=3.1,0&planner=rrt-star&planner_seed=7"
    );
    assert_eq!(Link::parse(&query).unwrap(), link);
    let planned = link.plan.unwrap().planned().unwrap();
    assert_eq!((planned.robot, planned.world, planned.start), (task.robot, World::clone(&task.world), task.start));
    assert_eq!(planned.goal, Some(task.goal));
}

#[test]
fn what_is_left_out_is_as_the_world_has_it() {
    let link = Link::parse("widget=plan&plan=apartment,Rusty&planner=bug1-sensor&lies=yes").unwrap();
    let plan = link.plan.unwrap();
    assert_eq!((plan.planner, plan.seed, plan.lies), (Some(PlannerName::Bug1Sensor), None, true));
    let planned = plan.planned().unwrap();
    let apartment = World::apartment();
    let rusty = apartment.robots.iter().find(|resident| resident.name == "Rusty").unwrap();
    assert_eq!((&planned.start.coordinates()[..], planned.goal), (&rusty.start[..], None));
}

#[test]
fn four_coordinates_are_a_car_with_its_trailer_and_three_one_without() {
    for (from, has_trailer) in [("6.5,2.5,0", false), ("6.5,2.5,0,0.25", true)] {
        let link = Link::parse(&format!("plan=lot,Hitch&from={from}")).unwrap();
        let planned = link.plan.unwrap().planned().unwrap();
        let AnyRobot::Hitch(car) = planned.robot else { panic!("a car") };
        assert_eq!(car.hitch_len.is_some(), has_trailer, "{from}");
        let body = Pose2::new(6.5, 2.5, 0.0);
        let start = AnyConfiguration::Hitch(HitchCfg { body, trailer: has_trailer.then_some(0.25) });
        assert_eq!(planned.start, start);
    }
    assert_eq!(
        refusal("plan=lot,Hitch&from=6.5,2.5,0&to=6.75,7,0,0"),
        "to: 4 numbers are no configuration of \"Hitch\", as it is planned"
    );
}

#[test]
fn a_robot_that_no_address_names_has_no_plan_in_one() {
    let [from, to] = [[6.5, 2.5, 0.0], [6.75, 7.0, 0.0]];
    let at =
        |[x, y, theta]: [f64; 3]| AnyConfiguration::Hitch(HitchCfg { body: Pose2::new(x, y, theta), trailer: None });
    let of = |name: &str, car, world| {
        let task = Task::new(name, AnyRobot::Hitch(car), world, [at(from), at(to)]);
        LinkedPlan::of(&task, PlannerName::HybridAStar, Seed(1)).is_some()
    };
    assert!(of("Hitch", HITCH, World::lot()));
    assert!(!of("Somebody", HITCH, World::lot()), "nobody of that name");
    let longer = Hitch { wheelbase: HITCH.wheelbase + 0.5, ..HITCH };
    assert!(!of("Hitch", longer, World::lot()), "of other sizes");
    let mut changed = World::lot();
    changed.obstacles.pop();
    assert!(!of("Hitch", HITCH, changed), "in a world of one's own");
}

#[test]
fn a_plan_with_a_wrong_part_is_refused_by_its_field() {
    let as_rusty =
        "plan: it must be a built-in world and a robot of it that the lab can plan for, as apartment,Rusty, not";
    for (query, said) in [
        ("plan=apartment", format!("{as_rusty} \"apartment\"")),
        ("plan=moon,Rusty", format!("{as_rusty} \"moon,Rusty\"")),
        ("plan=apartment,Hitch", format!("{as_rusty} \"Hitch\"")),
        ("plan=lot,Hitch&from=1", "from: 1 numbers are no configuration of \"Hitch\", as it is planned".to_owned()),
        ("plan=lot,Hitch&from=1,x,0", "from: it must be up to 16 numbers, joined by commas, not \"1,x,0\"".to_owned()),
        ("plan=lot,Hitch&to=inf,0,0", "to: it must be up to 16 numbers, joined by commas, not \"inf,0,0\"".to_owned()),
        ("plan=lot,Hitch&lies=no", "lies: it must be one of yes, not \"no\"".to_owned()),
        (
            "plan=lot,Hitch&planner_seed=4294967296",
            "planner_seed: it must be a whole number up to 4294967295, not \"4294967296\"".to_owned(),
        ),
    ] {
        assert_eq!(refusal(query), said);
    }
    let planner = refusal("plan=lot,Hitch&planner=bug1");
    assert!(planner.starts_with("planner: it must be one of ") && planner.ends_with(", not \"bug1\""), "{planner}");
    assert!(planner.contains("hybrid-a-star") && !planner.contains("bug2"), "those that suit it: {planner}");
}
