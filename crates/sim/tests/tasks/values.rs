//! What robots observe and earn, against values by hand.

use motion_lab_core::configuration::HitchCfg;
use motion_lab_core::geometry::Aabb;
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::SimulatedRobot;
use motion_lab_sim::tasks::{EpisodeEnd, EpisodeMoment, HitchPark, LearningTask, ReachPost, RustyGoal};

use crate::simulator::quantized;

fn at<'a, R: SimulatedRobot>(before: &'a R::Configuration, q: &'a R::Configuration) -> EpisodeMoment<'a, R> {
    EpisodeMoment { before, q, ranges: &[], in_contact: false }
}

fn near(value: f32, by_hand: f64) -> bool {
    (f64::from(value) - by_hand).abs() < 1e-6
}

#[test]
fn a_rover_observes_its_rays_over_four_metres_and_where_its_goal_is() {
    let task = RustyGoal::new();
    // in the corridor, its heading up: the goal is 3 m ahead to the right, by 3-4-5: 1.8 right, 2.4 ahead
    let q = Pose2::new(6.0, 4.0, std::f64::consts::FRAC_PI_2);
    let goal = Point2::new(7.8, 6.4);
    let ranges = RangeSensor { n_rays: 360, max_range: 4.0 }.scan_from(&Scene::apartment(), &[], &q);
    let mut seen = vec![7.0; task.setting().observations];
    task.observe(&goal, &EpisodeMoment { ranges: &ranges, ..at(&q, &q) }, &mut seen);
    for (k, (seen, range)) in seen.iter().zip(&ranges).enumerate() {
        assert!(near(*seen, if range.is_finite() { range / 4.0 } else { 1.0 }), "ray {k}: {seen} of {range}");
    }
    // up through B's door to the round table, 2.25 m; left along the corridor, nothing; down to D's and E's corner,
    // 0.75 m
    assert!(near(seen[0], 2.25 / 4.0) && seen[90] == 1.0 && near(seen[180], 0.75 / 4.0));
    let [distance, cos, sin] = [seen[360], seen[361], seen[362]];
    assert!(near(distance, 3.0 / 4.0) && near(cos, 2.4 / 3.0) && near(sin, -1.8 / 3.0), "{distance} {cos} {sin}");
}

#[test]
fn a_tick_earns_what_it_came_nearer_and_the_goal_one_more_and_contact_one_less() {
    let task = RustyGoal::new();
    let (before, q, goal) = (Pose2::new(3.0, 4.0, 0.0), Pose2::new(3.03, 4.0, 0.0), Point2::new(4.0, 4.0));
    let earned = |now: &EpisodeMoment<'_, _>, goal: &Point2| {
        let judged = task.judge(goal, now);
        ((judged.reward * 1e9).round() / 1e9, judged.end)
    };
    assert_eq!(earned(&at(&before, &q), &goal), (0.03, None));
    assert_eq!(earned(&at(&q, &before), &goal), (-0.03, None));
    let hit = EpisodeMoment { in_contact: true, ..at(&before, &q) };
    assert_eq!(earned(&hit, &goal), (-0.97, Some(EpisodeEnd::Contact)));
    // within 0.25 m, and not a hair farther
    assert_eq!(earned(&at(&before, &q), &Point2::new(3.28, 4.0)), (1.03, Some(EpisodeEnd::Reached)));
    assert_eq!(earned(&at(&before, &q), &Point2::new(3.281, 4.0)), (0.03, None));
    // who touches something at the goal has not reached it
    assert_eq!(earned(&hit, &Point2::new(3.1, 4.0)).1, Some(EpisodeEnd::Contact));
}

