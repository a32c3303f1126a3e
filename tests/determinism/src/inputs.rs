//! The script of a generated run.

use motion_lab_core::configuration::RobotKind;
use motion_lab_core::random::Stream;
use motion_lab_core::worlds::{Resident, World};
use motion_lab_sim::run::{Event, Quantized, RobotInput, Script, WorldChange, WorldEvent};

use crate::feature::Feature;

/// A script for all robots of these worlds, and for the worlds where they may change: inputs of the kinds that are on,
/// whether a robot takes them or refuses them.
pub fn script(worlds: &[World], on: &[Feature], ticks: u64, draws: &mut Stream) -> Script {
    let (mut events, mut changes, mut added) = (Vec::new(), Vec::new(), Vec::new());
    let mut tick = 0;
    loop {
        tick += 1 + draws.below(30);
        if tick > ticks {
            return Script::new(events, changes);
        }
        for world in worlds {
            let change = change(world, on, &mut added, draws);
            changes.extend(change.map(|change| WorldEvent { tick, world: world.name.clone(), change }));
            let robots = world.robots.iter().filter_map(|robot| {
                let input = input(robot, world, on, draws)?;
                Some(Event { tick, robot: robot.name.clone(), input })
            });
            events.extend(robots);
        }
    }
}

/// One of these things, if there is any.
fn chosen<T: Clone>(all: &[T], draws: &mut Stream) -> Option<T> {
    all.get(draws.below(all.len() as u64) as usize).cloned()
}

/// An input to a robot, or in three draws of four none.
fn input(robot: &Resident, world: &World, on: &[Feature], draws: &mut Stream) -> Option<RobotInput> {
    const KINDS: [Feature; 5] =
        [Feature::Drives, Feature::Moves, Feature::Teleports, Feature::Trailers, Feature::Releases];
    if draws.below(4) > 0 {
        return None;
    }
    let kinds: Vec<Feature> = KINDS.into_iter().filter(|kind| on.contains(kind)).collect();
    Some(match chosen(&kinds, draws)? {
        Feature::Drives => RobotInput::Drive(channel(draws), channel(draws)),
        Feature::Moves => RobotInput::MoveTo(coordinates(robot, world, draws)),
        Feature::Teleports => RobotInput::Teleport(coordinates(robot, world, draws)),
        Feature::Trailers => RobotInput::SetTrailer(draws.below(2) == 0),
        _ => RobotInput::Release,
    })
}

/// A channel: often the least or the greatest, which drives into things, else anything.
fn channel(draws: &mut Stream) -> i16 {
    match draws.below(4) {
        0 => -128,
        1 => 128,
        _ => draws.below(257) as i16 - 128,
    }
}

/// Coordinates of a robot anywhere in its world.
fn coordinates(robot: &Resident, world: &World, draws: &mut Stream) -> Vec<Quantized> {
    let (min, max) = (world.bounds.min, world.bounds.max);
    let drives = RobotKind::of(&robot.kind).is_some_and(|kind| kind.drives);
    let coordinate = |k: usize| match k {
        0 if drives => draws.uniform(min.x, max.x),
        1 if drives => draws.uniform(min.y, max.y),
        _ => draws.uniform(-3.0, 3.0),
    };
    (0..robot.start.len()).map(coordinate).filter_map(Quantized::try_new).collect()
}

/// A change of a world, or none. `added` are the obstacles that scripts have added.
fn change(world: &World, on: &[Feature], added: &mut Vec<String>, draws: &mut Stream) -> Option<WorldChange> {
    const KINDS: [Feature; 4] = [Feature::Doors, Feature::Additions, Feature::Removals, Feature::Displacements];
    let kinds: Vec<Feature> = KINDS.into_iter().filter(|kind| on.contains(kind)).collect();
    let number = |low: f64, high: f64, draws: &mut Stream| Quantized::try_new(draws.uniform(low, high));
    match chosen(&kinds, draws)? {
        Feature::Doors => {
            let door = chosen(&world.doors, draws)?.name;
            Some(if draws.below(3) > 0 { WorldChange::Close(door) } else { WorldChange::Open(door) })
        }
        Feature::Additions => {
            let name = format!("thing {}", added.len() + 1);
            let (min, max) = (world.bounds.min, world.bounds.max);
            let at = (draws.uniform(min.x, max.x), draws.uniform(min.y, max.y));
            let point = |draws: &mut Stream| {
                Some((number(at.0 - 0.4, at.0 + 0.4, draws)?, number(at.1 - 0.4, at.1 + 0.4, draws)?))
            };
            let points = (0..=draws.below(5)).map(|_| point(draws)).collect::<Option<Vec<_>>>()?;
            let radius = number(0.05, 0.25, draws)?;
            added.push(name.clone());
            Some(WorldChange::Add { name, points, radius })
        }
        kind => {
            let names = world.obstacles.iter().map(|obstacle| obstacle.name.clone());
            let name = chosen(&names.collect::<Vec<_>>(), draws)?;
            if kind == Feature::Removals {
                return Some(WorldChange::Remove(name));
            }
            let shift = |draws: &mut Stream| number(-0.5, 0.5, draws);
            Some(WorldChange::Move { name, to: (shift(draws)?, shift(draws)?, number(-0.05, 0.05, draws)?) })
        }
    }
}
