//! `AtlasState`, the state of the atlas: the world in the editor, its robots, a refusal, a drag.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::atlas_space::AtlasSpace;
use super::field::{NumberField, TypedText};
use motion_lab_core::configuration::{AnyConfiguration, Kinds};
use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::{Item, Picture, world as picture_of};
use motion_lab_core::worlds::World;
use motion_lab_sim::anatomy::WorldSource;
use motion_lab_sim::atlas::{Atlas, EditShape, Editor, GridLayer, Op, TeleportRefusal, Template};

/// The side of a grid cell at first, metres.
pub const FIRST_CELL: f64 = 0.25;

/// The effect of a click.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    #[default]
    Put,
    /// Nothing: pointing shows distances.
    Measure,
    Edit,
}

/// A drag of a thing, or of one of its handles.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Drag {
    pub from: Point2,
    pub handle: Option<usize>,
}

/// The state of the atlas.
#[derive(Clone, Debug)]
pub struct AtlasState {
    pub(crate) editor: Editor,
    /// The world with the change that is tried out.
    pub(super) preview: Option<Editor>,
    /// The change that is tried out and was not refused.
    pub(super) tried: Option<Op>,
    /// The file it was read from or saved in.
    path: Option<PathBuf>,
    /// The built-in world that it began as, by the name that `World::built_in` knows.
    built_in: Option<&'static str>,
    /// Which one of the worlds of its name this is, from 1 on.
    copy: u32,
    /// The names of the edited worlds beside it.
    pub(crate) others: Vec<String>,
    pub(super) atlas: Atlas,
    /// The world, with the change that is tried out, and its robots at their starts.
    pub(super) starts: Atlas,
    /// The picture of the world, with the change that is tried out.
    pub(crate) still: Arc<Picture>,
    /// The name labels, with the scale that they were placed for, pixels per metre, and whether the world is edited.
    pub(super) labels: Option<((f64, bool), Vec<Item>)>,
    warnings: Vec<String>,
    pub(super) grid: Option<(GridLayer, Arc<Picture>)>,
    /// The configuration space of the robot that a click places.
    pub(super) space: Option<AtlasSpace>,
    /// The point that is measured while the pointer is elsewhere.
    pub probe: Option<Point2>,
    /// The effect of a click.
    pub mode: Mode,
    /// Index of the robot that a click places.
    pub robot: usize,
    /// Where the pointer was pressed.
    pub pressed: Option<Point2>,
    pub(super) refused: Option<(AnyConfiguration, TeleportRefusal)>,
    /// Where releasing the pointer puts the robot.
    pub(super) wanted: Option<AnyConfiguration>,
    /// The side of a grid cell, metres.
    pub resolution: f64,
    /// The name of the selected thing.
    pub selected: Option<String>,
    /// Whether that was only added, and not picked since.
    pub(super) is_new: bool,
    /// Its shape, the corners in the order that they had when it was selected.
    pub(super) shape: Option<EditShape>,
    /// What is typed into a number field and not yet entered.
    pub(super) typed: Option<TypedText>,
    /// The number field that is dragged.
    pub(super) held: Option<NumberField>,
    /// The text of its name field.
    pub name_text: String,
    /// Whether that text was typed and is not yet entered.
    pub(super) is_naming: bool,
    /// The reason why the last change was refused.
    pub message: Option<String>,
    pub(crate) drag: Option<Drag>,
    /// The thing that the next click on the paper adds.
    pub placing: Option<Template>,
    /// Where the drag that draws it began.
    pub drawn_from: Option<Point2>,
    /// What is looked for in the list of everything.
    pub search: String,
}

impl Default for AtlasState {
    fn default() -> Self {
        AtlasState::of(World::apartment())
    }
}

impl AtlasState {
    /// The state for a world that is in no file.
    pub fn of(world: World) -> Self {
        AtlasState { built_in: world.built_in_name(), ..AtlasState::edited(Editor::new(world)) }
    }

