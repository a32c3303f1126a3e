//! Planning in the window, behaviour by behaviour.

mod race;
mod removal;

use super::*;
use crate::window::ui::PlanState;
use motion_lab_core::configuration::Configuration;
use motion_lab_core::picture::Role;
use motion_lab_sim::plans::PathFile;

fn plan(harness: &Harness<'_, Lab>) -> PlanState {
    harness.state().app.world().resource::<Interface>().0.plan.clone()
}

fn planned(size: [f32; 2]) -> Harness<'static, Lab> {
    let mut harness = lab(size);
    click(&mut harness, "Plan");
    harness
}

/// Plays until the planner has its path or has ended.
fn play(harness: &mut Harness<'_, Lab>) {
    click(harness, "Play");
    for _ in 0..4000 {
        if !plan(harness).playing {
            return;
        }
        harness.run_steps(1);
    }
    panic!("it goes on and on");
}

#[test]
fn a_step_is_an_iteration_and_play_goes_on_to_the_path_that_the_library_finds() {
    let mut harness = planned(WIDE);
    assert_eq!(plan(&harness).effort().iterations, 0);
    click(&mut harness, "Step");
    click(&mut harness, "Step");
    assert_eq!(plan(&harness).effort().iterations, 2);
    harness.get_by_label_contains("2 iterations");
    play(&mut harness);
    // the library's own loop, on the same seed, among obstacles a millimetre larger
    let among = |scene| crate::prelude::ChainChecker::new(scene, crate::prelude::Reach::<2>::workbench());
    let checker = among(crate::prelude::Scene::workbench().grown(1e-3));
    let [start, goal] = [[2.0, 0.0], [3.1, 0.0]].map(motion_lab_core::configuration::Tn);
    let problem =
        motion_lab_core::collision::Problem::try_new(checker, start, goal, motion_lab_sim::tour::BOOK_SEED).unwrap();
    let mut planner = motion_lab_core::planning::RrtConnect::new(problem);
    let path = motion_lab_core::planning::solve(&mut planner, &motion_lab_core::planning::Bounds::default()).unwrap();
    use motion_lab_core::planning::Planner;
    let shown = plan(&harness);
    assert_eq!(shown.effort(), planner.growth().effort());
    let corners: Vec<Coordinates> = shown.drawn().corners.iter().map(|q| q.coordinates()).collect();
    assert_eq!(corners, path.corners().iter().map(|q| q.coordinates()).collect::<Vec<_>>());
    // a millimetre of the world's own obstacles is proven
    let motions = path.legs().iter().map(|leg| leg.motion().clone());
    let own =
        motion_lab_core::planning::LinePath::try_keeping(&among(crate::prelude::Scene::workbench()), motions, 1e-3);
    let clearance = own.unwrap().clearance();
    assert!(clearance > 1e-3 && shown.lengths().unwrap().clearance.to_bits() == clearance.to_bits(), "{clearance}");
    harness.get_by_label_contains(" m, proven");
    // what is drawn has the growth's edges, the path and both ends
    let ids: Vec<&str> = shown.over.items.iter().map(|item| item.id.as_str()).collect();
    for id in ["growth", "path", "start/0", "start/joint 1", "goal/0", "goal/1"] {
        assert!(ids.contains(&id), "{id} of {ids:?}");
    }
    // red is the goal, whose colour contact borrows, and no path hits anything
    assert!(shown.over.items.iter().all(|item| (item.role == Role::Goal) == item.id.starts_with("goal")));
    // another seed is another tree
    click(&mut harness, "Next seed");
    assert_eq!((plan(&harness).effort().iterations, plan(&harness).seed().0), (0, 2006));
}

#[test]
fn keys_move_the_planner_and_not_the_run() {
    let mut harness = planned(WIDE);
    let tick = harness.state().transport().tick;
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    assert_eq!((plan(&harness).effort().iterations, harness.state().transport().tick), (1, tick));
    harness.key_press(Key::Home);
    harness.run_steps(2);
    assert_eq!(plan(&harness).effort().iterations, 0);
    harness.key_press(Key::Space);
    harness.run_steps(2);
    assert!(plan(&harness).playing && harness.state().transport().playback == Playback::Paused);
}

