//! Robots on wheels put elsewhere by hand: by their bodies with Alt, by their points, by the dial; and two of them in
//! one world.

use super::*;
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::worlds::{Resident, World as Model};

/// The pane of a built-in world, and how the world lies in it.
fn fit(harness: &Harness<'_, Lab>, world: &Model) -> motion_lab_core::picture::Fit {
    crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(world), paper(harness, &world.name))
}

fn on_screen(harness: &Harness<'_, Lab>, world: &Model, [x, y]: [f64; 2]) -> Pos2 {
    let [x, y] = fit(harness, world).screen_from_world(Point2::new(x, y));
    pos2(x as f32, y as f32)
}

fn drag_by(harness: &mut Harness<'_, Lab>, from: Pos2, to: Pos2) {
    pointer(harness, from, Some(true));
    for i in 1..=20 {
        pointer(harness, from.lerp(to, i as f32 / 20.0), None);
    }
    harness.run_steps(2);
}

/// The same with Alt.
fn put_by(harness: &mut Harness<'_, Lab>, from: Pos2, to: Pos2) {
    alt(harness, true);
    drag_by(harness, from, to);
    alt(harness, false);
}

/// Whether two numbers differ by the rounding of inputs at most.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < 2e-6
}

/// Where the script puts a robot last, and how often it does.
fn put(harness: &Harness<'_, Lab>) -> (Vec<f64>, usize) {
    let places = harness.state().script().events.iter().filter_map(|event| match &event.input {
        RobotInput::Teleport(to) => Some(to.iter().map(|c| c.value()).collect::<Vec<_>>()),
        _ => None,
    });
    let places: Vec<_> = places.collect();
    (places.last().cloned().unwrap_or_default(), places.len())
}

#[test]
fn a_rover_is_put_elsewhere_by_its_body_with_alt_and_stays_out_of_the_furniture() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let world = Model::apartment();
    let before = harness.state().robot(0).coordinates;
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    let to = on_screen(&harness, &world, [before[0] + 0.5, before[1] - 0.25]);
    put_by(&mut harness, body, to);
    let (there, count) = put(&harness);
    let off = [there[0] - before[0] - 0.5, there[1] - before[1] + 0.25];
    assert!(off.iter().all(|off| off.abs() < 0.02) && same(there[2], before[2]), "{before:?} {there:?}");
    assert_eq!(count, 1, "paused, a drag is one input");
    harness.get_by_label("comes with the next tick");
    // into the round table of room B, 0.5 m about (6, 6.75)
    let table = on_screen(&harness, &world, [6.0, 6.75]);
    put_by(&mut harness, to, table);
    let shown = super::super::safe::words(&harness);
    assert!(shown.iter().any(|(text, ..)| text == "B's round table"), "what is in the way has its name");
    pointer(&mut harness, table, Some(false));
    harness.run_steps(2);
    let said = interface(&harness).notice().unwrap().text.clone();
    assert_eq!(said, "Rusty stays where it is free: B's round table is in the way");
    let (there, _) = put(&harness);
    let scene = Scene::of_world(&world);
    assert!(!scene.intersects(&Footprint::disc(Point2::new(there[0], there[1]), 0.11)), "{there:?}");
    let from_table = motion_lab_core::num::hypot(there[0] - 6.0, there[1] - 6.75) - 0.5 - 0.11;
    assert!(from_table > 0.0, "{there:?}");
    // it says how near it will be, not how near it is
    let said = super::super::safe::words(&harness).into_iter().find(|(text, ..)| text.starts_with("clearance: "));
    let said: f64 = said.unwrap().0["clearance: ".len()..].split('\u{a0}').next().unwrap().parse().unwrap();
    assert!((said - from_table).abs() < 1e-4, "{said} {from_table}");
    click(&mut harness, "Step");
    let now = harness.state().robot(0);
    assert!(now.manual && now.refusals == 0 && (now.coordinates[0] - there[0]).abs() < 1e-9, "{:?}", now.coordinates);
    click(&mut harness, "Undo");
    assert_eq!(put(&harness).1, 0, "one thing to undo");
    // dragged again while the first drag waits for its tick, it goes on from where it is to come
    put_by(&mut harness, body, body + egui::vec2(40.0, 0.0));
    pointer(&mut harness, body + egui::vec2(40.0, 0.0), Some(false));
    let (first, _) = put(&harness);
    put_by(&mut harness, body + egui::vec2(40.0, 0.0), body + egui::vec2(40.0, -20.0));
    let (second, _) = put(&harness);
    let px = 20.0 / fit(&harness, &world).px_per_metre();
    assert!((second[0] - first[0]).abs() < 0.02 && (second[1] - first[1] - px).abs() < 0.02, "{first:?} {second:?}");
    // and taken where it still is, it goes on from there
    pointer(&mut harness, body + egui::vec2(40.0, -20.0), Some(false));
    harness.run_steps(2);
    put_by(&mut harness, body, body + egui::vec2(0.0, -30.0));
    pointer(&mut harness, body + egui::vec2(0.0, -30.0), Some(false));
    let ([x, y, ..], px) = (&put(&harness).0[..], 30.0 / fit(&harness, &world).px_per_metre()) else { panic!() };
    assert!((x - before[0]).abs() < 0.02 && (y - before[1] - px).abs() < 0.02, "{before:?} {x} {y}");
}

