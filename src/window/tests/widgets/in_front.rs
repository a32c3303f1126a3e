//! The robot in front, handed on from widget to widget.

use super::*;
use crate::window::ui::paint::style::ScreenTheme;
use bevy_egui::egui::epaint::ColorMode;
use motion_lab_core::collision::{Checker, Collision, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::picture::{Role, Theme};
use motion_lab_core::robots::{AnyRobot, Reach, Robot};
use motion_lab_core::worlds::World;
use motion_lab_sim::anatomy::{Anatomy, Tab};

fn asked(harness: &Harness<'_, Lab>) -> Anatomy {
    interface(harness).anatomy.anatomy.clone()
}

/// The lab, paused after a few ticks of the tour with this robot in front.
fn stopped(robot: &str) -> Harness<'static, Lab> {
    let mut harness = lab(WIDE);
    if robot != "Rusty" {
        bring(&mut harness, robot);
    }
    harness.run_steps(40);
    pause(&mut harness);
    harness
}

#[test]
fn the_arm_that_was_stopped_is_the_one_that_is_asked_about_planned_for_and_put() {
    let mut harness = stopped("Reach");
    let there = harness.state().robot(1).coordinates;
    assert_ne!(there[..], World::workbench().robots[0].start[..], "it has moved");
    click(&mut harness, "Query");
    click(&mut harness, "distance");
    assert_eq!((asked(&harness).q().coordinates(), asked(&harness).tab), (there.clone(), Tab::Distance));
    assert_eq!(**asked(&harness).world(), World::workbench());
    // the distance on the screen is that of the Workbench's own arm there
    let arm = Reach::<2>::workbench();
    let q = motion_lab_core::configuration::Tn([there[0], there[1]]);
    let distance = Scene::workbench().distance(&arm.footprint(&q));
    harness.get_by_label(&format!("distance: {distance:.4} m"));
    click(&mut harness, "Space");
    assert_eq!(asked(&harness).q().coordinates(), there);
    click(&mut harness, "Plan");
    let task = interface(&harness).plan.task();
    assert_eq!((task.start.coordinates(), &*task.name), (there.clone(), "Reach"));
    assert_eq!(task.robot, AnyRobot::Reach(arm));
    click(&mut harness, "Atlas");
    let shown = &atlas(&harness);
    assert_eq!((shown.world(), shown.atlas().robots()[0].q.coordinates()), (&World::workbench(), there.clone()));
    // and the run stands as it stood
    click(&mut harness, "Drive");
    assert_eq!(harness.state().robot(1).coordinates, there);
    assert!(harness.state().script().events.is_empty());
}

#[test]
fn a_run_that_plays_and_what_nobody_chose_are_not_handed_on() {
    let mut harness = lab(WIDE);
    harness.run_steps(40);
    for widget in ["Query", "Plan", "Space", "Atlas", "Query"] {
        click(&mut harness, widget);
    }
    let (shown, first) = (asked(&harness), Anatomy::default());
    assert_eq!((shown.q(), shown.checker().robot()), (first.q(), first.checker().robot()));
    let start = interface(&harness).plan.task().start;
    assert_eq!(start.coordinates()[..], [2.0, 0.0], "round the post");
    assert_eq!(atlas(&harness).world(), &World::apartment());
}

#[test]
fn the_world_is_handed_on_as_it_stands() {
    let mut harness = stopped("Rusty");
    click(&mut harness, "close door B");
    click(&mut harness, "Step");
    click(&mut harness, "Query");
    // the middle of the gap, where only the closed door is
    let there = AnyConfiguration::Pose(Pose2::new(6.0, 4.75, 0.0));
    interface_mut(&mut harness).anatomy.anatomy.set_q(there).unwrap();
    assert!(asked(&harness).intersects());
    assert_eq!(asked(&harness).copy_as_command(), None, "no command knows this world");
    // from the world itself Rusty is free there
    let rusty = *asked(&harness).checker().robot();
    assert!(Checker::new(Scene::apartment(), rusty).distance(&there) > 0.0);
}

#[test]
fn a_plan_that_has_begun_and_an_edited_world_stay() {
    let mut harness = stopped("Reach");
    click(&mut harness, "Plan");
    click(&mut harness, "Step");
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    let block = at(&harness, [0.6, 1.2]);
    click_at(&mut harness, block);
    harness.key_press(Key::Delete);
    harness.run_steps(3);
    let edited = atlas(&harness).world().clone();
    assert_ne!(edited, World::workbench());
    let planned = interface(&harness).plan.task().start;
    click(&mut harness, "Drive");
    click(&mut harness, "Step");
    bring(&mut harness, "Hitch");
    click(&mut harness, "Plan");
    assert_eq!((interface(&harness).plan.task().start, interface(&harness).plan.effort().iterations), (planned, 1));
    click(&mut harness, "Drive");
    click(&mut harness, "Atlas");
    assert_eq!(atlas(&harness).world(), &edited);
    // the car is asked about all the same
    click(&mut harness, "Drive");
    click(&mut harness, "Query");
    assert_eq!(asked(&harness).q().coordinates(), harness.state().robot(2).coordinates);
}

