//! The simulation inside a Bevy app: the fixed loop, and the transport's commands.

use std::time::Duration;

use bevy::app::App;
use bevy::prelude::MinimalPlugins;
use bevy::time::TimeUpdateStrategy;
use motion_lab_core::prelude::*;
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::RobotInput;
use motion_lab_sim::simulation::{
    LatestFrame, PendingInput, Playback, RobotCommand, RunCommand, SimulationPlugin, Transport, TransportCommand,
    start_run, view,
};

use super::{assert_same, tour, wild_script};

fn app(ticks: u64, input: impl Into<motion_lab_sim::recording::RunInput>) -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, SimulationPlugin));
    start_run(app.world_mut(), tour(ticks), input).unwrap();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
    app
}

fn send(app: &mut App, command: TransportCommand) {
    app.world_mut().write_message(RunCommand::from(command));
    app.update();
}

#[test]
fn frame_rates_and_stalls_change_no_bit() {
    let input = (Seed(5), wild_script(5, 120));
    let log = Run::record(tour(120), input.clone()).unwrap();
    // updates at 60 Hz, at 7 Hz, and uneven ones with stalls too long for the loop to catch up on
    let rates: [&[u64]; 3] = [&[16, 17, 17], &[143], &[1, 300, 2, 50, 5000, 9]];
    for frames_ms in rates {
        let mut app = app(120, input.clone());
        app.world_mut().resource_mut::<Transport>().playback = Playback::Playing;
        let mut seen = 0;
        for ms in frames_ms.iter().cycle() {
            app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(*ms)));
            app.update();
            let frame = app.world().resource::<LatestFrame>().frame();
            if frame.tick > 0 && frame.tick <= 120 {
                assert_same(frame, &log.frames()[frame.tick as usize - 1]);
                seen += 1;
            }
            if frame.tick >= 120 {
                break;
            }
        }
        assert!(seen >= 20, "only {seen} updates were compared");
    }
}

#[test]
fn the_transport_obeys() {
    let log = Run::record(tour(40), Seed(9)).unwrap();
    let mut app = app(40, Seed(9));
    let tick = |app: &App| app.world().resource::<Transport>().tick();
    send(&mut app, TransportCommand::Step);
    send(&mut app, TransportCommand::Step);
    assert_eq!(tick(&app), 2);
    send(&mut app, TransportCommand::StepBack);
    assert_eq!(tick(&app), 1);
    send(&mut app, TransportCommand::Seek(33));
    assert_same(app.world().resource::<LatestFrame>().frame(), &log.frames()[32]);
    send(&mut app, TransportCommand::Seek(7));
    assert_same(app.world().resource::<LatestFrame>().frame(), &log.frames()[6]);
    assert_eq!(app.world().resource::<Transport>().frontier(), 33);
    send(&mut app, TransportCommand::Play);
    let before = tick(&app);
    app.update();
    assert_eq!(tick(&app), before + 1);
    send(&mut app, TransportCommand::Pause);
    let before = tick(&app);
    app.update();
    assert_eq!(tick(&app), before);
    send(&mut app, TransportCommand::SetSpeed(f64::NAN));
    assert_eq!(app.world().resource::<Transport>().speed, 1.0);
    send(&mut app, TransportCommand::SetSpeed(2.0));
    send(&mut app, TransportCommand::ReRoll);
    let rolled = app.world().resource::<Transport>();
    assert!(rolled.seed() != Seed(9) && rolled.tick() == 0 && rolled.speed == 2.0);
    send(&mut app, TransportCommand::Seek(30));
    assert_ne!(*app.world().resource::<LatestFrame>().frame(), log.frames()[29]);
    send(&mut app, TransportCommand::SetSeed(Seed(9)));
    send(&mut app, TransportCommand::Seek(30));
    assert_same(app.world().resource::<LatestFrame>().frame(), &log.frames()[29]);
    send(&mut app, TransportCommand::Reset);
    assert_same(app.world().resource::<LatestFrame>().frame(), log.initial().unwrap());
}