#[test]
fn two_fingers_over_a_body_magnify_and_put_it_nowhere() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    // controls grow with the first finger, before any body is where it stays
    interface_mut(&mut harness).pointer.is_touched = true;
    harness.run_steps(4);
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    let touch = |harness: &mut Harness<'_, Lab>, finger: u64, phase, at: Pos2| {
        let id = egui::TouchId(finger);
        harness.event(egui::Event::Touch { device_id: egui::TouchDeviceId(1), id, phase, pos: at, force: None });
    };
    use egui::TouchPhase::{End, Move, Start};
    let finger = |k: u64, apart: f32| body + egui::vec2(if k == 1 { 4.0 } else { -4.0 } * apart, 2.0);
    for k in [1, 2] {
        touch(&mut harness, k, Start, finger(k, 1.0));
    }
    pointer(&mut harness, finger(1, 1.0), Some(true));
    for apart in 2..=12 {
        [1, 2].into_iter().for_each(|k| touch(&mut harness, k, Move, finger(k, apart as f32)));
        pointer(&mut harness, finger(1, apart as f32), None);
    }
    assert!(interface(&harness).cameras["Apartment"].zoom > 1.5, "{:?}", interface(&harness).cameras);
    // the finger that is left drags nothing
    touch(&mut harness, 2, End, finger(2, 12.0));
    for apart in 13..=20 {
        touch(&mut harness, 1, Move, finger(1, apart as f32));
        pointer(&mut harness, finger(1, apart as f32), None);
    }
    touch(&mut harness, 1, End, finger(1, 20.0));
    pointer(&mut harness, finger(1, 20.0), Some(false));
    assert_eq!(harness.state().script().events, [], "neither put nor towed");
}

#[test]
fn a_door_beside_a_rover_takes_its_click() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let world = Model::apartment();
    // 9 cm of floor between it and the gap of door B: the square that takes the pointer covers both
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    let to = on_screen(&harness, &world, [6.0, 4.55]);
    put_by(&mut harness, body, to);
    pointer(&mut harness, to, Some(false));
    click(&mut harness, "Step");
    let square = harness.get_by_label("Rusty: its body, to be dragged").rect();
    let [at_door, on_body] = [[6.0, 4.75], [6.0, 4.6]].map(|place| on_screen(&harness, &world, place));
    assert!(square.contains(at_door), "{square} {at_door}");
    click_at(&mut harness, at_door);
    let closed = |h: &Harness<'_, Lab>| h.state().script().changes.iter().map(|change| change.change.clone()).collect();
    let close = motion_lab_sim::run::WorldChange::Close("door B".into());
    assert_eq!((closed(&harness), interface(&harness).hand.armed.clone()), (vec![close.clone()], None));
    click_at(&mut harness, on_body);
    let changes: Vec<_> = closed(&harness);
    assert_eq!((changes.len(), interface(&harness).hand.armed.as_deref()), (1, Some("Rusty")), "the body is its own");
}

