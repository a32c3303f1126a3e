//! Before tick 0 the obstacle entities are the truth, whoever spawned them; in a run they are not.

use bevy::prelude::{Add, Commands, On, Query, RelationshipTarget};
use motion_lab_core::geometry::Shape;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Obstacle, ObstacleKind};
use motion_lab_sim::recording::Run;
use motion_lab_sim::simulation::{
    App, CommandError, CommandRefused, LatestFrame, ObstacleOf, ObstacleShape, Obstacles, Placement, Roster, RunConfig,
    SimulatedWorld, SimulationPlugin, start_run, step,
};

use super::*;

type Ecs = bevy::prelude::World;

fn app(ticks: u64) -> App {
    let mut app = App::new();
    app.add_plugins((bevy::time::TimePlugin, SimulationPlugin));
    start_run(app.world_mut(), apartment(ticks), Seed(2005)).unwrap();
    app
}

fn frames(world: &mut Ecs, ticks: u64) -> Vec<Frame> {
    let mut frames = Vec::new();
    for _ in 0..ticks {
        step(world);
        frames.push(world.resource::<LatestFrame>().frame().clone());
    }
    frames
}

fn apartment_entity(world: &Ecs) -> bevy::prelude::Entity {
    world.resource::<Roster>().worlds()[0]
}

fn find(world: &Ecs, name: &str) -> bevy::prelude::Entity {
    let obstacles = world.get::<Obstacles>(apartment_entity(world)).unwrap();
    obstacles.iter().find(|&e| world.get::<ObstacleShape>(e).unwrap().name == name).unwrap()
}

fn bar(name: &str, y: f64) -> ObstacleShape {
    let segment = Shape::try_segment(Point2::new(2.0, y), Point2::new(3.75, y)).unwrap();
    ObstacleShape { name: name.into(), kind: ObstacleKind::Wall, pieces: vec![(Pose2::IDENTITY, segment)] }
}

/// The frames of the same world written out as a file has it.
fn recorded(edit: impl FnOnce(&mut World), ticks: u64) -> Log {
    let mut config = apartment(ticks);
    edit(&mut config.worlds[0]);
    Run::record(config, Seed(2005)).unwrap()
}

/// The run of an app whose observers spawn a bar or take a bed away within `start_run`, when the world's own obstacles
/// are being spawned.
fn observed(spawns: bool, removes: bool) -> Vec<Frame> {
    let mut app = App::new();
    app.add_plugins((bevy::time::TimePlugin, SimulationPlugin));
    app.add_observer(move |on: On<Add, SimulatedWorld>, worlds: Query<&SimulatedWorld>, mut commands: Commands| {
        if spawns && worlds.get(on.entity).unwrap().model.name == "Apartment" {
            commands.spawn((bar("bar 1", 5.3), ObstacleOf(on.entity)));
        }
    });
    app.add_observer(move |on: On<Add, ObstacleShape>, shapes: Query<&ObstacleShape>, mut commands: Commands| {
        if removes && shapes.get(on.entity).unwrap().name == "A's bed" {
            commands.entity(on.entity).insert(Placement { present: false, ..Placement::default() });
        }
    });
    start_run(app.world_mut(), seeing(400), Seed(2005)).unwrap();
    frames(app.world_mut(), 400)
}

/// The Apartment with a sensor on its rover.
fn seeing(ticks: u64) -> TourConfig {
    TourConfig { sensor: Some(RangeSensor { n_rays: 36, max_range: 20.0 }), ..apartment(ticks) }
}

#[test]
fn what_observers_spawn_and_move_as_the_run_starts_is_met() {
    let expected = |spawns: bool, removes: bool| {
        let mut config = seeing(400);
        config.worlds[0].obstacles.retain(|o| !removes || o.name != "A's bed");
        let bar = Obstacle::new("bar 1", ObstacleKind::Wall, bar("bar 1", 5.3).pieces);
        config.worlds[0].obstacles.extend(spawns.then_some(bar));
        Run::record(config, Seed(2005)).unwrap().into_frames()
    };
    for (spawns, removes) in [(true, false), (false, true), (true, true)] {
        assert!(observed(spawns, removes) == expected(spawns, removes), "{spawns} {removes}");
    }
    assert!(expected(true, false) != expected(false, false), "the bar is met");
    assert!(expected(false, true) != expected(false, false), "the bed is seen");
}

