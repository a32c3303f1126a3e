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
