//! Query anatomy, configuration space and atlas.

mod fingers;
mod focus;
mod in_front;
mod layout;
mod lesson_ends;
mod lessons;
mod numbers;
mod pair;
mod tasks_done;
mod word_count;

use super::*;
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::simulation::TransportCommand;

const TABLET: [f32; 2] = [820.0, 1180.0];

/// Puts the widget with this word on the rail in front.
fn front(harness: &mut Harness<'_, Lab>, word: &str) {
    click(harness, word);
    harness.run_steps(3);
}

fn value(harness: &Harness<'_, Lab>, name: &str) -> f64 {
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, name);
    slider.accesskit_node().numeric_value().expect("a value")
}

#[test]
fn the_anatomy_answers_the_four_questions() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    assert_eq!(harness.state().transport().playback, Playback::Paused, "the run waits");
    harness.get_by_label("intersects: false");
    click(&mut harness, "distance");
    harness.get_by_label("distance: 0.0607 m");
    click(&mut harness, "3 cm capsule links");
    harness.get_by_label("distance: 0.0307 m");
    click(&mut harness, "3 cm capsule links");
    // theta2 slides down until the arm touches the block: exactly 0, and it stays 0
    let anatomy = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.anatomy.anatomy.clone();
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, "θ₂").rect();
    let mut seen = Vec::new();
    for part in [0.76, 0.74, 0.71, 0.68] {
        click_at(&mut harness, slider.left_center() + egui::vec2(part * 180.0, 0.0));
        seen.push((value(&harness, "θ₂"), anatomy(&harness).distance(), anatomy(&harness).intersects()));
    }
    assert!(seen[0].1 > 0.0 && !seen[0].2, "{seen:?}");
    assert!(seen.iter().all(|(th2, d, hit)| (*d == 0.0) == *hit && (*th2 < 1.4008) == *hit), "{seen:?}");
    assert!(seen[3].2, "{seen:?}");
    click(&mut harness, "Reset");
    click(&mut harness, "swept");
    let said = anatomy(&harness).described();
    assert!(said.contains("the block"), "{said}");
    harness.get_by_role_and_label(egui::accesskit::Role::Slider, "step of θ₁");
}

#[test]
fn a_run_that_played_plays_on_when_the_dashboard_is_back() {
    let mut harness = lab(WIDE);
    let playback = |harness: &Harness<'_, Lab>| harness.state().transport().playback;
    for (by, then) in [("Play", Playback::Playing), ("Pause", Playback::Paused)] {
        if playback(&harness) != then {
            click(&mut harness, by);
        }
        front(&mut harness, "Query");
        front(&mut harness, "Plan");
        assert_eq!(playback(&harness), Playback::Paused, "the run waits");
        front(&mut harness, "Drive");
        assert_eq!(playback(&harness), then);
    }
    // what was opened meanwhile stands at its start
    click(&mut harness, "Play");
    front(&mut harness, "Query");
    let world = harness.state_mut().app.world_mut();
    let (_, bytes) = super::super::run_files::recorded(world).unwrap();
    super::super::run_files::open_log(world, "run", &bytes).unwrap();
    harness.run_steps(3);
    front(&mut harness, "Drive");
    assert_eq!(playback(&harness), Playback::Paused);
    // nor does one that was paused on the dashboard, however that came to the front and went
    click(&mut harness, "Play");
    front(&mut harness, "Query");
    for (widget, by) in [(Widget::Dashboard, TransportCommand::Play), (Widget::Anatomy, TransportCommand::Pause)] {
        interface_mut(&mut harness).widget = widget;
        harness.state_mut().app.world_mut().write_message(RunCommand::from(by));
        harness.run_steps(3);
    }
    front(&mut harness, "Drive");
    assert_eq!(playback(&harness), Playback::Paused);
}

#[test]
fn the_name_of_a_chooser_stands_before_it() {
    for (widget, names) in
        [("Query", &["robot", "world"][..]), ("Space", &["robot", "world"]), ("Plan", &["robot", "planner"])]
    {
        let mut harness = lab(WIDE);
        front(&mut harness, widget);
        if widget == "Query" {
            click(&mut harness, "Any robot, any world");
        }
        for name in names {
            let label = harness.get_by_role_and_label(egui::accesskit::Role::Label, name).rect();
            let list = harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, name).rect();
            let is_in_row = (label.center().y - list.center().y).abs() < 2.0;
            assert!(is_in_row && label.right() <= list.left(), "{widget}: {name} at {label} and {list}");
        }
    }
}

