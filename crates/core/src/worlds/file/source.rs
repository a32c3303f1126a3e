//! The text of a world file, and the positions of its parts.
//!
//! A valid file is parsed once. After an error it is parsed again with its parts left as text: [`RawValue`] borrows the
//! file's text, so the address of a part gives its line.

use ron::value::RawValue;
use serde::Deserialize;

use super::description::WorldText;
use super::ron_words::{begin_of, ron_in_words};
use crate::text_position::{Position, byte_at, offset_of, position_at};
use crate::worlds::{WORLD_VERSION, WorldError, WorldItem, WorldProblem};

/// The text of a world file, and the file's name in errors.
#[derive(Clone, Copy)]
pub(crate) struct FileText<'a> {
    pub file: &'a str,
    pub text: &'a str,
}

/// A part of a world file that an error is about.
#[derive(Clone, Copy)]
pub(crate) enum FilePart<'a> {
    Name,
    Bounds,
    Item(&'a WorldItem),
}

/// The head of a file, whatever else it holds.
#[derive(Deserialize)]
#[serde(rename = "World")]
struct FileHead<'a> {
    #[serde(borrow)]
    version: &'a RawValue,
    #[serde(borrow)]
    name: &'a RawValue,
    #[serde(borrow)]
    bounds: &'a RawValue,
}

/// The version of a file, whatever else it holds.
#[derive(Deserialize)]
#[serde(rename = "World")]
struct FileVersion {
    version: u64,
}

/// The lists of a file, whatever else it holds.
#[derive(Deserialize)]
#[serde(rename = "World")]
struct Lists<'a> {
    #[serde(borrow, default)]
    walls: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    obstacles: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    doors: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    routes: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    places: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    marks: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    robots: Vec<&'a RawValue>,
}

/// The name of an item, whatever else it holds.
#[derive(Deserialize)]
struct Name {
    name: String,
}

impl<'a> Lists<'a> {
    fn each(&self) -> [(&'static str, &[&'a RawValue]); 7] {
        [
            ("walls", &self.walls),
            ("obstacles", &self.obstacles),
            ("doors", &self.doors),
            ("routes", &self.routes),
            ("places", &self.places),
            ("marks", &self.marks),
            ("robots", &self.robots),
        ]
    }
}

impl<'a> FileText<'a> {
    /// Reads the file as written. Refuses other versions of the format.
    pub fn read(&self) -> Result<WorldText, WorldError> {
        let file: Result<WorldText, _> = ron::from_str(self.text);
        // A file of another version may have another form; then the version is the error to report.
        let version = match &file {
            Ok(file) => Some(file.version),
            Err(_) => ron::from_str(self.text).ok().map(|v: FileVersion| v.version),
        };
        if let Some(other) = version.filter(|v| *v != WORLD_VERSION) {
            let at = self.position(self.head(|head| head.version));
            return Err(self.error_at(at, None, WorldProblem::Version(other)));
        }
        file.map_err(|error| {
            let at = begin_of(&error);
            self.error_at(at, self.item_around(at), WorldProblem::Syntax(ron_in_words(self.text, &error)))
        })
    }

    /// An error at the beginning of a part.
    pub fn error(&self, part: FilePart, problem: impl Into<WorldProblem>) -> WorldError {
        let (offset, item) = match part {
            FilePart::Name => (self.head(|head| head.name), None),
            FilePart::Bounds => (self.head(|head| head.bounds), None),
            FilePart::Item(item) => (self.item_offset(item), Some(item.clone())),
        };
        self.error_at(self.position(offset), item, problem.into())
    }

    /// The line in which an item begins.
    pub fn line(&self, item: &WorldItem) -> usize {
        self.position(self.item_offset(item)).line
    }

    fn error_at(&self, at: Position, item: Option<WorldItem>, problem: WorldProblem) -> WorldError {
        let Position { line, column } = at;
        WorldError { file: self.file.to_owned(), line, column, item: item.map(Box::new), problem: Box::new(problem) }
    }

    /// The position of a byte of the text.
    fn position(&self, offset: usize) -> Position {
        position_at(self.text, offset)
    }

    /// Byte offset of a part in the text, after the comments before it.
    fn offset(&self, part: &RawValue) -> usize {
        offset_of(self.text, part.trim().get_ron())
    }

    /// Byte offset of a part of the head; 0 if the head cannot be read.
    fn head(&self, part: impl Fn(&FileHead<'a>) -> &'a RawValue) -> usize {
        ron::from_str(self.text).map_or(0, |head: FileHead| self.offset(part(&head)))
    }

    fn lists(&self) -> Option<Lists<'a>> {
        ron::from_str(self.text).ok()
    }

    fn item_offset(&self, item: &WorldItem) -> usize {
        let found = self.lists().and_then(|lists| {
            let (_, raws) = lists.each().into_iter().find(|(list, _)| *list == item.list)?;
            raws.get(item.index).map(|raw| self.offset(raw))
        });
        found.unwrap_or(0)
    }

    /// The item whose text holds a position; `None` outside the items, or if the file is not RON.
    fn item_around(&self, at: Position) -> Option<WorldItem> {
        let byte = byte_at(self.text, at);
        for (list, raws) in self.lists()?.each() {
            for (index, raw) in raws.iter().enumerate() {
                let start = self.offset(raw);
                if (start..start + raw.trim().get_ron().len()).contains(&byte) {
                    let name = raw.into_rust().map_or(String::new(), |n: Name| n.name);
                    return Some(WorldItem { list, index, name });
                }
            }
        }
        None
    }
}
