//! Robots on wheels towed by their bodies: the pointer pulls, their own commands drive.

use super::*;
use motion_lab_core::geometry::{Point2, Pose2};
use motion_lab_core::num::{hypot, wrap};
use motion_lab_core::picture::Fit;
use motion_lab_core::worlds::World as Model;

/// How a built-in world lies in its pane.
fn fit(harness: &Harness<'_, Lab>, world: &Model) -> Fit {
    crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(world), paper(harness, &world.name))
}

fn on_screen(harness: &Harness<'_, Lab>, world: &Model, [x, y]: [f64; 2]) -> Pos2 {
    let [x, y] = fit(harness, world).screen_from_world(Point2::new(x, y));
    pos2(x as f32, y as f32)
}

/// Brings the car to the front and puts it into the middle of the lot, paused.
fn parked(trailer: bool) -> Harness<'static, Lab> {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Hitch");
    if trailer {
        click(&mut harness, "put a trailer on");
        click(&mut harness, "Step");
    }
    let to = [4.0, 2.5, 0.0, 0.0].map(|v| motion_lab_sim::run::Quantized::try_new(v).unwrap());
    let input = RobotInput::Teleport(to[..if trailer { 4 } else { 3 }].to_vec());
    let command = motion_lab_sim::simulation::RobotCommand { robot: "Hitch".into(), input };
    harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
    harness.run_steps(3);
    click(&mut harness, "Step");
    assert_eq!(harness.state().robot(2).coordinates[..2], [4.0, 2.5]);
    harness
}

/// Presses here and moves there, in twenty frames.
fn grip(harness: &mut Harness<'_, Lab>, from: Pos2, to: Pos2) {
    // the pointer comes before it presses
    pointer(harness, from, None);
    harness.step();
    pointer(harness, from, Some(true));
    (1..=20).for_each(|i| pointer(harness, from.lerp(to, i as f32 / 20.0), None));
}

/// The inputs after the first `from`.
fn inputs(harness: &Harness<'_, Lab>, from: usize) -> Vec<RobotInput> {
    harness.state().script().events[from..].iter().map(|event| event.input.clone()).collect()
}

fn says(harness: &Harness<'_, Lab>, words: &str) -> bool {
    super::super::safe::words(harness).iter().any(|(text, ..)| text == words)
}

const ABEAM: &str = "abeam: the car can only steer";

#[test]
fn a_car_dragged_sideways_turns_its_wheels_and_does_not_slide() {
    let mut harness = parked(false);
    let (lot, before) = (Model::lot(), harness.state().script().events.len());
    let body = on_screen(&harness, &lot, [5.0, 2.5]);
    let abeam = on_screen(&harness, &lot, [5.0, 4.5]);
    grip(&mut harness, body, abeam);
    harness.run_steps(10);
    assert_eq!(harness.state().transport().playback, Playback::Playing, "a tow starts the run, as a key does");
    assert_eq!(harness.state().robot(2).coordinates[..], [4.0, 2.5, 0.0], "abeam it stands");
    assert_eq!(harness.state().robot(2).channels, [0, 128], "and steers to the pointer");
    assert!(says(&harness, ABEAM));
    // farther ahead it goes
    let ahead = on_screen(&harness, &lot, [9.0, 3.0]);
    pointer(&mut harness, ahead, None);
    let mut poses = Vec::new();
    for _ in 0..400 {
        harness.step();
        let [x, y, theta] = harness.state().robot(2).coordinates[..] else { panic!() };
        poses.push(Pose2 { x, y, theta });
    }
    assert!(!says(&harness, ABEAM));
    for pair in poses.windows(2) {
        // the chord of an arc points along the mean of the headings at its ends
        let middle = Pose2 { theta: pair[0].theta + 0.5 * wrap(pair[1].theta - pair[0].theta), ..pair[0] };
        let sideways = middle.inverse().transform(pair[1].position()).y;
        assert!(sideways.abs() < 1e-12, "{sideways}");
    }
    // it was gripped a metre ahead of its axle: that point is where the pointer is
    let gripped = poses.last().unwrap().transform(Point2::new(1.0, 0.0));
    assert!(hypot(gripped.x - 9.0, gripped.y - 3.0) < 0.1, "{gripped}");
    assert_eq!(harness.state().robot(2).channels, [0, 0], "it rests there");
    assert_eq!(interface(&harness).hand.armed.as_deref(), Some("Hitch"), "it is in hand");
    // pulled again from its rest, it is the same drag
    let farther = on_screen(&harness, &lot, [9.6, 3.1]);
    pointer(&mut harness, farther, None);
    harness.run_steps(60);
    assert!(harness.state().robot(2).coordinates[0] > poses.last().unwrap().x + 0.3);
    pointer(&mut harness, farther, Some(false));
    harness.run_steps(3);
    assert_eq!(interface(&harness).hand.tow, None);
    let inputs = inputs(&harness, before);
    assert!(inputs.len() > 10 && inputs.iter().all(|input| matches!(input, RobotInput::Drive(..))), "{inputs:?}");
    click(&mut harness, "Undo");
    assert_eq!(harness.state().script().events.len(), before, "all of it is undone at once");
}

