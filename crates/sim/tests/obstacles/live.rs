//! Doors opened and closed in a run under way, as a window does it.

use motion_lab_sim::recording::{Run, verify};
use motion_lab_sim::run::ReadLog;
use motion_lab_sim::simulation::{
    App, CommandRefused, LatestFrame, PendingInput, RunCommand, SimulationPlugin, Transport, TransportCommand,
    WorldCommand, seek, start_run, step,
};

use super::*;

fn app() -> App {
    let mut app = App::new();
    app.add_plugins((bevy::time::TimePlugin, SimulationPlugin));
    start_run(app.world_mut(), apartment(600), Seed(2005)).unwrap();
    app.update();
    app
}

fn send(app: &mut App, change: WorldChange) {
    app.world_mut().write_message(RunCommand::from(TransportCommand::Checkpoint));
    app.world_mut().write_message(RunCommand::from(WorldCommand { world: "Apartment".into(), change }));
    app.update();
}

fn run_to(app: &mut App, tick: u64) {
    while app.world().resource::<Transport>().tick() < tick {
        step(app.world_mut());
    }
}

fn frame(app: &App) -> Frame {
    app.world().resource::<LatestFrame>().frame().clone()
}

fn script(app: &App) -> Script {
    app.world().resource::<PendingInput>().script().clone()
}

fn refused(app: &mut App) -> Vec<String> {
    app.update();
    let mut messages = app.world_mut().resource_mut::<bevy::prelude::Messages<CommandRefused>>();
    messages.drain().map(|CommandRefused(error)| error.to_string()).collect()
}

#[test]
fn a_door_closed_by_hand_is_in_the_script_the_log_and_the_undo() {
    let mut app = app();
    run_to(&mut app, 50);
    send(&mut app, close());
    assert_eq!(script(&app), changes(&[(51, close())]));
    assert_eq!(script(&app).version, 2);
    run_to(&mut app, 600);
    let last = frame(&app);
    assert!(y(&last) > 4.86);
    // a run from the script alone, its log as a file, read and simulated again
    let log = Run::record(apartment(600), (Seed(2005), script(&app))).unwrap();
    assert_eq!(log.frames()[599], last);
    let mut file = Vec::new();
    log.write_mcap(&mut file).unwrap();
    let read: ReadLog = Log::read_mcap(&file).unwrap();
    assert_eq!(read.log, log);
    assert_eq!(verify(&read.log, |_| {}).unwrap().identical, 600);
    // the undo forgets the change and all that came of it
    app.world_mut().write_message(RunCommand::from(TransportCommand::Undo));
    app.update();
    assert_eq!(script(&app), Script::empty());
    run_to(&mut app, 600);
    let free = Run::record(apartment(600), Seed(2005)).unwrap();
    assert_eq!(frame(&app), free.frames()[599]);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Redo));
    app.update();
    seek(app.world_mut(), 600).unwrap();
    assert_eq!(frame(&app), last);
}

#[test]
fn of_several_changes_of_a_door_in_a_tick_the_last_wins() {
    let mut app = app();
    run_to(&mut app, 5);
    for change in [close(), open(), close()] {
        send(&mut app, change);
    }
    assert_eq!(script(&app), changes(&[(6, close())]));
    run_to(&mut app, 10);
    // taken back, and another world continued from there
    seek(app.world_mut(), 3).unwrap();
    send(&mut app, WorldChange::Remove("A's bed".into()));
    assert_eq!(script(&app), changes(&[(4, WorldChange::Remove("A's bed".into()))]));
    assert_eq!(app.world().resource::<Transport>().frontier(), 3, "what came later is forgotten");
}

#[test]
fn what_is_added_is_numbered_as_the_script_has_it_whatever_was_undone() {
    let post = |name: &str, x: f64| WorldChange::Add {
        name: name.into(),
        points: vec![(quantized(x), quantized(7.0))],
        radius: quantized(0.1),
    };
    let mut app = app();
    run_to(&mut app, 2);
    send(&mut app, post("one", 4.5));
    run_to(&mut app, 4);
    send(&mut app, post("two", 5.0));
    run_to(&mut app, 6);
    app.world_mut().write_message(RunCommand::from(TransportCommand::Undo));
    app.update();
    send(&mut app, post("three", 7.5));
    run_to(&mut app, 20);
    let log = Run::record(apartment(600), (Seed(2005), script(&app))).unwrap();
    assert_eq!(frame(&app), log.frames()[19]);
    let first = (World::apartment().obstacles.len() + World::apartment().doors.len()) as u32;
    assert_eq!(frame(&app).obstacles.iter().map(|o| o.obstacle).collect::<Vec<_>>(), [first, first + 1]);
    // a name that is taken is refused, and nothing else happens
    send(&mut app, post("three", 4.2));
    assert_eq!(refused(&mut app), ["the name \"three\" is taken in world \"Apartment\""]);
    assert_eq!(frame(&app), log.frames()[19]);
}

#[test]
fn a_door_where_a_robot_stands_stays_open_and_says_why() {
    use motion_lab_sim::run::RobotInput;
    use motion_lab_sim::simulation::RobotCommand;
    let mut app = app();
    let input = RobotInput::Teleport([2.9375, 4.75, 0.0].map(quantized).to_vec());
    app.world_mut().write_message(RunCommand::from(RobotCommand { robot: "Rusty".into(), input }));
    app.update();
    run_to(&mut app, 1);
    send(&mut app, close());
    let why = "tick 2: \"door A\" in world \"Apartment\" stays as it is: robot \"Rusty\" stands there";
    assert_eq!(refused(&mut app), [why]);
    assert!(script(&app).changes.is_empty(), "what is refused at once is no input");
    // in a script it stays, and the run says so when it comes to it
    let script = Script { events: script(&app).events, ..changes(&[(2, close())]) };
    start_run(app.world_mut(), apartment(600), (Seed(2005), script)).unwrap();
    run_to(&mut app, 3);
    assert_eq!(refused(&mut app), [why]);
    assert!(frame(&app).obstacles.is_empty());
    // gone over again, it is no news
    seek(app.world_mut(), 0).unwrap();
    seek(app.world_mut(), 3).unwrap();
    assert!(refused(&mut app).is_empty());
}

