//! Whatever others do, and in whatever order: entities, configuration and frame agree, and the run's configuration,
//! seed and script give its bits anywhere.

use bevy::prelude::{Component, Entity, EntityWorldMut, With};
use motion_lab_core::configuration::Configuration as _;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{Hitch, RUSTY, Reach, Rusty};
use motion_lab_core::worlds::ObstacleKind;
use motion_lab_sim::run::{Quantized, RobotInput, WorldChange};
use motion_lab_sim::simulation::{
    Configuration, Contacts, Control, Cut, Door, DrawnTour, DriveMode, MountedOn, ObstacleOf, ObstacleShape, OwnState,
    Placement, Playback, PreviousConfiguration, ResidesIn, RobotId, RobotModel, RobotName, Scan, SensorModel,
    SensorMount, SensorName, SensorNoise, SimulatedRobot, SimulatedWorld, Slip, TickMotion, Transport, WorldCommand,
    WorldScene, play_tick, settle,
};
use oracle::fixtures::count_from_env;

use super::*;

/// The names of everything that a sequence may name, and of what is not there.
const NAMES: [&str; 8] = ["A", "B", "C", "D", "E", "post", "gate", "F"];

/// One of several.
fn one<T: Copy>(draws: &mut Stream, from: &[T]) -> T {
    from[draws.below(from.len() as u64) as usize]
}

/// An entity with this component, if there is one.
fn any<C: Component>(world: &mut Ecs, draws: &mut Stream) -> Option<Entity> {
    let mut all: Vec<Entity> = world.query_filtered::<Entity, With<C>>().iter(world).collect();
    all.sort_unstable();
    (!all.is_empty()).then(|| one(draws, &all))
}

/// Writes into the values of a robot.
fn write<R: SimulatedRobot>(world: &mut Ecs, draws: &mut Stream) {
    let Some(e) = any::<RobotModel<R>>(world, draws) else { return };
    let mut robot = world.entity_mut(e);
    match draws.below(7) {
        6 => {
            if let Some(mut cut) = robot.get_mut::<Cut<R>>() {
                *cut = Cut::default();
            }
        }
        0 => {
            if let Some(mut q) = robot.get_mut::<Configuration<R>>() {
                let moved: Vec<f64> = q.0.coordinates().iter().map(|x| x + 0.125).collect();
                q.0 = R::Configuration::from_coordinates(&moved).unwrap();
            }
        }
        1 => {
            if let Some(mut mode) = robot.get_mut::<DriveMode<R>>() {
                mode.manual = draws.below(2) == 0;
                mode.channels = [draws.below(300) as i16 - 150, 7];
            }
        }
        2 => {
            let target = robot.get::<Configuration<R>>().map(|q| q.0);
            if let Some(mut mode) = robot.get_mut::<DriveMode<R>>() {
                (mode.manual, mode.target) = (true, target);
            }
        }
        3 => _ = robot.insert((Control::<R>::default(), Contacts::<R>::default())),
        4 => _ = robot.insert(OwnState::<R>::default()),
        _ => {
            if let Some(mut mode) = robot.get_mut::<DriveMode<R>>() {
                mode.refusals += 3;
            }
        }
    }
}

/// Removes a component of a robot.
fn remove<R: SimulatedRobot>(robot: &mut EntityWorldMut, draws: &mut Stream) {
    match draws.below(12) {
        0 => _ = robot.remove::<Configuration<R>>(),
        1 => _ = robot.remove::<PreviousConfiguration<R>>(),
        2 => _ = robot.remove::<Control<R>>(),
        3 => _ = robot.remove::<Contacts<R>>(),
        4 => _ = robot.remove::<DriveMode<R>>(),
        5 => _ = robot.remove::<OwnState<R>>(),
        6 => _ = robot.remove::<(DrawnTour<R>, TickMotion<R>, Cut<R>)>(),
        7 => _ = robot.remove::<RobotModel<R>>(),
        8 => _ = robot.remove::<RobotId>(),
        9 => _ = robot.remove::<RobotName>(),
        10 => _ = robot.remove::<ResidesIn>(),
        _ => _ = robot.remove::<Slip>(),
    }
}

