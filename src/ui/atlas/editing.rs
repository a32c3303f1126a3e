//! Editing in the atlas: selecting, dragging and changing things.

use std::sync::Arc;

use super::state::Drag;
use crate::atlas::{Op, snap};
use crate::geometry::{Aabb, Point2, Pose2};
use crate::num::{atan2, greater, lesser};
use crate::picture::world as picture_of;
use crate::ui::AtlasState;

/// Spacing of the grid that points snap to, metres.
const GRID: f64 = 0.05;

/// Headings snap to multiples of this, radians: 15 degrees.
const TURN: f64 = std::f64::consts::PI / 12.0;

impl AtlasState {
    /// Whether a change can be undone, and whether one can be redone.
    pub fn can_undo(&self) -> [bool; 2] {
        [self.editor.can_undo(), self.editor.can_redo()]
    }

    /// The unit that added things are sized by, metres: a 20th of the world's shorter side, rounded to the grid.
    pub fn unit(&self) -> f64 {
        let Aabb { min, max } = self.world().bounds;
        greater(1.0, (0.05 * lesser(max.x - min.x, max.y - min.y) / GRID).round()) * GRID
    }

    /// A warning of the comments that saving would drop; `None` without comments.
    pub fn drops(&self) -> Option<String> {
        let words = match self.editor.comments() {
            0 => return None,
            1 => "one comment".to_owned(),
            n => format!("{n} comments"),
        };
        Some(format!("Saving drops the {words} of {}: worlds are saved in canonical form.", self.editor.file()))
    }

    /// Selects a thing by name, or nothing.
    pub fn select(&mut self, name: Option<&str>) {
        let known = |n: &&str| !self.editor.handles(n).is_empty();
        self.selected = name.filter(known).map(str::to_owned);
        self.name_text = self.selected.clone().unwrap_or_default();
        self.message = None;
    }

    /// The handle of the selected thing within `reach` metres of a point.
    pub fn handle_at(&self, at: Point2, reach: f64) -> Option<usize> {
        let handles = self.editor.handles(self.selected.as_ref()?);
        handles.into_iter().find(|h| (h.at - at).norm() <= reach).map(|h| h.index)
    }

    /// Begins a drag of the selected thing, or of its handle `handle`.
    pub fn begin_drag(&mut self, from: Point2, handle: Option<usize>) {
        self.drag = self.selected.is_some().then_some(Drag { from, handle, op: None });
    }

    /// Continues a drag to a point. It snaps to corners within `reach` metres, else to a grid of 5 cm. Headings snap to
    /// multiples of 15 degrees.
    pub fn drag_to(&mut self, to: Point2, reach: f64) {
        let (Some(drag), Some(name)) = (self.drag.clone(), self.selected.clone()) else { return };
        let others = self.world().obstacles.iter().filter(|o| o.name != name);
        let mut corners: Vec<Point2> =
            others.flat_map(|o| o.placed().flat_map(|p| p.core().to_vec()).collect::<Vec<_>>()).collect();
        let shape = self.editor.shape(&name);
        // its own neighbours too: a corner dropped on one of them goes away
        corners.extend(shape.iter().zip(drag.handle).flat_map(|(shape, handle)| shape.neighbours(handle)));
        let snapped = snap(to, &corners, reach, GRID);
        let op = match (drag.handle, self.world().place(&name)) {
            (Some(1), Some(place)) => {
                let way = to - place.pose.position();
                let theta = (atan2(way.y, way.x) / TURN).round() * TURN;
                Op::SetPose { pose: Pose2 { theta, ..place.pose }, name }
            }
            (Some(handle), _) => Op::Drag { name, handle, to: snapped },
            (None, _) => Op::Move { name, by: snapped - snap(drag.from, &[], 0.0, GRID) },
        };
        match self.editor.preview(&op) {
            Ok(world) => {
                self.still = Arc::new(picture_of(&world));
                self.message = None;
                self.drag = Some(Drag { op: Some(op), ..drag });
            }
            Err(error) => {
                self.message = Some(error.to_string());
                self.drag = Some(Drag { op: None, ..drag });
            }
        }
    }

    /// Ends a drag and makes its change, unless that was refused.
    pub fn end_drag(&mut self) {
        let drag = self.drag.take();
        match drag.and_then(|d| d.op) {
            Some(op) => self.change(&op, self.selected.clone()),
            None => self.redraw(),
        }
    }

    /// Makes a change and selects `select`. A refused change leaves its reason in `message`.
    pub fn change(&mut self, op: &Op, select: Option<String>) {
        match self.editor.apply(op) {
            Ok(()) => {
                self.message = None;
                self.redraw();
                self.select(select.as_deref());
            }
            Err(error) => {
                self.redraw();
                self.message = Some(error.to_string());
            }
        }
    }

    /// Undoes a change if `back`, else redoes one.
    pub fn undo(&mut self, back: bool) {
        if back {
            self.editor.undo()
        } else {
            self.editor.redo()
        };
        self.redraw();
        self.select(self.selected.clone().as_deref());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worlds::World;

    #[test]
    fn a_thing_is_dragged_by_itself_and_by_its_handles_and_refused_changes_are_reported() {
        let mut atlas = AtlasState::of(World::workbench());
        atlas.select(Some("the block"));
        atlas.begin_drag(Point2::new(0.75, 1.25), None);
        atlas.drag_to(Point2::new(-0.25, 1.25), 0.05);
        assert_eq!(atlas.world(), &World::workbench(), "not before it is let go");
        atlas.end_drag();
        let x = |a: &AtlasState| a.world().obstacle("the block").unwrap().placed().next().unwrap().core()[0].x;
        assert!((x(&atlas) + 0.5).abs() < 1e-12, "{}", x(&atlas));
        atlas.undo(true);
        assert_eq!(atlas.world(), &World::workbench());
        atlas.undo(false);
        assert!((x(&atlas) + 0.5).abs() < 1e-12);
        // a name that is taken
        atlas.change(&Op::Rename { name: "the block".into(), to: "the post".into() }, None);
        assert!(atlas.message.as_ref().is_some_and(|m| m.contains("the post")), "{:?}", atlas.message);
        assert_eq!(atlas.selected.as_deref(), Some("the block"));
        assert!(!atlas.is_saved());
    }
}