#[test]
fn a_number_is_asked_for_before_it_is_shown() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    click(&mut harness, "Guess first");
    assert!(harness.query_by_label_contains("0.0306").is_none());
    harness.get_by_label_contains("the links are given a radius of 3 cm").focus();
    harness.run_steps(2);
    harness.event(Event::Text("0.05".into()));
    harness.step();
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    harness.get_by_label_contains("Off by +0.0193 m: it is 0.030660 m");
}

#[test]
fn the_configuration_space_is_proven_and_moves_the_arm() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Space");
    // more is proven from frame to frame, until all is that can be
    let anatomy = harness.state().app.world().resource::<Interface>().0.anatomy.anatomy.clone();
    let slice = motion_lab_core::cspace::Slice::through(anatomy.checker(), &anatomy.q()).unwrap();
    let mut cells = motion_lab_core::cspace::CellMap::new(slice, 8);
    cells.refine(u32::MAX);
    let share = format!("proven free {:.1} %", 100.0 * cells.progress().free);
    assert!(harness.query_by_label_contains(&share).is_none(), "not at once");
    harness.run_steps(20);
    harness.get_by_label_contains(&share);
    let space = harness.get_by_label_contains("configuration space. The robot is the point").rect();
    click_at(&mut harness, space.center());
    let q = harness.state().app.world().resource::<Interface>().0.anatomy.anatomy.q().to_string();
    click_at(&mut harness, space.center() + egui::vec2(60.0, 0.0));
    let moved = harness.state().app.world().resource::<Interface>().0.anatomy.anatomy.q().to_string();
    assert_ne!(q, moved);
    let th2 = |q: &str| q.rsplit_once("th2: ").map(|(_, tail)| tail.to_owned());
    assert_eq!(th2(&q), th2(&moved), "a point to the right is another theta1");
}

#[test]
fn the_atlas_puts_robots_refuses_and_edits() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Atlas");
    let paper = harness.get_by_label_contains("World Apartment").rect();
    let atlas = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.atlas.clone();
    let fit = crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(atlas(&harness).world()), paper);
    let at = |x: f64, y: f64| {
        let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
        pos2(x as f32, y as f32)
    };
    click_at(&mut harness, at(6.0, 4.0));
    let q = atlas(&harness).atlas().robots()[0].q;
    assert!((motion_lab_core::configuration::Configuration::coordinates(&q)[0] - 6.0).abs() < 0.05, "{q}");
    // on the round table: refused by name, in place
    click_at(&mut harness, at(6.0, 6.75));
    assert_eq!(atlas(&harness).atlas().robots()[0].q, q, "it stays");
    harness.get_by_label("would overlap B's round table; click the ring for the nearest free place");
    // the editor
    click(&mut harness, "Edit");
    click(&mut harness, "Add box");
    click_at(&mut harness, at(6.0, 4.0));
    assert!(atlas(&harness).world().obstacle("box").is_some());
    click(&mut harness, "Delete");
    assert!(atlas(&harness).world().obstacle("box").is_none());
    click(&mut harness, "Undo");
    assert!(atlas(&harness).world().obstacle("box").is_some());
    // saved, it is a world file that runs
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.ron");
    let notice = crate::window::desktop::files::save_world(harness.state_mut().app.world_mut(), &path);
    assert!(!notice.is_error && atlas(&harness).is_saved(), "{notice:?}");
    let text = std::fs::read_to_string(&path).unwrap();
    let world = motion_lab_core::worlds::World::parse("mine.ron", &text).unwrap();
    assert_eq!(world.to_ron(), text, "canonical");
    let opened = crate::window::desktop::files::open_world(harness.state_mut().app.world_mut(), &path);
    assert!(!opened.is_error && atlas(&harness).is_saved());
    std::fs::write(&path, "a cat").unwrap();
    let refused = crate::window::desktop::files::open_world(harness.state_mut().app.world_mut(), &path);
    assert!(refused.is_error && atlas(&harness).is_saved(), "{refused:?}");
    // the buttons stand where the name of the file leaves them
    harness.run_steps(2);
    click(&mut harness, "Run this world");
    let config = harness.state().app.world().resource::<RunConfig>().config().clone();
    assert!(config.worlds.len() == 1 && config.worlds[0].obstacle("box").is_some());
    click(&mut harness, "Undo");
    assert_eq!(harness.state().app.world().resource::<RunConfig>().config().worlds.len(), 3);
}

