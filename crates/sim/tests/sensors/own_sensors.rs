//! Robots' own range sensors: of any kind of robot, several on one, from a world's file or from code. What they read is
//! worked out by hand in a square room of ten metres, and their order, streams and logs are those that are documented.

use std::f64::consts::{FRAC_PI_2, SQRT_2};

use bevy::app::App;
use bevy::prelude::Messages;
use motion_lab_core::prelude::*;
use motion_lab_core::random::Stream;
use motion_lab_core::sensors::{BeamModel, FanSensor, RangeSensor, SensorError};
use motion_lab_core::worlds::{ResidentSensor, World};
use motion_lab_sim::recording::{Recorder, Run, verify};
use motion_lab_sim::run::{Frame, Log};
use motion_lab_sim::simulation::{
    CommandError, CommandRefused, LatestFrame, MountedOn, Roster, Scan, SensorModel, SensorMount, SensorName,
    SensorNoise, SensorRefusal, SensorRoster, SimulationPlugin, SpawnError, Transport, seek, sensors, settle,
    start_run, step,
};
use motion_lab_sim::tour::{BOOK_SEED, ConfigError, TourConfig};

/// A square room from -5 to 5 with these robots.
pub fn room(robots: &str) -> World {
    let text = format!(
        "World(version: 1, name: \"room\", bounds: (min: (-5, -5), max: (5, 5)),
        walls: [(name: \"wall\", points: [(-5, -5), (5, -5), (5, 5), (-5, 5)], closed: true)], robots: [{robots}])"
    );
    World::parse("room.ron", &text).unwrap()
}

pub fn config(robots: &str, ticks: u64) -> TourConfig {
    TourConfig { worlds: vec![room(robots)], ticks, sensor: None }
}

pub const AHEAD: &str = "(name: \"ahead\", rays: 1, range: 9, mount: (x: 0.5, y: 0, theta: 0))";
pub const LEFT: &str = "(name: \"left\", rays: 3, range: 9, field_of_view: 1.5707963267948966, \
                    mount: (x: 0, y: 0.5, theta: 1.5707963267948966), noise: (sigma_hit: 0.02))";

/// A car with these sensors.
pub fn car(sensors: &str) -> String {
    format!("(name: \"car\", kind: \"hitch\", start: [1, 0.5, 0], sensors: [{sensors}])")
}

fn near(read: &[f64], expected: &[f64]) {
    let same = |(r, e): (&f64, &f64)| (r - e).abs() < 1e-12;
    assert!(read.len() == expected.len() && read.iter().zip(expected).all(same), "{read:?}, not {expected:?}");
}

#[test]
fn a_car_sees_from_where_its_sensors_are_mounted_in_the_order_of_their_names() {
    let exact = LEFT.replace(", noise: (sigma_hit: 0.02)", "");
    for sensors in [format!("{AHEAD}, {exact}"), format!("{exact}, {AHEAD}")] {
        let run = Recorder::new(config(&car(&sensors), 1), BOOK_SEED).unwrap();
        let [ahead, left] = &run.frame().scans[..] else { panic!("{:?}", run.frame().scans) };
        assert_eq!([ahead.robot, left.robot], [0, 0]);
        near(&ahead.ranges, &[3.5]); // from x = 1.5 to 5
        near(&left.ranges, &[4.0 * SQRT_2, 4.0, 4.0 * SQRT_2]); // from (1, 1): the corner, the wall, the wall
        let views = run.sensors();
        assert_eq!(views.iter().map(|v| v.name.as_str()).collect::<Vec<_>>(), ["ahead", "left"]);
        near(&[views[1].pose.x, views[1].pose.y, views[1].pose.theta], &[1.0, 1.0, FRAC_PI_2]);
        assert!(views.iter().zip(&run.frame().scans).all(|(view, scan)| view.ranges == scan.ranges));
    }
}

/// The arm's links are a metre long and begin at the origin.
#[test]
fn an_arm_sees_from_its_tip_along_its_last_link_and_not_itself() {
    let arm = "(name: \"arm\", kind: \"reach\", start: [0, 1.5707963267948966], sensors: [
        (name: \"tip\", rays: 4, range: 9),
        (name: \"turned\", rays: 1, range: 9, mount: (x: 0.25, y: 0.5, theta: -1.5707963267948966))])";
    let mut run = Recorder::new(config(arm, 3), BOOK_SEED).unwrap();
    // the tip is at (1, 1) and looks up; the other one sits ahead of it and to its left, at (0.5, 1.25), and looks
    // right
    near(&run.frame().scans[0].ranges, &[4.0, 6.0, 6.0, 4.0]);
    near(&run.frame().scans[1].ranges, &[4.5]);
    // it goes with the arm
    let frame = run.step().clone();
    let [th1, th2] = frame.robots[0].configuration[..] else { panic!("two angles") };
    assert!((th1, th2) != (0.0, FRAC_PI_2), "it moves");
    let tip = |th: f64| motion_lab_core::num::sin_cos(th);
    let ((s1, c1), (s2, c2)) = (tip(th1), tip(th1 + th2));
    let up = (5.0 - (s1 + s2)) / s2; // along the link, as far as the upper wall
    assert!(c1 + c2 + up * c2 < 5.0);
    near(&frame.scans[0].ranges[..1], &[up]);
}

/// The frames of a run, from tick 0 on.
pub fn frames(log: &Log) -> Vec<Frame> {
    std::iter::once(log.initial().unwrap()).chain(log.frames()).cloned().collect()
}

pub fn app(config: TourConfig) -> App {
    let mut app = App::new();
    app.add_plugins(SimulationPlugin);
    start_run(app.world_mut(), config, BOOK_SEED).unwrap();
    app
}

pub fn latest(app: &App) -> Frame {
    app.world().resource::<LatestFrame>().frame().clone()
}

/// Steps to a tick, and returns the frames from the next one on.
pub fn run_to(app: &mut App, tick: u64) -> Vec<Frame> {
    let mut frames = Vec::new();
    while app.world().resource::<Transport>().tick() < tick {
        step(app.world_mut());
        frames.push(latest(app));
    }
    frames
}

#[test]
fn sensors_from_code_are_those_of_a_file_whatever_the_order_of_spawning() {
    let rover = "(name: \"rover\", kind: \"rusty\", start: [-2, 0, 1]), ";
    let with = |sensors: &str| TourConfig {
        sensor: Some(RangeSensor { n_rays: 5, max_range: 3.0 }),
        ..config(&format!("{rover}{}", car(sensors)), 30)
    };
    let expected = frames(&Run::record(with(&format!("{AHEAD}, {LEFT}")), BOOK_SEED).unwrap());
    let without = frames(&Run::record(with(""), BOOK_SEED).unwrap());
    assert_eq!((expected[0].scans.len(), without[0].scans.len()), (3, 1));
    for order in [[0, 1], [1, 0]] {
        let mut app = app(with(""));
        assert_eq!(latest(&app), without[0]);
        let car = app.world().resource::<Roster>().robots()[1];
        for which in order {
            let world = app.world_mut();
            let name = SensorName(["ahead", "left"][which].into());
            if which == 0 {
                let rays = SensorModel::from(RangeSensor { n_rays: 1, max_range: 9.0 });
                world.spawn((rays, name, SensorMount(Pose2::new(0.5, 0.0, 0.0)), MountedOn(car)));
            } else {
                let rays = FanSensor { sensor: RangeSensor { n_rays: 3, max_range: 9.0 }, field_of_view: FRAC_PI_2 };
                let noise = SensorNoise(BeamModel { sigma_hit: 0.02, ..BeamModel::EXACT });
                let mount = SensorMount(Pose2::new(0.0, 0.5, FRAC_PI_2));
                world.spawn((SensorModel(rays), name, mount, noise, MountedOn(car)));
            }
        }
        settle(app.world_mut());
        assert_eq!(latest(&app), expected[0], "frame 0 is taken anew");
        assert_eq!(run_to(&mut app, 30), expected[1..], "spawned in the order {order:?}");
        let entities: Vec<_> = app.world().resource::<SensorRoster>().entities().collect();
        let scans = entities.iter().map(|&e| app.world().get::<Scan>(e).unwrap().ranges().clone());
        assert!(scans.eq(expected[30].scans.iter().map(|scan| scan.ranges.clone())), "each has its own scan");
        // the frame has the same memory, and the next tick fills it again where nobody else holds it
        let frame = app.world().resource::<LatestFrame>().frame();
        let places: Vec<_> = frame.scans.iter().map(|scan| scan.ranges.as_ptr()).collect();
        assert!(
            entities.iter().map(|&e| app.world().get::<Scan>(e).unwrap().ranges().as_ptr()).eq(places.iter().copied())
        );
        step(app.world_mut());
        let frame = app.world().resource::<LatestFrame>().frame();
        assert!(frame.scans.iter().map(|scan| scan.ranges.as_ptr()).eq(places));
        seek(app.world_mut(), 7).unwrap();
        assert_eq!(latest(&app), expected[7]);
    }
}

/// Nobody asks for frame 0 here: the first tick takes the sensors.
#[test]
fn a_sensor_that_is_moved_or_removed_before_the_first_tick_is_so_in_the_run() {
    let two = config(&car(&format!("{AHEAD}, {LEFT}")), 2);
    let mut app = app(two);
    let [ahead, left] = app.world().resource::<SensorRoster>().entities().collect::<Vec<_>>()[..] else {
        panic!("two")
    };
    app.world_mut().despawn(left);
    app.world_mut().entity_mut(ahead).insert(SensorMount(Pose2::new(0.0, 0.0, -FRAC_PI_2)));
    step(app.world_mut());
    let frame = latest(&app);
    assert_eq!(frame.scans.len(), 1);
    let [x, y, theta] = frame.robots[0].configuration[..] else { panic!("a pose") };
    let (s, c) = motion_lab_core::num::sin_cos(theta - FRAC_PI_2);
    let down = (-5.0 - y) / s;
    assert!((x + down * c).abs() < 5.0);
    near(&frame.scans[0].ranges, &[down]);
}

#[test]
fn from_the_first_tick_on_sensors_are_fixed_and_a_change_is_refused() {
    let sensors = car(&format!("{AHEAD}, {LEFT}"));
    let expected = frames(&Run::record(config(&sensors, 12), BOOK_SEED).unwrap());
    let mut app = app(config(&sensors, 12));
    run_to(&mut app, 3);
    let [ahead, left] = app.world().resource::<SensorRoster>().entities().collect::<Vec<_>>()[..] else {
        panic!("two")
    };
    let car = app.world().resource::<Roster>().robots()[0];
    let rays = RangeSensor { n_rays: 2, max_range: 1.0 };
    app.world_mut().spawn((SensorModel::from(rays), SensorName("late".into()), MountedOn(car)));
    app.world_mut().entity_mut(ahead).insert(SensorModel::from(rays));
    app.world_mut().despawn(left);
    let mut refused = app.world_mut().resource_mut::<Messages<CommandRefused>>();
    let things: Vec<String> = refused
        .drain()
        .map(|CommandRefused(error)| match error {
            CommandError::Foreign(change) => format!("{} {}", change.thing, change.component),
            other => panic!("{other}"),
        })
        .collect();
    let of_car = |name: &str| format!("sensor {name:?} of robot \"car\" ");
    assert_eq!(things, ["sensor \"late\" SensorModel".to_owned(), of_car("ahead") + "SensorModel", of_car("left")]);
    assert_eq!(app.world().get::<SensorModel>(ahead).map(|model| model.0.sensor.n_rays == 2), Some(false));
    assert_eq!(run_to(&mut app, 8), expected[4..9]);
    // nor do they come in when the run is taken back
    seek(app.world_mut(), 0).unwrap();
    settle(app.world_mut());
    assert_eq!(latest(&app), expected[0]);
    assert_eq!(run_to(&mut app, 12), expected[1..13]);
    // another run has the sensors of its own world, and nothing is refused
    start_run(app.world_mut(), config(&sensors, 12), BOOK_SEED).unwrap();
    assert!(app.world().resource::<SensorRoster>().refused().is_empty());
    assert_eq!(run_to(&mut app, 12), expected[1..13]);
}

#[test]
fn sensors_that_cannot_be_are_refused_and_the_others_stay() {
    let mut app = app(config(&car(AHEAD), 1));
    let car = app.world().resource::<Roster>().robots()[0];
    let world = app.world_mut();
    let good = RangeSensor { n_rays: 2, max_range: 9.0 };
    let named = |name: &str| SensorName(name.to_owned());
    let wide = FanSensor { sensor: good, field_of_view: 7.0 };
    world.spawn((SensorModel(wide), named("wide"), MountedOn(car)));
    world.spawn((SensorModel::from(RangeSensor { n_rays: 0, ..good }), named("blind"), MountedOn(car)));
    world.spawn((
        SensorModel::from(good),
        named("off"),
        SensorMount(Pose2 { x: f64::NAN, ..Pose2::IDENTITY }),
        MountedOn(car),
    ));
    let noise = SensorNoise(BeamModel { z_miss: 2.0, ..BeamModel::EXACT });
    world.spawn((SensorModel::from(good), named("noisy"), noise, MountedOn(car)));
    world.spawn((SensorModel::from(good), named(" blank"), MountedOn(car)));
    let stone = world.spawn_empty().id();
    world.spawn((SensorModel::from(good), named("on a stone"), MountedOn(stone)));
    world.spawn((SensorModel::from(good), named("twice"), MountedOn(car)));
    world.spawn((SensorModel::from(good), named("twice"), MountedOn(car)));
    world.spawn((SensorModel::from(good), MountedOn(car))); // without a name, on a robot to which no run gives one
    settle(world);
    let names: Vec<String> = sensors(world).into_iter().map(|view| view.name).collect();
    assert_eq!(names, ["ahead"]);
    let refused = world.resource::<SensorRoster>().refused();
    let reasons: Vec<String> = refused.iter().map(ToString::to_string).collect();
    assert_eq!(refused.len(), 8, "{reasons:#?}");
    assert_eq!(refused[2].reason, SensorRefusal::Numbers(SensorError::Rays(0)));
    let begins = [
        "robot \"car\", sensor \"\": without a name it must be the run's own sensor",
        "robot \"car\", sensor \" blank\": its name must be",
        "robot \"car\", sensor \"blind\": 0 rays: ",
        "robot \"car\", sensor \"noisy\": noise: z_short",
        "robot \"car\", sensor \"off\": mount x: NaN, ",
        "robot \"car\", sensor \"twice\": another sensor of the robot has the same name",
        "robot \"car\", sensor \"wide\": field of view 7 rad: ",
        "sensor \"on a stone\": it is mounted on no robot of the run",
    ];
    for (reason, begin) in reasons.iter().zip(begins) {
        assert!(reason.starts_with(begin), "{reason}, not {begin}");
    }
}

/// Sensors that read nothing but random ranges: each reading is the range times one draw.
#[test]
fn the_first_sensor_draws_from_the_robots_stream_and_every_other_from_one_of_its_own() {
    let random = |name: &str| format!("(name: \"{name}\", rays: 2, range: 4, noise: (z_rand: 1))");
    let record = |sensors: &[&str]| {
        let sensors = sensors.iter().map(|name| random(name)).collect::<Vec<_>>().join(", ");
        frames(&Run::record(config(&car(&sensors), 5), BOOK_SEED).unwrap())
    };
    let (both, first) = (record(&["b", "a"]), record(&["a"]));
    let readings = |name: &str, tick: u64| {
        [0, 1].map(|k| {
            let mut draws = Stream::new(BOOK_SEED, name).at(2 * tick + k);
            let _ = draws.unit(); // the kind of reading
            4.0 * draws.unit()
        })
    };
    for (both, first) in both.iter().zip(&first) {
        assert_eq!(both.scans[0], first.scans[0]);
        assert_eq!(*both.scans[0].ranges, readings("car/beam", both.tick), "tick {}", both.tick);
        assert_eq!(*both.scans[1].ranges, readings("car/beam/b", both.tick), "tick {}", both.tick);
    }
}

#[test]
fn the_runs_sensor_stays_a_rovers_first_with_its_stream_and_its_encoding() {
    let rover = |sensors: &str| {
        let sensor = "sensor: (sigma_hit: 0.05, z_rand: 0.2)";
        let robots = format!("(name: \"rover\", kind: \"rusty\", start: [-2, 0, 1], {sensor}{sensors})");
        let sensor = Some(RangeSensor { n_rays: 7, max_range: 4.0 });
        frames(&Run::record(TourConfig { sensor, ..config(&robots, 20) }, BOOK_SEED).unwrap())
    };
    let (alone, more) = (rover(""), rover(&format!(", sensors: [{LEFT}, {AHEAD}]")));
    for (alone, more) in alone.iter().zip(&more) {
        assert_eq!(more.scans.len(), 3);
        assert_eq!((&alone.robots, &alone.scans[0]), (&more.robots, &more.scans[0]));
        // without the further scans the frame has the bytes that it had
        let mut cut = more.clone();
        cut.scans.truncate(1);
        assert_eq!(cut.digest(), alone.digest());
    }
}

#[test]
fn a_run_of_a_car_with_two_sensors_goes_through_its_log_and_is_verified() {
    let log = Run::record(config(&car(&format!("{LEFT}, {AHEAD}")), 40), Seed(11)).unwrap();
    assert!(log.frames().iter().all(|frame| frame.scans.len() == 2));
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes).unwrap();
    let mut read = Log::read_mcap(&bytes).unwrap().log;
    assert_eq!(read, log, "with the sensors in the world's text");
    assert_eq!(verify(&read, |_| {}).unwrap().identical, 40);
    read.frames_mut()[20].scans.swap(0, 1);
    assert_eq!(verify(&read, |_| {}).unwrap().identical, 20, "the order of the scans is part of the run");
}

#[test]
fn a_world_made_in_code_is_checked_when_its_run_begins() {
    let mut world = room(&car(""));
    let bad = RangeSensor { n_rays: 3, max_range: 0.0 };
    world.robots[0].sensors = vec![ResidentSensor::new("front", bad)];
    let refused = Run::record(TourConfig { worlds: vec![world], ticks: 1, sensor: None }, BOOK_SEED).unwrap_err();
    let motion_lab_sim::recording::RunError::Spawn(SpawnError::Config(error)) = refused else { panic!("{refused}") };
    assert!(matches!(error, ConfigError::ResidentSensor { .. }));
    let words = "robot \"car\" in world \"room\": sensors[0] \"front\": range 0 m: it must be 0.001 to 10000 m";
    assert_eq!(error.to_string(), words);
}
