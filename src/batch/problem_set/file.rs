//! `ProblemFile`, problems as written: it names worlds and scenarios and does not hold them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use ron::extensions::Extensions;
use ron::value::RawValue;
use serde::Deserialize;

use super::bundle::ProblemBundle;
use super::set::ProblemSet;
use super::text::{EndsText, ProblemsText, ScenarioText, SetText};
use motion_lab_core::one_line::OneLine;
use motion_lab_core::text_position::{Position, offset_of, position_at};
use motion_lab_core::worlds::{World, ron_in_words};
use motion_lab_import::Scenario;

/// The version of the format that is read.
const VERSION: u64 = 1;

/// The version alone, for files of other versions.
#[derive(Deserialize)]
#[serde(rename = "Problems")]
struct ProblemsVersion {
    version: u64,
}

/// The sets as raw text, for their places in the file.
#[derive(Deserialize)]
#[serde(rename = "Problems")]
struct RawProblems<'a> {
    #[serde(borrow)]
    version: &'a RawValue,
    #[serde(borrow, default)]
    sets: Vec<&'a RawValue>,
}

/// A file of planning problems as written. It names its worlds and scenarios, which [`with`](Self::with) adds.
#[derive(Clone, Debug, PartialEq)]
pub struct ProblemFile {
    file: String,
    source: String,
    text: ProblemsText,
}

/// Why a problem file is refused, with its place.
///
/// Prints as `problems.ron:4:5: sets[1] "maze": columns 1: it must be from 2 to 200`.
#[derive(Clone, Debug, PartialEq)]
pub struct ProblemFileError {
    /// The file, as the caller named it.
    pub file: String,
    /// The line, from 1: where the item begins, or where reading stopped.
    pub line: usize,
    /// The column, from 1, in characters.
    pub column: usize,
    /// The item; empty when the file is not of the format's form.
    pub item: String,
    /// The reason.
    pub reason: String,
}

impl fmt::Display for ProblemFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: ", self.file, self.line, self.column)?;
        if !self.item.is_empty() {
            write!(f, "{}: ", OneLine(&self.item))?;
        }
        write!(f, "{}", OneLine(&self.reason))
    }
}

impl std::error::Error for ProblemFileError {}

/// The RON options of problem files: what is optional, and what a generator is like, is written plainly.
fn options() -> ron::Options {
    ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

impl ProblemFile {
    /// Reads a file of problems. Errors call it `file`.
    ///
    /// # Errors
    /// [`ProblemFileError`] names file, line and column, for invalid RON, another version, or an unknown field.
    pub fn parse(file: &str, text: &str) -> Result<Self, ProblemFileError> {
        let read: Result<ProblemsText, _> = options().from_str(text);
        // the version comes first: the rest of another version's file may look different
        let version = match &read {
            Ok(read) => read.version,
            Err(_) => options().from_str(text).map_or(VERSION, |ProblemsVersion { version }| version),
        };
        let error = |Position { line, column }, item: &str, reason| {
            let (file, item) = (file.to_owned(), item.to_owned());
            ProblemFileError { file, line, column, item, reason }
        };
        if version != VERSION {
            let reason = format!("version {version}: this program reads version {VERSION}");
            return Err(error(place(text, None), "version", reason));
        }
        match read {
            Ok(read) => Ok(ProblemFile { file: file.to_owned(), source: text.to_owned(), text: read }),
            Err(e) => {
                let at = Position { line: e.span.start.line, column: e.span.start.col };
                Err(error(at, "", ron_in_words(text, &e)))
            }
        }
    }

    /// The names of its worlds: built-in ones, or paths of world files relative to the file's folder. Each once.
    pub fn world_names(&self) -> BTreeSet<&str> {
        let names = self.text.sets.iter().filter_map(|set| match set {
            SetText::Paired(EndsText { world, .. })
            | SetText::Crossed(EndsText { world, .. })
            | SetText::Scenario(ScenarioText { world, .. }) => Some(world.as_str()),
            SetText::Generated(_) => None,
        });
        names.collect()
    }

    /// The names of its scenarios: paths relative to the file's folder. Each once.
    pub fn scenario_names(&self) -> BTreeSet<&str> {
        let names = self.text.sets.iter().filter_map(|set| match set {
            SetText::Scenario(ScenarioText { file, .. }) => Some(file.as_str()),
            _ => None,
        });
        names.collect()
    }

    /// Where the file names this world or scenario, as messages have it: `problems.ron:3:14`.
    pub fn place_of(&self, name: &str) -> String {
        let raw: Option<RawProblems> = options().from_str(&self.source).ok();
        let quoted = format!("{name:?}");
        let offset = raw.and_then(|raw| {
            let mut sets = raw.sets.iter().map(|set| set.get_ron());
            sets.find_map(|set| Some(offset_of(&self.source, set) + set.find(&quoted)?))
        });
        let Position { line, column } = position_at(&self.source, offset.unwrap_or(0));
        format!("{}:{line}:{column}", self.file)
    }

    /// The file with what it names.
    pub fn bundle(&self, worlds: &BTreeMap<String, World>, scenarios: &BTreeMap<String, Scenario>) -> ProblemBundle {
        ProblemBundle {
            file: self.text.clone(),
            worlds: worlds.iter().map(|(name, world)| (name.clone(), world.to_ron())).collect(),
            scenarios: scenarios.iter().map(|(name, scenario)| (name.clone(), scenario.to_text())).collect(),
        }
    }

    /// The problems, in the worlds and of the scenarios that the file names.
    ///
    /// # Errors
    /// [`ProblemFileError`] names the set that can't be: a robot that is not there, coordinates that are none of its
    /// own, a map that is not the world's, settings out of range, or no problem at all.
    pub fn with(
        &self,
        worlds: &BTreeMap<String, World>,
        scenarios: &BTreeMap<String, Scenario>,
    ) -> Result<ProblemSet, ProblemFileError> {
        self.bundle(worlds, scenarios).made().map_err(|(set, reason)| {
            let Position { line, column } = place(&self.source, set);
            let named = |i: usize| format!("sets[{i}] {:?}", self.text.sets.get(i).map_or("", SetText::name));
            let item = set.map(named).unwrap_or_default();
            ProblemFileError { file: self.file.clone(), line, column, item, reason }
        })
    }
}

/// The position of a set, or of the version; the beginning of the text for what is not there.
fn place(text: &str, set: Option<usize>) -> Position {
    let raw: Option<RawProblems> = options().from_str(text).ok();
    let part = raw.and_then(|raw| match set {
        Some(i) => raw.sets.get(i).copied(),
        None => Some(raw.version),
    });
    part.map_or(Position { line: 1, column: 1 }, |part| position_at(text, offset_of(text, part.trim().get_ron())))
}