#[test]
fn saving_without_a_path_says_that_there_is_none() {
    let mut harness = planned(WIDE);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    harness.run_steps(2);
    harness.get_by_label_contains("there is no path to save");
}

#[test]
fn the_ends_are_dragged_in_both_papers_and_an_end_in_contact_is_said() {
    let mut harness = planned(WIDE);
    click(&mut harness, "Step");
    // the goal's tip, from (-2, 0) or so, to a point above
    let before = plan(&harness);
    let [start, goal] = [0, 1].map(|end| before.task().robot.reference(&before.end_at(end)));
    let rect = harness.get_by_label_contains("workspace. RRT-Connect").rect();
    let fit = crate::window::ui::paint::canvas::fit(before.backdrop(), rect);
    let on_screen = |p: motion_lab_core::geometry::Point2| {
        let [x, y] = fit.screen_from_world(p);
        pos2(x as f32, y as f32)
    };
    let to = motion_lab_core::geometry::Point2::new(-1.2, 1.0);
    pointer(&mut harness, on_screen(goal), Some(true));
    for i in 1..=8 {
        pointer(&mut harness, on_screen(goal).lerp(on_screen(to), i as f32 / 8.0), None);
    }
    pointer(&mut harness, on_screen(to), Some(false));
    harness.run_steps(2);
    let after = plan(&harness);
    let moved = [0, 1].map(|end| after.task().robot.reference(&after.end_at(end)));
    assert!((moved[1] - to).norm() < 0.02 && moved[0] == start, "{moved:?}");
    assert_eq!(after.effort().iterations, 0, "it begins anew");
    // a click is enough
    let at = motion_lab_core::geometry::Point2::new(-1.0, 1.2);
    pointer(&mut harness, on_screen(at), Some(true));
    pointer(&mut harness, on_screen(at), Some(false));
    harness.run_steps(2);
    let clicked = plan(&harness);
    assert!((clicked.task().robot.reference(&clicked.end_at(1)) - at).norm() < 0.02);
    let after = clicked;
    // the start's point on the torus, across and up
    let slice = motion_lab_core::cspace::Slice::through(
        &motion_lab_core::collision::Checker::new(std::sync::Arc::clone(&after.task().scene), after.task().robot),
        &after.end_at(1),
    )
    .unwrap();
    let rect = harness.get_by_label_contains("configuration space. ").rect();
    let cells =
        motion_lab_core::cspace::cspace_picture(&motion_lab_core::cspace::CellMap::new(slice, 1), &Default::default());
    let fit = crate::window::ui::paint::canvas::fit(&cells, rect);
    let on_torus = |[x, y]: [f64; 2]| {
        let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
        pos2(x as f32, y as f32)
    };
    let (from, to) = (on_torus([2.0, 0.0]), on_torus([1.2, 1.6]));
    pointer(&mut harness, from, Some(true));
    for i in 1..=8 {
        pointer(&mut harness, from.lerp(to, i as f32 / 8.0), None);
    }
    pointer(&mut harness, to, Some(false));
    harness.run_steps(2);
    let start = plan(&harness).end_at(0).coordinates();
    assert!((start[0] - 1.2).abs() < 0.03 && (start[1] - 1.6).abs() < 0.03, "{start:?}");
    assert_eq!(plan(&harness).end_at(1), after.end_at(1));
    // into the block, where the chapter's arm overlaps it: pi/4, pi/4
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.plan.move_end(
        1,
        motion_lab_core::configuration::AnyConfiguration::T2(motion_lab_core::configuration::T2::new(0.785, 0.785)),
    );
    harness.run_steps(2);
    harness.get_by_label_contains("No path: the goal would overlap the block");
    let roles = |harness: &Harness<'_, Lab>, id: &str| {
        let over = plan(harness).over;
        over.items.iter().filter(|item| item.id.starts_with(id)).map(|item| item.role).collect::<Vec<_>>()
    };
    assert!(roles(&harness, "goal").iter().all(|role| *role == Role::Goal) && !roles(&harness, "goal").is_empty());
    let start = roles(&harness, "start");
    assert!(start.contains(&Role::Robot) && !start.contains(&Role::Goal), "the start is free: {start:?}");
    assert!(plan(&harness).lengths().is_none());
    harness.get_by_label_contains("configuration space. ");
}

