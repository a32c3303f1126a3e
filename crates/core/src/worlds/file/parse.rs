//! Turns a world file into a checked world.

use std::collections::BTreeMap;

use super::description::{Named, RobotText};
use super::items::{Budget, make_bounds, make_door, make_mark, make_place, make_solid, make_wall};
use super::name::check_name;
use super::resident::make_resident;
use super::route::{Radii, make_route, routed};
use super::source::{FilePart, FileText};
use crate::configuration::{RobotKind, WrittenCoordinate};
use crate::worlds::{MAX_ITEMS, World, WorldError, WorldItem, WorldProblem};

impl World {
    /// Reads a world from `text`, a world file. Errors name the file `source_name`.
    ///
    /// Clockwise polygons are reversed, concave ones cut into convex pieces, and angles wrapped. `-0.0` is stored as
    /// `0.0`.
    ///
    /// # Errors
    /// [`WorldError`] names file, line, column, item and reason. Refused are: text that is not RON or not of the
    /// format's form; another version; an unknown field; a name that is empty or taken; numbers that are not finite;
    /// coordinates beyond [`MAX_COORDINATE`](crate::geometry::MAX_COORDINATE); features below
    /// [`MIN_FEATURE`](crate::geometry::MIN_FEATURE); polygons that cross themselves; more than [`MAX_ITEMS`] shapes,
    /// or items in a list; more than [`MAX_ALL_RAYS`](crate::worlds::MAX_ALL_RAYS) rays; unknown kinds of robots;
    /// robots that are not [within the bounds](crate::worlds::OutsideError); [routes](crate::worlds::RouteError) that
    /// are none.
    ///
    /// ```
    /// use motion_lab_core::worlds::World;
    /// let text = "World(version: 1, name: \"yard\", bounds: (min: (0, 0), max: (4, 3)),\n\
    ///             obstacles: [(name: \"the tree\", shape: Disc(center: (1, 1), radius: 0))])";
    /// let error = World::parse("yard.ron", text).unwrap_err();
    /// assert!(error.to_string().starts_with("yard.ron:2:13: obstacles[0] \"the tree\": radius 0 m"));
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<World, WorldError> {
        let world = World::parse_recorded(source_name, text)?;
        world.check_residents().map_err(|(index, problem)| {
            let item = WorldItem { list: "robots", index, name: world.robots[index].name.clone() };
            FileText { file: source_name, text }.error(FilePart::Item(&item), problem)
        })?;
        Ok(world)
    }

    /// Reads a world as [`parse`](Self::parse), but takes robots that are not within its bounds: logs that were
    /// recorded with such a world still replay.
    ///
    /// # Errors
    /// As [`parse`](Self::parse), but for those robots.
    pub fn parse_recorded(source_name: &str, text: &str) -> Result<World, WorldError> {
        let source = FileText { file: source_name, text };
        let file = source.read()?;
        check_name(&file.name).map_err(|problem| source.error(FilePart::Name, problem))?;
        let bounds = make_bounds(&file.bounds).map_err(|problem| source.error(FilePart::Bounds, problem))?;

        let mut names = TakenNames { source, taken: BTreeMap::new() };
        names.claim("walls", &file.walls)?;
        names.claim("obstacles", &file.obstacles)?;
        names.claim("doors", &file.doors)?;
        names.claim("routes", &file.routes)?;
        names.claim("places", &file.places)?;
        names.claim("marks", &file.marks)?;
        names.claim("robots", &file.robots)?;

        let mut budget = Budget::default();
        let mut obstacles = source.convert("walls", &file.walls, |w| make_wall(w, &mut budget))?;
        let solids = source.convert("obstacles", &file.obstacles, |o| make_solid(o, &mut budget))?;
        obstacles.extend(solids);
        let doors = source.convert("doors", &file.doors, |d| make_door(d, &mut budget))?;
        let routes = source.convert("routes", &file.routes, |r| make_route(r, &mut budget))?;
        let radii: Radii<'_> = routes.iter().map(|r| (r.name.as_str(), r.radius)).collect();
        let robots = source.convert("robots", &file.robots, |r| {
            let robot = make_resident(r)?;
            budget.spend_rays(&robot)?;
            routed(robot, r, &radii)
        })?;
        Ok(World {
            name: file.name,
            bounds,
            obstacles,
            doors,
            places: source.convert("places", &file.places, make_place)?,
            marks: source.convert("marks", &file.marks, make_mark)?,
            routes,
            robots,
        })
    }
}

