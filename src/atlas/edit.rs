//! `Editor`, a world under a hand: every change checked as world files are, every change undone again.

use super::op::{changed, is_taken};
use super::{Atlas, EditError, EditShape, Handle, Op, Refusal, Teleport};
use crate::geometry::Point2;
use crate::num::hypot;
use crate::worlds::{World, WorldError};

/// A world under a hand.
///
/// Each change gives a world that reading its file would give: it is printed and read again, so what `world check` refuses is
/// refused here with the same words, and what is saved is what was seen. A file is saved in canonical form: opened and saved
/// without a change it is the same to the byte, if it was canonical; comments are not kept.
#[derive(Clone, Debug)]
pub struct Editor {
    file: String,
    /// Every world since it was opened; the present one is number `now`.
    history: Vec<World>,
    now: usize,
    saved: Option<usize>,
}

impl Editor {
    /// Opens the text of a world file. `file` is what errors call it.
    ///
    /// # Errors
    /// [`WorldError`] when the file is refused.
    pub fn open(file: &str, text: &str) -> Result<Self, WorldError> {
        let world = World::parse(file, text)?;
        let saved = (world.to_ron() == text).then_some(0);
        Ok(Editor { file: file.to_owned(), history: vec![world], now: 0, saved })
    }

    /// Opens a world that is in no file yet.
    pub fn new(world: World) -> Self {
        Editor { file: "world.ron".into(), history: vec![world], now: 0, saved: None }
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
        self.saved = Some(self.now);
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
        let can = self.now > 0;
        self.now -= usize::from(can);
        can
    }

    /// Makes the change again that was taken back last; false when there is none.
    pub fn redo(&mut self) -> bool {
        let can = self.now + 1 < self.history.len();
        self.now += usize::from(can);
        can
    }

    /// The handles of a wall or obstacle; none for anything else.
    pub fn handles(&self, name: &str) -> Vec<Handle> {
        self.world().obstacle(name).map_or_else(Vec::new, |o| EditShape::of(o).handles())
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
        None if step > 0.0 => Point2::new((p.x / step).round() * step, (p.y / step).round() * step),
        None => p,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose2, Vector2};

    fn p(x: f64, y: f64) -> Point2 {
        Point2::new(x, y)
    }

    fn name(name: &str) -> String {
        name.to_owned()
    }

    fn boxed(x0: f64, y0: f64, x1: f64, y1: f64) -> EditShape {
        EditShape::Box { min: p(x0, y0), max: p(x1, y1) }
    }

    #[test]
    fn canonical_files_are_saved_as_they_were_opened() {
        for built_in in World::built_in_names() {
            let text = World::built_in(built_in).unwrap().to_ron();
            let mut editor = Editor::open("w.ron", &text).unwrap();
            assert!(editor.is_saved());
            assert_eq!(editor.text(), text, "{built_in}: open, save: the same bytes");
            // and an edit taken back leaves no trace
            let place = editor.world().places[0].name.clone();
            editor.apply(&Op::Move { name: place, by: Vector2::new(0.1, 0.0) }).unwrap();
            assert!(editor.text() != text && !editor.is_saved());
            assert!(editor.undo() && editor.is_saved());
            assert_eq!(editor.text(), text);
        }
    }

    #[test]
    fn a_drawn_world_is_a_world_file() {
        let mut editor = Editor::new(World::workbench());
        let ops = [
            Op::Add {
                name: name("the fence"),
                shape: EditShape::Wall(vec![p(-2.0, -2.0), p(2.0, -2.0), p(2.0, -1.8)]),
            },
            Op::Add { name: name("the tree"), shape: EditShape::Disc { center: p(-1.5, 1.5), radius: 0.2 } },
            Op::Add {
                name: name("the ell"),
                shape: EditShape::Polygon(vec![
                    p(1.5, 0.0),
                    p(2.1, 0.0),
                    p(2.1, 0.2),
                    p(1.7, 0.2),
                    p(1.7, 0.9),
                    p(1.5, 0.9),
                ]),
            },
            Op::Add {
                name: name("the log"),
                shape: EditShape::Rounded { points: vec![p(-2.0, 0.0), p(-1.8, 0.3)], radius: 0.05 },
            },
            Op::AddPlace { name: name("there"), pose: Pose2::new(1.0, 0.3, 7.0) },
            Op::Move { name: name("the post"), by: Vector2::new(-0.5, 0.25) },
            Op::Drag { name: name("the block"), handle: 2, to: p(1.2, 1.8) },
            Op::Drag { name: name("the fence"), handle: 2, to: p(2.0, -1.0) },
            Op::Drag { name: name("the tree"), handle: 1, to: p(-1.5, 1.9) },
            Op::Rename { name: name("the shelf"), to: name("the \"bar\"") },
            Op::Delete { name: name("the base") },
        ];
        for op in &ops {
            let seen = editor.preview(op).unwrap();
            editor.apply(op).unwrap();
            assert_eq!(*editor.world(), seen);
            assert_eq!(World::parse("w.ron", &editor.text()).unwrap(), seen, "{op:?}");
        }
        let world = editor.world();
        assert_eq!(EditShape::of(world.obstacle("the post").unwrap()), boxed(-0.7 - 0.5, 0.55, -0.5 - 0.5, 0.75));
        assert_eq!(EditShape::of(world.obstacle("the block").unwrap()), boxed(0.5, 1.0, 1.2, 1.8));
        let EditShape::Disc { radius, .. } = EditShape::of(world.obstacle("the tree").unwrap()) else {
            panic!("a disc")
        };
        assert!((radius - 0.4).abs() < 1e-12);
        assert!(world.obstacle("the \"bar\"").is_some() && world.places.iter().all(|p| p.name != "the base"));
        assert!(world.place("there").unwrap().pose.theta < 3.2, "an angle is wrapped, as in a file");
        assert!(editor.handles("the ell").len() >= 7, "its convex pieces' corners");
        for _ in &ops {
            assert!(editor.undo());
        }
        assert!(!editor.undo());
        assert_eq!(*editor.world(), World::workbench());
        while editor.redo() {}
        assert!(editor.world().obstacle("the ell").is_some());
    }