#[test]
fn an_undo_in_the_middle_of_a_tow_brings_back_the_run_before_and_adds_nothing() {
    let mut harness = parked(false);
    let lot = Model::lot();
    let before = harness.state().script().clone();
    let (body, to) = (on_screen(&harness, &lot, [5.2, 2.5]), on_screen(&harness, &lot, [10.5, 2.7]));
    grip(&mut harness, body, to);
    harness.run_steps(10);
    assert!(harness.state().script().events.len() > before.events.len(), "it is towed");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(10);
    assert_eq!(interface(&harness).hand.tow, None);
    assert_eq!(*harness.state().script(), before);
    pointer(&mut harness, to, Some(false));
    harness.run_steps(3);
    assert_eq!(*harness.state().script(), before, "nor when the pointer lets go");
    // what waits for the next tick would be in the script after it
    (0..3).for_each(|_| click(&mut harness, "Step"));
    harness.run_steps(3);
    assert_eq!(*harness.state().script(), before, "nor with the ticks to come");
}

#[test]
fn going_back_in_the_middle_of_a_tow_drops_nothing_of_the_run() {
    let mut harness = parked(false);
    let lot = Model::lot();
    let (body, to) = (on_screen(&harness, &lot, [5.2, 2.5]), on_screen(&harness, &lot, [10.5, 2.7]));
    grip(&mut harness, body, to);
    harness.run_steps(10);
    let towed = harness.state().script().clone();
    harness.key_press(Key::Home);
    harness.run_steps(10);
    pointer(&mut harness, to, Some(false));
    (0..3).for_each(|_| click(&mut harness, "Step"));
    let after = harness.state().script().clone();
    assert!(after.events.starts_with(&towed.events), "{after:?}");
}

