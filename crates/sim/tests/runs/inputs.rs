//! Live input, alone and beside a script: the events recorded, and the cars' places after them.

use std::time::Duration;

use bevy::app::App;
use bevy::prelude::MinimalPlugins;
use bevy::time::TimeUpdateStrategy;
use motion_lab_core::num::tan;
use motion_lab_core::prelude::*;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, RobotInput};
use motion_lab_sim::simulation::{
    LatestFrame, PendingInput, RobotCommand, RunCommand, SimulationPlugin, Transport, TransportCommand, start_run, view,
};
use motion_lab_sim::tour::TourConfig;

use crate::runs::controls::open;
use crate::simulator::{event, script};

/// The distance a car covers in a tick at full speed, metres: 1.5 m/s for 0.05 s.
const FULL: f64 = 0.075;

/// Two cars at rest at the origin of a world each, paused before tick 1, with this script beyond.
fn cars(more: &[(u64, &str, i16)]) -> App {
    let mut events = vec![event(1, "a", RobotInput::Drive(0, 0)), event(1, "b", RobotInput::Drive(0, 0))];
    events.extend(more.iter().map(|(tick, robot, speed)| event(*tick, robot, RobotInput::Drive(*speed, 0))));
    let world = |robot: &str| open(&format!("{robot}'s"), &[(robot, "hitch", &[0.0; 3])]);
    let config = TourConfig { worlds: vec![world("a"), world("b")], ticks: 100, sensor: None };
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, SimulationPlugin));
    start_run(app.world_mut(), config, (Seed(1), script(events))).unwrap();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::ZERO));
    app
}

/// Presses before the next tick; several presses within a tick keep their order.
fn press(app: &mut App, robot: &str, speed: i16, steering: i16) {
    let input = RobotInput::Drive(speed, steering);
    app.world_mut().write_message(RunCommand::from(RobotCommand { robot: robot.into(), input }));
}

/// Runs this number of ticks.
fn step(app: &mut App, ticks: u64) {
    for _ in 0..ticks {
        app.world_mut().write_message(RunCommand::from(TransportCommand::Step));
        app.update();
    }
}

/// The events of the script after tick 1: tick, robot, channels.
fn captured(app: &App) -> Vec<(u64, &str, [i16; 2])> {
    let channels = |e: &Event| match e.input {
        RobotInput::Drive(a, b) => [a, b],
        _ => panic!("{e:?}"),
    };
    let events = app.world().resource::<PendingInput>().script().events.iter();
    events.filter(|e| e.tick > 1).map(|e| (e.tick, e.robot.as_str(), channels(e))).collect()
}

/// Checks how far ahead the cars are, in ticks at full speed.
#[track_caller]
fn assert_gone(app: &App, expected: [f64; 2]) {
    let frame = app.world().resource::<LatestFrame>().frame();
    for (robot, ticks) in frame.robots.iter().zip(expected) {
        let x = robot.configuration[0];
        assert!((x - ticks * FULL).abs() < 1e-12, "robot {}: {} ticks, not {ticks}", robot.id, x / FULL);
    }
}

#[test]
fn a_tap_counts_for_one_tick_on_either_channel() {
    let mut app = cars(&[]);
    step(&mut app, 3);
    for speed in [128, 0] {
        press(&mut app, "a", speed, 0);
    }
    for speed in [-64, 0] {
        press(&mut app, "b", speed, 0);
    }
    step(&mut app, 5);
    assert_gone(&app, [1.0, -0.5]);
    let taps = [(4, "a", [128, 0]), (4, "b", [-64, 0]), (5, "a", [0, 0]), (5, "b", [0, 0])];
    assert_eq!(captured(&app), taps);

    // steered for one tick as it goes on, it turns by that tick's arc
    press(&mut app, "a", 64, 0);
    step(&mut app, 2);
    for steering in [128, 0] {
        press(&mut app, "a", 64, steering);
    }
    step(&mut app, 5);
    let steered = [(9, "a", [64, 0]), (11, "a", [64, 128]), (12, "a", [64, 0])];
    assert_eq!(captured(&app)[4..], steered);
    let turned = 0.5 * FULL * tan(HITCH.max_steer) / HITCH.wheelbase;
    let cars = view(app.world());
    let headings = [0, 1].map(|id: usize| cars[id].coordinates[2]);
    assert!((headings[0] - turned).abs() < 1e-12 && headings[1] == 0.0, "{headings:?}, not {turned}");
    assert_eq!(cars[0].channels, [64, 0]);
}