/// Changes the components of robots that are not written.
fn change_robot(world: &mut Ecs, draws: &mut Stream) {
    let home = any::<SimulatedWorld>(world, draws);
    let name = one(draws, &NAMES);
    match draws.below(8) {
        0 | 1 => {
            if let Some(e) = any::<RobotModel<Rusty>>(world, draws) {
                remove::<Rusty>(&mut world.entity_mut(e), draws);
            }
        }
        2 => {
            if let Some(e) = any::<RobotModel<Hitch>>(world, draws) {
                remove::<Hitch>(&mut world.entity_mut(e), draws);
            }
        }
        3 => {
            if let Some(e) = any::<RobotModel<Rusty>>(world, draws) {
                let radius = one(draws, &[0.11, 0.2, f64::NAN]);
                world.entity_mut(e).insert(RobotModel(Rusty { body_radius: radius, ..RUSTY }));
            }
        }
        4 => {
            if let Some(e) = any::<RobotId>(world, draws) {
                world.entity_mut(e).insert(named(name, one(draws, &["rusty", "hitch", "hovercraft"])));
            }
        }
        5 => {
            if let Some((e, home)) = any::<RobotId>(world, draws).zip(home) {
                world.entity_mut(e).insert(ResidesIn(home));
            }
        }
        6 => {
            if let Some(e) = any::<RobotId>(world, draws) {
                world.despawn(e);
            }
        }
        _ => {
            let q = Configuration::<Rusty>(Pose2::new(draws.uniform(-3.0, 3.0), draws.uniform(-3.0, 3.0), 0.5));
            let channels = [draws.below(300) as i16 - 150, 3];
            let mode = DriveMode::<Rusty> { manual: draws.below(2) == 0, channels, target: None, refusals: 0 };
            let robot = (RobotModel(RUSTY), q, mode, named(name, "rusty"));
            match home {
                Some(home) if draws.below(4) > 0 => _ = world.spawn((robot, ResidesIn(home))),
                _ => _ = world.spawn(robot),
            }
        }
    }
}

/// Changes obstacles, sensors and worlds.
fn change_thing(world: &mut Ecs, draws: &mut Stream) {
    let home = any::<SimulatedWorld>(world, draws);
    let obstacle = any::<ObstacleShape>(world, draws);
    let sensor = any::<SensorModel>(world, draws);
    let robot = any::<RobotId>(world, draws);
    let pose = Pose2::new(draws.uniform(-0.5, 0.5), 0.25, 0.125);
    let shape = ObstacleShape {
        name: one(draws, &NAMES).into(),
        kind: ObstacleKind::Solid,
        pieces: vec![(Pose2::new(draws.uniform(-3.0, 3.0), 3.0, 0.0), Shape::Disc { radius: 0.1 })],
    };
    let fan = SensorModel::from(RangeSensor { n_rays: 2, max_range: 3.0 });
    let of = |world: &mut Ecs, entity: Option<Entity>, change: &dyn Fn(&mut EntityWorldMut)| {
        if let Some(entity) = entity {
            change(&mut world.entity_mut(entity));
        }
    };
    match draws.below(20) {
        18 => of(world, home, &|e| _ = e.remove::<SimulatedWorld>()),
        19 => of(world, one(draws, &[home, obstacle, sensor, robot]), &|e| _ = e.clear()),
        0 => of(world, obstacle, &|e| _ = e.insert(Placement { present: true, pose })),
        1 => of(world, obstacle, &|e| _ = e.insert(Placement { present: false, pose })),
        2 => of(world, obstacle, &|e| _ = e.insert(shape.clone())),
        3 => of(world, obstacle, &|e| _ = e.insert(Door)),
        4 => of(world, obstacle, &|e| _ = e.remove::<Door>()),
        5 => of(world, obstacle, &|e| _ = e.remove::<ObstacleOf>()),
        6 => of(world, obstacle, &|e| {
            if let Some(home) = home {
                e.insert(ObstacleOf(home));
            }
        }),
        7 => of(world, obstacle, &|e| _ = e.remove::<ObstacleShape>()),
        8 => obstacle.into_iter().for_each(|e| _ = world.despawn(e)),
        9 => home.into_iter().for_each(|home| _ = world.spawn((shape.clone(), ObstacleOf(home)))),
        10 => of(world, sensor, &|e| _ = e.insert(fan)),
        11 => of(world, sensor, &|e| _ = e.insert((SensorName("front".into()), SensorMount(pose)))),
        12 => of(world, sensor, &|e| _ = e.remove::<(SensorModel, SensorNoise)>()),
        13 => of(world, sensor, &|e| _ = e.insert(Scan::default())),
        14 => sensor.into_iter().for_each(|e| _ = world.despawn(e)),
        15 => robot.into_iter().for_each(|robot| _ = world.spawn((fan, SensorName("more".into()), MountedOn(robot)))),
        16 => of(world, home, &|e| _ = e.remove::<WorldScene>()),
        _ => home.into_iter().filter(|_| draws.below(4) == 0).for_each(|home| _ = world.despawn(home)),
    }
}

