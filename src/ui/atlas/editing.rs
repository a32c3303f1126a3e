//! Editing in the atlas: selecting, dragging and changing things.

use std::sync::Arc;

use super::state::Drag;
use crate::atlas::{Op, snap};
use crate::geometry::{Point2, Pose2};
use crate::num::{atan2, greater, lesser};
use crate::picture::world as picture_of;
use crate::ui::AtlasState;
use crate::worlds::Bounds;

/// Points snap to a grid of so many metres.
const GRID: f64 = 0.05;

/// Headings snap to multiples of this, radians: 15 degrees.
const TURN: f64 = std::f64::consts::PI / 12.0;

impl AtlasState {
    /// Whether the last change can be taken back, and whether the one taken back last can be made again.
    pub fn can_undo(&self) -> [bool; 2] {
        [self.editor.can_undo(), self.editor.can_redo()]
    }

    /// Half the size of a thing that is added, metres: a 20th of the shorter side of the world, on the grid.
    pub fn unit(&self) -> f64 {
        let Bounds { min, max } = self.world().bounds;
        greater(1.0, (0.05 * lesser(max.x - min.x, max.y - min.y) / GRID).round()) * GRID
    }

    /// What saving would drop, in words.
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
        let known = |n: &&str| self.editor.shape(n).is_some() || self.world().place(n).is_some();
        self.selected = name.filter(known).map(str::to_owned);
        self.name_text = self.selected.clone().unwrap_or_default();
        self.message = None;
    }

    /// The handle of the selected thing within `reach` metres of a point.
    pub fn handle_at(&self, at: Point2, reach: f64) -> Option<usize> {
        let handles = self.editor.handles(self.selected.as_ref()?);
        handles.into_iter().find(|h| (h.at - at).norm() <= reach).map(|h| h.index)
    }

    /// A drag begins.
    pub fn begin_drag(&mut self, from: Point2, handle: Option<usize>) {
        self.drag = self.selected.is_some().then_some(Drag { from, handle, op: None });
    }

    /// A drag goes on to a point, which snaps to corners within `reach` metres and to a grid of 5 cm; a heading snaps to 15 degrees.
    pub fn drag_to(&mut self, to: Point2, reach: f64) {
        let (Some(drag), Some(name)) = (self.drag.clone(), self.selected.clone()) else { return };
        let others = self.world().obstacles.iter().filter(|o| o.name != name);
        let mut corners: Vec<Point2> =
            others.flat_map(|o| o.placed().flat_map(|p| p.core().to_vec()).collect::<Vec<_>>()).collect();
        let shape = self.editor.shape(&name);
        // onto its neighbour, where a corner goes away
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

    /// A drag ends: its last accepted change is made.
    pub fn end_drag(&mut self) {
        let drag = self.drag.take();
        match drag.and_then(|d| d.op) {
            Some(op) => self.change(&op, self.selected.clone()),
            None => self.redraw(),
        }
    }

    /// Makes a change, or says why not; then `select` is selected.
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

    /// Undoes a change, or does it again.
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
    fn a_thing_is_dragged_by_itself_and_by_its_handles_and_refused_changes_are_told() {
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
