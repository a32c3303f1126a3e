//! `Draft`, a world under construction. Every item passes the checks of a world file and gets a unique name.

use std::collections::{BTreeMap, BTreeSet};

use super::Imported;
use crate::geometry::Pose2;
use crate::worlds::file::description::{BoundsText, ObstacleText, PlaceText, PolylineText, ShapeText, Xy};
use crate::worlds::file::items::{Budget, make_bounds, make_mark, make_place, make_solid, make_wall};
use crate::worlds::file::name::{MAX_NAME, check_name};
use crate::worlds::{MAX_ITEMS, Mark, Obstacle, Place, Resident, World, WorldProblem};

/// Largest number of notes kept.
const MOST_NOTES: usize = 100;

/// A world under construction.
#[derive(Default)]
pub(super) struct Draft {
    walls: Vec<Obstacle>,
    solids: Vec<Obstacle>,
    places: Vec<Place>,
    marks: Vec<Mark>,
    robots: Vec<Resident>,
    names: BTreeSet<String>,
    counts: BTreeMap<String, usize>,
    budget: Budget,
    notes: Vec<String>,
}

impl Draft {
    /// Adds a wall along these points, under a name that was claimed.
    pub fn wall(&mut self, name: String, points: Vec<Xy>, closed: bool) -> Result<(), WorldProblem> {
        let wall = make_wall(&PolylineText { name, points, closed }, &mut self.budget)?;
        self.walls.push(wall);
        Ok(())
    }

    /// Adds a solid obstacle, under a name that was claimed.
    pub fn solid(&mut self, name: String, shape: ShapeText) -> Result<(), WorldProblem> {
        let solid = make_solid(&ObstacleText { name, shape }, &mut self.budget)?;
        self.solids.push(solid);
        Ok(())
    }

    /// Adds a painted mark, under a name that was claimed.
    pub fn mark(&mut self, name: String, points: Vec<Xy>, closed: bool) -> Result<(), WorldProblem> {
        check_room("marks", self.marks.len())?;
        self.marks.push(make_mark(&PolylineText { name, points, closed })?);
        Ok(())
    }

    /// Adds a place, under a name that was claimed.
    pub fn place(&mut self, name: String, pose: Pose2) -> Result<(), WorldProblem> {
        check_room("places", self.places.len())?;
        self.places.push(make_place(&PlaceText { name, pose })?);
        Ok(())
    }

    /// Adds a robot, named after its kind.
    pub fn robot(&mut self, kind: &str, start: Vec<f64>) -> Result<(), WorldProblem> {
        check_room("robots", self.robots.len())?;
        let name = self.claim(&capitalised(kind));
        self.robots.push(Resident::try_new(name, kind, start, None)?);
        Ok(())
    }

    /// Adds a note for the reader, unless it is there already or there are too many.
    pub fn note(&mut self, note: impl Into<String>) {
        let note = note.into();
        if self.notes.len() < MOST_NOTES && !self.notes.contains(&note) {
            self.notes.push(note);
        }
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

    /// Returns the finished world with these bounds, and the notes.
    pub fn finish(self, name: &str, min: Xy, max: Xy) -> Result<Imported, WorldProblem> {
        let bounds = make_bounds(&BoundsText { min, max })?;
        let mut obstacles = self.walls;
        obstacles.extend(self.solids);
        let name = good_name(name);
        let world = World {
            name,
            bounds,
            obstacles,
            doors: vec![],
            routes: vec![],
            places: self.places,
            marks: self.marks,
            robots: self.robots,
        };
        Ok(Imported { world, notes: self.notes })
    }
}

fn check_room(what: &'static str, there: usize) -> Result<(), WorldProblem> {
    if there < MAX_ITEMS { Ok(()) } else { Err(WorldProblem::TooMany { what }) }
}

/// The kind of a robot as a name: its first letter becomes a capital.
pub(super) fn capitalised(kind: &str) -> String {
    let mut name = kind.to_owned();
    if let Some(first) = name.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    name
}

/// Makes a name valid: without control characters, short enough for a number after it, or else `unnamed`.
fn good_name(wanted: &str) -> String {
    let clean: String = wanted.chars().filter(|c| !c.is_control()).collect();
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
        let mut draft = Draft::default();
        assert_eq!(draft.claim("box"), "box");
        assert_eq!((draft.claim("box"), draft.claim("box")), ("box 2".into(), "box 3".into()));
        assert_eq!(draft.claim("wall 2"), "wall 2");
        assert_eq!((draft.numbered("wall"), draft.numbered("wall")), ("wall 1".into(), "wall 3".into()));
        assert_eq!(draft.claim(" \u{7}\n"), "unnamed");
        let long = "é".repeat(300);
        for _ in 0..3 {
            let name = draft.claim(&long);
            assert!(check_name(&name).is_ok() && name.starts_with('é'), "{name}");
        }
    }
}