    #[test]
    fn what_a_file_would_be_refused_for_is_refused_and_changes_nothing() {
        let mut editor = Editor::new(World::workbench());
        let bow = EditShape::Polygon(vec![p(0.0, 0.0), p(1.0, 1.0), p(1.0, 0.0), p(0.0, 1.0)]);
        let refused = [
            (Op::Add { name: name("the block"), shape: boxed(0.0, 0.0, 1.0, 1.0) }, "the name is taken"),
            (Op::Add { name: name(""), shape: boxed(0.0, 0.0, 1.0, 1.0) }, "it must be 1 to 200 bytes"),
            (Op::Add { name: name("dust"), shape: EditShape::Disc { center: p(0.0, 0.0), radius: 0.0 } }, "radius 0 m"),
            (Op::Add { name: name("nan"), shape: EditShape::Disc { center: p(f64::NAN, 0.0), radius: 1.0 } }, ""),
            (Op::Add { name: name("bow"), shape: bow }, "polygon: "),
            (Op::Add { name: name("dot"), shape: EditShape::Wall(vec![p(0.0, 0.0)]) }, ""),
            (Op::Drag { name: name("the block"), handle: 2, to: p(0.5, 1.0) }, "the smallest feature"),
            (Op::Rename { name: name("the block"), to: name("the post") }, "the name is taken"),
            (Op::Delete { name: name("nobody") }, "nothing here is called \"nobody\""),
            (Op::Reshape { name: name("the base"), shape: boxed(0.0, 0.0, 1.0, 1.0) }, "has no shape"),
            (Op::Move { name: name("Reach"), by: Vector2::new(1.0, 0.0) }, "has no shape"),
        ];
        for (op, reason) in refused {
            let error = editor.apply(&op).unwrap_err().to_string();
            assert!(error.contains(reason), "{op:?}: {error}");
            assert_eq!(*editor.world(), World::workbench());
        }
        assert!(!editor.undo(), "nothing was done");
    }

    #[test]
    fn closed_walls_stay_closed_and_names_stay_free() {
        let mut editor = Editor::new(World::lot());
        let square = vec![p(1.0, 1.0), p(2.0, 1.0), p(2.0, 2.0), p(1.0, 1.0)];
        editor.apply(&Op::Add { name: editor.free_name("wall"), shape: EditShape::Wall(square) }).unwrap();
        assert_eq!(editor.handles("wall").len(), 3);
        editor.apply(&Op::Drag { name: name("wall"), handle: 0, to: p(0.5, 0.5) }).unwrap();
        let EditShape::Wall(points) = EditShape::of(editor.world().obstacle("wall").unwrap()) else { panic!("a wall") };
        assert_eq!((points[0], points[3]), (p(0.5, 0.5), p(0.5, 0.5)));
        assert_eq!(editor.free_name("wall"), "wall 2");
    }

    #[test]
    fn starts_in_contact_are_told() {
        let mut editor = Editor::new(World::lot());
        assert!(editor.warnings().is_empty());
        editor.apply(&Op::Move { name: name("the west pillar"), by: Vector2::new(1.0, -2.4) }).unwrap();
        assert_eq!(editor.warnings(), ["Hitch would overlap the west pillar at its start"]);
    }

    #[test]
    fn points_snap_to_corners_first_and_then_to_the_grid() {
        let corners = [p(1.0, 1.0), p(1.06, 1.0)];
        assert_eq!(snap(p(1.04, 1.01), &corners, 0.1, 0.25), corners[1]);
        let on_grid = snap(p(1.30, 0.88), &corners, 0.1, 0.25);
        assert_eq!(on_grid, p(1.25, 1.0));
        assert_eq!(snap(p(1.3, 0.9), &corners, 0.1, 0.0), p(1.3, 0.9));
    }
}
