//! `IrContext`, what the parts of a scene are read with, and how they are read.

use crate::yaml::{Fields, YamlNode, YamlValue};
use crate::{ImportError, ImportProblem, WorldDraft};
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::worlds::{MAX_ITEMS, WorldProblem};

/// Largest number of points of all obstacles of a scene.
const MAX_POINTS: usize = 4 * MAX_ITEMS;

/// What all that a scene draws at random may take, in comparisons of two poses or two edges.
const MAX_DRAWS: usize = 200_000_000;

/// What it takes to draw a pose or a shape before it is compared, in comparisons.
const DRAW: usize = 8;

/// How a world of IR-SIM is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IrsimOptions {
    /// Whether what this lab does not have, such as obstacles that move, is left out with a note; otherwise it is an
    /// error.
    pub is_lenient: bool,
    /// The seed of what is drawn at random. IR-SIM's generator is another one: its own worlds differ.
    pub seed: Seed,
}

impl Default for IrsimOptions {
    fn default() -> Self {
        IrsimOptions { is_lenient: false, seed: Seed(0) }
    }
}

/// A scene under construction.
pub(crate) struct IrContext {
    pub draft: WorldDraft,
    pub options: IrsimOptions,
    /// The lower left corner of the world.
    pub min: [f64; 2],
    /// The width and the height of the world.
    pub size: [f64; 2],
    /// What may still be made of it.
    pub room: IrRoom,
}

/// How much may still be made of a scene: a short entry may stand for very many objects.
pub(crate) struct IrRoom {
    objects: usize,
    points: usize,
    draws: usize,
}

impl Default for IrRoom {
    fn default() -> Self {
        IrRoom { objects: MAX_ITEMS, points: MAX_POINTS, draws: MAX_DRAWS }
    }
}

impl IrRoom {
    /// Takes the room of some objects, left out or not, or of sensors on them.
    pub fn take_objects(&mut self, number: usize) -> Result<(), WorldProblem> {
        self.objects = self.objects.checked_sub(number).ok_or(WorldProblem::TooMany { what: "objects" })?;
        Ok(())
    }

    /// Takes the room of some points of obstacles.
    pub fn take_points(&mut self, number: usize) -> Result<(), ImportProblem> {
        let left = self.points.checked_sub(number);
        self.points = left
            .ok_or_else(|| ImportProblem::Unsupported(format!("obstacles of more than {MAX_POINTS} points in all")))?;
        Ok(())
    }

    /// Takes the room of one pose or shape that is drawn and compared so often.
    pub fn take_draw(&mut self, comparisons: usize) -> Result<(), ImportProblem> {
        let left = self.draws.checked_sub(DRAW + comparisons);
        self.draws = left.ok_or_else(|| {
            ImportProblem::Unsupported("what is drawn at random takes too many tries in the scene as a whole".into())
        })?;
        Ok(())
    }
}

impl IrContext {
    /// The stream that draws this item's things.
    pub fn stream(&self, item: &str) -> Stream {
        Stream::new(self.options.seed, item)
    }

    /// The world's bounds.
    pub fn bounds(&self) -> Aabb {
        let ([x, y], [width, height]) = (self.min, self.size);
        Aabb { min: Point2::new(x, y), max: Point2::new(x + width, y + height) }
    }

    /// What is read of an item. What the lab does not have is left out with a note, if so asked.
    pub fn or_left_out<T>(&mut self, item: &str, read: Result<T, ImportError>) -> Result<Option<T>, ImportError> {
        match read {
            Ok(read) => Ok(Some(read)),
            Err(error) => match *error.problem {
                ImportProblem::Unsupported(reason) if self.options.is_lenient => {
                    let at = if error.item.is_empty() { item } else { &error.item };
                    let why = if at == item { reason } else { format!("{at}: {reason}") };
                    self.draft.note(format!("{item} is left out: {why}"));
                    Ok(None)
                }
                problem => Err(ImportError { problem: Box::new(problem), ..error }),
            },
        }
    }

    /// Takes the keys that are left out and adds a note for each.
    pub fn note_ignored(&mut self, fields: &mut Fields, item: &str, keys: &[&str]) {
        for key in keys {
            if fields.take(key).is_some_and(|node| !node.is_null()) {
                self.draft.note(format!("{item}{key} is left out"));
            }
        }
    }

    /// Refuses keys that nobody knows, or leaves them out.
    pub fn finish(&mut self, fields: Fields, item: &str, known: &str) -> Result<(), ImportError> {
        if !self.options.is_lenient {
            return fields.finish(known);
        }
        for (key, _) in fields.others() {
            self.draft.note(format!("{item}{key} is left out"));
        }
        Ok(())
    }
}

/// The objects of a section: a list of them, or one by itself.
pub(crate) fn objects<'a>(section: Option<&'a YamlNode>, name: &str) -> Vec<(String, &'a YamlNode)> {
    match section {
        None => Vec::new(),
        Some(node) if node.is_null() => Vec::new(),
        Some(YamlNode { value: YamlValue::List(nodes), .. }) => {
            nodes.iter().enumerate().map(|(i, node)| (format!("{name}[{i}]"), node)).collect()
        }
        Some(node) => vec![(name.to_owned(), node)],
    }
}

/// An error for what this lab does not have.
pub(crate) fn unsupported(node: &YamlNode, item: impl Into<String>, what: impl Into<String>) -> ImportError {
    ImportError::at(node.line, item, ImportProblem::Unsupported(what.into()))
}
