//! Robots before tick 0: what is spawned, moved, renamed, replaced, driven or despawned is so in the run.

use bevy::prelude::Entity;
use motion_lab_core::configuration::{DiscSizes, Sizes};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{HITCH, Hitch, RUSTY, Reach, Rusty};
use motion_lab_core::worlds::Resident;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, RobotInput, Script, WorldChange, WorldEvent};
use motion_lab_sim::simulation::{
    Configuration, DriveMode, ObstacleOf, OwnState, PendingInput, ResidesIn, RobotModel, RunConfig, SensorModel,
    SensorName, SimulatedWorld, Slip, TransportCommand, settle,
};

use super::*;

fn world_entity(world: &Ecs, w: usize) -> Entity {
    world.resource::<Roster>().worlds()[w]
}

/// Fails unless the app's run is that of this configuration, as a file might say it, over its first 20 ticks.
#[track_caller]
fn assert_runs_as(app: &mut App, expected: &TourConfig) {
    settle(app.world_mut());
    assert_eq!(app.world().resource::<RunConfig>().config().worlds, expected.worlds);
    assert_agrees(app.world_mut());
    let log = Run::record(TourConfig { ticks: 20, ..expected.clone() }, Seed(7)).unwrap();
    assert_eq!(log.initial(), Some(&frame(app.world())));
    for recorded in log.frames() {
        step(app.world_mut());
        assert_eq!(frame(app.world()).digest(), recorded.digest());
    }
    assert_agrees(app.world_mut());
}

#[test]
fn a_robot_that_is_moved_starts_there() {
    let mut app = app();
    let (a, d) = (robot(app.world(), "A"), robot(app.world(), "D"));
    app.world_mut().get_mut::<Configuration<Rusty>>(a).unwrap().0 = Pose2::new(0.5, -1.0, 4.0);
    app.world_mut().get_mut::<Configuration<Reach<2>>>(d).unwrap().0 = T2::new(1.0, -1.0);
    let mut expected = config();
    expected.worlds[0].robots[0].start = vec![0.5, -1.0, Pose2::new(0.0, 0.0, 4.0).theta];
    expected.worlds[1].robots[0].start = vec![1.0, -1.0];
    assert_runs_as(&mut app, &expected);
    assert!(refused(app.world_mut()).is_empty());
}

#[test]
fn a_robot_that_is_spawned_is_in_the_run_after_the_others_by_its_name_and_senses() {
    let mut app = app();
    let (yard, bench) = (world_entity(app.world(), 0), world_entity(app.world(), 1));
    let q = |x| Configuration::<Rusty>(Pose2::new(x, -1.0, 0.0));
    // in whatever order they come
    for (name, x) in [("z", 0.4), ("E", -0.4)] {
        app.world_mut().spawn((RobotModel(RUSTY), q(x), named(name, "rusty"), ResidesIn(yard)));
    }
    let car = HitchCfg { body: Pose2::new(0.0, 1.0, 0.0), trailer: Some(0.25) };
    app.world_mut().spawn((RobotModel(HITCH), Configuration::<Hitch>(car), named("F", "hitch"), ResidesIn(bench)));
    let mut expected = config();
    expected.worlds[0].robots.push(Resident::new("E", "rusty", [-0.4, -1.0, 0.0]));
    expected.worlds[0].robots.push(Resident::new("z", "rusty", [0.4, -1.0, 0.0]));
    expected.worlds[1].robots.push(Resident::new("F", "hitch", [0.0, 1.0, 0.0, 0.25]));
    assert_runs_as(&mut app, &expected);
    assert_eq!(frame(app.world()).scans.len(), 4, "each rover has the run's sensor");
    assert!(refused(app.world_mut()).is_empty());
}

#[test]
fn a_robot_that_is_despawned_is_gone_and_those_after_it_have_lower_ids() {
    let mut app = app();
    let a = robot(app.world(), "A");
    app.world_mut().despawn(a);
    let mut expected = config();
    expected.worlds[0].robots.remove(0);
    assert_runs_as(&mut app, &expected);
}