#[test]
fn a_car_that_is_let_go_of_stands_whatever_ends_the_tow() {
    let ends: [(&str, fn(&mut Harness<'_, Lab>, Pos2)); 6] = [
        ("release", |harness, at| pointer(harness, at, Some(false))),
        ("Escape", |harness, _| harness.key_press(Key::Escape)),
        ("another widget", |harness, _| harness.key_press_modifiers(Modifiers::COMMAND, Key::Num2)),
        ("the list of keys", |harness, _| harness.key_press(Key::F1)),
        ("a second finger", |harness, at| {
            for id in [1, 2] {
                let (device_id, phase, force) = (egui::TouchDeviceId(1), egui::TouchPhase::Start, None);
                let pos = at + egui::vec2(40.0 * id as f32, 0.0);
                harness.event(Event::Touch { device_id, id: egui::TouchId(id), phase, pos, force });
            }
            harness.step();
        }),
        ("the focus goes", |harness, _| {
            harness.state_mut().app.world_mut().write_message(lost());
        }),
    ];
    for (name, end) in ends {
        let mut harness = parked(true);
        let app = &mut harness.state_mut().app;
        app.add_message::<bevy::window::WindowFocused>().add_systems(Update, crate::window::let_go_of_tow);
        let lot = Model::lot();
        let body = on_screen(&harness, &lot, [5.2, 2.5]);
        let to = on_screen(&harness, &lot, [10.5, 2.7]);
        grip(&mut harness, body, to);
        harness.run_steps(10);
        let is_driven = |harness: &Harness<'_, Lab>| harness.state().robot(2).channels[0] > 0;
        assert!(is_driven(&harness), "{name}: the test tows");
        end(&mut harness, to);
        harness.run_steps(6);
        // a run that waits while another widget is in front has it with its next tick
        let waits = harness.state().transport().playback == Playback::Paused;
        assert!(waits || !is_driven(&harness), "{name}");
        assert_eq!(harness.state().script().events.last().unwrap().input, RobotInput::Drive(0, 0), "{name}");
        // nor does what is left of the drag tow it again
        let events = harness.state().script().events.len();
        (0..5).for_each(|i| pointer(&mut harness, to + egui::vec2(2.0 * i as f32, 0.0), None));
        assert_eq!(harness.state().script().events.len(), events, "{name}");
    }
}

/// The window has lost the focus.
fn lost() -> bevy::window::WindowFocused {
    bevy::window::WindowFocused { window: Entity::PLACEHOLDER, focused: false }
}

#[test]
fn a_rover_is_towed_to_the_pointer_and_with_ctrl_it_is_put_there() {
    let mut harness = lab(WIDE);
    let world = Model::apartment();
    let before = harness.state().robot(0).coordinates;
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    let to = on_screen(&harness, &world, [before[0] + 0.6, before[1] - 0.4]);
    grip(&mut harness, body, to);
    harness.run_steps(300);
    let now = harness.state().robot(0);
    let [x, y] = fit(&harness, &world).screen_from_world(Point2::new(now.coordinates[0], now.coordinates[1]));
    assert!(pos2(x as f32, y as f32).distance(to) < 6.0, "{now:?}");
    assert!(now.manual && now.channels == [0, 0] && now.contacts == 0);
    pointer(&mut harness, to, Some(false));
    harness.run_steps(2);
    let is_put = |input: &RobotInput| matches!(input, RobotInput::Teleport(_));
    assert!(!inputs(&harness, 0).iter().any(is_put));
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    harness.event(Event::ModifiersChanged(Modifiers { ctrl: true, ..Modifiers::COMMAND }));
    grip(&mut harness, body, body + egui::vec2(20.0, 0.0));
    assert!(says(&harness, "put, not driven"));
    pointer(&mut harness, body + egui::vec2(20.0, 0.0), Some(false));
    harness.event(Event::ModifiersChanged(Modifiers::NONE));
    harness.run_steps(2);
    assert!(inputs(&harness, 0).last().is_some_and(is_put));
}

#[test]
fn a_magnified_view_stands_while_a_robot_is_towed() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    for _ in 0..3 {
        harness.key_press(Key::Plus);
        harness.run_steps(2);
    }
    // driven, it has the view come along
    harness.key_down(Key::ArrowUp);
    harness.run_steps(10);
    harness.key_up(Key::ArrowUp);
    harness.run_steps(6);
    let camera = |harness: &Harness<'_, Lab>| interface(harness).cameras["Apartment"];
    let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    let at_the_edge = pos2(body.x, paper(&harness, "Apartment").bottom() - 30.0);
    grip(&mut harness, body, at_the_edge);
    let stands = camera(&harness);
    harness.run_steps(160);
    assert_eq!(camera(&harness), stands);
    let now = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
    assert!(now.y > body.y + 60.0, "the test tows: {body} {now}");
}