#[test]
fn a_release_put_off_survives_an_input_of_another_robot() {
    let mut app = cars(&[]);
    step(&mut app, 3);
    press(&mut app, "a", 128, 0);
    press(&mut app, "a", 0, 0);
    press(&mut app, "b", -128, 0);
    step(&mut app, 6);
    assert_gone(&app, [1.0, -6.0]);
    assert_eq!(captured(&app), [(4, "a", [128, 0]), (4, "b", [-128, 0]), (5, "a", [0, 0])]);
}

#[test]
fn an_input_of_one_robot_is_none_of_another() {
    let mut app = cars(&[]);
    step(&mut app, 2);
    for robot in ["a", "b"] {
        press(&mut app, robot, 128, 0);
    }
    step(&mut app, 4);
    // channels held on are no change, and another car's release is no event of this one
    for robot in ["a", "b"] {
        press(&mut app, robot, 128, 0);
    }
    press(&mut app, "b", 0, 0);
    step(&mut app, 4);
    assert_gone(&app, [8.0, 4.0]);
    assert_eq!(captured(&app), [(3, "a", [128, 0]), (3, "b", [128, 0]), (7, "b", [0, 0])]);
}

#[test]
fn of_two_devices_the_one_that_changed_last_wins_the_tick() {
    let mut app = cars(&[]);
    step(&mut app, 1);
    for (a, b) in [(64, -128), (-64, 128), (128, 64)] {
        press(&mut app, "a", a, 0);
        press(&mut app, "b", b, 0);
    }
    step(&mut app, 3);
    assert_gone(&app, [3.0, 1.5]);
    assert_eq!(captured(&app), [(2, "a", [128, 0]), (2, "b", [64, 0])]);
}

#[test]
fn who_drives_beside_a_script_ends_it_for_all() {
    let script = [(10, "a", 128), (10, "b", 64), (30, "b", -128), (40, "a", 0)];
    // without live input the script is played
    let mut app = cars(&script);
    step(&mut app, 50);
    assert_gone(&app, [30.0, 0.5 * 20.0 - 21.0]);

    let mut app = cars(&script);
    step(&mut app, 19);
    press(&mut app, "a", -64, 0);
    step(&mut app, 31);
    assert_gone(&app, [10.0 - 0.5 * 31.0, 0.5 * 41.0]);
    assert_eq!(captured(&app), [(10, "a", [128, 0]), (10, "b", [64, 0]), (20, "a", [-64, 0])]);
}

#[test]
fn at_the_tick_of_a_script_s_own_input_what_is_pressed_comes_after_it() {
    let mut app = cars(&[(20, "a", 128), (20, "b", 128)]);
    step(&mut app, 19);
    press(&mut app, "a", -128, 0);
    step(&mut app, 10);
    assert_gone(&app, [-10.0, 10.0]);
    assert_eq!(captured(&app), [(20, "a", [-128, 0]), (20, "b", [128, 0])]);
}

#[test]
fn back_in_a_scripted_run_a_press_takes_the_place_of_all_that_came_after() {
    let mut app = cars(&[(10, "a", 128), (20, "b", 128), (30, "a", 0)]);
    step(&mut app, 40);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Seek(19)));
    app.update();
    press(&mut app, "a", 64, 0);
    step(&mut app, 21);
    assert_gone(&app, [10.0 + 0.5 * 21.0, 0.0]);
    assert_eq!(captured(&app), [(10, "a", [128, 0]), (20, "a", [64, 0])]);
}

