//! `Draft`, a world in the making: every item goes through the checks of a world file and gets a name of its own.

use std::collections::{BTreeMap, BTreeSet};

use super::Imported;
use crate::worlds::description::{BoundsText, ObstacleText, PolylineText, ShapeText, Xy};
use crate::worlds::items::{Budget, make_bounds, make_solid, make_wall};
use crate::worlds::parse::{MAX_NAME, check_name};
use crate::worlds::{Obstacle, World, WorldProblem};

/// A world in the making.
#[derive(Default)]
pub(super) struct Draft {
    walls: Vec<Obstacle>,
    solids: Vec<Obstacle>,
    names: BTreeSet<String>,
    counts: BTreeMap<String, usize>,
    budget: Budget,
    notes: Vec<String>,
}

impl Draft {
    /// Adds a wall along these points, named after `stem`: `wall 1`.
    pub fn wall(&mut self, stem: &str, points: Vec<Xy>, closed: bool) -> Result<(), WorldProblem> {
        let name = self.numbered(stem);
        let wall = make_wall(&PolylineText { name, points, closed }, &mut self.budget)?;
        self.walls.push(wall);
        Ok(())
    }

    /// Adds a solid obstacle, named after `stem`: `box 1`.
    pub fn solid(&mut self, stem: &str, shape: ShapeText) -> Result<(), WorldProblem> {
        let name = self.numbered(stem);
        let solid = make_solid(&ObstacleText { name, shape }, &mut self.budget)?;
        self.solids.push(solid);
        Ok(())
    }

    /// Adds something a reader should know, once.
    pub fn note(&mut self, note: impl Into<String>) {
        let note = note.into();
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Whether nothing is there to collide with.
    pub fn is_empty(&self) -> bool {
        self.walls.is_empty() && self.solids.is_empty()
    }

    /// The name itself where it is free and good, else made so.
    pub fn claim(&mut self, name: &str) -> String {
        let name = free_name(name, |name| self.names.contains(name));
        self.names.insert(name.clone());
        name
    }

    /// The next of the names `stem 1`, `stem 2` and so on.
    fn numbered(&mut self, stem: &str) -> String {
        let count = self.counts.entry(stem.to_owned()).or_default();
        *count += 1;
        let name = format!("{stem} {count}");
        self.claim(&name)
    }

    /// The world, within these bounds.
    pub fn finish(self, name: &str, min: Xy, max: Xy) -> Result<Imported, WorldProblem> {
        let bounds = make_bounds(&BoundsText { min, max })?;
        let mut obstacles = self.walls;
        obstacles.extend(self.solids);
        let name = free_name(name, |_| false);
        let world = World { name, bounds, obstacles, places: Vec::new(), marks: Vec::new(), robots: Vec::new() };
        Ok(Imported { world, notes: self.notes })
    }
}

/// A name like `wanted` that a world file allows and that is not taken.
pub(super) fn free_name(wanted: &str, taken: impl Fn(&str) -> bool) -> String {
    let clean: String = wanted.chars().filter(|c| !c.is_control()).collect();
    // room for a number behind it
    let mut end = clean.len().min(MAX_NAME - 12);
    while !clean.is_char_boundary(end) {
        end -= 1;
    }
    let clean = clean[..end].trim();
    let clean = if check_name(clean).is_ok() { clean } else { "unnamed" };
    let mut name = clean.to_owned();
    let mut count = 1;
    while taken(&name) {
        count += 1;
        name = format!("{clean} {count}");
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_made_good_and_unique() {
        let mut draft = Draft::default();
        assert_eq!(draft.claim("box"), "box");
        assert_eq!(draft.claim("box"), "box 2");
        assert_eq!(draft.claim(" \u{7}\n"), "unnamed");
        let long = "é".repeat(300);
        for _ in 0..3 {
            let name = draft.claim(&long);
            assert!(check_name(&name).is_ok() && name.starts_with('é'), "{name}");
        }
    }
}
