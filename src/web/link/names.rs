//! The names in a world of a link.

use super::error::LinkError;
use super::limits::MAX_NAME;
use motion_lab_core::worlds::World;

/// Refuses a world with a name that is long enough for a sentence.
pub fn check(world: &World) -> Result<(), LinkError> {
    let World { name, obstacles, doors, routes, places, marks, robots, .. } = world;
    let things = obstacles.iter().map(|o| &o.name).chain(doors.iter().map(|d| &d.name));
    let ways = routes.iter().map(|r| &r.name).chain(places.iter().map(|p| &p.name));
    let rest = marks.iter().map(|m| &m.name).chain(robots.iter().map(|r| &r.name));
    let sensors = robots.iter().flat_map(|r| &r.sensors).map(|s| &s.name);
    let rest = rest.chain(sensors);
    let long = [name].into_iter().chain(things).chain(ways).chain(rest).find(|name| name.chars().count() > MAX_NAME);
    long.map_or(Ok(()), |name| Err(LinkError::Name(name.clone())))
}
