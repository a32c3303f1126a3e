//! The entities as the truth: before tick 0 the run follows them, later what others change is put back.

mod agreement;
mod in_run;
mod kept;
mod observers;
mod sequences;
mod start;
mod types;

use bevy::prelude::{Entity, Messages, World as Ecs};
use bevy::time::TimePlugin;
use motion_lab_core::geometry::Aabb;
use motion_lab_core::prelude::*;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Door, Obstacle, ObstacleKind, Resident, World};
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{Frame, RobotInput};
use motion_lab_sim::simulation::{
    App, CommandRefused, LatestFrame, RobotCommand, RobotName, Roster, RunCommand, SimulationPlugin, TransportCommand,
    recipe, start_run, step,
};
use motion_lab_sim::tour::TourConfig;

pub(crate) use agreement::assert_agrees;

/// Two rovers and a car behind a door in one world, an arm in another, a sensor of three rays on each rover.
pub(crate) fn config() -> TourConfig {
    let bounds = Aabb { min: Point2::new(-4.0, -4.0), max: Point2::new(4.0, 4.0) };
    let at = |x, y| vec![(Pose2::new(x, y, 0.0), Shape::Disc { radius: 0.2 })];
    let yard = World {
        obstacles: vec![
            Obstacle::new("post", ObstacleKind::Solid, at(0.0, 2.0)),
            Obstacle::new("bin", ObstacleKind::Solid, at(-2.0, 2.0)),
        ],
        doors: vec![Door { name: "gate".into(), a: Point2::new(2.0, 2.0), b: Point2::new(3.0, 2.0), open: true }],
        robots: vec![
            Resident::new("A", "rusty", [0.0, 0.0, 0.0]),
            Resident::new("B", "rusty", [1.0, 0.0, 1.0]),
            Resident::new("C", "hitch", [-2.0, -2.5, 0.0]),
        ],
        ..World::empty("yard", bounds)
    };
    let bench = World { robots: vec![Resident::new("D", "reach", [0.5, 0.5])], ..World::empty("bench", bounds) };
    TourConfig { worlds: vec![yard, bench], ticks: 40, sensor: Some(RangeSensor { n_rays: 3, max_range: 5.0 }) }
}

/// An app with the run of [`config`], paused at tick 0.
pub(crate) fn app() -> App {
    let mut app = App::new();
    app.add_plugins((TimePlugin, SimulationPlugin));
    start_run(app.world_mut(), config(), Seed(7)).unwrap();
    app
}

/// The entity of the robot with this name, whichever it is now.
pub(crate) fn robot(world: &Ecs, name: &str) -> Entity {
    world.resource::<Roster>().named(name).unwrap()
}

pub(crate) fn frame(world: &Ecs) -> Frame {
    world.resource::<LatestFrame>().frame().clone()
}

pub(crate) fn steps(world: &mut Ecs, ticks: u64) {
    (0..ticks).for_each(|_| step(world));
}

/// What was refused since this was asked last.
pub(crate) fn refused(world: &mut Ecs) -> Vec<String> {
    world.resource_mut::<Messages<CommandRefused>>().drain().map(|CommandRefused(error)| error.to_string()).collect()
}

/// Sends a command, and lets the app carry it out.
pub(crate) fn send(app: &mut App, command: TransportCommand) {
    app.world_mut().write_message(RunCommand::from(command));
    app.update();
}

pub(crate) fn drive(app: &mut App, robot: &str, channels: (i16, i16)) {
    let input = RobotInput::Drive(channels.0, channels.1);
    app.world_mut().write_message(RunCommand::from(RobotCommand { robot: robot.into(), input }));
    app.update();
}

/// Fails unless the run's configuration, seed and script, recorded elsewhere, give its frame to the last bit.
#[track_caller]
pub(crate) fn assert_recorded(world: &Ecs) {
    let now = frame(world);
    let mut recorder = Recorder::of(&recipe(world).unwrap()).unwrap();
    let recorded = recorder.seek(now.tick).unwrap();
    assert_eq!(*recorded, now);
    assert_eq!(recorded.digest(), now.digest(), "equal as numbers, but not in their bits");
}

/// A name for a robot that is to be spawned.
pub(crate) fn named(name: &str, kind: &str) -> RobotName {
    RobotName::new(name, kind)
}