#[test]
fn a_path_is_played_as_a_run_and_drawn_over_it() {
    let mut harness = planned(WIDE);
    click(&mut harness, "Next seed");
    play(&mut harness);
    click(&mut harness, "Play it");
    harness.run_steps(4);
    assert_eq!(harness.state().transport().seed.0, 2006, "the seed that the script was made for");
    let world = harness.state().app.world();
    assert_eq!(world.resource::<Interface>().0.widget, motion_lab_sim::manifest::Widget::Dashboard);
    assert_eq!(harness.state().transport().playback, Playback::Playing);
    assert!(plan(&harness).over_world("Workbench").is_some() && plan(&harness).over_world("Lot").is_none());
    harness.get_by_label("Reach \u{b7} Workbench \u{b7} on its path");
    assert!(harness.query_by_label_contains("three robots, three spaces").is_none(), "one robot in one space");
    // the arm's trail leaves out where it stood before it was put at the start
    assert_eq!(harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].robots[0].put, 1);
    let over = plan(&harness).over_world("Workbench").cloned().unwrap();
    assert!(
        over.items.iter().any(|item| item.id == "path") && !over.items.iter().any(|item| item.id.starts_with("start"))
    );
    let goal = plan(&harness).task().goal.coordinates();
    for _ in 0..4000 {
        harness.run_steps(1);
        let off: f64 = harness.state().robot(0).coordinates.iter().zip(&goal).map(|(a, b)| (a - b).abs()).sum();
        if off < 1e-4 {
            assert_eq!(harness.state().robot(0).contacts, 0);
            drag(&mut harness, "Reach: elbow, \u{3b8}\u{2081} in radians", [0.0, -1.0]);
            harness.get_by_label("Reach \u{b7} Workbench \u{b7} driven by hand");
            // another run of the same world does not play it
            let config = motion_lab_sim::tour::TourConfig::default();
            let app = harness.state_mut().app.world_mut();
            super::super::session::new_run(
                app,
                motion_lab_sim::run::Recipe::new(config, motion_lab_sim::tour::BOOK_SEED),
            )
            .unwrap();
            harness.run_steps(2);
            assert!(plan(&harness).over_world("Workbench").is_none() && !plan(&harness).over_drive);
            return;
        }
    }
    panic!("it never arrives");
}

#[test]
fn while_a_path_plays_the_fields_say_what_the_readout_says_and_nobody_waits_for_a_drag() {
    let mut harness = planned(WIDE);
    play(&mut harness);
    click(&mut harness, "Play it");
    let mut seen = 0;
    for frame in 0..60 {
        // played, paused, and gone through again from where it is paused
        match frame {
            30 => pause(&mut harness),
            40 => harness.key_press(Key::ArrowLeft),
            _ => {}
        }
        harness.run_steps(1);
        assert!(harness.query_by_label_contains("the drag waits").is_none(), "frame {frame}");
        assert!(harness.query_by_label("comes with the next tick").is_none(), "frame {frame}");
        let robot = &harness.state().app.world().resource::<ShownDashboard>().0.cockpits[0].robots[0];
        let now = harness.state().robot(0).coordinates;
        assert_eq!((robot.target.clone(), &robot.coordinates), (None, &now), "frame {frame}");
        for (i, sign) in ["\u{3b8}\u{2081}", "\u{3b8}\u{2082}"].into_iter().enumerate() {
            let field = harness.get_by_label(&format!("Reach: {sign}")).value().expect("a number");
            let said: f64 = field.replace('\u{2212}', "-").parse().unwrap();
            assert!((said - now[i]).abs() < 6e-4, "frame {frame}: {sign} is {said} in its field, {} on paper", now[i]);
        }
        seen += 1;
    }
    assert_eq!(seen, 60);
    // a drag is asked for, and waits
    drag(&mut harness, "Reach: elbow, \u{3b8}\u{2081} in radians", [0.0, -1.0]);
    harness.get_by_label("comes with the next tick");
    harness.get_by_label_contains("the drag waits for the next tick");
}