#[test]
fn a_point_dragged_into_an_obstacle_says_in_the_world_what_is_in_the_way() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let point = harness.get_by_label("Rusty: its configuration as a point, to be dragged").rect().center();
    let inset = harness.get_by_label_contains("Configuration of Rusty").rect();
    let before = harness.state().robot(0).coordinates;
    // the inset shows the Apartment's 12 x 8 m; B's round table is about (6, 6.75)
    let scale = inset.height() / 8.0;
    let table = point + egui::vec2(6.0 - before[0] as f32, before[1] as f32 - 6.75) * scale;
    let said = |harness: &Harness<'_, Lab>| {
        super::super::safe::words(harness).iter().any(|(text, ..)| text == "B's round table")
    };
    drag_by(&mut harness, point, table);
    assert!(said(&harness), "what is in the way has its name");
    pointer(&mut harness, table, Some(false));
    harness.run_steps(3);
    assert!(!said(&harness), "no longer than the drag");
}

#[test]
fn a_rover_has_a_dial_for_its_heading() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let dial = harness.get_by_label("Rusty: its heading on a dial, to be dragged").rect().center();
    let before = harness.state().robot(0).coordinates;
    drag_by(&mut harness, dial + egui::vec2(18.0, 0.0), dial + egui::vec2(0.0, -18.0));
    let (turned, _) = put(&harness);
    assert!((turned[2] - std::f64::consts::FRAC_PI_2).abs() < 1e-3, "straight up: {turned:?}");
    assert!(same(turned[0], before[0]) && same(turned[1], before[1]), "it turns on the spot");
}

#[test]
fn a_point_and_a_dial_are_dragged_and_the_car_follows() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Hitch");
    let before = harness.state().robot(2).coordinates;
    let dial = harness.get_by_label("Hitch: its heading on a dial, to be dragged").rect().center();
    drag_by(&mut harness, dial + egui::vec2(18.0, 0.0), dial + egui::vec2(12.0, -12.0));
    let (turned, _) = put(&harness);
    assert!((turned[2] - std::f64::consts::FRAC_PI_4).abs() < 1e-3, "up and to the right: {turned:?}");
    assert!(same(turned[0], before[0]) && same(turned[1], before[1]), "it turns on the spot");
    pointer(&mut harness, dial + egui::vec2(12.0, -12.0), Some(false));
    let point = harness.get_by_label("Hitch: its configuration as a point, to be dragged").rect().center();
    drag_by(&mut harness, point, point + egui::vec2(12.0, -6.0));
    let (moved, count) = put(&harness);
    assert!(moved[0] > turned[0] && moved[1] > turned[1] && same(moved[2], turned[2]), "{turned:?} {moved:?}");
    assert!(((moved[0] - turned[0]) / (moved[1] - turned[1]) - 2.0).abs() < 0.1, "twice as far across as up");
    assert_eq!(count, 1);
}