    /// The built-in world that it began as, by the name that `World::built_in` knows.
    pub fn built_in(&self) -> Option<&'static str> {
        self.built_in
    }

    /// Its name in the list of worlds: of the world, or of the file that it was opened from; and whether it has edits,
    /// with its number where another edited one of this name was there before it.
    pub fn label(&self) -> String {
        let name = self.name();
        let is_in_file = self.built_in.is_none() && self.path.is_some() && self.is_saved();
        match (self.has_history() && !is_in_file, self.copy) {
            (false, _) => name.to_owned(),
            (true, 1) => format!("{name}, edited"),
            (true, copy) => format!("{name} ({copy}), edited"),
        }
    }

    fn name(&self) -> &str {
        let in_file = self.path.as_ref().filter(|_| self.built_in.is_none());
        in_file.and_then(|path| path.file_name()?.to_str()).unwrap_or(&self.world().name)
    }

    /// The same state, with the least number that none of these others of its name has.
    #[must_use]
    pub fn numbered_among<'a>(mut self, others: impl Iterator<Item = &'a AtlasState>) -> Self {
        let taken: Vec<u32> = others.filter(|other| other.name() == self.name()).map(|other| other.copy).collect();
        if taken.contains(&self.copy) {
            self.copy = (1..).find(|number| !taken.contains(number)).unwrap_or(self.copy);
        }
        self
    }

    /// A name for its file: the one that it is in, or its own in small letters.
    pub fn file_name(&self) -> String {
        let in_file = self.path.as_ref().and_then(|path| path.file_name());
        let own = || {
            let small = self.world().name.to_lowercase();
            let words: Vec<&str> = small.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
            format!("{}.ron", words.join("-"))
        };
        in_file.map_or_else(own, |name| name.to_string_lossy().into_owned())
    }

    /// Whether it has edits, be they undone.
    pub fn has_history(&self) -> bool {
        self.editor.can_undo() || self.editor.can_redo()
    }

    /// Whether it has edits that are in no file.
    pub fn is_unsaved(&self) -> bool {
        self.editor.can_undo() && !self.is_saved()
    }

    /// The state for an editor and its world.
    pub fn edited(editor: Editor) -> Self {
        let world = editor.world().clone();
        let name_text = world.name.clone();
        let atlas = Atlas::new(world.clone());
        AtlasState {
            still: Arc::new(picture_of(&world)),
            starts: atlas.clone(),
            atlas,
            preview: None,
            tried: None,
            probe: None,
            placing: None,
            drawn_from: None,
            search: String::new(),
            warnings: editor.warnings(),
            editor,
            path: None,
            built_in: None,
            copy: 1,
            others: Vec::new(),
            labels: None,
            grid: None,
            space: None,
            mode: Mode::default(),
            robot: 0,
            pressed: None,
            refused: None,
            wanted: None,
            resolution: FIRST_CELL,
            selected: None,
            is_new: false,
            shape: None,
            typed: None,
            held: None,
            name_text,
            is_naming: false,
            message: None,
            drag: None,
        }
    }

    /// The same state in another mode.
    #[must_use]
    pub fn in_mode(self, mode: Mode) -> Self {
        AtlasState { mode, ..self }
    }

    /// The same state in the mode of an earlier one, for the kinds of robots that it knew.
    #[must_use]
    pub fn like(self, earlier: &AtlasState) -> Self {
        let mut new = self.in_mode(earlier.mode);
        new.know(earlier.atlas.kinds().clone());
        new
    }

    /// Shows robots of these kinds too.
    pub fn know(&mut self, kinds: Kinds) {
        self.atlas = self.atlas.clone().knowing(kinds.clone());
        self.starts = self.starts.clone().knowing(kinds.clone());
        self.editor = self.editor.clone().knowing(kinds);
        self.warnings = self.editor.warnings();
        self.labels = None;
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.editor.world()
    }

    /// The world with its robots.
    pub fn atlas(&self) -> &Atlas {
        &self.atlas
    }

    /// The text of the world's file, in canonical form.
    pub fn text(&self) -> String {
        self.editor.text()
    }

    /// Records that the text was written to this file.
    pub fn mark_saved(&mut self, path: &Path) {
        self.editor.mark_saved();
        self.path = Some(path.to_owned());
    }

    /// Remembers the file that the world was read from.
    pub fn stands_in(&mut self, path: &Path) {
        self.path = Some(path.to_owned());
    }

    /// The source of the world: its file, if that holds the world's present state.
    pub fn source(&self) -> WorldSource {
        match &self.path {
            Some(path) if self.is_saved() => WorldSource::File(path.display().to_string()),
            _ => WorldSource::Unsaved,
        }
    }

    /// Whether the file on the disk holds the world's present state.
    pub fn is_saved(&self) -> bool {
        self.editor.is_saved()
    }

    /// What a run of the world would refuse.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The middle of the world.
    pub fn middle(&self) -> Point2 {
        let bounds = self.world().bounds;
        bounds.min + (bounds.max - bounds.min) * 0.5
    }

    /// Sets the side of the grid's cells, metres.
    pub fn set_resolution(&mut self, resolution: f64) {
        self.resolution = resolution;
        self.grid = None;
    }

    /// Whether somebody chose this: another world than the first, an edit, or a place for a robot.
    pub fn was_changed(&self) -> bool {
        let is_first = self.built_in == World::built_in_names().first().copied();
        !is_first || self.has_history() || self.atlas.robots() != self.starts.robots()
    }

    /// Draws the world again, and ends a drag under way. Its robots stay where they were put, unless their starts or
    /// sizes have changed.
    pub(super) fn redraw(&mut self) {
        (self.drag, self.held) = (None, None);
        let chosen = self.atlas.robots().get(self.robot).map(|robot| robot.name.clone());
        self.see(self.editor.world().clone());
        (self.preview, self.tried) = (None, None);
        self.atlas = self.starts.clone().keeping(&self.atlas);
        self.robot = self.atlas.robots().iter().position(|robot| Some(&robot.name) == chosen.as_ref()).unwrap_or(0);
        self.warnings = self.editor.warnings();
        (self.grid, self.refused, self.wanted) = (None, None, None);
    }

    /// Draws this world, with its robots at their starts.
    pub(super) fn see(&mut self, world: World) {
        self.still = Arc::new(picture_of(&world));
        self.starts = Atlas::new(world).knowing(self.atlas.kinds().clone());
        self.labels = None;
    }
}