#[test]
fn a_path_goes_to_a_file_and_comes_back_and_a_wrong_file_changes_nothing() {
    let mut harness = planned(WIDE);
    play(&mut harness);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("path.json");
    let world = harness.state_mut().app.world_mut();
    assert!(!crate::window::desktop::files::save_path(world, &path).unwrap().is_error);
    let drawn = world.resource::<Interface>().0.plan.drawn().clone();
    let notice = crate::window::desktop::files::open_path(world, &path);
    assert!(!notice.is_error, "{notice:?}");
    harness.run_steps(2);
    let read = plan(&harness);
    assert_eq!((&read.drawn().corners, &read.drawn().ends), (&drawn.corners, &drawn.ends));
    assert_eq!(read.drawn().edges.len(), drawn.edges.len());
    // as words and as the picture, for readers who do not see it
    assert_eq!(harness.get_all_by_label_contains("Proven free, with a clearance of at least").count(), 2);
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(PathFile::read(&text).unwrap().names(), ["Workbench", "Reach"]);
    std::fs::write(&path, text.replacen("\"version\":1", "\"version\":9", 1)).unwrap();
    let notice = crate::window::desktop::files::open_path(harness.state_mut().app.world_mut(), &path);
    assert!(notice.is_error && notice.text.contains("version 9: this program reads version 1"), "{notice:?}");
    assert_eq!(plan(&harness).drawn(), read.drawn());
}

#[test]
fn a_planner_of_a_programs_own_is_chosen_and_stepped_where_it_suits_the_robot() {
    use motion_lab_core::planning::RrtConnect;
    use motion_lab_sim::plans::{OwnPlanner, Planners};
    static MINE: OwnPlanner = OwnPlanner {
        arm: Some(|problem| Ok(Box::new(RrtConnect::new(problem)))),
        ..OwnPlanner::new("mine", "Mine", "As the lab's, for arms of two links")
    };
    let mut planners = Planners::default();
    planners.register(&MINE).unwrap();
    let mut app = app(Duration::from_millis(25));
    app.insert_resource(planners);
    let mut harness = lab_of(app, WIDE);
    click(&mut harness, "Plan");
    let choose = |harness: &mut Harness<'_, Lab>| {
        harness.get_all_by_role(egui::accesskit::Role::ComboBox).nth(2).unwrap().click();
        harness.run_steps(3);
    };
    choose(&mut harness);
    harness.get_by_label("Mine").click();
    harness.run_steps(3);
    assert_eq!(plan(&harness).planner().id(), "mine");
    let list = harness.get_all_by_role(egui::accesskit::Role::ComboBox).nth(2).unwrap().rect().center();
    pointer(&mut harness, list, None);
    harness.run_steps(60);
    harness.get_by_label("As the lab's, for arms of two links");
    play(&mut harness);
    harness.get_by_label_contains(" m, proven");
    assert!(plan(&harness).command().unwrap().starts_with("motion-lab plan --planner mine --robot Reach "));
    // no trailer has it, and the arm has it once more
    let task = |harness: &mut Harness<'_, Lab>, name: &str| {
        harness.get_all_by_role(egui::accesskit::Role::ComboBox).nth(1).unwrap().click();
        harness.run_steps(3);
        harness.get_by_label(name).click();
        harness.run_steps(3);
    };
    task(&mut harness, "Hitch with its trailer, Lot");
    assert_eq!(plan(&harness).planner().id(), "hybrid-a-star");
    choose(&mut harness);
    assert!(harness.query_by_label("Mine").is_none());
    choose(&mut harness);
    // neither another task nor the beginning of a lesson takes it from the list
    task(&mut harness, "Reach, Workbench");
    interface_mut(&mut harness).begin(motion_lab_sim::manifest::Lesson::of("step_planner").unwrap());
    harness.run_steps(3);
    assert_eq!(plan(&harness).planner().id(), "rrt-connect");
    choose(&mut harness);
    harness.get_by_label("Mine");
}

