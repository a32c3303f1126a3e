//! `Editor`, a world under a hand: every change checked as world files are, every change undone again.

use super::op::{changed, is_taken, shape_of};
use super::{Atlas, EditError, EditShape, Handle, Op, Refusal, Teleport};
use crate::geometry::{Point2, Vector2};
use crate::num::{hypot, lesser, sin_cos};
use crate::worlds::{Bounds, World, WorldError, comments};

/// A world under a hand.
///
/// Each change gives a world that reading its file would give: it is printed and read again, so what `world check` refuses is
/// refused here with the same words, and what is saved is what was seen. A file is saved in canonical form: opened and saved
/// without a change it is the same to the byte, if it was canonical; comments are not kept, and [`comments`](Editor::comments) says
/// so before.
#[derive(Clone, Debug)]
pub struct Editor {
    file: String,
    /// Every world since it was opened; the present one is number `now`.
    history: Vec<World>,
    now: usize,
    saved: Option<usize>,
    /// How many comments the text had that it was opened from.
    comments: usize,
}

/// How far from a place the handle of its heading is, of the shorter side of the world.
const HEADING: f64 = 0.05;

impl Editor {
    /// Opens the text of a world file. `file` is what errors call it.
    ///
    /// # Errors
    /// [`WorldError`] when the file is refused.
    pub fn open(file: &str, text: &str) -> Result<Self, WorldError> {
        let world = World::parse(file, text)?;
        let saved = (world.to_ron() == text).then_some(0);
        Ok(Editor { file: file.to_owned(), history: vec![world], now: 0, saved, comments: comments(text) })
    }

    /// Opens a world that is in no file yet.
    pub fn new(world: World) -> Self {
        Editor { file: "world.ron".into(), history: vec![world], now: 0, saved: None, comments: 0 }
    }

    /// The world as it is.
    pub fn world(&self) -> &World {
        &self.history[self.now]
    }

    /// The world as a file: canonical.
    pub fn text(&self) -> String {
        self.world().to_ron()
    }

    /// To be called when [`text`](Self::text) is on the disk.
    pub fn mark_saved(&mut self) {
        (self.saved, self.comments) = (Some(self.now), 0);
    }

    /// How many comments are in the file that was opened: saving drops them.
    pub fn comments(&self) -> usize {
        self.comments
    }

    /// What errors call the file.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Whether a change can be taken back.
    pub fn can_undo(&self) -> bool {
        self.now > 0
    }

    /// Whether a change that was taken back can be made again.
    pub fn can_redo(&self) -> bool {
        self.now + 1 < self.history.len()
    }

    /// Whether the file on the disk is the world as it is.
    pub fn is_saved(&self) -> bool {
        self.saved == Some(self.now)
    }

    /// The world that a change would give; nothing is changed. For showing what a drag under way comes to.
    ///
    /// # Errors
    /// [`EditError`] says why the change is refused.
    pub fn preview(&self, op: &Op) -> Result<World, EditError> {
        let changed = changed(self.world(), op)?;
        Ok(World::parse(&self.file, &changed.to_ron())?)
    }

    /// Makes a change. What was undone before can't be done again then.
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

    /// Takes the last change back; false when there is none.
    pub fn undo(&mut self) -> bool {
        let can = self.can_undo();
        self.now -= usize::from(can);
        can
    }

    /// Makes the change again that was taken back last; false when there is none.
    pub fn redo(&mut self) -> bool {
        let can = self.can_redo();
        self.now += usize::from(can);
        can
    }

    /// The shape of a wall, an obstacle or a mark; `None` for anything else.
    pub fn shape(&self, name: &str) -> Option<EditShape> {
        shape_of(self.world(), name)
    }

    /// The handles of a wall, an obstacle or a mark, or of a place: where it is, and where it faces. None for anything else.
    pub fn handles(&self, name: &str) -> Vec<Handle> {
        if let Some(place) = self.world().place(name) {
            let Bounds { min, max } = self.world().bounds;
            let (s, c) = sin_cos(place.pose.theta);
            let ahead = Vector2::new(c, s) * (HEADING * lesser(max.x - min.x, max.y - min.y));
            let at = place.pose.position();
            return [(0, at), (1, at + ahead)].map(|(index, at)| Handle { index, at, makes_corner: false }).to_vec();
        }
        self.shape(name).map_or_else(Vec::new, |shape| shape.handles())
    }

    /// What is right in a file and would still be refused when the world runs: robots that start in contact.
    pub fn warnings(&self) -> Vec<String> {
        let atlas = Atlas::new(self.world().clone());
        let starts = atlas.robots().iter().enumerate().filter_map(|(i, r)| {
            let refusal = Teleport::ask_only(&atlas.checker(i)?, &r.q).err()?;
            Some(match refusal {
                Refusal::Overlap { .. } => format!("{} {refusal} at its start", r.name),
                other => format!("{}: {other}", r.name),
            })
        });
        starts.collect()
    }

    /// A name that nothing has yet: `wall`, `wall 2`, ..
    pub fn free_name(&self, kind: &str) -> String {
        let taken = |name: &str| is_taken(self.world(), name);
        let numbered = std::iter::once(kind.to_owned()).chain((2..).map(|n: u32| format!("{kind} {n}")));
        numbered.into_iter().find(|name| !taken(name)).unwrap_or_default()
    }
}

/// A point moved onto the nearest of `corners` within `reach`, else onto the grid of `step` metres (0 for none).
pub fn snap(p: Point2, corners: &[Point2], reach: f64, step: f64) -> Point2 {
    let off = |c: &Point2| hypot(c.x - p.x, c.y - p.y);
    let nearest = corners.iter().filter(|c| off(c) <= reach).min_by(|a, b| off(a).total_cmp(&off(b)));
    match nearest {
        Some(corner) => *corner,
        None if step > 0.0 => {
            // divided by a whole number where that is the step, so that 24 steps of 0.05 are 1.2
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