#[test]
fn actions_are_parts_of_the_greatest_speeds_and_turns() {
    let (rusty, reach) = (RustyGoal::new(), ReachPost::new());
    let q = Pose2::new(3.0, 4.0, 0.0);
    let drive = |action: [f32; 2]| rusty.input(&at(&q, &q), &action);
    assert_eq!(drive([1.0, -0.5]), RobotInput::Drive(128, -64));
    assert_eq!(drive([-1.0, 0.25]), RobotInput::Drive(-128, 32));
    let q = T2::new(3.0, -1.0);
    // 0.1 rad in a tick and joint at most; beyond pi the angle comes round
    let to = reach.input(&at(&q, &q), &[0.5, -1.0]);
    assert_eq!(to, RobotInput::MoveTo(quantized(&[3.05, -1.1])));
    let q = T2::new(3.125, 0.0);
    let RobotInput::MoveTo(to) = reach.input(&at(&q, &q), &[1.0, 0.0]) else { panic!("an arm moves to a target") };
    assert!((to[0].value() - (3.225 - std::f64::consts::TAU)).abs() < 1e-6, "{to:?}");
}

#[test]
fn a_trailer_is_parked_when_all_of_it_is_within_the_bays_marks() {
    let task = HitchPark::new();
    let bay = Aabb { min: Point2::new(5.5, 5.25), max: Point2::new(8.0, 10.0) };
    // the car stands below the bay, heading down; its trailer's axle is 2 m behind its own
    let parked = |x: f64, y: f64| {
        let down = -std::f64::consts::FRAC_PI_2;
        let q = HitchCfg { body: Pose2::new(x, y - 2.0, down), trailer: Some(down) };
        (task.judge(&bay, &at(&q, &q)).end, q)
    };
    let trailer = motion_lab_core::robots::HITCH.trailer_body;
    let highest = 10.0 - trailer.rear_overhang;
    let lowest = 5.25 + trailer.front_overhang;
    let beside = 5.5 + 0.5 * trailer.width;
    assert!(highest > lowest, "the trailer is shorter than the bay");
    for (x, y, is_in) in [
        (6.75, 7.5, true),
        (6.75, highest - 1e-3, true),
        (6.75, highest + 1e-3, false),
        (6.75, lowest + 1e-3, true),
        (6.75, lowest - 1e-3, false),
        (beside + 1e-3, 7.5, true),
        (beside - 1e-3, 7.5, false),
        (9.25, 7.5, false),
    ] {
        assert_eq!(parked(x, y).0.is_some(), is_in, "axle at ({x}, {y})");
    }
    let mut seen = vec![7.0; task.setting().observations];
    let (_, q) = parked(6.75, 7.0);
    task.observe(&bay, &at(&q, &q), &mut seen);
    // the bay's middle is at (6.75, 7.625)
    let by_hand = [6.75 / 16.0, 5.0 / 10.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.625 / 10.0, 0.0, -1.0];
    assert!(seen.iter().zip(by_hand).all(|(seen, right)| near(*seen, right)), "{seen:?}");
}

#[test]
fn an_arm_observes_both_configurations_what_is_left_and_its_clearance() {
    let task = ReachPost::new();
    // the worked example: at (pi/4, pi/2) the block is 1.5 / sqrt(2) - 1 m away
    let q = T2::new(std::f64::consts::FRAC_PI_4, std::f64::consts::FRAC_PI_2);
    let goal = T2::new(0.0, std::f64::consts::PI);
    let mut seen = vec![7.0; task.setting().observations];
    task.observe(&goal, &at(&q, &q), &mut seen);
    let half = 0.5_f64.sqrt();
    let clearance = 1.5 * half - 1.0;
    let by_hand = [half, half, 0.0, 1.0, 1.0, 0.0, -1.0, 0.0, -0.25, 0.5];
    assert!(seen.iter().zip(by_hand).all(|(seen, right)| near(*seen, right)), "{seen:?}");
    let arm = Reach::<2>::workbench();
    assert!(near(seen[10], Scene::workbench().distance(&arm.footprint(&q))), "{seen:?}");
    assert!(f64::from(seen[10]) <= clearance + 1e-6, "the radius of the links comes off");
    // it came 0.05 rad nearer by each joint
    let before = T2::new(0.3, 3.0);
    let now = T2::new(0.25, 3.05);
    let far = |x: f64, y: f64| (x * x + y * y).sqrt();
    let right = far(0.3, std::f64::consts::PI - 3.0) - far(0.25, std::f64::consts::PI - 3.05);
    assert!((task.judge(&goal, &at(&before, &now)).reward - right).abs() < 1e-9);
}