#[test]
fn live_driving_is_recorded_and_replays() {
    let mut app = app(1, Seed(4));
    let drive = |app: &mut App, robot: &str, input| {
        app.world_mut().write_message(RunCommand::from(RobotCommand { robot: robot.into(), input }));
    };
    let step = |app: &mut App, n: u64| (0..n).for_each(|_| send(app, TransportCommand::Step));
    step(&mut app, 10);
    drive(&mut app, "Rusty", RobotInput::Drive(128, 30));
    drive(&mut app, "Nobody", RobotInput::Drive(1, 1));
    drive(&mut app, "Hitch", RobotInput::Drive(300, 0));
    step(&mut app, 5);
    assert!(view(app.world())[0].manual && !view(app.world())[2].manual);
    drive(&mut app, "Rusty", RobotInput::Drive(0, 0));
    drive(&mut app, "Hitch", RobotInput::SetTrailer(true));
    step(&mut app, 5);
    let script = app.world().resource::<PendingInput>().script().clone();
    assert_eq!(script.events.iter().map(|e| e.tick).collect::<Vec<_>>(), [11, 16, 16]);
    let replayed = Run::record(tour(20), (Seed(4), script)).unwrap();
    assert_same(app.world().resource::<LatestFrame>().frame(), &replayed.frames()[19]);

    // back to tick 12: playing on repeats the rest, driving forgets it
    send(&mut app, TransportCommand::Seek(12));
    step(&mut app, 8);
    assert_same(app.world().resource::<LatestFrame>().frame(), &replayed.frames()[19]);
    send(&mut app, TransportCommand::Seek(12));
    drive(&mut app, "Rusty", RobotInput::Release);
    step(&mut app, 8);
    let script = app.world().resource::<PendingInput>().script().clone();
    assert_eq!(script.events.iter().map(|e| e.tick).collect::<Vec<_>>(), [11, 13]);
    let other = Run::record(tour(20), (Seed(4), script)).unwrap();
    assert_same(app.world().resource::<LatestFrame>().frame(), &other.frames()[19]);
    assert_ne!(other.frames()[19], replayed.frames()[19]);
}

#[test]
fn a_run_that_cannot_start_leaves_the_one_under_way() {
    let mut app = app(5, Seed(4));
    send(&mut app, TransportCommand::Step);
    let before = app.world().resource::<LatestFrame>().frame().clone();
    let mut bad = tour(5);
    bad.worlds[2].robots[0].kind = "hovercraft".into();
    let error = start_run(app.world_mut(), bad, Seed(1)).unwrap_err().to_string();
    assert!(error.contains("Hitch") && error.contains("hovercraft"), "{error}");
    let mut bad = tour(5);
    bad.worlds[1].robots[0].start.push(0.0);
    assert!(start_run(app.world_mut(), bad, Seed(1)).unwrap_err().to_string().contains("Reach"));
    assert_eq!(*app.world().resource::<LatestFrame>().frame(), before);
    assert_eq!(view(app.world()).len(), 3);
    send(&mut app, TransportCommand::Step);
    assert_eq!(app.world().resource::<Transport>().tick(), 2);
}

/// The types of the systems of a tick, in their order.
fn systems(world: &bevy::prelude::World) -> Vec<std::any::TypeId> {
    use bevy::ecs::system::System;
    let schedules = world.resource::<bevy::prelude::Schedules>();
    let schedule = schedules.get(motion_lab_sim::simulation::SimulationSchedule).unwrap();
    schedule.systems().unwrap().map(|(_, system)| System::system_type(&**system)).collect()
}

#[test]
fn a_recorder_runs_the_systems_of_a_headless_app_in_the_same_order() {
    let mut app = motion_lab_sim::simulation::headless_app();
    start_run(app.world_mut(), tour(5), Seed(4)).unwrap();
    let mut recorder = Recorder::new(tour(5), Seed(4)).unwrap();
    for _ in 0..5 {
        motion_lab_sim::simulation::step(app.world_mut());
        assert_same(app.world().resource::<LatestFrame>().frame(), recorder.step());
    }
    let (of_app, of_recorder) = (systems(app.world()), systems(recorder.world()));
    // four systems of each of three types of robots, and those of the tick itself
    assert!(of_app.len() >= 3 * 4 + 6, "{}", of_app.len());
    assert_eq!(of_app, of_recorder);
}
