//! Many changes of a world within one tick, and how many changes a script may have.

use bevy::prelude::{Insert, On, Query, ResMut, Resource};
use motion_lab_core::geometry::Aabb;
use motion_lab_core::worlds::{Obstacle, ObstacleKind};
use motion_lab_sim::recording::{Recorder, Run};
use motion_lab_sim::run::{MAX_CHANGED_SHAPES, RobotInput};
use motion_lab_sim::simulation::{
    App, CommandError, CommandRefused, LatestFrame, Refusals, SceneRevision, SimulationPlugin, WorldScene, start_run,
    step,
};

use super::*;
use crate::simulator::event;

/// A disc of 5 cm.
fn post(name: &str, x: f64, y: f64) -> WorldChange {
    WorldChange::Add { name: name.into(), points: vec![(quantized(x), quantized(y))], radius: quantized(0.05) }
}

fn moved(name: &str, x: f64, y: f64) -> WorldChange {
    WorldChange::Move { name: name.into(), to: (quantized(x), quantized(y), quantized(0.0)) }
}

/// The numbers of obstacles of the scenes that a run has had.
#[derive(Resource, Default)]
struct Scenes(Vec<usize>);

/// The run of these changes, with Rusty held at (5, 6.75) from tick 1 on, and its scenes from tick 2 on.
fn run(of: &[(u64, WorldChange)], ticks: u64) -> (App, Vec<usize>) {
    let put = RobotInput::Teleport([5.0, 6.75, 0.0].map(quantized).to_vec());
    let events = vec![event(1, "Rusty", put), event(1, "Rusty", RobotInput::Drive(0, 0))];
    let script = Script { events, ..changes(of) };
    let mut app = App::new();
    app.add_plugins((bevy::time::TimePlugin, SimulationPlugin)).init_resource::<Scenes>();
    app.add_observer(|on: On<Insert, SceneRevision>, scenes: Query<&WorldScene>, mut seen: ResMut<Scenes>| {
        seen.0.extend(scenes.get(on.entity).map(|scene| scene.0.obstacle_count()));
    });
    start_run(app.world_mut(), apartment(ticks), (Seed(1), script)).unwrap();
    app.update();
    step(app.world_mut());
    let before = app.world().resource::<Scenes>().0.len();
    (1..ticks).for_each(|_| step(app.world_mut()));
    let scenes = app.world().resource::<Scenes>().0[before..].to_vec();
    (app, scenes)
}

fn frame(app: &App) -> &Frame {
    app.world().resource::<LatestFrame>().frame()
}

#[test]
fn the_changes_of_a_tick_make_one_scene() {
    let posts: Vec<(u64, WorldChange)> =
        (0..40).map(|k| (2 + k / 20, post(&format!("post {k}"), 4.2 + 0.02 * k as f64, 7.5))).collect();
    let (app, scenes) = run(&posts, 4);
    let own = World::apartment().obstacles.len();
    assert_eq!(scenes, [own + 20, own + 40], "one for each tick that changes the world");
    assert_eq!((app.world().resource::<Refusals>().count(), frame(&app).obstacles.len()), (0, 40));
}

#[test]
fn each_change_meets_what_those_before_it_in_the_tick_have_made_and_each_refusal_is_named() {
    // the disc of Rusty has a radius of 0.11 m: a post touches it whose middle is nearer than 0.16 m
    let all = [
        post("free", 5.0, 7.0),
        post("on it", 5.0, 6.8),
        moved("free", 0.0, -0.2),
        WorldChange::Remove("free".into()),
        moved("free", 0.0, -0.1),
        moved("on it", 0.0, 0.0),
        moved("free", 0.0, -0.05),
        moved("free", 0.0, -0.3),
        post("another", 5.15, 6.75),
        post("beside it", 5.17, 6.75),
    ];
    let of: Vec<(u64, WorldChange)> = all.into_iter().map(|change| (2, change)).collect();
    let (mut app, scenes) = run(&of, 3);
    assert_eq!(scenes.len(), 1);
    app.update();
    let mut messages = app.world_mut().resource_mut::<bevy::prelude::Messages<CommandRefused>>();
    let refused: Vec<String> = messages.drain().map(|CommandRefused(error)| error.to_string()).collect();
    let expected =
        |name: &str| format!("tick 2: {name:?} in world \"Apartment\" stays as it is: robot \"Rusty\" stands there");
    let names = ["on it", "free", "free", "on it", "free", "another"];
    assert_eq!(refused, names.map(expected));
    // `free` was put at 7.0, taken away, and came back at 7.0 - 0.05; `on it` never came
    assert_eq!(app.world().resource::<Refusals>().count(), 6);
    let states = &frame(&app).obstacles;
    let present: Vec<(bool, f64)> = states.iter().map(|state| (state.present, state.pose.y)).collect();
    assert_eq!(present, [(true, quantized(-0.05).value()), (true, 0.0)]);
}

/// A world of this many shapes, all of one obstacle, with a door.
fn large(shapes: usize) -> World {
    let bounds = Aabb { min: Point2::new(0.0, 0.0), max: Point2::new(9.0, 9.0) };
    let mut world = World::empty("large", bounds);
    let piece = |k: usize| (Pose2::new(1.0 + k as f64 * 1e-5, 1.0, 0.0), Shape::Disc { radius: 0.1 });
    world.obstacles.push(Obstacle::new("all", ObstacleKind::Solid, (1..shapes).map(piece).collect()));
    world.doors.push(motion_lab_core::worlds::Door {
        name: "door".into(),
        a: Point2::new(5.0, 5.0),
        b: Point2::new(6.0, 5.0),
        open: true,
    });
    world
}

