//! `Editor`, a world under edit: every change is checked as world files are, and can be undone.

use super::numbers::{listed, sides};
use super::op::{all_names, changed};
use super::residents::{Stand, stand};
use super::thing::{numbers_of, shape_of};
use super::{EditError, EditShape, Handle, Number, Op};
use crate::atlas::{Atlas, TeleportRefusal};
use motion_lab_core::configuration::Kinds;
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Vector2};
use motion_lab_core::num::{hypot, lesser, sin_cos};
use motion_lab_core::worlds::{ObstacleKind, Resident, World, WorldError, comments};

/// A world under edit.
///
/// Each change prints the world and reads it again. So the editor refuses what `world check` refuses, with the same
/// words, and the saved world is the one shown. A file is saved in canonical form: a canonical file that is opened and
/// saved without a change stays the same to the byte. Comments are not kept; [`comments`](Editor::comments) counts them
/// beforehand.
#[derive(Clone, Debug)]
pub struct Editor {
    file: String,
    /// The versions of the world since it was opened; the present one is number `now`.
    history: Vec<World>,
    now: usize,
    saved: Option<usize>,
    /// Number of comments in the text that was opened.
    comments: usize,
    kinds: Kinds,
}

/// Distance from a place to the handle of its heading, as a fraction of the world's shorter side.
const HEADING: f64 = 0.05;

impl Editor {
    /// Opens the text of a world file. Errors call it `file`.
    ///
    /// # Errors
    /// [`WorldError`] when the file is refused.
    pub fn open(file: &str, text: &str) -> Result<Self, WorldError> {
        let world = World::parse(file, text)?;
        let saved = (world.to_ron() == text).then_some(0);
        Ok(Editor { file: file.to_owned(), saved, comments: comments(text), ..Editor::new(world) })
    }

    /// Opens a world that has no file yet.
    pub fn new(world: World) -> Self {
        let (file, kinds) = ("world.ron".into(), Kinds::default());
        Editor { file, history: vec![world], now: 0, saved: None, comments: 0, kinds }
    }

    /// The editor with these kinds of robots in place of those that it knew. It can then move robots of a program's own
    /// kinds whose first two coordinates are a position. Of kinds with footprints, [`warnings`](Self::warnings) also
    /// names the robots that start in contact or where a run would not start.
    #[must_use]
    pub fn knowing(self, kinds: Kinds) -> Self {
        Editor { kinds, ..self }
    }

    /// The kinds of robots that it knows.
    pub fn kinds(&self) -> &Kinds {
        &self.kinds
    }

    /// The present world.
    pub fn world(&self) -> &World {
        &self.history[self.now]
    }

    /// The world as the text of a canonical file.
    pub fn text(&self) -> String {
        self.world().to_ron()
    }

    /// Marks the present world as saved. To be called when [`text`](Self::text) is on the disk.
    pub fn mark_saved(&mut self) {
        (self.saved, self.comments) = (Some(self.now), 0);
    }

    /// Number of comments in the opened file; saving drops them.
    pub fn comments(&self) -> usize {
        self.comments
    }

    /// The name of the file in errors.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Whether a change can be undone.
    pub fn can_undo(&self) -> bool {
        self.now > 0
    }

    /// Whether an undone change can be made again.
    pub fn can_redo(&self) -> bool {
        self.now + 1 < self.history.len()
    }

    /// Whether the file on the disk holds the present world.
    pub fn is_saved(&self) -> bool {
        self.saved == Some(self.now)
    }

    /// Whether a wall was taken away, and that is not undone.
    pub fn has_lost_wall(&self) -> bool {
        let walls = |world: &World| world.obstacles.iter().filter(|o| o.kind == ObstacleKind::Wall).count();
        self.history[..=self.now].windows(2).any(|step| walls(&step[1]) < walls(&step[0]))
    }

    /// The world after a change, without making it: for showing a drag under way.
    ///
    /// # Errors
    /// [`EditError`] says why the change is refused.
    pub fn preview(&self, op: &Op) -> Result<World, EditError> {
        let changed = changed(self.world(), op, &self.kinds)?;
        Ok(World::parse(&self.file, &changed.to_ron())?)
    }

    /// Makes a change. Undone changes can't be made again after it.
    ///
    /// # Errors
    /// [`EditError`] says why it is refused; the world stays as it was.
    pub fn apply(&mut self, op: &Op) -> Result<(), EditError> {
        let world = self.preview(op)?;
        if world == *self.world() {
            return Ok(());
        }
        self.history.truncate(self.now + 1);
        self.saved = self.saved.filter(|saved| *saved <= self.now);
        self.history.push(world);
        self.now += 1;
        Ok(())
    }

    /// Undoes the last change; `false` when there is none.
    pub fn undo(&mut self) -> bool {
        let can = self.can_undo();
        self.now -= usize::from(can);
        can
    }

    /// Makes the last undone change again; `false` when there is none.
    pub fn redo(&mut self) -> bool {
        let can = self.can_redo();
        self.now += usize::from(can);
        can
    }

    /// The shape of a wall, an obstacle or a mark; `None` for anything else.
    pub fn shape(&self, name: &str) -> Option<EditShape> {
        shape_of(self.world(), name)
    }

    /// Whether the world holds something of this name.
    pub fn holds(&self, name: &str) -> bool {
        all_names(self.world()).contains(name)
    }