#[test]
fn another_model_another_name_another_world_and_another_kind_are_so_in_the_configuration() {
    let mut app = app();
    let (a, b, c) = (robot(app.world(), "A"), robot(app.world(), "B"), robot(app.world(), "C"));
    let bench = world_entity(app.world(), 1);
    let world = app.world_mut();
    world.entity_mut(a).insert(RobotModel(Rusty { body_radius: 0.25, track: 0.4, ..RUSTY }));
    world.entity_mut(b).insert((ResidesIn(bench), named("Bea", "rusty")));
    // the car becomes an arm of three links
    let arm = (
        RobotModel(Reach::<3>::redundant()),
        Configuration::<Reach<3>>(motion_lab_core::configuration::Tn([0.1, 0.2, 0.3])),
    );
    world.entity_mut(c).remove::<RobotModel<Hitch>>().insert((arm, named("C", "reach3")));
    let mut expected = config();
    let [mut first, mut second, mut third] = [0, 1, 2].map(|i| expected.worlds[0].robots[i].clone());
    first.sizes = Some(Sizes::Disc(DiscSizes { radius: 0.25, track: 0.4, wheel_radius: RUSTY.wheel_radius }));
    second.name = "Bea".into();
    (third.kind, third.start) = ("reach3".into(), vec![0.1, 0.2, 0.3]);
    expected.worlds[0].robots = vec![first, third];
    expected.worlds[1].robots.insert(0, second);
    assert_runs_as(&mut app, &expected);
    assert!(refused(app.world_mut()).is_empty());
}

#[test]
fn a_drive_mode_becomes_the_first_input() {
    let mut app = app();
    let (a, d) = (robot(app.world(), "A"), robot(app.world(), "D"));
    let world = app.world_mut();
    *world.get_mut::<DriveMode<Rusty>>(a).unwrap() =
        DriveMode { manual: true, channels: [128, 5], target: None, refusals: 0 };
    let target = Some(T2::new(0.75, 0.5));
    *world.get_mut::<DriveMode<Reach<2>>>(d).unwrap() =
        DriveMode { manual: true, channels: [0; 2], target, refusals: 0 };
    settle(world);
    let events = world.resource::<PendingInput>().script().events.clone();
    let quantized = |x: f64| motion_lab_sim::run::Quantized::try_new(x).unwrap();
    assert_eq!(
        events,
        [
            Event { tick: 1, robot: "A".into(), input: RobotInput::Drive(128, 5) },
            Event { tick: 1, robot: "D".into(), input: RobotInput::MoveTo(vec![quantized(0.75), quantized(0.5)]) },
        ]
    );
    assert_agrees(world);
    steps(world, 10);
    assert_eq!(frame(world).robots[0].channels, [128, 5]);
    assert_agrees(world);
    assert_recorded(world);
    assert!(refused(world).is_empty());
}

fn driven(channels: [i16; 2]) -> DriveMode<Rusty> {
    DriveMode { manual: true, channels, target: None, refusals: 0 }
}

#[test]
fn a_drive_mode_is_that_of_its_entity_whatever_its_name_becomes() {
    let mut app = app();
    let (a, b) = (robot(app.world(), "A"), robot(app.world(), "B"));
    let world = app.world_mut();
    // it can't be named so, and stays "A"
    world.entity_mut(a).insert((named("B", "rusty"), driven([128, 5])));
    settle(world);
    let drives = |world: &Ecs| {
        let events = &world.resource::<PendingInput>().script().events;
        events.iter().map(|event| (event.tick, event.robot.clone(), event.input.clone())).collect::<Vec<_>>()
    };
    assert_eq!(drives(world), [(1, "A".into(), RobotInput::Drive(128, 5))]);
    // two that change their names are driven by their new ones
    world.entity_mut(a).insert((named("Ann", "rusty"), driven([1, 2])));
    world.entity_mut(b).insert((named("A", "rusty"), driven([3, 4])));
    settle(world);
    assert_eq!(drives(world), [(1, "Ann".into(), RobotInput::Drive(1, 2)), (1, "A".into(), RobotInput::Drive(3, 4))]);
    steps(world, 5);
    assert_recorded(world);
}