#[test]
fn where_two_robots_share_a_world_a_click_takes_the_one_under_it() {
    let mut harness = lab(WIDE);
    let mut model = Model::apartment();
    let first = model.robots[0].clone();
    model.robots.push(Resident { name: "Second".into(), start: vec![6.0, 4.0, 0.0], ..first });
    let config = motion_lab_sim::tour::TourConfig { worlds: vec![model.clone()], ..Default::default() };
    let world = harness.state_mut().app.world_mut();
    world.resource_mut::<Transport>().playback = Playback::Paused;
    crate::window::session::new_run(world, motion_lab_sim::run::Recipe::new(config, motion_lab_sim::tour::BOOK_SEED))
        .unwrap();
    harness.run_steps(4);
    for name in ["Rusty", "Second"] {
        harness.get_by_label(name);
    }
    let armed = |harness: &Harness<'_, Lab>| interface(harness).hand.armed.clone();
    let at = harness.get_by_label("Second: its body, to be dragged").rect().center();
    click_at(&mut harness, at);
    assert_eq!(armed(&harness).as_deref(), Some("Second"));
    // beside every robot, here nearer to Rusty, the one in hand stays
    let beside = on_screen(&harness, &model, [2.75, 4.0]);
    click_at(&mut harness, beside);
    assert_eq!(armed(&harness).as_deref(), Some("Second"));
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    let at = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    click_at(&mut harness, at);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(4);
    harness.key_up(Key::ArrowUp);
    harness.run_steps(2);
    let driven: Vec<&str> = harness.state().script().events.iter().map(|event| event.robot.as_str()).collect();
    assert!(!driven.is_empty() && driven.iter().all(|robot| *robot == "Rusty"), "{driven:?}");
    // neither is put onto the other
    let other = harness.state().robot(1).footprint.parts()[0].pose().position();
    let from = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    let to = on_screen(&harness, &model, [other.x, other.y]);
    let named = |harness: &Harness<'_, Lab>| {
        let words = super::super::safe::words(harness);
        let paper = paper(harness, "Apartment");
        words.iter().filter(|(text, ink, _)| text == "Second" && paper.contains_rect(*ink)).count()
    };
    assert_eq!(named(&harness), 0);
    put_by(&mut harness, from, to);
    let (there, _) = put(&harness);
    assert!(motion_lab_core::num::hypot(there[0] - other.x, there[1] - other.y) > 0.22, "{there:?} is on the other");
    assert_eq!(named(&harness), 1, "what is in the way has its name");
}

#[test]
fn a_magnified_view_goes_along_with_the_robot_that_is_driven() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    for _ in 0..4 {
        harness.key_press(Key::Plus);
        harness.run_steps(2);
    }
    let camera = |harness: &Harness<'_, Lab>| interface(harness).cameras["Apartment"];
    assert!(camera(&harness).zoom > 4.0);
    harness.key_down(Key::ArrowUp);
    let from = harness.state().robot(0).footprint.parts()[0].pose().position();
    for _ in 0..60 {
        harness.run_steps(10);
        let rusty = harness.state().robot(0).footprint.parts()[0].pose().position();
        let paper = paper(&harness, "Apartment");
        let bounds = Model::apartment().bounds;
        let whole = crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(&Model::apartment()), paper);
        let [x, y] = camera(&harness).fit(&whole, &bounds, 1.0).screen_from_world(rusty);
        assert!(paper.shrink(20.0).contains(pos2(x as f32, y as f32)), "({x}, {y}) off {paper}");
    }
    let to = harness.state().robot(0).footprint.parts()[0].pose().position();
    assert!((to - from).norm() > 1.0, "the test drives: {from} {to}");
}

#[test]
fn the_hint_of_the_robot_in_hand_gives_way_to_the_robot() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    arm_rusty(&mut harness);
    harness.run_steps(2);
    let hint = |harness: &Harness<'_, Lab>| {
        let words = super::super::safe::words(harness);
        words.into_iter().find(|(text, ..)| text == "arrows drive, Esc lets go").expect("the hint").1
    };
    let stands = hint(&harness);
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    put_by(&mut harness, body, stands.center());
    pointer(&mut harness, stands.center(), Some(false));
    click(&mut harness, "Step");
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect();
    assert!(body.center().distance(stands.center()) < 3.0, "it was put there: {body} {stands}");
    assert!(!hint(&harness).expand(20.0).intersects(body), "{} covers {body}", hint(&harness));
}

#[test]
fn an_arrow_key_without_a_robot_in_hand_says_how_to_take_one() {
    let mut harness = lab(WIDE);
    harness.key_press(Key::ArrowUp);
    harness.run_steps(2);
    harness.get_by_label_contains("no robot is in hand");
    assert!(harness.state().script().events.is_empty());
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_press(Key::ArrowUp);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("no robot is in hand").is_none());
}