#[test]
fn what_is_spawned_moved_and_removed_is_what_robots_meet() {
    // two bars, by their names in whatever order they are spawned; the lower one holds Rusty
    for names in [["bar 1", "bar 2"], ["bar 2", "bar 1"]] {
        let mut app = app(400);
        let world = app.world_mut();
        let apartment = apartment_entity(world);
        for name in names {
            let y = if name == "bar 1" { 5.3 } else { 5.5 };
            world.spawn((bar(name, y), ObstacleOf(apartment)));
        }
        world.despawn(find(world, "A's bed"));
        let away = Placement { present: false, ..Placement::default() };
        world.entity_mut(find(world, "A's wardrobe")).insert(away);
        // a door is closed, and put half a metre to the right
        let aside = Placement { present: true, pose: Pose2::new(0.5, 0.0, 0.0) };
        world.entity_mut(find(world, "door E")).insert(aside);
        let up = Placement { present: true, pose: Pose2::new(0.0, 0.25, 0.0) };
        world.entity_mut(find(world, "A's armchair")).insert(up);
        let found = frames(world, 400);
        let expected = recorded(
            |world| {
                world.obstacles.retain(|o| o.name != "A's bed" && o.name != "A's wardrobe");
                (world.doors[4].a, world.doors[4].b) = (Point2::new(9.0, 3.25), Point2::new(8.125, 3.25));
                world.doors[4].open = false;
                let chair = world.obstacles.iter_mut().find(|o| o.name == "A's armchair").unwrap();
                *chair = Obstacle::new("A's armchair", ObstacleKind::Solid, chair.pieces.clone());
                chair.pieces[0].0 = Pose2::new(0.0, 0.25, 0.0);
                for bar in [bar("bar 1", 5.3), bar("bar 2", 5.5)] {
                    world.obstacles.push(Obstacle::new(bar.name, bar.kind, bar.pieces));
                }
            },
            400,
        );
        assert_eq!(found, expected.frames());
        assert!(found.iter().all(|f| y(f) > 5.6), "held above the upper bar");
        let config = world.resource::<RunConfig>().config().clone();
        assert_eq!(config.worlds, expected.recipe.config.worlds, "and the run's own configuration says so");
    }
    assert!(recorded(|_| {}, 400).frames().iter().any(|f| y(f) < 5.3), "without the bars it drives on");
}

#[test]
fn what_no_world_could_have_is_left_out_aloud() {
    let mut app = app(10);
    let world = app.world_mut();
    let apartment = apartment_entity(world);
    let nan = Shape::Disc { radius: f64::NAN };
    for (name, pieces) in [
        ("the outer wall", vec![(Pose2::IDENTITY, Shape::Disc { radius: 1.0 })]), // taken
        ("Rusty", vec![(Pose2::IDENTITY, Shape::Disc { radius: 1.0 })]),          // by a robot
        ("nothing", vec![]),
        ("not a number", vec![(Pose2::IDENTITY, nan)]),
        (" padded", vec![(Pose2::IDENTITY, Shape::Disc { radius: 1.0 })]),
    ] {
        let shape = ObstacleShape { name: name.into(), kind: ObstacleKind::Solid, pieces };
        world.spawn((shape, ObstacleOf(apartment)));
    }
    assert_eq!(frames(world, 10), recorded(|_| {}, 10).frames());
    let refused = world.resource_mut::<bevy::prelude::Messages<CommandRefused>>().drain().count();
    assert_eq!(refused, 5);
}

#[test]
fn in_a_run_a_change_from_outside_has_no_effect_and_is_refused_aloud() {
    let mut app = app(60);
    let world = app.world_mut();
    let mut found = frames(world, 20);
    let apartment = apartment_entity(world);
    world.despawn(find(world, "the outer wall"));
    let bar_entity = world.spawn((bar("bar", 5.5), ObstacleOf(apartment))).id();
    let door = find(world, DOOR);
    world.entity_mut(door).insert(Placement::default());
    found.extend(frames(world, 40));
    assert_eq!(found, recorded(|_| {}, 60).frames());
    let refused: Vec<String> = world
        .resource_mut::<bevy::prelude::Messages<CommandRefused>>()
        .drain()
        .map(|CommandRefused(error)| match error {
            CommandError::Foreign(change) => format!("{} {}", change.thing, change.component),
            other => panic!("{other}"),
        })
        .collect();
    let expected = [
        "obstacle \"the outer wall\" in world \"Apartment\" ".to_owned(),
        "obstacle \"bar\" ObstacleShape".to_owned(),
        format!("obstacle {DOOR:?} in world \"Apartment\" Placement"),
    ];
    assert_eq!(refused, expected);
    assert!(world.get_entity(bar_entity).is_ok_and(|bar| !bar.contains::<ObstacleShape>()), "the entity stays");
    assert!(!world.get::<Placement>(door).unwrap().present, "the door is open, as the run has it");
    find(world, "the outer wall");
}
