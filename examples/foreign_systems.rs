//! Who owns a run's entities: two systems that change them, at tick 0 and in the run, and what comes of it.
//!
//! `cargo run --example foreign_systems`
//!
//! At tick 0 the run follows its entities. Later each change is put back and refused, and the run stays a function of
//! its configuration, seed and script: it is recorded again from them at the end.
#![allow(clippy::print_stdout, dead_code)]

use std::error::Error;
use std::time::Duration;

use bevy::ecs::world::World;
use bevy::prelude::{App, Entity, Messages, PreUpdate, Update, With};
use bevy::time::TimeUpdateStrategy;
use motion_lab::configuration::HitchCfg;
use motion_lab::geometry::Pose2;
use motion_lab::recording::Recorder;
use motion_lab::robots::{HITCH, Hitch, Rusty};
use motion_lab::simulation::{
    CommandError, CommandRefused, Configuration, Door, DriveMode, LatestFrame, ObstacleOf, ObstacleShape, Playback,
    ResidesIn, RobotModel, RobotName, Roster, Transport, headless_app, recipe, start_run,
};
use motion_lab::tour::{BOOK_SEED, TourConfig};

/// Ticks of the run: a second.
const TICKS: u64 = 20;

fn tick(world: &World) -> u64 {
    world.resource::<LatestFrame>().frame().tick
}

/// At tick 0: a rover starts elsewhere and is driven, a second car comes to the Lot, an armchair goes.
fn before(world: &mut World) {
    let roster = world.resource::<Roster>();
    let (rover, lot, is_first) = (roster.robots()[0], roster.worlds()[2], roster.named("Second").is_none());
    if tick(world) > 0 || !is_first {
        return;
    }
    if let Some(mut q) = world.get_mut::<Configuration<Rusty>>(rover) {
        q.0.x += 0.25;
    }
    if let Some(mut mode) = world.get_mut::<DriveMode<Rusty>>(rover) {
        (mode.manual, mode.channels) = (true, [64, 16]);
    }
    let q = Configuration::<Hitch>(HitchCfg { body: Pose2::new(4.0, 9.0, 0.0), trailer: None });
    world.spawn((RobotModel(HITCH), q, RobotName::new("Second", "hitch"), ResidesIn(lot)));
    let mut shapes = world.query::<(Entity, &ObstacleShape)>();
    let chair = shapes.iter(world).find(|(_, shape)| shape.name == "A's armchair").map(|(entity, _)| entity);
    chair.into_iter().for_each(|chair| _ = world.despawn(chair));
}

/// At tick 5: a configuration is written, a model is replaced, a door leaves its world, an arm is despawned.
fn later(world: &mut World) {
    if tick(world) != 5 {
        return;
    }
    let robots = world.resource::<Roster>().robots().to_vec();
    if let Some(mut q) = world.get_mut::<Configuration<Rusty>>(robots[0]) {
        q.0.x += 0.1;
    }
    world.entity_mut(robots[2]).insert(RobotModel(Hitch { wheelbase: 9.0, ..HITCH }));
    if let Some(door) = world.query_filtered::<Entity, With<Door>>().iter(world).next() {
        world.entity_mut(door).remove::<ObstacleOf>();
    }
    world.despawn(robots[1]);
}

/// What was refused since this was asked last, without the numbers of entities.
fn refusals(app: &mut App) -> Vec<String> {
    let words = |CommandRefused(error)| match error {
        CommandError::Foreign(change) if change.component.is_empty() => format!("{}: despawned", change.thing),
        CommandError::Foreign(change) => format!("{}: {}", change.thing, change.component),
        other => other.to_string(),
    };
    app.world_mut().resource_mut::<Messages<CommandRefused>>().drain().map(words).collect()
}

/// The program's output.
pub fn report() -> Result<String, Box<dyn Error>> {
    let mut app = headless_app();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
    app.add_systems(PreUpdate, before).add_systems(Update, later);
    start_run(app.world_mut(), TourConfig::default(), BOOK_SEED)?;
    app.world_mut().resource_mut::<Transport>().playback = Playback::Playing;
    let mut lines = Vec::new();
    while tick(app.world()) < TICKS {
        app.update();
        lines.extend(refusals(&mut app).into_iter().map(|refusal| format!("put back: {refusal}")));
    }
    let recipe = recipe(app.world()).ok_or("no run")?;
    let robots: Vec<&str> = recipe.config.robot_names().collect();
    lines.push(format!("robots: {}", robots.join(", ")));
    let inputs = recipe.script.events.iter().map(|e| format!("tick {}: {} gets {:?}", e.tick, e.robot, e.input));
    lines.extend(inputs);
    let recorded = Recorder::of(&recipe)?.seek(TICKS)?.digest();
    let is_same = recorded == app.world().resource::<LatestFrame>().frame().digest();
    lines.push(format!("recorded again elsewhere: {}\n", if is_same { "the same bits" } else { "other bits" }));
    Ok(lines.join("\n"))
}

fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}