/// A post called `post` of these points and radius about (4.5, 7), and how far it is from a point at (4.5, 7.3), by
/// hand.
type Post = (&'static [(f64, f64)], f64, f64);

/// No two differ in less than the name: in the radius, in the place, in the number of points, in a single point.
const POSTS: [Post; 5] = [
    (&[(4.5, 7.0)], 0.125, 0.175),
    (&[(4.5, 7.0)], 0.0625, 0.2375),
    (&[(4.5, 7.0625)], 0.0625, 0.175),
    (&[(4.25, 7.0), (4.75, 7.0)], 0.125, 0.175),
    (&[(4.25, 7.0), (4.75, 7.0), (4.5, 7.125)], 0.125, 0.05),
];

/// Fails unless this post stands there, as the scene, the world as it stands and the entities have it.
#[track_caller]
fn assert_stands(app: &mut App, post: Option<Post>, why: &str) {
    use bevy::prelude::RelationshipTarget;
    use motion_lab_core::collision::Collision;
    use motion_lab_core::geometry::Footprint;
    use motion_lab_sim::simulation::{ObstacleShape, Obstacles, Placement, Roster, StandingWorld, WorldScene};
    let world = app.world();
    let of_world = world.resource::<Roster>().worlds()[0];
    let distance = world.get::<WorldScene>(of_world).unwrap().0.distance(&Footprint::disc(Point2::new(4.5, 7.3), 0.0));
    // without a post a wall of the room is nearer than 70 cm
    let expected = post.map_or(0.3..0.7, |(.., distance)| distance - 1e-5..distance + 1e-5);
    assert!(expected.contains(&distance), "{why}: {distance} m");
    let corners = |pieces: &[(Pose2, Shape)]| -> Vec<(usize, f64)> {
        pieces.iter().map(|(at, shape)| shape.place(at)).map(|piece| (piece.core().len(), piece.radius())).collect()
    };
    let expected: Vec<_> = post.into_iter().map(|(points, radius, _)| vec![(points.len(), radius)]).collect();
    let obstacles = &world.get::<StandingWorld>(of_world).unwrap().0.obstacles;
    let named = obstacles.iter().filter(|o| o.name == "post").map(|o| corners(&o.pieces));
    assert_eq!(named.collect::<Vec<_>>(), expected, "{why}");
    // one that the script adds later is an entity that is not there yet
    let is_there = |e: &bevy::prelude::Entity| world.get::<Placement>(*e).unwrap().present;
    let entities = world.get::<Obstacles>(of_world).unwrap().iter().filter(is_there);
    let shapes = entities.filter_map(|e| world.get::<ObstacleShape>(e)).filter(|shape| shape.name == "post");
    let named = shapes.map(|shape| corners(&shape.pieces));
    assert_eq!(named.collect::<Vec<_>>(), expected, "{why}: entities");
}

#[test]
fn of_posts_of_one_name_the_one_of_the_script_stands_over_undo_and_redo() {
    let add = |(points, radius, _): Post| WorldChange::Add {
        name: "post".into(),
        points: points.iter().map(|(x, y)| (quantized(*x), quantized(*y))).collect(),
        radius: quantized(radius),
    };
    let command = |app: &mut App, command: TransportCommand| {
        app.world_mut().write_message(RunCommand::from(command));
        app.update();
    };
    for (i, one) in POSTS.into_iter().enumerate() {
        for (k, other) in POSTS.into_iter().enumerate().filter(|(k, _)| *k != i) {
            let pair = |when: &str| format!("{i} and {k}, {when}");
            let mut app = app();
            run_to(&mut app, 2);
            assert_stands(&mut app, None, &pair("at first"));
            send(&mut app, add(one));
            run_to(&mut app, 6);
            assert_stands(&mut app, Some(one), &pair("added"));
            let first = frame(&app);
            // the run is continued from before the post, with another one in its place
            seek(app.world_mut(), 2).unwrap();
            assert_stands(&mut app, None, &pair("before it was added"));
            send(&mut app, add(other));
            run_to(&mut app, 8);
            assert_stands(&mut app, Some(other), &pair("added instead"));
            // from script to script, without a run in between that has none
            command(&mut app, TransportCommand::Undo);
            seek(app.world_mut(), 6).unwrap();
            assert_stands(&mut app, Some(one), &pair("undone"));
            assert_eq!(frame(&app), first, "{}", pair("undone"));
            command(&mut app, TransportCommand::Redo);
            seek(app.world_mut(), 6).unwrap();
            assert_stands(&mut app, Some(other), &pair("done again"));
            command(&mut app, TransportCommand::Undo);
            command(&mut app, TransportCommand::Undo);
            assert_stands(&mut app, None, &pair("both undone"));
            assert_eq!(script(&app), Script::empty());
            run_to(&mut app, 8);
            assert_stands(&mut app, None, &pair("both undone, and played on"));
            assert!(frame(&app).obstacles.is_empty());
            // its name is free again
            send(&mut app, add(other));
            assert_eq!(refused(&mut app), [""; 0]);
            run_to(&mut app, 10);
            assert_stands(&mut app, Some(other), &pair("added anew"));
        }
    }
}
