//! The lab in a Bevy app of one's own: two systems and an observer beside the simulation's own.
//!
//! `cargo run --example bevy_app`
//!
//! One system drives the rover by commands, which become the run's script; the other writes down where it is. The
//! observer counts contacts. What the app ran is recorded again at the end, from seed and script, to the last bit.
#![allow(clippy::print_stdout, dead_code)]

use std::error::Error;
use std::time::Duration;

use bevy::prelude::{
    App, FixedPostUpdate, IntoScheduleConfigs, MessageWriter, On, Query, Res, ResMut, Resource, Update,
    resource_changed,
};
use bevy::time::TimeUpdateStrategy;
use motion_lab::collision::Collision;
use motion_lab::geometry::Tangent2;
use motion_lab::recording::Run;
use motion_lab::robots::{Robot, Rusty};
use motion_lab::run::{Frame, RobotInput};
use motion_lab::simulation::{
    Configuration, ContactBegan, DriveMode, LatestFrame, PendingInput, Playback, ResidesIn, RobotCommand, RobotModel,
    RobotName, RunCommand, Transport, WorldScene, headless_app, start_run,
};
use motion_lab::tour::{BOOK_SEED, TourConfig};

/// Ticks of the run: 40 s.
const TICKS: u64 = 800;

/// How far ahead the rover looks, metres.
const AHEAD: f64 = 0.3;

/// The clearance that it wants there, metres.
const ROOM: f64 = 0.1;

/// The channels for straight ahead, and for a turn on the spot at half the greatest rate.
const GO: [i16; 2] = [128, 0];
const TURN: [i16; 2] = [0, 64];

/// What the app writes down.
#[derive(Resource, Default)]
pub struct Diary {
    /// Its lines.
    pub lines: Vec<String>,
    /// The contacts so far.
    pub contacts: u32,
}

/// Drives every rover: straight ahead, and where there is no room it turns on the spot until there is plenty.
fn drive(
    rovers: Query<(&RobotName, &RobotModel<Rusty>, &Configuration<Rusty>, &DriveMode<Rusty>, &ResidesIn)>,
    scenes: Query<&WorldScene>,
    mut commands: MessageWriter<RunCommand>,
) {
    for (name, RobotModel(rover), Configuration(q), mode, ResidesIn(world)) in &rovers {
        let Ok(WorldScene(scene)) = scenes.get(*world) else { continue };
        let ahead = q.boxplus(&Tangent2::new(AHEAD, 0.0, 0.0));
        let wanted = if mode.channels == TURN { 3.0 * ROOM } else { ROOM };
        let channels = if scene.distance(&rover.footprint(&ahead)) < wanted { TURN } else { GO };
        if !(mode.manual && mode.channels == channels) {
            let input = RobotInput::Drive(channels[0], channels[1]);
            commands.write(RobotCommand { robot: name.name.clone(), input }.into());
        }
    }
}

/// Writes down where the rover is, every ten seconds of the run.
fn write_down(frame: Res<LatestFrame>, mut diary: ResMut<Diary>) {
    let Frame { tick, robots, .. } = frame.frame();
    if let Some(rover) = robots.first().filter(|_| tick.is_multiple_of(200)) {
        let [x, y] = [0, 1].map(|i| rover.configuration[i]);
        diary.lines.push(format!("tick {tick:3}: Rusty at ({x:.3}, {y:.3})"));
    }
}

/// Counts the contacts of all robots.
fn count(contact: On<ContactBegan>, robots: Query<&RobotName>, mut diary: ResMut<Diary>) {
    diary.contacts += 1;
    if let Some(robot) = robots.get(contact.robot).ok().filter(|_| diary.contacts <= 3) {
        diary.lines.push(format!("tick {:3}: {} met something", contact.tick, robot.name));
    }
}

/// The app: the lab, and what is added to it.
pub fn app() -> App {
    let mut app = headless_app();
    app.init_resource::<Diary>()
        .add_systems(FixedPostUpdate, drive)
        .add_systems(Update, write_down.run_if(resource_changed::<LatestFrame>))
        .add_observer(count);
    app
}

/// Runs the app for `ticks` ticks of the tour. A program that keeps up with the clock would call `app.run()` instead.
pub fn ran(ticks: u64) -> Result<App, Box<dyn Error>> {
    let mut app = app();
    start_run(app.world_mut(), TourConfig::default(), BOOK_SEED)?;
    app.world_mut().resource_mut::<Transport>().playback = Playback::Playing;
    // every update is a tick long, whatever the clock says
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
    while app.world().resource::<LatestFrame>().frame().tick < ticks {
        app.update();
    }
    Ok(app)
}

/// The program's output.
pub fn report() -> Result<String, Box<dyn Error>> {
    let app = ran(TICKS)?;
    let (frame, diary) = (app.world().resource::<LatestFrame>().frame(), app.world().resource::<Diary>());
    let mut lines = diary.lines.clone();
    lines.push(format!("{} contacts", diary.contacts));
    let mut script = app.world().resource::<PendingInput>().script().clone();
    lines.push(format!("{} inputs to the rover", script.events.len()));
    // an input of the last tick would apply at the next one
    script.events.retain(|event| event.tick <= TICKS);
    let log = Run::record(TourConfig { ticks: TICKS, ..TourConfig::default() }, (BOOK_SEED, script))?;
    let same = log.frames().last() == Some(frame);
    lines.push(format!("recorded again from its script: {}\n", if same { "the same bits" } else { "other bits" }));
    Ok(lines.join("\n"))
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}