#[test]
fn the_three_robots_have_their_spaces_and_the_car_its_slice() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Space");
    harness.run_steps(4);
    harness.get_by_label("\u{3b8}\u{2081} and \u{3b8}\u{2082}: opposite edges are one");
    let pick = |harness: &mut Harness<'_, Lab>, name: &str| {
        harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "robot").click();
        harness.run_steps(3);
        click(harness, name);
        harness.run_steps(6);
    };
    pick(&mut harness, "Rusty");
    harness.get_by_label("x and y: every obstacle is grown by r = 0.11 m");
    assert!(harness.query_by_label("the tip's reach").is_none());
    pick(&mut harness, "Hitch");
    harness.get_by_label("x and y at \u{3b8} = 0.000");
    let anatomy = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.anatomy.anatomy.clone();
    assert_eq!(anatomy(&harness).world().name, "Lot", "where it lives");
    // another heading is another slice
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, "θ").rect();
    click_at(&mut harness, slider.left_center() + egui::vec2(0.75 * 180.0, 0.0));
    harness.run_steps(4);
    let theta = value(&harness, "θ");
    assert!(theta > 1.0 && theta < 2.0, "{theta}");
    harness.get_by_label(&format!("x and y at \u{3b8} = {theta:.3}"));
    // the motion of the swept tab, on demand
    click(&mut harness, "Query's motion");
    assert_eq!(anatomy(&harness).tab, motion_lab_sim::anatomy::Tab::Swept);
}

#[test]
fn a_world_of_the_atlas_is_asked_about_in_the_anatomy() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.ron");
    let mut harness = lab(WIDE);
    front(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    harness.get_by_label("Add disc").click_accesskit();
    harness.run_steps(3);
    crate::window::desktop::files::save_world(harness.state_mut().app.world_mut(), &path);
    let is_asked_about = |harness: &Harness<'_, Lab>| {
        let anatomy = &interface(harness).anatomy.anatomy;
        assert!(anatomy.world().obstacle("disc").is_some());
        assert!(anatomy.copy_as_command().unwrap().contains("mine.ron"), "a command about the file");
    };
    front(&mut harness, "Query");
    is_asked_about(&harness);
    // and by the list of worlds
    click(&mut harness, "Reset");
    assert!(interface(&harness).anatomy.anatomy.world().obstacle("disc").is_none());
    click(&mut harness, "Any robot, any world");
    harness.run_steps(20);
    harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "world").click_accesskit();
    harness.run_steps(3);
    harness.get_by_label("Apartment, in the atlas").click_accesskit();
    harness.run_steps(3);
    is_asked_about(&harness);
}

#[test]
fn hints_about_the_arm_are_not_given_beside_a_car() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    interface_mut(&mut harness).settings.hints_away.clear();
    harness.run_steps(3);
    let pick = |harness: &mut Harness<'_, Lab>, name: &str| {
        harness.get_by_role_and_label(egui::accesskit::Role::ComboBox, "robot").click();
        harness.run_steps(3);
        click(harness, name);
        harness.run_steps(6);
    };
    let shown = |harness: &Harness<'_, Lab>, words: &str| harness.query_by_label_contains(words).is_some();
    for (robot, is_arm) in [("Reach", true), ("Hitch", false)] {
        if !is_arm {
            pick(&mut harness, robot);
        }
        assert!(shown(&harness, "Drag the point, and see the robot move."), "{robot}");
        assert_eq!(shown(&harness, "Unequal links"), is_arm, "{robot}");
        assert_eq!(shown(&harness, "Guess first"), is_arm, "{robot}: the questions are of an arm's tip");
    }
}
