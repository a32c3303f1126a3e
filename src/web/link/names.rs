//! The names in a link's worlds and script, which the lab shows among its own words.

use super::error::LinkError;
use super::limits::MAX_NAME;
use motion_lab_core::worlds::World;
use motion_lab_sim::run::{Script, WorldChange};

/// Refuses a world with a name that is long enough for a sentence.
pub fn check(world: &World) -> Result<(), LinkError> {
    let World { name, obstacles, doors, routes, places, marks, robots, .. } = world;
    let things = obstacles.iter().map(|o| &o.name).chain(doors.iter().map(|d| &d.name));
    let ways = routes.iter().map(|r| &r.name).chain(places.iter().map(|p| &p.name));
    let rest = marks.iter().map(|m| &m.name).chain(robots.iter().map(|r| &r.name));
    let sensors = robots.iter().flat_map(|r| &r.sensors).map(|s| &s.name);
    [name].into_iter().chain(things).chain(ways).chain(rest).chain(sensors).try_for_each(|name| check_name(name))
}

/// Refuses a script that adds an obstacle with such a name.
pub fn check_added(script: &Script) -> Result<(), LinkError> {
    let added = script.changes.iter().filter_map(|event| match &event.change {
        WorldChange::Add { name, .. } => Some(name),
        _ => None,
    });
    added.into_iter().try_for_each(|name| check_name(name))
}

fn check_name(name: &str) -> Result<(), LinkError> {
    let is_long = name.chars().count() > MAX_NAME;
    if is_long || name.contains(is_mark) { Err(LinkError::Name(name.to_owned())) } else { Ok(()) }
}

/// Whether a character is not seen, or turns the direction of text.
fn is_mark(letter: char) -> bool {
    matches!(letter, '\u{ad}' | '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}
