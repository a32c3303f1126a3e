//! A recipe without some of the things in it, and without what refers to them.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::removal::{Removal, WorldRemoval};
use crate::run::{Event, Recipe, Script, WorldChange, WorldEvent};
use crate::tour::TourConfig;
use motion_lab_core::worlds::{Obstacle, Resident, ResidentSensor, SourceShape, World};

/// Several removals at once.
pub(super) type Removals = BTreeSet<Removal>;

/// The recipe after these removals. With a robot its events go, with an obstacle, a door or the change that adds an
/// obstacle the changes that name it, and with a world all of these. `None` where a world would be none that a file
/// can hold.
pub(super) fn without(recipe: &Recipe, removals: &Removals) -> Option<Recipe> {
    let Recipe { seed, config, script } = recipe;
    let mut worlds = Vec::new();
    for (w, world) in config.worlds.iter().enumerate() {
        if !removals.contains(&Removal::World(w)) {
            worlds.push(world_without(w, world, removals)?);
        }
    }
    let sensor = config.sensor.filter(|_| !removals.contains(&Removal::RunSensor));
    let script = script_without(script, &config.worlds, &worlds, removals);
    Some(Recipe { seed: *seed, config: Arc::new(TourConfig { worlds, ticks: config.ticks, sensor }), script })
}

/// The recipe of the run up to a tick.
pub(super) fn up_to(recipe: &Recipe, ticks: u64) -> Recipe {
    let mut script = recipe.script.clone();
    script.truncate_after(ticks);
    Recipe { seed: recipe.seed, config: Arc::new(TourConfig { ticks, ..(*recipe.config).clone() }), script }
}

/// What remains of a list, where `removal` says how the item of an index is taken.
fn remaining<'a, T>(
    list: &'a [T],
    taken: impl Fn(WorldRemoval) -> bool + 'a,
    removal: fn(usize) -> WorldRemoval,
) -> impl Iterator<Item = (usize, &'a T)> {
    list.iter().enumerate().filter(move |(i, _)| !taken(removal(*i)))
}

fn world_without(w: usize, world: &World, removals: &Removals) -> Option<World> {
    let own = (Removal::Of(w, WorldRemoval::Robot(0)), Removal::Of(w, WorldRemoval::Mark(usize::MAX)));
    if removals.range(own.0..=own.1).next().is_none() {
        return Some(world.clone());
    }
    let taken = |removal: WorldRemoval| removals.contains(&Removal::Of(w, removal));
    let mut obstacles = Vec::new();
    let mut is_cut = false;
    for (o, obstacle) in remaining(&world.obstacles, taken, WorldRemoval::Obstacle) {
        let first = Removal::Of(w, WorldRemoval::Piece(o, 0));
        let last = Removal::Of(w, WorldRemoval::Piece(o, usize::MAX));
        if removals.range(first..=last).next().is_none() {
            obstacles.push(obstacle.clone());
        } else {
            obstacles.extend(obstacle_without(obstacle, |p| taken(WorldRemoval::Piece(o, p)))?);
            is_cut = true;
        }
    }
    let routes: Vec<_> = remaining(&world.routes, taken, WorldRemoval::Route).map(|(_, route)| route.clone()).collect();
    let robots = remaining(&world.robots, taken, WorldRemoval::Robot).map(|(r, robot)| {
        let robot = resident_without(r, robot, taken);
        let follows = |name: &String| routes.iter().any(|route| route.name == *name);
        Resident { route: robot.route.clone().filter(follows), ..robot }
    });
    let robots = robots.collect();
    let left = World {
        name: world.name.clone(),
        bounds: world.bounds,
        obstacles,
        doors: remaining(&world.doors, taken, WorldRemoval::Door).map(|(_, door)| door.clone()).collect(),
        routes,
        places: remaining(&world.places, taken, WorldRemoval::Place).map(|(_, place)| place.clone()).collect(),
        marks: remaining(&world.marks, taken, WorldRemoval::Mark).map(|(_, mark)| mark.clone()).collect(),
        robots,
    };
    if is_cut { as_from_a_file(&left) } else { Some(left) }
}

