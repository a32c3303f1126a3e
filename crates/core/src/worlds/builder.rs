//! `WorldBuilder`, a world under construction, item by item.

use std::collections::{BTreeMap, BTreeSet};

use super::file::description::{BoundsText, ObstacleText, PlaceText, PolylineText, ShapeText, Xy};
use super::file::items::{Budget, make_bounds, make_mark, make_place, make_solid, make_wall};
use super::file::name::{MAX_NAME, check_name};
use super::{MAX_ITEMS, Mark, Obstacle, Place, Resident, World, WorldProblem};
use crate::geometry::Pose2;

/// A world under construction. Every item passes the checks of a world file, and its name is free if it was claimed.
///
/// ```
/// use motion_lab_core::worlds::{ShapeText, WorldBuilder};
/// let mut yard = WorldBuilder::default();
/// let (tree, fence) = (yard.claim("tree"), yard.claim("fence"));
/// yard.solid(tree, ShapeText::Disc { center: (2.0, 3.0), radius: 0.4 })?;
/// yard.wall(fence, vec![(0.0, 0.0), (8.0, 0.0), (8.0, 6.0)], false)?;
/// assert_eq!(yard.claim("tree"), "tree 2");
/// let yard = yard.finish("Yard", (0.0, 0.0), (8.0, 6.0))?;
/// assert!(yard.obstacle("tree").is_some());
/// # Ok::<(), motion_lab_core::worlds::WorldProblem>(())
/// ```
#[derive(Default)]
pub struct WorldBuilder {
    walls: Vec<Obstacle>,
    solids: Vec<Obstacle>,
    places: Vec<Place>,
    marks: Vec<Mark>,
    robots: Vec<Resident>,
    names: BTreeSet<String>,
    counts: BTreeMap<String, usize>,
    budget: Budget,
}

impl WorldBuilder {
    /// Adds a wall along these points, metres, under a name that was claimed. A closed one leads back to its first
    /// point.
    ///
    /// # Errors
    /// [`WorldProblem`], for what a world file may not hold.
    pub fn wall(&mut self, name: String, points: Vec<Xy>, closed: bool) -> Result<(), WorldProblem> {
        let wall = make_wall(&PolylineText { name, points, closed }, &mut self.budget)?;
        self.walls.push(wall);
        Ok(())
    }

    /// Adds a solid obstacle, under a name that was claimed.
    ///
    /// # Errors
    /// As [`wall`](Self::wall).
    pub fn solid(&mut self, name: String, shape: ShapeText) -> Result<(), WorldProblem> {
        let solid = make_solid(&ObstacleText { name, shape }, &mut self.budget)?;
        self.solids.push(solid);
        Ok(())
    }

    /// Adds a painted mark, with which nothing collides, under a name that was claimed.
    ///
    /// # Errors
    /// As [`wall`](Self::wall).
    pub fn mark(&mut self, name: String, points: Vec<Xy>, closed: bool) -> Result<(), WorldProblem> {
        check_room("marks", self.marks.len())?;
        self.marks.push(make_mark(&PolylineText { name, points, closed })?);
        Ok(())
    }

    /// Adds a place, under a name that was claimed.
    ///
    /// # Errors
    /// As [`wall`](Self::wall).
    pub fn place(&mut self, name: String, pose: Pose2) -> Result<(), WorldProblem> {
        check_room("places", self.places.len())?;
        self.places.push(make_place(&PlaceText { name, pose: pose.into() })?);
        Ok(())
    }

    /// Adds a robot, under its name, which was claimed.
    ///
    /// # Errors
    /// [`WorldProblem::TooMany`] for more than [`MAX_ITEMS`].
    pub fn robot(&mut self, robot: Resident) -> Result<(), WorldProblem> {
        check_room("robots", self.robots.len())?;
        self.robots.push(robot);
        Ok(())
    }

    /// Whether the world has no obstacle yet.
    pub fn is_empty(&self) -> bool {
        self.walls.is_empty() && self.solids.is_empty()
    }

    /// Claims a name, made valid. If it is taken, claims the next free one like it: `table`, `table 2`.
    pub fn claim(&mut self, name: &str) -> String {
        let name = good_name(name);
        if self.names.insert(name.clone()) {
            self.counts.entry(name.clone()).or_insert(1);
            return name;
        }
        self.numbered(&name)
    }

    /// Claims the next free one of the names `stem 1`, `stem 2` and so on.
    pub fn numbered(&mut self, stem: &str) -> String {
        let count = self.counts.entry(stem.to_owned()).or_default();
        loop {
            *count += 1;
            let name = format!("{stem} {count}");
            if self.names.insert(name.clone()) {
                return name;
            }
        }
    }

    /// Returns the finished world, with these bounds, metres.
    ///
    /// # Errors
    /// [`WorldProblem`], for bounds that a world file may not have.
    pub fn finish(self, name: &str, min: Xy, max: Xy) -> Result<World, WorldProblem> {
        let bounds = make_bounds(&BoundsText { min, max })?;
        let mut obstacles = self.walls;
        obstacles.extend(self.solids);
        let name = good_name(name);
        Ok(World {
            name,
            bounds,
            obstacles,
            doors: vec![],
            routes: vec![],
            places: self.places,
            marks: self.marks,
            robots: self.robots,
        })
    }
}

fn check_room(what: &'static str, there: usize) -> Result<(), WorldProblem> {
    if there < MAX_ITEMS { Ok(()) } else { Err(WorldProblem::TooMany { what }) }
}

/// Makes a name valid: without control characters, short enough for a number after it, or else `unnamed`. Only its
/// beginning is read, so that many things may be named after one long text.
fn good_name(wanted: &str) -> String {
    let clean: String = wanted.chars().take(10 * MAX_NAME).filter(|c| !c.is_control()).collect();
    let mut end = clean.len().min(MAX_NAME - 12);
    while !clean.is_char_boundary(end) {
        end -= 1;
    }
    let clean = clean[..end].trim();
    if check_name(clean).is_ok() { clean.to_owned() } else { "unnamed".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_made_good_and_unique() {
        let mut world = WorldBuilder::default();
        assert_eq!(world.claim("box"), "box");
        assert_eq!((world.claim("box"), world.claim("box")), ("box 2".into(), "box 3".into()));
        assert_eq!(world.claim("wall 2"), "wall 2");
        assert_eq!((world.numbered("wall"), world.numbered("wall")), ("wall 1".into(), "wall 3".into()));
        assert_eq!(world.claim(" \u{7}\n"), "unnamed");
        // only the first 2,000 characters are read
        let late = |before: usize| "\u{7}".repeat(before) + "x";
        assert_eq!((world.claim(&late(1_999)), world.claim(&late(2_000))), ("x".into(), "unnamed 2".into()));
        let long = "é".repeat(300);
        for _ in 0..3 {
            let name = world.claim(&long);
            assert!(check_name(&name).is_ok() && name.starts_with('é'), "{name}");
        }
    }
}
