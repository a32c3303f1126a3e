//! Sensors that a program spawns, changes or removes before tick 0 are in the run's configuration, as a world file has
//! them: any program verifies the run.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use bevy::app::App;
use bevy::prelude::{Add, Commands, Entity, On, Query};
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::{BeamModel, FanSensor, RangeSensor};
use motion_lab_core::worlds::{MAX_SENSORS, ResidentSensor};
use motion_lab_sim::recording::{Recorder, Run, verify, verify_with_robots};
use motion_lab_sim::run::Log;
use motion_lab_sim::simulation::{
    MountedOn, RobotName, Roster, RunCommand, RunConfig, SensorModel, SensorMount, SensorName, SensorNoise,
    SensorRefusal, SensorRoster, Sensors, StandingWorld, TransportCommand, headless_app, sensors, settle, start_run,
    step,
};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use crate::sensors::own_sensors::{AHEAD, LEFT, app, car, config, frames, latest, run_to};

type Ecs = bevy::prelude::World;

const SIX: RangeSensor = RangeSensor { n_rays: 6, max_range: 3.0 };
const FIVE: RangeSensor = RangeSensor { n_rays: 5, max_range: 4.0 };
const NOISE: BeamModel = BeamModel { sigma_hit: 0.02, ..BeamModel::EXACT };

/// The components of [`AHEAD`].
fn ahead() -> (SensorModel, SensorName, SensorMount) {
    let rays = RangeSensor { n_rays: 1, max_range: 9.0 };
    (SensorModel::from(rays), SensorName("ahead".into()), SensorMount(Pose2::new(0.5, 0.0, 0.0)))
}

/// The components of [`LEFT`].
fn left() -> (SensorModel, SensorName, SensorMount, SensorNoise) {
    let rays = FanSensor { sensor: RangeSensor { n_rays: 3, max_range: 9.0 }, field_of_view: FRAC_PI_2 };
    let mount = SensorMount(Pose2::new(0.0, 0.5, FRAC_PI_2));
    (SensorModel(rays), SensorName("left".into()), mount, SensorNoise(NOISE))
}

/// A rover with these further sensors.
fn rover(name: &str, more: &str) -> String {
    let y = if name == "rover" { 0 } else { -2 };
    format!("(name: \"{name}\", kind: \"rusty\", start: [-2, {y}, 1]{more})")
}

fn with(sensor: Option<RangeSensor>, robots: &[String], ticks: u64) -> TourConfig {
    TourConfig { sensor, ..config(&robots.join(", "), ticks) }
}

/// The plugin of a program that mounts sensors on every robot called "car" and a backward one on "rover".
fn mounts(app: &mut App) {
    app.add_observer(|on: On<Add, RobotName>, names: Query<&RobotName>, mut commands: Commands| {
        let Ok(name) = names.get(on.entity) else { return };
        if name.name == "car" {
            commands.spawn((left(), MountedOn(on.entity)));
            commands.spawn((ahead(), MountedOn(on.entity)));
        } else {
            let mount = SensorMount(Pose2::new(0.0, 0.0, PI));
            commands.spawn((SensorModel::from(FIVE), SensorName("back".into()), mount, MountedOn(on.entity)));
        }
    });
}

/// The same from a file.
const BACK: &str = ", sensors: [(name: \"back\", rays: 5, range: 4, mount: (x: 0, y: 0, theta: 3.141592653589793))]";

#[track_caller]
fn verified(log: &Log) {
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes).unwrap();
    let read = Log::read_mcap(&bytes).unwrap().log;
    assert_eq!(read, *log);
    let verification = verify(&read, |_| {}).unwrap();
    assert_eq!(verification.difference, None);
    assert_eq!((verification.identical, Some(verification.digest)), (log.ticks(), log.digest()));
}

#[test]
fn a_run_with_sensors_from_code_is_verified_by_any_program() {
    let bare = with(Some(SIX), &[rover("rover", ""), car("")], 40);
    let log = Run::record_with_robots(bare.clone(), Seed(5), mounts).unwrap();
    assert!(log.initial().unwrap().scans.len() == 4 && log.frames().iter().all(|frame| frame.scans.len() == 4));
    verified(&log);
    // a file with the same sensors gives the same run, to the digest
    let file = with(Some(SIX), &[rover("rover", BACK), car(&format!("{AHEAD}, {LEFT}"))], 40);
    let expected = Run::record(file.clone(), Seed(5)).unwrap();
    assert_eq!((&*log.recipe.config, log.digest()), (&file, expected.digest()));
    assert_eq!(frames(&log), frames(&expected));
    assert!(log.digest() != Run::record(bare, Seed(5)).unwrap().digest());
    // the program itself spawns them again, which are the same ones: nothing is refused
    let again = verify_with_robots(&log, mounts, |run| {
        assert_eq!(run.world().resource::<SensorRoster>().refused(), []);
        assert_eq!(run.config(), &*log.recipe.config);
    });
    assert_eq!(Some(again.unwrap().digest), log.digest());
}

