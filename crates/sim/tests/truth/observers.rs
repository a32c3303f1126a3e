//! Observers of others, which answer what the simulation itself spawns, inserts and removes.

use bevy::prelude::{Add, App, Commands, Entity, Insert, Local, On, Query, Res, With};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{RUSTY, Rusty};
use motion_lab_core::worlds::World;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Script, WorldChange, WorldEvent};
use motion_lab_sim::simulation::{
    Configuration, MountedOn, Placement, RobotId, RobotModel, RobotName, RunConfig, Scan, SimulatedWorld, Transport,
    settle,
};

use super::*;

/// An app with these observers and no run yet.
fn with(observers: impl FnOnce(&mut App)) -> App {
    let mut app = App::new();
    app.add_plugins((TimePlugin, SimulationPlugin));
    observers(&mut app);
    app
}

/// Starts the run of [`config`], and fails unless it is the one of `expected`.
#[track_caller]
fn assert_starts_as(mut app: App, expected: &TourConfig) -> App {
    start_run(app.world_mut(), config(), Seed(7)).unwrap();
    settle(app.world_mut());
    let worlds = |worlds: &[World]| worlds.iter().map(|w| (w.obstacles.clone(), w.robots.clone())).collect::<Vec<_>>();
    assert_eq!(worlds(&app.world().resource::<RunConfig>().config().worlds), worlds(&expected.worlds));
    assert_agrees(app.world_mut());
    let log = Run::record(TourConfig { ticks: 10, ..expected.clone() }, Seed(7)).unwrap();
    steps(app.world_mut(), 10);
    assert_eq!(log.frames().last().unwrap().digest(), frame(app.world()).digest());
    app
}

#[test]
fn what_observers_make_of_a_start_is_the_start() {
    let moves = |on: On<Add, RobotId>, names: Query<&RobotName>, mut commands: Commands| {
        if names.get(on.entity).is_ok_and(|name| name.name == "A") {
            commands.entity(on.entity).insert(Configuration::<Rusty>(Pose2::new(0.25, -1.0, 0.5)));
        }
    };
    let mut expected = config();
    expected.worlds[0].robots[0].start = vec![0.25, -1.0, 0.5];
    _ = assert_starts_as(with(|app| _ = app.add_observer(moves)), &expected);

    let despawns = |on: On<Insert, RobotName>, names: Query<&RobotName>, mut commands: Commands| {
        if names.get(on.entity).is_ok_and(|name| name.name == "B") {
            commands.entity(on.entity).despawn();
        }
    };
    let mut expected = config();
    expected.worlds[0].robots.remove(1);
    _ = assert_starts_as(with(|app| _ = app.add_observer(despawns)), &expected);

    let clears = |on: On<Add, Placement>, mut commands: Commands| commands.entity(on.entity).despawn();
    let mut expected = config();
    expected.worlds[0].obstacles.clear();
    expected.worlds[0].doors.clear();
    _ = assert_starts_as(with(|app| _ = app.add_observer(clears)), &expected);

    let blinds = |on: On<Add, MountedOn>, mut commands: Commands| commands.entity(on.entity).despawn();
    let app = assert_starts_as(with(|app| _ = app.add_observer(blinds)), &TourConfig { sensor: None, ..config() });
    assert!(frame(app.world()).scans.is_empty());
}

#[test]
fn a_robot_that_was_spawned_before_the_first_run_is_left_out_aloud() {
    let mut app = with(|_| ());
    let q = Configuration::<Rusty>(Pose2::new(0.0, -1.0, 0.0));
    let ghost = app.world_mut().spawn((RobotModel(RUSTY), q, named("ghost", "rusty"))).id();
    let mut app = assert_starts_as(app, &config());
    assert!(!app.world().entity(ghost).contains::<RobotModel<Rusty>>());
    let said = refused(app.world_mut());
    assert!(said.len() == 1 && said[0].starts_with("robot \"ghost\" (entity "), "{said:?}");
}

/// Closes the gate at tick 12 in an app with an observer, and fails unless the run is that of an app without.
#[track_caller]
fn assert_unmoved(observers: impl FnOnce(&mut App)) -> Vec<String> {
    let mut app = with(|_| ());
    let close = WorldEvent { tick: 12, world: "yard".into(), change: WorldChange::Close("gate".into()) };
    start_run(app.world_mut(), config(), (Seed(7), Script::new(vec![], vec![close]))).unwrap();
    observers(&mut app);
    for _ in 0..20 {
        step(app.world_mut());
        settle(app.world_mut());
        assert_agrees(app.world_mut());
        assert_recorded(app.world());
    }
    let said = refused(app.world_mut());
    // and back, where the gate opens
    send(&mut app, TransportCommand::Seek(5));
    settle(app.world_mut());
    assert_agrees(app.world_mut());
    assert_recorded(app.world());
    said
}