    /// The numbers of the thing of this name, in the order in which [`Op::SetNumber`] counts them: coordinates and
    /// sizes of a shape, the ends of a door, the pose of a place, the start of a robot and what it is like. Empty for a
    /// name that nothing has.
    pub fn numbers(&self, name: &str) -> Vec<Number> {
        numbers_of(self.world(), name, &self.kinds)
    }

    /// The numbers of the part of the plane that the world shows, in the order in which [`Op::SetBounds`] counts them.
    pub fn bounds(&self) -> Vec<Number> {
        let Aabb { mut min, mut max } = self.world().bounds;
        listed(|visit| sides(&mut min, &mut max, visit))
    }

    /// The pose of a place, or of a robot's start; `None` for anything else.
    pub fn pose(&self, name: &str) -> Option<Pose2> {
        let robot = || match self.stand(name)? {
            Stand::Pose(pose) => Some(pose),
            Stand::Base(_) | Stand::Place(_) => None,
        };
        self.world().place(name).map(|place| place.pose).or_else(robot)
    }

    fn stand(&self, name: &str) -> Option<Stand> {
        stand(self.world().robots.iter().find(|robot| robot.name == name)?, &self.kinds)
    }

    /// The handles of a thing; empty for a robot of a kind that the editor does not know. A place has two: its position
    /// and its heading. So has a robot that starts with a pose; other robots have the one where they stand. A door has
    /// its two ends, the hinge first.
    pub fn handles(&self, name: &str) -> Vec<Handle> {
        let handle = |(index, at)| Handle { index, at, makes_corner: false };
        if let Some(pose) = self.pose(name) {
            let Aabb { min, max } = self.world().bounds;
            let (s, c) = sin_cos(pose.theta);
            let ahead = Vector2::new(c, s) * (HEADING * lesser(max.x - min.x, max.y - min.y));
            let at = pose.position();
            return [(0, at), (1, at + ahead)].map(handle).to_vec();
        }
        if let Some(door) = self.world().door(name) {
            return [(0, door.a), (1, door.b)].map(handle).to_vec();
        }
        if let Some(stand) = self.stand(name) {
            return vec![handle((0, stand.at()))];
        }
        self.shape(name).map_or_else(Vec::new, |shape| shape.handles())
    }

    /// Everything that the world holds, in the order of its file: what it is, and its name.
    pub fn things(&self) -> Vec<(&'static str, &str)> {
        let world = self.world();
        let obstacle = |kind| if kind == ObstacleKind::Wall { "wall" } else { "obstacle" };
        let obstacles = world.obstacles.iter().map(|o| (obstacle(o.kind), o.name.as_str()));
        let doors = world.doors.iter().map(|d| ("door", d.name.as_str()));
        let places = world.places.iter().map(|p| ("place", p.name.as_str()));
        let marks = world.marks.iter().map(|m| ("mark", m.name.as_str()));
        let robots = world.robots.iter().map(|r| ("robot", r.name.as_str()));
        obstacles.chain(doors).chain(places).chain(marks).chain(robots).collect()
    }

    /// Warnings about robots that start in contact, or where a run would not start. A world file may have them.
    pub fn warnings(&self) -> Vec<String> {
        let atlas = Atlas::new(self.world().clone()).knowing(self.kinds.clone());
        let starts = atlas.in_contact().into_iter().map(|(name, refusal)| match refusal {
            TeleportRefusal::Overlap { .. } => format!("{name} {refusal} at its start"),
            other => format!("{name}: {other}"),
        });
        let nowhere = |robot: &&Resident| {
            self.kinds.has_footprints(&robot.kind) && self.kinds.footprint(&robot.kind, &robot.start).is_none()
        };
        let none =
            self.world().robots.iter().filter(nowhere).map(|Resident { name, kind, .. }| {
                format!("{name}: its start is no configuration of the kind {kind:?}")
            });
        starts.chain(none).collect()
    }

    /// A free name for a new thing: `wall`, `wall 2`, ..
    pub fn free_name(&self, kind: &str) -> String {
        let taken = all_names(self.world());
        let numbered = std::iter::once(kind.to_owned()).chain((2..).map(|n: u32| format!("{kind} {n}")));
        numbered.into_iter().find(|name| !taken.contains(name.as_str())).unwrap_or_default()
    }
}

/// A point moved onto the nearest of `corners` within `reach`, else onto the grid of `step` metres (0 for none).
pub fn snap(p: Point2, corners: &[Point2], reach: f64, step: f64) -> Point2 {
    let off = |c: &Point2| hypot(c.x - p.x, c.y - p.y);
    let nearest = corners.iter().filter(|c| off(c) <= reach).min_by(|a, b| off(a).total_cmp(&off(b)));
    match nearest {
        Some(corner) => *corner,
        None if step > 0.0 => {
            // where 1/step is a whole number the coordinate is divided by it, so that 24 steps of 0.05 are 1.2
            let per = (1.0 / step).round();
            let whole = (per * step - 1.0).abs() < 1e-9;
            let at = |x: f64| if whole { (x * per).round() / per } else { (x / step).round() * step };
            Point2::new(at(p.x), at(p.y))
        }
        None => p,
    }
}

#[cfg(test)]
mod tests;