#[test]
fn a_trailer_is_planned_for_by_choice_and_each_robot_has_its_planners() {
    planned(PHONE).get_by_label_contains("workspace. RRT-Connect for Reach");
    let mut wide = planned(WIDE);
    // the pace under the papers is the first
    wide.get_all_by_role(egui::accesskit::Role::ComboBox).nth(1).unwrap().click();
    wide.run_steps(3);
    wide.get_by_label("Hitch with its trailer, Lot").click();
    wide.run_steps(3);
    let shown = plan(&wide);
    assert_eq!((shown.planner().id(), shown.task().start.coordinates().len()), ("hybrid-a-star", 4));
    click(&mut wide, "Step");
    assert!(plan(&wide).effort().edges > 0);
    let command = plan(&wide).command().unwrap();
    assert!(
        command.starts_with("motion-lab plan --planner hybrid-a-star --robot Hitch --world lot --from "),
        "{command}"
    );
}

#[test]
fn bug1_by_its_sensor_has_a_switch_that_makes_the_sensor_lie_and_says_what_was_misjudged() {
    use motion_lab_sim::plans::{PlannerName, Task};
    let mut harness = planned(WIDE);
    assert!(harness.query_by_label("the sensor lies").is_none(), "other planners see all");
    let (robot, start) = motion_lab_core::robots::AnyRobot::of_kind("rusty", &[1.5, 5.75, 0.0]).unwrap();
    let goal = start.with(0, 9.75).with(1, 6.25);
    let state = &mut interface_mut(&mut harness).plan;
    state.take(Task::new("Rusty", robot, motion_lab_core::worlds::World::apartment(), [start, goal]));
    state.set_seed(motion_lab_core::random::Seed(2034));
    state.set_planner(PlannerName::Bug1Sensor);
    state.pace = 6;
    harness.run_steps(3);
    play(&mut harness);
    harness.get_by_label("Round 1: left where the boundary comes nearest.");
    harness.get_by_label_contains(" m, proven");
    click(&mut harness, "the sensor lies");
    assert!(plan(&harness).sensor_lies() && plan(&harness).effort().iterations == 0);
    assert!(harness.query_by_label_contains("Round 1").is_none(), "it begins anew");
    play(&mut harness);
    harness.get_by_label_contains("m farther from the goal than the boundary comes: misjudged.");
    harness.get_by_label("Round 2: left where the boundary comes nearest.");
    // at this seed it gives up
    interface_mut(&mut harness).plan.set_seed(motion_lab_core::random::Seed(2023));
    harness.run_steps(3);
    play(&mut harness);
    harness.get_by_label_contains("No path: the robot gave up: it never came back to where the boundary had seemed");
    click(&mut harness, "the sensor lies");
    assert!(!plan(&harness).sensor_lies());
}

#[test]
fn an_end_that_lies_in_another_slice_is_said_to() {
    use motion_lab_core::configuration::{AnyConfiguration, HitchCfg};
    use motion_lab_core::geometry::Pose2;
    let mut harness = planned(WIDE);
    let at = |theta| AnyConfiguration::Hitch(HitchCfg { body: Pose2::new(6.5, 3.0, theta), trailer: None });
    let said = |harness: &Harness<'_, Lab>| {
        super::safe::words(harness)
            .into_iter()
            .any(|(text, ..)| text.ends_with("that of the goal, the start lies in another"))
    };
    for (goal, is_other) in [(0.0, false), (-1.5, true)] {
        let car = motion_lab_core::robots::AnyRobot::Hitch(motion_lab_core::robots::HITCH);
        let task =
            motion_lab_sim::plans::Task::new("Hitch", car, motion_lab_core::worlds::World::lot(), [at(0.0), at(goal)]);
        interface_mut(&mut harness).plan.take(task);
        harness.run_steps(4);
        assert_eq!(said(&harness), is_other, "{goal}");
    }
}