#[test]
fn a_new_robots_drive_mode_becomes_its_first_input_too() {
    let mut app = app();
    let yard = world_entity(app.world(), 0);
    let rover = |name: &str, x: f64| {
        let q = Configuration::<Rusty>(Pose2::new(x, -1.0, 0.0));
        (RobotModel(RUSTY), q, named(name, "rusty"), ResidesIn(yard))
    };
    let world = app.world_mut();
    world.spawn((rover("F", 0.4), driven([-128, 9])));
    world.spawn((rover("E", -0.4), DriveMode::<Rusty> { refusals: 2, ..driven([7, 7]) }));
    settle(world);
    let expected = [Event { tick: 1, robot: "F".into(), input: RobotInput::Drive(-128, 9) }];
    assert_eq!(world.resource::<PendingInput>().script().events, expected);
    let said = refused(world);
    assert!(
        said.len() == 1 && said[0].starts_with("robot \"E\" (") && said[0].contains("DriveMode<Rusty> was changed"),
        "{said:?}"
    );
    step(world);
    assert_eq!(frame(world).robots[4].channels, [-128, 9], "E comes first");
    assert_recorded(world);
}

#[test]
fn the_last_drive_mode_that_is_written_holds_and_the_script_does_not_grow() {
    let mut app = app();
    let quantized = |x: f64| motion_lab_sim::run::Quantized::try_new(x).unwrap();
    let event = |robot: &str, input| Event { tick: 1, robot: robot.into(), input };
    let to = RobotInput::Teleport(vec![quantized(-0.5), quantized(-1.0), quantized(0.0)]);
    let before = [RobotInput::Drive(1, 1), to.clone(), RobotInput::Release].map(|input| event("A", input));
    let later = Event { tick: 3, ..event("A", RobotInput::Drive(9, 9)) };
    let others = event("B", RobotInput::Drive(2, 2));
    let script = [&before[..], &[others.clone(), later.clone()]].concat();
    start_run(app.world_mut(), config(), (Seed(7), Script::new(script, vec![]))).unwrap();
    let (a, d) = (robot(app.world(), "A"), robot(app.world(), "D"));
    let world = app.world_mut();
    for speed in [100, 110, 120] {
        *world.get_mut::<DriveMode<Rusty>>(a).unwrap() = driven([speed, 0]);
        let target = Some(T2::new(0.75, f64::from(speed) / 200.0));
        *world.get_mut::<DriveMode<Reach<2>>>(d).unwrap() =
            DriveMode { manual: true, channels: [0; 2], target, refusals: 0 };
        settle(world);
    }
    let drive = event("A", RobotInput::Drive(120, 0));
    let aim = event("D", RobotInput::MoveTo(vec![quantized(0.75), quantized(0.6)]));
    assert_eq!(world.resource::<PendingInput>().script().events, [event("A", to), others, drive, aim, later]);
    step(world);
    assert_eq!((frame(world).robots[0].channels, frame(world).robots[0].manual), ([120, 0], true));
    assert_recorded(world);
    assert!(refused(world).is_empty());
    // a rover goes nowhere by itself, and an arm has no channels
    send(&mut app, TransportCommand::Seek(0));
    let world = app.world_mut();
    *world.get_mut::<DriveMode<Rusty>>(a).unwrap() =
        DriveMode { target: Some(Pose2::new(1.0, 1.0, 0.0)), ..driven([0, 0]) };
    *world.get_mut::<DriveMode<Reach<2>>>(d).unwrap() =
        DriveMode { manual: true, channels: [5, 0], target: None, refusals: 0 };
    settle(world);
    assert_eq!(refused(world).len(), 2);
    // no script holds an angle of 20,000 rad
    *world.get_mut::<DriveMode<Reach<2>>>(d).unwrap() = DriveMode {
        manual: true,
        channels: [0; 2],
        target: Some(motion_lab_core::configuration::Tn([20_000.0, 0.5])),
        refusals: 0,
    };
    settle(world);
    assert_eq!(refused(world).len(), 1);
    // nor has it any on its way
    *world.get_mut::<DriveMode<Reach<2>>>(d).unwrap() =
        DriveMode { manual: true, channels: [5, 0], target: Some(T2::new(0.75, 0.5)), refusals: 0 };
    settle(world);
    assert_eq!(refused(world).len(), 1);
    assert_eq!(world.resource::<PendingInput>().script().events.len(), 5);
}