#[test]
fn observers_of_obstacles_that_move_in_a_run_take_nothing_from_it() {
    let gone = "it was despawned past the run's commands, and is back as another entity";
    let said = assert_unmoved(|app| {
        app.add_observer(|_: On<Insert, Placement>, robots: Query<Entity, With<RobotId>>, mut commands: Commands| {
            robots.iter().for_each(|robot| commands.entity(robot).despawn());
        });
    });
    for name in ["robot \"A\"", "robot \"D\"", "sensor \"\" of robot \"B\""] {
        assert!(said.iter().any(|text| text.starts_with(name) && text.ends_with(gone)), "{name}: {said:?}");
    }
    let said = assert_unmoved(|app| {
        app.add_observer(|_: On<Insert, Placement>, robots: Query<Entity, With<RobotId>>, mut commands: Commands| {
            for robot in robots {
                commands.entity(robot).remove::<Configuration<Rusty>>();
            }
        });
    });
    assert!(said.iter().any(|text| text.contains("): one of its components was changed past")), "{said:?}");
    let said = assert_unmoved(|app| {
        // once, for what fights the simulation at every turn has its way with the entities
        let despawn = |_: On<Insert, Placement>,
                       worlds: Query<Entity, With<SimulatedWorld>>,
                       mut commands: Commands,
                       mut has_been: Local<bool>| {
            if !std::mem::replace(&mut *has_been, true) {
                worlds.iter().for_each(|world| commands.entity(world).despawn());
            }
        };
        app.add_observer(despawn);
    });
    assert!(said.iter().any(|text| text.starts_with("world \"yard\"") && text.ends_with(gone)), "{said:?}");
    let said = assert_unmoved(|app| {
        app.add_observer(
            |_: On<Insert, Placement>, mut robots: Query<&mut Configuration<Rusty>>, mut scans: Query<&mut Scan>| {
                robots.iter_mut().for_each(|mut q| q.0.x += 0.5);
                scans.iter_mut().for_each(|mut scan| *scan = Scan::default());
            },
        );
    });
    assert!(said.iter().any(|text| text.contains("): Configuration<Rusty> was changed past")), "{said:?}");
    let said = assert_unmoved(|app| {
        app.add_observer(|on: On<Insert, Placement>, mut commands: Commands, mut has_been: Local<bool>| {
            if !std::mem::replace(&mut *has_been, true) {
                commands.entity(on.entity).despawn();
            }
        });
    });
    assert!(said.iter().any(|text| text.starts_with("obstacle \"gate\"") && text.ends_with(gone)), "{said:?}");
}

#[test]
fn what_a_script_adds_is_there_once_however_often_a_run_begins() {
    let mut app = with(|app| _ = app.add_observer(|_: On<Add, RobotId>| ()));
    let at = motion_lab_sim::run::Quantized(1 << 20);
    let add = WorldChange::Add { name: "crate".into(), points: vec![(at, at)], radius: at };
    let script = Script::new(vec![], vec![WorldEvent { tick: 5, world: "yard".into(), change: add }]);
    let count = |app: &mut App| {
        let mut all = app.world_mut().query::<&motion_lab_sim::simulation::ObstacleShape>();
        all.iter(app.world()).filter(|shape| shape.name == "crate").count()
    };
    for _ in 0..3 {
        start_run(app.world_mut(), config(), (Seed(7), script.clone())).unwrap();
        for _ in 0..2 {
            let a = robot(app.world(), "A");
            app.world_mut().get_mut::<Configuration<Rusty>>(a).unwrap().0.x += 0.125;
            settle(app.world_mut());
            assert_eq!(count(&mut app), 1);
        }
        steps(app.world_mut(), 6);
        assert_eq!(count(&mut app), 1);
        assert_recorded(app.world());
    }
}

#[test]
fn an_observer_in_a_recorder_changes_no_bit_either() {
    let close = WorldEvent { tick: 12, world: "yard".into(), change: WorldChange::Close("gate".into()) };
    let recipe = motion_lab_sim::run::Recipe::new(config(), (Seed(7), Script::new(vec![], vec![close])));
    let writes = |_: On<Insert, Placement>, now: Res<Transport>, mut rovers: Query<&mut Configuration<Rusty>>| {
        // what it does to the start would be the start
        if now.tick() > 0 {
            rovers.iter_mut().for_each(|mut q| q.0.x += 0.5);
        }
    };
    let mut recorder = Recorder::of_with_robots(&recipe, |app| _ = app.add_observer(writes)).unwrap();
    let mut alone = Recorder::of(&recipe).unwrap();
    for _ in 0..20 {
        assert_eq!(recorder.step().digest(), alone.step().digest());
    }
}