/// The world as reading its file gives it, which may order and write pieces otherwise; `None` where no file can hold
/// it.
pub(super) fn as_from_a_file(world: &World) -> Option<World> {
    World::parse_recorded("", &world.to_ron()).ok()
}

fn resident_without(r: usize, robot: &Resident, taken: impl Fn(WorldRemoval) -> bool) -> Resident {
    let mut left = robot.clone();
    left.sensors.clear();
    for (s, sensor) in robot.sensors.iter().enumerate().filter(|(s, _)| !taken(WorldRemoval::Sensor(r, *s))) {
        let noise = sensor.noise.filter(|_| !taken(WorldRemoval::SensorNoise(r, s)));
        left.sensors.push(ResidentSensor { noise, ..sensor.clone() });
    }
    left.sizes = left.sizes.filter(|_| !taken(WorldRemoval::Sizes(r)));
    left.sensor = left.sensor.filter(|_| !taken(WorldRemoval::RunSensorNoise(r)));
    left.route = left.route.filter(|_| !taken(WorldRemoval::Following(r)));
    left
}

/// The obstacle without these of its shapes; none where none is left.
fn obstacle_without(obstacle: &Obstacle, is_taken: impl Fn(usize) -> bool) -> Option<Option<Obstacle>> {
    let mut left = Obstacle::new(&obstacle.name, obstacle.kind, Vec::new());
    for (_, shape) in obstacle.written().into_iter().enumerate().filter(|(p, _)| !is_taken(*p)) {
        match shape {
            SourceShape::Outline(points) => left.add_polygon(points).ok()?,
            SourceShape::Piece(piece) => left.pieces.push(piece.clone()),
        }
    }
    Some(Some(left).filter(|left| !left.pieces.is_empty()))
}

/// The script without these of its inputs, and without those for what is no longer there.
fn script_without(script: &Script, before: &[World], after: &[World], removals: &Removals) -> Script {
    // an event of a robot that the run never had stays as it is
    let (were, are) = if script.events.is_empty() { Default::default() } else { (robots(before), robots(after)) };
    let is_gone = |event: &Event| were.contains(&*event.robot) && !are.contains(&*event.robot);
    let events = script.events.iter().enumerate();
    let events = events.filter(|(i, event)| !removals.contains(&Removal::Event(*i)) && !is_gone(event));
    let events = events.map(|(_, event)| event.clone()).collect();

    let (had, has) = if script.changes.is_empty() { Default::default() } else { (things(before), things(after)) };
    let mut gone: BTreeSet<(&str, &str)> = had.difference(&has).copied().collect();
    let mut changes = Vec::new();
    for (i, change) in script.changes.iter().enumerate() {
        let WorldEvent { world, change: what, .. } = change;
        let named = (world.as_str(), what.name());
        let is_of_a_world = after.iter().any(|left| left.name == *world);
        if removals.contains(&Removal::Change(i)) {
            // what would change the added obstacle later goes with it
            if matches!(what, WorldChange::Add { .. }) {
                gone.insert(named);
            }
        } else if is_of_a_world && !gone.contains(&named) {
            changes.push(change.clone());
        }
    }
    Script::new(events, changes)
}

/// The names of the robots of worlds.
fn robots(worlds: &[World]) -> BTreeSet<&str> {
    worlds.iter().flat_map(|world| &world.robots).map(|robot| &*robot.name).collect()
}

/// The names of the obstacles and doors of worlds, each behind its world's.
fn things<'a>(worlds: &'a [World]) -> BTreeSet<(&'a str, &'a str)> {
    let of = |world: &'a World| {
        let World { name, obstacles, doors, .. } = world;
        let names = obstacles.iter().map(|o| &*o.name).chain(doors.iter().map(|d| &*d.name));
        names.map(move |thing| (&**name, thing))
    };
    worlds.iter().flat_map(of).collect()
}

#[cfg(test)]
mod tests;
