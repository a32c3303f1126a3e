//! Contacts as events for observers.

use std::time::Duration;

use bevy::app::App;
use bevy::ecs::schedule::Schedules;
use bevy::prelude::{Commands, EntityEvent, On, Query, Res, ResMut, Resource, World};
use bevy::time::TimeUpdateStrategy;
use motion_lab_core::prelude::{RUSTY, Seed};
use motion_lab_core::robots::Hitch;
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{Log, RobotInput, Script};
use motion_lab_sim::simulation::{
    ContactBegan, ContactEnded, Cut, LatestFrame, Playback, RobotId, Roster, RunCommand, SimulationSchedule, Transport,
    TransportCommand, headless_app, start_run, step,
};
use motion_lab_sim::tour::TourConfig;

use super::crowd::arena;
use super::{event, script};

/// What was heard: the tick, the robot's id, and whether a contact began.
type Heard = Vec<(u64, u32, bool)>;

#[derive(Resource, Default)]
struct Diary(Heard);

/// Notes an event, which comes outside of the schedule, when the tick's frame has been taken.
fn note(diary: &mut Diary, heard: (u64, u32, bool), frame: &LatestFrame, schedules: &Schedules) {
    assert_eq!(frame.frame().tick, heard.0, "the frame is the tick's");
    assert_eq!(frame.frame().robots[heard.1 as usize].in_contact, heard.2);
    assert!(schedules.contains(SimulationSchedule), "a schedule that runs is not among the schedules");
    diary.0.push(heard);
}

fn observed(app: &mut App) {
    app.init_resource::<Diary>();
    app.add_observer(
        |on: On<ContactBegan>,
         ids: Query<&RobotId>,
         f: Res<LatestFrame>,
         s: Res<Schedules>,
         mut diary: ResMut<Diary>| {
            note(&mut diary, (on.tick, ids.get(on.event_target()).unwrap().0, true), &f, &s);
        },
    );
    app.add_observer(
        |on: On<ContactEnded>,
         ids: Query<&RobotId>,
         f: Res<LatestFrame>,
         s: Res<Schedules>,
         mut diary: ResMut<Diary>| {
            note(&mut diary, (on.tick, ids.get(on.event_target()).unwrap().0, false), &f, &s);
        },
    );
}

/// Two rovers drive at each other from a metre apart, part at tick 60, and meet again after tick 90.
fn config() -> (TourConfig, (Seed, Script)) {
    let robots: [(&str, &str, &[f64]); 2] =
        [("west", "rusty", &[-0.5, 0.0, 0.0]), ("east", "rusty", &[0.5, 0.0, std::f64::consts::PI])];
    let drive = |tick, v| ["west", "east"].map(|r| event(tick, r, RobotInput::Drive(v, 0)));
    let events = [(1, 128), (60, -128), (90, 128)].into_iter().flat_map(|(tick, v)| drive(tick, v)).collect();
    (TourConfig { worlds: vec![arena(2.0, &robots)], ticks: 140, sensor: None }, (Seed(1), script(events)))
}

/// The events by the recorded frames.
fn by_frames(log: &Log) -> Heard {
    let before = std::iter::once(log.initial().unwrap()).chain(log.frames());
    let mut all = Vec::new();
    for (before, after) in before.zip(log.frames()) {
        for (id, (b, a)) in (0..).zip(before.robots.iter().zip(&after.robots)) {
            if a.in_contact != b.in_contact {
                all.push((after.tick, id, a.in_contact));
            }
        }
    }
    all
}

fn app() -> App {
    let mut app = headless_app();
    observed(&mut app);
    let (config, input) = config();
    start_run(app.world_mut(), config, input).unwrap();
    app
}

fn heard(world: &World) -> &Heard {
    &world.resource::<Diary>().0
}

fn send(app: &mut App, command: TransportCommand) {
    app.world_mut().write_message(RunCommand::from(command));
    app.update();
}