#[test]
fn what_no_script_can_hold_forgets_nothing() {
    let mut app = cars(&[(30, "a", 128)]);
    step(&mut app, 40);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Seek(19)));
    app.update();
    // nobody of that name, and channels go to 128
    press(&mut app, "nobody", 128, 0);
    press(&mut app, "a", 300, 0);
    app.update();
    assert_eq!(app.world().resource::<Transport>().frontier(), 40);
    assert_eq!(captured(&app), [(30, "a", [128, 0])]);
    step(&mut app, 21);
    assert_gone(&app, [11.0, 0.0]);
}

#[test]
fn what_the_script_has_for_the_next_tick_is_forgotten_as_all_after_it() {
    let mut app = cars(&[(21, "a", -128), (21, "b", -128), (25, "a", -64)]);
    step(&mut app, 19);
    press(&mut app, "a", 128, 0);
    step(&mut app, 3);
    // ticks 20 to 22 ahead
    assert_gone(&app, [3.0, 0.0]);
    assert_eq!(captured(&app), [(20, "a", [128, 0])]);
}

#[test]
fn input_at_the_frontier_of_a_looping_run_is_lived_through() {
    let mut app = cars(&[]);
    step(&mut app, 5);
    app.world_mut().write_message(RunCommand::from(TransportCommand::SetLooping(true)));
    app.update();
    press(&mut app, "a", 128, 0);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Play));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
    for _ in 0..4 {
        app.update();
    }
    let transport = app.world().resource::<Transport>();
    let (tick, frontier, looping) = (transport.tick(), transport.frontier(), transport.looping);
    assert!(!looping && tick == frontier && tick > 6, "it does not begin again: {tick} of {frontier}");
    assert_gone(&app, [tick as f64 - 5.0, 0.0]);
}

/// Cars this near keep a margin a little below their own distance, so that they can drive apart or side by side.
#[test]
fn cars_that_start_fifteen_micrometres_apart_drive_side_by_side() {
    let apart = HITCH.body.width + 1.5e-5;
    let world = open("side by side", &[("a", "hitch", &[0.0; 3]), ("b", "hitch", &[0.0, apart, 0.0])]);
    let config = TourConfig { worlds: vec![world], ticks: 20, sensor: None };
    let ahead = |robot: &str| event(1, robot, RobotInput::Drive(128, 0));
    let log = Run::record(config, (Seed(1), script(vec![ahead("a"), ahead("b")]))).unwrap();
    for frame in log.frames() {
        for (robot, y) in frame.robots.iter().zip([0.0, apart]) {
            let [x, across, theta] = robot.configuration[..] else { panic!("{robot:?}") };
            let expected = frame.tick as f64 * FULL;
            assert!((x - expected).abs() < 1e-12 && (across, theta) == (y, 0.0), "tick {}: {robot:?}", frame.tick);
            assert!(!robot.in_contact && robot.contacts == 0, "tick {}: {robot:?}", frame.tick);
        }
    }
}

#[test]
fn commands_are_carried_out_in_the_order_they_were_written() {
    let mut app = cars(&[]);
    step(&mut app, 3);
    // within one update: pressed, a tick, pressed again, two ticks
    press(&mut app, "a", 128, 0);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Step));
    press(&mut app, "a", -64, 0);
    for _ in 0..2 {
        app.world_mut().write_message(RunCommand::from(TransportCommand::Step));
    }
    app.update();
    assert_eq!(captured(&app), [(4, "a", [128, 0]), (5, "a", [-64, 0])]);
    assert_eq!(app.world().resource::<Transport>().tick(), 6);
    assert_gone(&app, [1.0 - 2.0 * 0.5, 0.0]);
}