#[test]
fn readings_and_zeros_that_are_written_in_place_are_put_back_at_tick_0_too() {
    use motion_lab_sim::simulation::{Scan, SensorRoster};
    let mut app = app();
    let (b, before) = (robot(app.world(), "B"), frame(app.world()));
    let sensor = app.world().resource::<SensorRoster>().entities().next().unwrap();
    let world = app.world_mut();
    *world.get_mut::<Scan>(sensor).unwrap() = Scan::default();
    let y = &mut world.get_mut::<Configuration<Rusty>>(b).unwrap().0.y;
    assert_eq!(y.to_bits(), 0.0_f64.to_bits());
    *y = -0.0;
    settle(world);
    assert_agrees(world);
    assert_eq!(frame(world).digest(), before.digest());
    let said = refused(world);
    assert!(said.len() == 1 && said[0].contains("Scan was changed past"), "{said:?}");
}

#[test]
fn a_world_that_is_changed_at_tick_0_keeps_what_is_in_it() {
    type Change = fn(&mut bevy::prelude::EntityWorldMut);
    let changes: [Change; 3] = [
        |world| _ = world.remove::<SimulatedWorld>(),
        |world| {
            let model = world.get::<SimulatedWorld>().unwrap().model.clone();
            world.insert(SimulatedWorld { index: 1, model });
        },
        |world| _ = world.clear(),
    ];
    for change in changes {
        let mut app = app();
        let (yard, a) = (world_entity(app.world(), 0), robot(app.world(), "A"));
        change(&mut app.world_mut().entity_mut(yard));
        assert_runs_as(&mut app, &config());
        assert_eq!((world_entity(app.world(), 0), robot(app.world(), "A")), (yard, a), "by the same entities");
        let said = refused(app.world_mut());
        assert!(said.iter().all(|text| text.starts_with("world \"yard\" (entity ")), "{said:?}");
        assert!(said.iter().any(|text| text.contains("): SimulatedWorld was changed past")), "{said:?}");
    }
}

#[test]
fn what_no_run_could_have_is_left_out_or_stays_as_it_was_and_says_so() {
    let mut app = app();
    let yard = world_entity(app.world(), 0);
    let (a, b, c) = (robot(app.world(), "A"), robot(app.world(), "B"), robot(app.world(), "C"));
    let world = app.world_mut();
    world.get_mut::<Configuration<Rusty>>(a).unwrap().0.x = f64::NAN;
    world.entity_mut(b).insert(RobotModel(Rusty { max_speed: 9.0, ..RUSTY }));
    world.entity_mut(c).insert(Slip(Stream::new(Seed(1), "another"))).remove::<OwnState<Hitch>>();
    let q = || Configuration::<Rusty>(Pose2::new(0.0, -1.0, 0.0));
    let rover = |name: &str, kind: &str| (RobotModel(RUSTY), q(), named(name, kind), ResidesIn(yard));
    world.spawn(rover("post", "rusty"));
    world.spawn(rover("A", "rusty"));
    world.spawn(rover("twin", "rusty"));
    world.spawn(rover("twin", "rusty"));
    world.spawn(rover(" padded", "rusty"));
    world.spawn(rover("car", "hitch"));
    world.spawn((RobotModel(RUSTY), named("nowhere", "rusty"), ResidesIn(yard)));
    let stray = world.spawn((RobotModel(RUSTY), q(), named("stray", "rusty"))).id();
    assert_runs_as(&mut app, &config());
    let mut said = refused(app.world_mut());
    said.iter_mut().for_each(|text| {
        let (from, to) = (text.find(" (entity").unwrap(), text.find(')').unwrap() + 1);
        text.replace_range(from..to, "");
    });
    said.sort();
    assert_eq!(
        said,
        [
            "robot \" padded\" is left out: its name must be 1 to 200 bytes without control characters and without blanks at its ends",
            "robot \"A\" is left out: its name is taken",
            "robot \"A\" stays as it was: robot \"A\" in world \"yard\": [NaN, 0.0, 0.0] is no configuration of a rusty",
            "robot \"B\" stays as it was: its model differs from that of its kind in more than its sizes",
            "robot \"C\": OwnState<Hitch> was changed past the run's commands, and is put back",
            "robot \"C\": Slip was changed past the run's commands, and is put back",
            "robot \"car\" is left out: robots of its type are of no kind \"hitch\"",
            "robot \"nowhere\" is left out: it has no configuration of its model's type",
            "robot \"post\" is left out: its name is taken",
            "robot \"stray\" is left out: it resides in no world of the run",
            "robot \"twin\" is left out: its name is taken",
            "robot \"twin\" is left out: its name is taken",
        ]
    );
    assert!(!app.world().entity(stray).contains::<RobotModel<Rusty>>(), "and is none of the run's robots");
}