/// Sends a command.
fn command(world: &mut Ecs, draws: &mut Stream) {
    let name = one(draws, &NAMES);
    let robot = |input| RunCommand::from(RobotCommand { robot: name.into(), input });
    let of_world = |change| RunCommand::from(WorldCommand { world: "yard".into(), change });
    let to = vec![Quantized(1 << 19), Quantized(-(1 << 20)), Quantized(0)];
    let at = (Quantized(1 << 20), Quantized(1 << 21), Quantized(0));
    let command = match draws.below(20) {
        0 | 1 => robot(RobotInput::Drive(draws.below(300) as i16 - 150, 30)),
        2 => robot(RobotInput::Teleport(to)),
        3 => robot(RobotInput::MoveTo(to[..2].to_vec())),
        4 => robot(RobotInput::Release),
        5 => robot(RobotInput::SetTrailer(draws.below(2) == 0)),
        6 => of_world(WorldChange::Close("gate".into())),
        7 => of_world(WorldChange::Open("gate".into())),
        8 => of_world(WorldChange::Remove(name.into())),
        9 => of_world(WorldChange::Move { name: name.into(), to: at }),
        10 => {
            of_world(WorldChange::Add { name: "added".into(), points: vec![(at.0, at.1)], radius: Quantized(1 << 17) })
        }
        11 => TransportCommand::Seek(draws.below(12)).into(),
        12 => TransportCommand::Seek(0).into(),
        13 => TransportCommand::StepBack.into(),
        14 => TransportCommand::ContinueFromHere.into(),
        15 => {
            one(draws, &[TransportCommand::Reset, TransportCommand::ReRoll, TransportCommand::SetSeed(Seed(3))]).into()
        }
        16 => TransportCommand::Checkpoint.into(),
        17 => TransportCommand::Redo.into(),
        18 => TransportCommand::SetLooping(draws.below(2) == 0).into(),
        _ => TransportCommand::Undo.into(),
    };
    world.write_message(command);
}

/// Does one thing to a run, by whoever may.
fn act(app: &mut App, draws: &mut Stream) {
    let world = app.world_mut();
    match draws.below(16) {
        0 => write::<Rusty>(world, draws),
        1 => write::<Reach<2>>(world, draws),
        2 => write::<Hitch>(world, draws),
        3 | 4 => change_robot(world, draws),
        5 | 6 => change_thing(world, draws),
        7..=9 => command(world, draws),
        10 => app.update(),
        11 => step(world),
        12 => play_tick(world),
        13 => world.resource_mut::<Transport>().playback = one(draws, &[Playback::Playing, Playback::Paused]),
        _ => steps(world, 2),
    }
}

/// `MOTION_LAB_SEQUENCES` sets the number of sequences.
#[test]
fn entities_configuration_and_frame_agree_after_any_sequence_and_the_run_has_its_bits_elsewhere() {
    let sequences = count_from_env("MOTION_LAB_SEQUENCES", 2_000);
    let mut app = app();
    let (mut refusals, mut at_start, mut later) = (0, 0, 0);
    for number in 0..sequences {
        let draws = &mut Stream::new(Seed(number), "sequence");
        // an app is that of fifty sequences: what others have spawned outlives a run
        if number.is_multiple_of(50) {
            app = super::app();
        }
        start_run(app.world_mut(), config(), Seed(number)).unwrap();
        if draws.below(2) == 0 {
            steps(app.world_mut(), draws.below(6));
        }
        for _ in 0..4 + draws.below(12) {
            act(&mut app, draws);
        }
        let panic = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            app.update();
            settle(app.world_mut());
            assert_agrees(app.world_mut());
            assert_recorded(app.world());
            let straight = frame(app.world());
            // there and back
            steps(app.world_mut(), 3);
            assert_recorded(app.world());
            send(&mut app, TransportCommand::Pause);
            send(&mut app, TransportCommand::Seek(0));
            assert_agrees(app.world_mut());
            assert_recorded(app.world());
            send(&mut app, TransportCommand::Seek(straight.tick));
            assert_eq!(frame(app.world()).digest(), straight.digest());
        }));
        panic.unwrap_or_else(|_| panic!("sequence {number}"));
        refusals += refused(app.world_mut()).len();
        *(if frame(app.world()).tick == 0 { &mut at_start } else { &mut later }) += 1;
    }
    assert!(refusals as u64 > sequences, "{refusals} refused");
    assert!(at_start as u64 > sequences / 20 && later as u64 > sequences / 4, "{at_start} at tick 0, {later} later");
}
