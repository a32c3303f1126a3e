//! Editing in the atlas: adding, selecting, dragging and changing things.

use super::state::{Drag, Mode};
use crate::window::ui::AtlasState;
use motion_lab_core::configuration::Configuration;
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Vector2};
use motion_lab_core::num::{atan2, greater, lesser};
use motion_lab_core::picture::{Anchor, Drawing, Face, Item, Role, true_minus};
use motion_lab_core::worlds::{ObstacleKind, World};
use motion_lab_sim::atlas::{Editor, Op, Template, snap};

/// Spacing of the grid that points snap to, metres.
const GRID: f64 = 0.05;

/// Headings snap to multiples of this, radians: 15 degrees.
const TURN: f64 = std::f64::consts::PI / 12.0;

impl AtlasState {
    /// Whether a change can be undone, and whether one can be redone.
    pub fn can_undo(&self) -> [bool; 2] {
        [self.editor.can_undo(), self.editor.can_redo()]
    }

    /// Whether a wall was picked, so that the numbers of its points are seen.
    pub fn has_picked_wall(&self) -> bool {
        let selected = self.selected.as_ref().filter(|_| self.mode == Mode::Edit && !self.is_new);
        let thing = selected.and_then(|name| self.world().obstacle(name));
        thing.is_some_and(|obstacle| obstacle.kind == ObstacleKind::Wall)
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

    /// Selects a thing by name, or nothing. What was typed for another thing is entered first. A reason in `message`
    /// stays.
    pub fn select(&mut self, name: Option<&str>) {
        let is_another = self.selected.as_deref() != name;
        if is_another {
            self.enter();
            self.is_new = false;
        }
        self.selected = name.filter(|name| self.editor.holds(name)).map(str::to_owned);
        let shape = self.selected.as_ref().and_then(|name| self.editor.shape(name));
        let known = self.shape.take().filter(|_| !is_another);
        self.shape = shape.map(|shape| known.map_or_else(|| shape.clone(), |known| shape.ordered_as(&known)));
        self.forget_name();
    }

    /// Selects what the reader points at, or nothing.
    pub fn pick(&mut self, name: Option<&str>) {
        self.select(name);
        self.is_new = false;
    }

    /// Adds a thing there, snapped to the grid, and selects it.
    pub fn add(&mut self, template: Template, at: Point2) {
        let unit = self.unit();
        self.add_by(template, |name| template.op(name, snap(at, &[], 0.0, GRID), unit));
    }

    /// Adds a thing drawn from one point to another, both snapped to corners within `reach`, else to the grid, and
    /// selects it. Where the two are one it is added there.
    pub fn add_drawn(&mut self, template: Template, ends: [Point2; 2], reach: Option<f64>) {
        let ends = self.drawn_ends(ends, reach);
        if ends[0] == ends[1] {
            return self.add(template, ends[0]);
        }
        self.add_by(template, |name| template.drawn(name, ends));
    }

    /// The ends of what is drawn, snapped; without a `reach` as they are.
    fn drawn_ends(&self, ends: [Point2; 2], reach: Option<f64>) -> [Point2; 2] {
        let Some(reach) = reach else { return ends };
        let corners = self.corners("", None);
        ends.map(|end| snap(end, &corners, reach, GRID))
    }

    /// What drawing the thing from one point to another would add, with its size beside the second.
    pub fn drawn_items(&self, template: Template, ends: [Point2; 2], reach: Option<f64>) -> Vec<Item> {
        let ends = self.drawn_ends(ends, reach);
        let mut items = self.items_of(&template.drawn(template.name(), ends), &template.name());
        let size = Drawing::Label {
            at: ends[1],
            text: true_minus(&template.measured(ends)),
            anchor: Anchor::Above,
            face: Face::Sans,
            size_px: 12.0,
            plate: true,
        };
        items.push(Item::new("size", "how large it is", Role::Text, size));
        items
    }

    fn add_by(&mut self, template: Template, op: impl FnOnce(String) -> Op) {
        let name = self.editor.free_name(&template.name());
        let op = op(name.clone());
        self.placing = None;
        self.enter();
        self.change(&op, Some(name.clone()));
        self.is_new = self.selected == Some(name);
    }

    /// What adding the thing there would add: its outline, and its handles.
    pub fn added_items(&self, template: Template, at: Point2) -> Vec<Item> {
        let name = template.name();
        self.items_of(&template.op(name.clone(), snap(at, &[], 0.0, GRID), self.unit()), &name)
    }

    /// The outline and the handles of the thing of this name that an operation adds.
    fn items_of(&self, op: &Op, name: &str) -> Vec<Item> {
        let alone = Editor::new(World::empty("new", self.world().bounds)).preview(op);
        alone.map_or_else(|_| Vec::new(), |world| Editor::new(world).selected_items(name))
    }

    /// The handle of the selected thing within `reach` metres of a point.
    pub fn handle_at(&self, at: Point2, reach: f64) -> Option<usize> {
        let handles = self.editor.handles(self.selected.as_ref()?);
        handles.into_iter().find(|h| (h.at - at).norm() <= reach).map(|h| h.index)
    }

    /// Begins a drag of the selected thing, or of its handle `handle`.
    pub fn begin_drag(&mut self, from: Point2, handle: Option<usize>) {
        self.enter();
        self.drag = self.selected.is_some().then_some(Drag { from, handle });
    }

    /// Continues a drag to a point. It snaps to corners within `reach` metres, else to a grid of 5 cm. Headings snap to
    /// multiples of 15 degrees. Without a reach nothing snaps.
    pub fn drag_to(&mut self, to: Point2, reach: Option<f64>) {
        let (Some(drag), Some(name)) = (self.drag.clone(), self.selected.clone()) else { return };
        let grid = if reach.is_some() { GRID } else { 0.0 };
        let snapped = reach.map_or(to, |reach| snap(to, &self.corners(&name, drag.handle), reach, grid));
        let op = match (drag.handle, self.editor.pose(&name)) {
            (Some(1), Some(pose)) => {
                let way = to - pose.position();
                let theta = atan2(way.y, way.x);
                let theta = if reach.is_some() { (theta / TURN).round() * TURN } else { theta };
                Op::SetPose { pose: Pose2 { theta, ..pose }, name }
            }
            (Some(handle), _) => Op::Drag { name, handle, to: snapped },
            (None, _) => Op::Move { name, by: snapped - snap(drag.from, &[], 0.0, grid) },
        };
        self.try_out(op);
    }

    /// The points that a drag of the thing of this name snaps to.
    fn corners(&self, name: &str, handle: Option<usize>) -> Vec<Point2> {
        let others = self.world().obstacles.iter().filter(|o| o.name != name);
        let mut corners: Vec<Point2> =
            others.flat_map(|o| o.placed().flat_map(|p| p.core().to_vec()).collect::<Vec<_>>()).collect();
        let shape = self.editor.shape(name);
        // its own neighbours too: a corner dropped on one of them goes away
        corners.extend(shape.iter().zip(handle).flat_map(|(shape, handle)| shape.neighbours(handle)));
        corners
    }

    /// Shows the world with a change, without making it. A refused one leaves its reason in `message`.
    pub fn try_out(&mut self, op: Op) {
        if self.tried.as_ref() == Some(&op) {
            // held still: what is drawn, and what is known of its space, stays
            return;
        }
        match self.editor.preview(&op) {
            Ok(world) => {
                self.see(world.clone());
                self.preview = Some(Editor::new(world).knowing(self.editor.kinds().clone()));
                (self.tried, self.message) = (Some(op), None);
            }
            Err(error) => (self.tried, self.message) = (None, Some(error.to_string())),
        }
    }

    /// Makes the change that was tried out last, unless that was refused.
    pub fn settle(&mut self) {
        match self.tried.take() {
            Some(op) => self.change(&op, self.selected.clone()),
            None if self.preview.is_some() => self.redraw(),
            // a click moved nothing, and the world is drawn as it is
            None => (self.drag, self.held) = (None, None),
        }
    }

    /// Ends a drag and makes its change, unless that was refused.
    pub fn end_drag(&mut self) {
        self.drag = None;
        self.settle();
    }

    /// Drops what is being added or dragged; where nothing is, selects nothing.
    pub fn leave(&mut self) {
        let is_placing = self.placing.take().is_some();
        if !self.drop_drag() && !is_placing {
            self.select(None);
        }
        self.message = None;
    }

    /// Removes what is selected.
    pub fn delete(&mut self) {
        if let Some(name) = self.selected.clone() {
            self.change(&Op::Delete { name }, None);
        }
    }

    /// Moves the robot, the point that is measured or what is selected by this many steps of 5 cm.
    pub fn step(&mut self, steps: [f64; 2]) {
        let by = Vector2::from(steps) * GRID;
        match self.mode {
            Mode::Put => {
                if let Some(robot) = self.atlas.robots().get(self.robot) {
                    self.ask(robot.robot.reference(&robot.q) + by, None, true);
                }
            }
            Mode::Measure => self.probe = Some(self.probe.unwrap_or_else(|| self.middle()) + by),
            Mode::Edit => {
                if let Some(name) = self.selected.clone() {
                    self.change(&Op::Move { name: name.clone(), by }, Some(name));
                }
            }
        }
    }

    /// Turns the robot or what is selected by 15 degrees. What has no heading stays as it is.
    pub fn turn(&mut self, left: bool) {
        let turned = |theta: f64| (theta / TURN).round() * TURN + if left { TURN } else { -TURN };
        match self.mode {
            Mode::Put => {
                let Some(robot) = self.atlas.robots().get(self.robot) else { return };
                if let Some(theta) = robot.q.coordinates().get(2).filter(|_| robot.robot.annulus().is_none()) {
                    self.ask(robot.robot.reference(&robot.q), Some(turned(*theta)), true);
                }
            }
            Mode::Measure => {}
            Mode::Edit => {
                let pose = self.selected.as_ref().and_then(|name| Some((name.clone(), self.editor.pose(name)?)));
                if let Some((name, pose)) = pose {
                    let pose = Pose2 { theta: turned(pose.theta), ..pose };
                    self.change(&Op::SetPose { name: name.clone(), pose }, Some(name));
                }
            }
        }
    }

    /// Makes a change and selects `select`. A refused change leaves its reason in `message`.
    pub fn change(&mut self, op: &Op, select: Option<String>) {
        match self.editor.apply(op) {
            Ok(()) => {
                self.message = None;
                self.redraw();
                if let Op::Rename { name, to } = op
                    && self.selected.as_ref() == Some(name)
                {
                    // the same thing, whose corners keep their numbers
                    self.selected = Some(to.clone());
                }
                self.select(select.as_deref());
            }
            Err(error) => {
                self.redraw();
                self.message = Some(error.to_string());
            }
        }
    }

    /// Undoes a change if `back`, else redoes one. What was typed is a change; a drag under way is dropped, and is all
    /// that is undone then.
    pub fn undo(&mut self, back: bool) {
        self.enter();
        if self.drop_drag() && back {
            return;
        }
        self.message = None;
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

    #[test]
    fn a_thing_is_dragged_by_itself_and_by_its_handles_and_refused_changes_are_reported() {
        let mut atlas = AtlasState::of(World::workbench());
        atlas.select(Some("the block"));
        atlas.begin_drag(Point2::new(0.75, 1.25), None);
        atlas.drag_to(Point2::new(-0.25, 1.25), Some(0.05));
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