#[test]
fn back_at_tick_0_robots_obstacles_and_sensors_may_be_changed_alike() {
    let mut app = app();
    steps(app.world_mut(), 30);
    send(&mut app, TransportCommand::Seek(0));
    assert!(refused(app.world_mut()).is_empty());
    let (a, post) = (robot(app.world(), "A"), find_obstacle(app.world_mut(), "post"));
    let world = app.world_mut();
    world.get_mut::<Configuration<Rusty>>(a).unwrap().0.x = -1.0;
    world.despawn(post);
    let fan = SensorModel::from(RangeSensor { n_rays: 5, max_range: 2.0 });
    world.spawn((fan, SensorName("front".into()), motion_lab_sim::simulation::MountedOn(a)));
    settle(world);
    assert_eq!(world.resource::<motion_lab_sim::simulation::Transport>().frontier(), 0, "the ticks ahead are gone");
    let found = world.resource::<RunConfig>().config().clone();
    let names = |found: &TourConfig| found.worlds[0].obstacles.iter().map(|o| o.name.clone()).collect::<Vec<_>>();
    assert_eq!((found.worlds[0].robots[0].start[0], names(&found)), (-1.0, vec!["bin".to_owned()]));
    assert_eq!(found.worlds[0].robots[0].sensors.len(), 1);
    assert_agrees(world);
    steps(world, 25);
    assert_agrees(world);
    assert_recorded(world);
}

pub(crate) fn find_obstacle(world: &mut Ecs, name: &str) -> Entity {
    use motion_lab_sim::simulation::ObstacleShape;
    let mut all = world.query::<(Entity, &ObstacleShape)>();
    all.iter(world).find(|(_, shape)| shape.name == name).unwrap().0
}

#[test]
fn an_obstacle_goes_where_its_relation_says_and_is_there_when_it_comes_later() {
    use motion_lab_core::worlds::{Obstacle, ObstacleKind};
    use motion_lab_sim::simulation::ObstacleShape;
    let mut app = app();
    let (bench, bin, post) =
        (world_entity(app.world(), 1), find_obstacle(app.world_mut(), "bin"), find_obstacle(app.world_mut(), "post"));
    let pieces = vec![(Pose2::new(1.0, 3.0, 0.0), Shape::Disc { radius: 0.1 })];
    let shape = ObstacleShape { name: "late".into(), kind: ObstacleKind::Solid, pieces: pieces.clone() };
    // first the shape alone, an update later the relation
    let late = app.world_mut().spawn(shape).id();
    app.update();
    app.world_mut().entity_mut(late).insert(ObstacleOf(bench));
    app.world_mut().entity_mut(bin).insert(ObstacleOf(bench));
    app.world_mut().entity_mut(post).remove::<ObstacleOf>();
    app.update();
    let mut expected = config();
    let _post = expected.worlds[0].obstacles.remove(0);
    let bin = expected.worlds[0].obstacles.remove(0);
    expected.worlds[1].obstacles = vec![bin, Obstacle::new("late", ObstacleKind::Solid, pieces)];
    assert_runs_as(&mut app, &expected);
}

#[test]
fn events_of_robots_and_doors_that_are_gone_leave_the_script_aloud() {
    let mut app = app();
    let drive = |tick, robot: &str| Event { tick, robot: robot.into(), input: RobotInput::Drive(9, 0) };
    let close = WorldEvent { tick: 4, world: "yard".into(), change: WorldChange::Close("gate".into()) };
    let script = Script::new(vec![drive(3, "A"), drive(4, "B"), drive(5, "A")], vec![close]);
    start_run(app.world_mut(), config(), (Seed(7), script)).unwrap();
    assert_eq!(app.world().resource::<PendingInput>().script().changes.len(), 1);
    let (a, gate) = (robot(app.world(), "A"), find_obstacle(app.world_mut(), "gate"));
    app.world_mut().despawn(a);
    app.world_mut().despawn(gate);
    app.update();
    let script = app.world().resource::<PendingInput>().script().clone();
    assert_eq!(script.events, [drive(4, "B")]);
    assert_eq!(script.changes, []);
    assert_eq!(refused(app.world_mut()), ["there is no robot \"A\"", "there is no door \"gate\" in world \"yard\""]);
    steps(app.world_mut(), 8);
    assert_recorded(app.world());
}