fn of_large(changes: impl IntoIterator<Item = (u64, WorldChange)>) -> Script {
    let event = |(tick, change)| WorldEvent { tick, world: "large".into(), change };
    Script::new(vec![], changes.into_iter().map(event).collect())
}

#[test]
fn a_script_changes_no_world_more_often_than_its_size_allows() {
    assert_eq!(MAX_CHANGED_SHAPES, 1_000_000_000);
    let worlds = [large(100_000)];
    let door =
        |k: u64| if k.is_multiple_of(2) { WorldChange::Open("door".into()) } else { WorldChange::Close("door".into()) };
    // ten thousand ticks of a hundred thousand shapes
    assert_eq!(of_large((1..=10_000).map(|tick| (tick, door(tick)))).check_worlds(&worlds), Ok(()));
    let refused = of_large((1..=10_001).map(|tick| (tick, door(tick)))).check_worlds(&worlds).unwrap_err();
    let words = "changes[10000]: the worlds change too often for their size: ";
    assert!(refused.to_string().starts_with(words), "{refused}");
    // a tick makes one scene, however many changes it has
    assert_eq!(of_large((1..=900_000).map(|k| (1 + k / 100, door(k)))).check_worlds(&worlds), Ok(()));
    // but each change places what it changes: 100,000 shapes at first, then 9,999 times the 99,999 of an obstacle
    let around = |k: u64| moved("all", 1e-3 * (k % 2) as f64, 0.0);
    assert_eq!(of_large((1..=10_000).map(|k| (1, around(k)))).check_worlds(&worlds), Ok(()));
    let refused = of_large((1..=10_002).map(|k| (1, around(k)))).check_worlds(&worlds).unwrap_err();
    assert!(refused.to_string().starts_with("changes[10000]: the worlds change too often"), "{refused}");
    let script = of_large((1..=10_001).map(|tick| (tick, door(tick))));
    let config = TourConfig { worlds: worlds.to_vec(), ticks: 1, sensor: None };
    assert!(Run::record(config, (Seed(1), script)).unwrap_err().to_string().starts_with(words));
}

#[test]
fn a_script_adds_no_more_shapes_than_a_world_may_have() {
    let worlds = [large(99_000)];
    let posts = |count: u64| of_large((0..count).map(|k| (7, post(&format!("p{k}"), 1.0, 1.0))));
    assert_eq!(posts(1000).check_worlds(&worlds), Ok(()));
    let refused = posts(1001).check_worlds(&worlds).unwrap_err().to_string();
    let words = "world \"large\" would have more than 100000 shapes, with those that the script adds";
    assert_eq!(refused, format!("changes[1000]: {words}"));
    // one that is larger from the start may change
    let opened = of_large([(7, WorldChange::Close("door".into()))]);
    assert_eq!(opened.check_worlds(&[large(100_002)]), Ok(()));
}

/// Heap allocations of the changes of these numbers, which a live run takes within a tick.
fn allocations(live: &mut Recorder, numbers: std::ops::Range<usize>) -> u64 {
    let counted = allocation_counter::measure(|| {
        numbers.for_each(|k| live.change("Apartment", post(&format!("post {k}"), 4.2, 7.5)).unwrap());
    });
    counted.count_total
}

#[test]
fn a_live_run_takes_a_change_whatever_the_number_of_those_before_it() {
    let mut live = Recorder::new(apartment(5), Seed(1)).unwrap();
    let counts = [0..100, 100..200, 200..4000, 4000..4100].map(|numbers| allocations(&mut live, numbers));
    // the script's list and the entities' grow now and then
    assert!(counts[3] < counts[1] + 50 && counts[1] > 100, "{counts:?}");
    assert_eq!(live.script().changes.len(), 4100);
    live.step();
    assert_eq!((live.refusals().count(), live.frame().obstacles.len()), (0, 4100));
}

#[test]
fn a_live_run_refuses_the_changes_that_its_script_could_not_have() {
    let mut live = Recorder::new(apartment(40), Seed(1)).unwrap();
    let worlds = live.config().worlds.clone();
    let (door, a, b) = (World::apartment().doors[0].name.clone(), || "a".to_owned(), || "b".to_owned());
    let tries = |tick: u64| {
        let of = [
            post("a", 4.2, 7.5),
            post("a", 4.3, 7.5),
            post("b", 4.4, 7.5),
            WorldChange::Remove(a()),
            WorldChange::Remove("c".into()),
            moved("b", 0.1, 0.0),
            WorldChange::Close(b()),
            WorldChange::Open(door.clone()),
            WorldChange::Remove(door.clone()),
            post("", 1.0, 1.0),
        ];
        of.into_iter().map(move |change| WorldEvent { tick, world: "Apartment".into(), change })
    };
    let mut refused = Vec::new();
    // the run goes on, back behind its first change, whose names are free again, and on once more
    for tick in [0, 3, 7, 0, 3, 2] {
        live.seek(tick).unwrap();
        for event in
            tries(tick + 1).chain([WorldEvent { tick: tick + 1, world: "Lot".into(), change: post("d", 1.0, 1.0) }])
        {
            let mut script = live.script().clone();
            script.changes.retain(|change| {
                change.tick <= tick || change.tick <= event.tick && live.transport().frontier() == tick
            });
            script = Script::new(vec![], [script.changes, vec![event.clone()]].concat());
            let expected = script.check().and_then(|()| script.check_worlds(&worlds)).map_err(CommandError::Script);
            let given = live.change(&event.world, event.change);
            refused.push(given.is_err());
            assert_eq!(given, expected);
        }
    }
    let count = |is: bool| refused.iter().filter(|refused| **refused == is).count();
    assert!(count(true) > 25 && count(false) > 15, "{refused:?}");
}