/// What the writer of a world file may have meant by angles of more than a turn, a sentence for each place, and for
/// each start, car and sensor of a robot, that has such an angle. None of a text that is no world file.
pub fn turns(text: &str) -> Vec<String> {
    let Ok(file) = (FileText { file: "", text }).read() else { return Vec::new() };
    let places = file.places.iter().filter_map(|place| {
        let note = place.pose.theta.turns_in_ron()?;
        Some(format!("the place {}: {note}", place.name))
    });
    places.chain(file.robots.iter().flat_map(turns_of)).collect()
}

fn turns_of(robot: &RobotText) -> Vec<String> {
    let name = &robot.name;
    let start = RobotKind::of(&robot.kind)
        .and_then(|known| WrittenCoordinate::all_turns_in_ron(&robot.start, known.lengths).next())
        .map(|note| format!("the start of {name}: {note}"));
    let car = robot.car.iter().flat_map(|car| {
        let jackknife = car.trailer.as_ref().and_then(|trailer| trailer.jackknife);
        [("max_steer", car.max_steer), ("jackknife", jackknife)]
    });
    let car = car.filter_map(|(field, angle)| Some(format!("the {field} of {name}: {}", angle?.turns_in_ron()?)));
    let sensors = robot.sensors.iter().flat_map(|sensor| {
        let angles = [("mount", sensor.mount.map(|mount| mount.theta)), ("field_of_view", sensor.field_of_view)];
        angles
            .map(|(field, angle)| Some(format!("the {field} of {name}'s {}: {}", sensor.name, angle?.turns_in_ron()?)))
    });
    start.into_iter().chain(car).chain(sensors.flatten()).collect()
}

impl FileText<'_> {
    /// Converts every item of a list.
    fn convert<T: Named, U>(
        &self,
        list: &'static str,
        items: &[T],
        mut make: impl FnMut(&T) -> Result<U, WorldProblem>,
    ) -> Result<Vec<U>, WorldError> {
        let convert = |(index, item): (usize, &T)| {
            make(item).map_err(|problem| {
                let item = WorldItem { list, index, name: item.name().to_owned() };
                self.error(FilePart::Item(&item), problem)
            })
        };
        items.iter().enumerate().map(convert).collect()
    }
}

/// The names taken so far in all lists, each with the list and index of its item.
struct TakenNames<'a> {
    source: FileText<'a>,
    taken: BTreeMap<&'a str, (&'static str, usize)>,
}

impl<'a> TakenNames<'a> {
    fn claim<T: Named>(&mut self, list: &'static str, items: &'a [T]) -> Result<(), WorldError> {
        for (index, name) in items.iter().map(Named::name).enumerate() {
            let refuse = |problem| {
                let item = WorldItem { list, index, name: name.to_owned() };
                Err(self.source.error(FilePart::Item(&item), problem))
            };
            if index == MAX_ITEMS {
                return refuse(WorldProblem::TooMany { what: list });
            }
            if let Err(problem) = check_name(name) {
                return refuse(problem);
            }
            if let Some(&(list, index)) = self.taken.get(name) {
                let item = WorldItem { list, index, name: name.to_owned() };
                return refuse(WorldProblem::NameTaken { line: self.source.line(&item), item });
            }
            self.taken.insert(name, (list, index));
        }
        Ok(())
    }
}