/// The entity of a robot's sensor.
fn sensor(world: &Ecs, robot: usize, name: &str) -> Entity {
    let robot = world.resource::<Roster>().robots()[robot];
    let mut on_it = bevy::prelude::RelationshipTarget::iter(world.get::<Sensors>(robot).unwrap());
    on_it.find(|&e| world.get::<SensorName>(e).unwrap().0 == name).unwrap()
}

/// Runs the app to a tick, and records the configuration and the frames that it then has. The plain library must give
/// the same, and so must this configuration.
#[track_caller]
fn runs_as(app: &mut App, expected: &TourConfig) {
    let ran = run_to(app, expected.ticks);
    let config = TourConfig::clone(app.world().resource::<RunConfig>().config());
    assert_eq!(config, *expected);
    let log = Run::record(config, BOOK_SEED).unwrap();
    assert_eq!(log.frames(), ran);
    verified(&log);
    let standing = app.world().get::<StandingWorld>(app.world().resource::<Roster>().worlds()[0]).unwrap();
    assert_eq!(*standing.0, expected.worlds[0], "and so does the world that is shown");
}

#[test]
fn what_a_file_has_keeps_its_order_and_what_is_changed_or_removed_is_so_in_the_configuration() {
    let third = "(name: \"Third\", rays: 2, range: 2)";
    let file = with(Some(SIX), &[car(&format!("{LEFT}, {third}, {AHEAD}")), rover("rover", "")], 20);
    let mut app = app(file);
    let world = app.world_mut();
    let it = world.resource::<Roster>().robots()[0];
    world.despawn(sensor(world, 0, "Third"));
    world.entity_mut(sensor(world, 0, "left")).remove::<SensorNoise>();
    world.entity_mut(sensor(world, 0, "ahead")).insert((SensorMount(Pose2::new(0.25, 0.5, -1.0)), SensorNoise(NOISE)));
    world.entity_mut(sensor(world, 1, "")).insert(SensorNoise(BeamModel { z_rand: 0.25, ..NOISE }));
    for name in ["middle", "back"] {
        world.spawn((SensorModel::from(FIVE), SensorName(name.into()), MountedOn(it)));
    }
    let exact = LEFT.replace(", noise: (sigma_hit: 0.02)", "");
    let turned = "(name: \"ahead\", rays: 1, range: 9, mount: (x: 0.25, y: 0.5, theta: -1), noise: (sigma_hit: 0.02))";
    let new = "(name: \"back\", rays: 5, range: 4), (name: \"middle\", rays: 5, range: 4)";
    let noisy = ", sensor: (sigma_hit: 0.02, z_rand: 0.25)";
    let sensors = car(&format!("{exact}, {turned}, {new}"));
    runs_as(&mut app, &with(Some(SIX), &[sensors, rover("rover", noisy)], 20));
}

#[test]
fn the_runs_own_sensor_is_what_the_robots_that_sense_agree_on() {
    let two = |sensor| with(sensor, &[rover("rover", ""), rover("other", ""), car("")], 10);
    // another one on both
    let mut changed = app(two(Some(SIX)));
    for robot in [0, 1] {
        let own = sensor(changed.world(), robot, "");
        changed.world_mut().entity_mut(own).insert(SensorModel::from(FIVE));
    }
    runs_as(&mut changed, &two(Some(FIVE)));
    // none on either
    let mut removed = app(two(Some(SIX)));
    for robot in [0, 1] {
        let own = sensor(removed.world(), robot, "");
        removed.world_mut().despawn(own);
    }
    runs_as(&mut removed, &two(None));
    assert_eq!(removed.world().resource::<SensorRoster>().refused(), []);
    // one where there was none
    let mut added = app(two(None));
    let robots = added.world().resource::<Roster>().robots().to_vec();
    for &robot in &robots[..2] {
        added.world_mut().spawn((SensorModel::from(SIX), MountedOn(robot)));
    }
    runs_as(&mut added, &two(Some(SIX)));
    // a second one beside the run's own is not taken
    let mut second = app(two(Some(SIX)));
    let robot = second.world().resource::<Roster>().robots()[0];
    second.world_mut().spawn((SensorModel::from(FIVE), MountedOn(robot)));
    runs_as(&mut second, &two(Some(SIX)));
    let refused = &second.world().resource::<SensorRoster>().refused()[0];
    assert_eq!((refused.reason.clone(), refused.robot.as_deref()), (SensorRefusal::NameOfConfiguration, Some("rover")));
}