#[test]
fn every_contact_begins_and_ends_once_whoever_runs_the_ticks() {
    let (config, input) = config();
    let log = Run::record(config.clone(), input.clone()).unwrap();
    let expected = by_frames(&log);
    // a metre apart, less two radii, at twice a rover's speed: 13 ticks, and slip may add one
    let closing = ((1.0 - 2.0 * RUSTY.body_radius) / (2.0 * RUSTY.max_speed * 0.05)).ceil() as u64;
    assert!(expected[0].0.abs_diff(closing) <= 1 && expected[0].2, "{expected:?}");
    let ends: Vec<_> = expected.iter().filter(|(.., began)| !began).collect();
    assert_eq!(ends, [&(60, 0, false), &(60, 1, false)], "both are free as soon as they drive back");
    assert_eq!(expected.iter().filter(|(.., began)| *began).count(), 4);

    // in the fixed loop, also with several ticks an update; by the step command; by a recorder
    for milliseconds in [50, 220] {
        let mut app = app();
        app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(milliseconds)));
        app.world_mut().resource_mut::<Transport>().playback = Playback::Playing;
        while app.world().resource::<Transport>().tick() < 140 {
            app.update();
        }
        assert_eq!(*heard(app.world()), expected, "{milliseconds} ms");
    }
    let mut app = app();
    (0..140).for_each(|_| send(&mut app, TransportCommand::Step));
    assert_eq!(*heard(app.world()), expected, "steps");
    let mut run = Recorder::with_robots(config, input, observed).unwrap();
    (0..140).for_each(|_| _ = run.step());
    assert_eq!(*heard(run.world()), expected, "a recorder");
}

#[test]
fn moving_the_run_is_no_contact() {
    let (config, input) = config();
    let expected = by_frames(&Run::record(config, input).unwrap());
    let began = expected[0].0;
    let mut app = app();
    for to in [began + 3, began - 1, began, 70, 3, 140] {
        send(&mut app, TransportCommand::Seek(to));
        send(&mut app, TransportCommand::StepBack);
    }
    assert!(heard(app.world()).is_empty(), "a seek simulates ticks too: {:?}", heard(app.world()));
    // from a tick in contact the end alone is heard
    send(&mut app, TransportCommand::Seek(59));
    send(&mut app, TransportCommand::Step);
    assert_eq!(*heard(app.world()), [(60, 0, false), (60, 1, false)]);
    send(&mut app, TransportCommand::Undo);
    send(&mut app, TransportCommand::Reset);
    assert_eq!(heard(app.world()).len(), 2);
}

#[test]
fn an_observer_of_one_robot_hears_that_robot() {
    let mut app = app();
    let east = app.world().resource::<Roster>().robots()[1];
    #[derive(Resource, Default)]
    struct East(Vec<u64>);
    app.init_resource::<East>();
    app.world_mut().entity_mut(east).observe(|on: On<ContactBegan>, mut east: ResMut<East>| east.0.push(on.tick));
    (0..140).for_each(|_| step(app.world_mut()));
    let of_east: Vec<u64> = heard(app.world()).iter().filter(|(_, id, b)| *id == 1 && *b).map(|h| h.0).collect();
    assert!(of_east.len() == 2 && app.world().resource::<East>().0 == of_east);
}

#[test]
fn an_observer_may_begin_another_run() {
    let mut app = headless_app();
    app.init_resource::<Diary>();
    // both robots are free from the same tick on
    app.add_observer(|on: On<ContactEnded>, mut diary: ResMut<Diary>, mut commands: Commands| {
        diary.0.push((on.tick, 0, false));
        commands.queue(|world: &mut World| {
            let (config, input) = config();
            start_run(world, config, input).unwrap();
        });
    });
    let (config, input) = config();
    start_run(app.world_mut(), config, input).unwrap();
    while app.world().resource::<Diary>().0.is_empty() {
        step(app.world_mut());
    }
    assert_eq!(app.world().resource::<Diary>().0, [(60, 0, false)], "the other robot of that tick is gone");
    assert_eq!(app.world().resource::<Transport>().tick(), 0);
}

/// A car's front is 3.2 m ahead of its rear axle and it goes 0.075 m in a tick: 0.2 m before a wall the third tick is
/// cut after two thirds of its way, and no way is left in those after it.
#[test]
fn a_cut_says_how_much_of_a_tick_s_motion_was_free() {
    let world = arena(9.0, &[("car", "hitch", &[9.0 - 0.2 - 3.2, 0.0, 0.0])]);
    let mut app = headless_app();
    let drive = script(vec![event(1, "car", RobotInput::Drive(128, 0))]);
    start_run(app.world_mut(), TourConfig { worlds: vec![world], ticks: 20, sensor: None }, (Seed(1), drive)).unwrap();
    for (expected, is_contact) in [(1.0, false), (1.0, false), (2.0 / 3.0, true), (0.0, true), (0.0, true)] {
        step(app.world_mut());
        let mut cuts = app.world_mut().query::<&Cut<Hitch>>();
        let cut = cuts.single(app.world()).unwrap();
        assert_eq!(cut.contact(), is_contact, "{}", cut.until());
        assert!((cut.until() - expected).abs() < 1e-3, "{}, not {expected}", cut.until());
    }
}