#[test]
fn what_was_asked_about_is_put_there_in_the_run_and_undone() {
    let mut harness = stopped("Rusty");
    click(&mut harness, "Query");
    let before = harness.state().robot(0).coordinates;
    interface_mut(&mut harness).anatomy.anatomy.set_coordinate(0, before[0] + 0.25);
    harness.run_steps(2);
    click(&mut harness, "Put it in the run");
    click(&mut harness, "Drive");
    click(&mut harness, "Step");
    let there = harness.state().robot(0).coordinates;
    // a run's inputs are in units of 2^-20 m
    assert!((there[0] - before[0] - 0.25).abs() < 1e-6 && (there[1] - before[1]).abs() < 1e-6, "{there:?}");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert!(harness.state().script().events.is_empty());
}

#[test]
fn an_arm_of_more_links_is_not_put_in_the_run() {
    let mut harness = stopped("Reach");
    click(&mut harness, "Query");
    let arm = AnyRobot::Reach3(Reach::redundant());
    let three = asked(&harness).with_robot(arm);
    interface_mut(&mut harness).anatomy.set(three);
    harness.run_steps(2);
    let is_disabled =
        |harness: &Harness<'_, Lab>| harness.get_by_label("Put it in the run").accesskit_node().is_disabled();
    assert!(is_disabled(&harness), "{:?}", interface(&harness).notice());
    // the book's own pose of two links is put, in units of 2^-20 rad
    click(&mut harness, "Reset");
    assert!(!is_disabled(&harness));
    click(&mut harness, "Put it in the run");
    let [event] = &harness.state().script().events[..] else { panic!("one event") };
    let RobotInput::Teleport(to) = &event.input else { panic!("a teleport") };
    let to: Vec<f64> = to.iter().map(|angle| angle.value()).collect();
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
    assert!((to[0] - FRAC_PI_4).abs() < 1e-6 && (to[1] - FRAC_PI_2).abs() < 1e-6, "{to:?}");
}

#[test]
fn a_car_is_handed_on_with_its_trailer() {
    let mut harness = stopped("Hitch");
    click(&mut harness, "put a trailer on");
    click(&mut harness, "Step");
    assert_eq!(harness.state().robot(2).coordinates.len(), 4);
    click(&mut harness, "Query");
    let AnyRobot::Hitch(car) = *asked(&harness).checker().robot() else { panic!("the car") };
    assert!(car.hitch_len.is_some());
    assert_eq!(asked(&harness).q().coordinates(), harness.state().robot(2).coordinates);
    assert_eq!(asked(&harness).footprint().parts().len(), 2, "the car and its trailer");
}

#[test]
fn what_is_nearest_is_drawn_where_the_robot_drives() {
    let mut harness = stopped("Rusty");
    let magenta = Theme::Light.colour(Role::Witness);
    // the ends of the segments of this colour that are painted
    let painted = |harness: &Harness<'_, Lab>| {
        let ends = harness.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
            egui::Shape::LineSegment { points, stroke } if stroke.color == magenta => Some(points.to_vec()),
            egui::Shape::Path(path) if path.stroke.color == ColorMode::Solid(magenta) => Some(path.points.clone()),
            _ => None,
        });
        ends.flatten().collect::<Vec<_>>()
    };
    assert!(painted(&harness).is_empty());
    harness.key_press(Key::V);
    harness.run_steps(3);
    for _ in 0..3 {
        let there = harness.state().robot(0).coordinates;
        let footprint = motion_lab_core::robots::RUSTY.footprint(&Pose2::new(there[0], there[1], there[2]));
        let witness = Scene::apartment().witness(&footprint).unwrap();
        let world = motion_lab_core::picture::world(&World::apartment());
        let fit = crate::window::ui::paint::canvas::fit(&world, paper(&harness, "Apartment"));
        for end in [witness.on_robot, witness.on_obstacle] {
            let [x, y] = fit.screen_from_world(end);
            let near = |p: &Pos2| p.distance(pos2(x as f32, y as f32)) < 1.0;
            assert!(painted(&harness).iter().any(near), "{end} at {x} {y}: {:?}", painted(&harness));
        }
        click(&mut harness, "Step");
    }
    click(&mut harness, "nearest points");
    assert!(painted(&harness).is_empty());
}

#[test]
fn a_robot_that_is_driven_is_handed_on_while_the_run_plays() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(20);
    assert_eq!(harness.state().transport().playback, Playback::Playing);
    click(&mut harness, "Query");
    let there = harness.state().robot(0).coordinates;
    assert_ne!(there[..], World::apartment().robots[0].start[..], "it was driven");
    assert_eq!(asked(&harness).q().coordinates(), there);
    assert_eq!(**asked(&harness).world(), World::apartment());
}