#[test]
fn an_unnamed_sensor_that_no_configuration_could_say_is_refused() {
    let two = |sensor| with(sensor, &[rover("rover", ""), rover("other", ""), car("")], 10);
    let changes: [fn(&mut Ecs, Entity); 5] = [
        |world, own| _ = world.despawn(own),
        |world, own| _ = world.entity_mut(own).insert(SensorModel::from(FIVE)),
        |world, own| {
            let fan = FanSensor { sensor: SIX, field_of_view: 0.5 * TAU };
            _ = world.entity_mut(own).insert(SensorModel(fan));
        },
        |world, own| _ = world.entity_mut(own).insert(SensorMount(Pose2::new(0.1, 0.0, 0.0))),
        |world, own| _ = world.entity_mut(own).insert(SensorNoise(BeamModel { z_rand: 2.0, ..NOISE })),
    ];
    for (i, change) in changes.into_iter().enumerate() {
        let mut app = app(two(Some(SIX)));
        let own = sensor(app.world(), 1, "");
        change(app.world_mut(), own);
        runs_as(&mut app, &two(None));
        let refused = app.world().resource::<SensorRoster>().refused();
        let of: Vec<&str> = refused.iter().filter_map(|r| r.robot.as_deref()).collect();
        assert_eq!(of, if i == 0 { vec!["rover"] } else { vec!["rover", "other"] }, "change {i}");
        assert_eq!(refused[0].reason, SensorRefusal::Unnamed);
    }
    // on a robot to which no run gives one, which leaves the others theirs
    let mut app = app(two(Some(SIX)));
    let car = app.world().resource::<Roster>().robots()[2];
    app.world_mut().spawn((SensorModel::from(SIX), MountedOn(car)));
    runs_as(&mut app, &two(Some(SIX)));
    let refused: Vec<String> =
        app.world().resource::<SensorRoster>().refused().iter().map(ToString::to_string).collect();
    let reason =
        "without a name it must be the run's own sensor, which all robots that sense have alike: give it a name";
    assert_eq!(refused, [format!("robot \"car\", sensor \"\": {reason}")]);
}

#[test]
fn of_two_sensors_with_one_name_the_configurations_own_is_taken() {
    let file = with(None, &[car(AHEAD)], 10);
    let mut app = app(file.clone());
    let it = app.world().resource::<Roster>().robots()[0];
    app.world_mut().spawn((SensorModel::from(FIVE), SensorName("ahead".into()), MountedOn(it)));
    runs_as(&mut app, &file);
    let [refused] = app.world().resource::<SensorRoster>().refused() else { panic!("one") };
    assert_eq!(refused.reason, SensorRefusal::NameOfConfiguration);
}

#[test]
fn a_robot_has_no_more_sensors_than_a_file_may_say() {
    let mut app = app(with(Some(SIX), &[rover("rover", "")], 2));
    let it = app.world().resource::<Roster>().robots()[0];
    for i in (0..MAX_SENSORS + 2).rev() {
        app.world_mut().spawn((SensorModel::from(FIVE), SensorName(format!("s{i:02}")), MountedOn(it)));
    }
    settle(app.world_mut());
    let names: Vec<String> = sensors(app.world()).into_iter().map(|view| view.name).collect();
    let expected: Vec<String> = (0..MAX_SENSORS).map(|i| format!("s{i:02}")).collect();
    assert_eq!((names[0].as_str(), &names[1..]), ("", &expected[..]));
    let refused = app.world().resource::<SensorRoster>().refused();
    assert_eq!(refused.iter().map(|r| r.sensor.as_str()).collect::<Vec<_>>(), ["s64", "s65"]);
    assert!(refused.iter().all(|r| r.reason == SensorRefusal::TooMany));
    let config = TourConfig::clone(app.world().resource::<RunConfig>().config());
    assert_eq!(config.validate(), Ok(()));
    run_to(&mut app, 2);
    assert_eq!(Run::record(config, BOOK_SEED).unwrap().frames()[1], latest(&app));
}

#[test]
fn a_configuration_without_sensors_from_code_stays_as_it_is() {
    // a heading beyond pi and a run's sensor that no robot has, as only code makes them
    let mut given = with(Some(SIX), &[car("")], 3);
    let turned = Pose2 { theta: 7.0, ..Pose2::IDENTITY };
    given.worlds[0].robots[0].sensors = vec![ResidentSensor { mount: turned, ..ResidentSensor::new("turned", FIVE) }];
    let run = Recorder::new(given.clone(), BOOK_SEED).unwrap();
    assert_eq!((run.config(), run.config().worlds[0].to_ron()), (&given, given.worlds[0].to_ron()));
    assert_eq!(Run::record(given.clone(), BOOK_SEED).unwrap().recipe.config, given.into());
}

#[test]
fn a_reset_begins_the_run_with_the_sensors_that_it_had() {
    let mut app = headless_app();
    start_run(app.world_mut(), with(Some(SIX), &[rover("rover", ""), car("")], 10), BOOK_SEED).unwrap();
    let it = app.world().resource::<Roster>().robots()[1];
    app.world_mut().spawn((ahead(), MountedOn(it)));
    let mut ran = Vec::new();
    for _ in 0..10 {
        step(app.world_mut());
        ran.push(latest(&app));
    }
    assert_eq!(ran[0].scans.len(), 2);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Reset));
    app.update();
    assert_eq!(latest(&app).tick, 0);
    assert_eq!(run_to(&mut app, 10), ran);
}
