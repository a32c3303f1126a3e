//! Reads scripts from text, with every check, and writes them in their one canonical form.

use std::fmt::Write;

use ron::value::RawValue;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::script_error::{MAX_EVENTS, ScriptError, ScriptProblem};
use super::{
    Event, Quantized, RobotInput, SCRIPT_VERSION, SCRIPT_VERSION_WITH_CHANGES, Script, WorldChange, WorldEvent,
};
use motion_lab_core::text_position::{line_at, line_ends, offset_of};
use motion_lab_core::worlds::{begin_of, ron_in_words};

/// The file as written. The events stay text here and are parsed one by one, so that an error knows its event and line.
#[derive(Deserialize)]
#[serde(rename = "Script", deny_unknown_fields)]
struct ScriptText<'a> {
    version: u64,
    #[serde(borrow)]
    events: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    changes: Vec<&'a RawValue>,
}

/// The version alone, whatever else a file of another version holds.
#[derive(Deserialize)]
#[serde(rename = "Script")]
struct VersionText {
    version: u64,
}

impl Script {
    /// Reads a script from `text`. Errors name the file `source_name`.
    ///
    /// # Errors
    /// [`ScriptError`] names file, line, event and reason. Refused are: text that is not RON or not of the format's
    /// form; another version; an unknown field; ticks that don't begin at 1 or later, or don't ascend; channels outside
    /// -128 to 128; coordinates beyond [`MAX_COORDINATE`](motion_lab_core::geometry::MAX_COORDINATE); more than
    /// [`MAX_EVENTS`] events.
    ///
    /// ```
    /// use motion_lab_sim::run::Script;
    /// let text = "Script(version: 1, events: [\n    (tick: 9, robot: \"Rusty\", input: Drive(129, 0)),\n])";
    /// let error = Script::parse("drive.ron", text).unwrap_err();
    /// assert_eq!(error.to_string(), "drive.ron:2: events[0]: channel 129: it must be in -128 to 128");
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, ScriptError> {
        let error = |line, problem| ScriptError { file: source_name.to_owned(), line, ..problem };
        let read: Result<ScriptText, _> = ron::from_str(text);
        // the version is checked first: a file of another version may have another form
        let version = match &read {
            Ok(file) => file.version,
            Err(_) => ron::from_str(text).map_or(u64::from(SCRIPT_VERSION), |VersionText { version }| version),
        };
        let line_of = |word: &str| line_at(text, text.find(word).unwrap_or(0));
        if ![SCRIPT_VERSION, SCRIPT_VERSION_WITH_CHANGES].map(u64::from).contains(&version) {
            return Err(error(line_of("version"), ScriptProblem::Version(version).anywhere()));
        }
        let file =
            read.map_err(|e| error(begin_of(&e).line, ScriptProblem::Syntax(ron_in_words(text, &e)).anywhere()))?;
        if version == u64::from(SCRIPT_VERSION) && !file.changes.is_empty() {
            return Err(error(line_of("changes"), ScriptProblem::Changes.anywhere()));
        }
        let count = file.events.len().saturating_add(file.changes.len());
        if count > MAX_EVENTS {
            return Err(error(1, ScriptProblem::TooMany(count).anywhere()));
        }
        let events = ScriptList { source_name, text, name: "events" };
        let events = events.read(&file.events, |event: &Event, before| event.check(before).map(|()| event.tick))?;
        let changes = ScriptList { source_name, text, name: "changes" };
        let check = |change: &WorldEvent, before| change.check(before).map(|()| change.tick);
        let changes = changes.read(&file.changes, check)?;
        Ok(Script { version: Script::version_of(&changes), events, changes })
    }

    /// The canonical text: one event a line, every number and name written in one way. Reading it gives the script
    /// back.
    pub fn to_ron(&self) -> String {
        let mut text = format!("Script(\n    version: {},\n    events: [\n", self.version);
        for Event { tick, robot, input } in &self.events {
            // writing into a string can't fail
            let _ = writeln!(text, "        (tick: {tick}, robot: {robot:?}, input: {}),", InputText(input));
        }
        text.push_str("    ],\n");
        // a script without changes keeps the text that it had before there were any
        if !self.changes.is_empty() {
            text.push_str("    changes: [\n");
            for WorldEvent { tick, world, change } in &self.changes {
                let _ =
                    writeln!(text, "        (tick: {tick}, world: {world:?}, change: {}),", ChangeText(change, " "));
            }
            text.push_str("    ],\n");
        }
        text.push_str(")\n");
        text
    }

    /// The same in one line, with blanks only within names. Reading it gives the script back.
    pub fn to_line(&self) -> String {
        let mut text = format!("Script(version:{},events:[", self.version);
        for Event { tick, robot, input } in &self.events {
            let input = InputText(input).to_string().replace(' ', "");
            // writing into a string can't fail
            let _ = write!(text, "(tick:{tick},robot:{robot:?},input:{input}),");
        }
        text.push(']');
        if !self.changes.is_empty() {
            text.push_str(",changes:[");
            for WorldEvent { tick, world, change } in &self.changes {
                let _ = write!(text, "(tick:{tick},world:{world:?},change:{}),", ChangeText(change, ""));
            }
            text.push(']');
        }
        text + ")"
    }
}

impl ScriptError {
    /// The error with the file's name, and with the line on which its event or change begins in `text`, the text that
    /// the script was read from. Line 1 where the error lies outside the lists.
    #[must_use]
    pub fn located(self, source_name: &str, text: &str) -> Self {
        let line = || {
            let file: ScriptText = ron::from_str(text).ok()?;
            let items = match self.list {
                "events" => &file.events,
                "changes" => &file.changes,
                _ => return None,
            };
            Some(line_at(text, offset_of(text, items.get(self.event?)?.trim().get_ron())))
        };
        let line = line().unwrap_or(1);
        ScriptError { file: source_name.to_owned(), line, ..self }
    }
}

/// A list of a script's text.
struct ScriptList<'a> {
    source_name: &'a str,
    text: &'a str,
    name: &'static str,
}

impl ScriptList<'_> {
    /// Reads the items. `check` gets each with the tick of the one before it, and returns its own.
    fn read<T: DeserializeOwned>(
        &self,
        items: &[&RawValue],
        check: impl Fn(&T, u64) -> Result<u64, ScriptProblem>,
    ) -> Result<Vec<T>, ScriptError> {
        let mut read = Vec::new();
        // lines are counted from item to item
        let (mut line, mut counted, mut before) = (1, 0, 0);
        for (i, raw) in items.iter().enumerate() {
            let item = raw.trim().get_ron();
            let offset = offset_of(self.text, item);
            line += line_ends(self.text, counted, offset);
            counted = offset;
            let error = |line, problem: ScriptProblem| ScriptError {
                file: self.source_name.to_owned(),
                line,
                ..problem.at(self.name, i)
            };
            let item: T = ron::from_str(item)
                .map_err(|e| error(line + begin_of(&e).line - 1, ScriptProblem::Syntax(ron_in_words(item, &e))))?;
            before = check(&item, before).map_err(|problem| error(line, problem))?;
            read.push(item);
        }
        Ok(read)
    }
}

/// Writes a change as the canonical text has it, with this after each comma and colon.
struct ChangeText<'a>(&'a WorldChange, &'a str);

impl std::fmt::Display for ChangeText<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let b = self.1;
        match self.0 {
            WorldChange::Close(name) => write!(f, "Close({name:?})"),
            WorldChange::Open(name) => write!(f, "Open({name:?})"),
            WorldChange::Remove(name) => write!(f, "Remove({name:?})"),
            WorldChange::Move { name, to: (x, y, theta) } => {
                write!(f, "Move(name:{b}{name:?},{b}to:{b}({},{b}{},{b}{}))", x.0, y.0, theta.0)
            }
            WorldChange::Add { name, points, radius } => {
                write!(f, "Add(name:{b}{name:?},{b}points:{b}[")?;
                for (i, (x, y)) in points.iter().enumerate() {
                    let comma = if i == 0 { "" } else { "," };
                    write!(f, "{comma}{}({},{b}{})", if i == 0 { "" } else { b }, x.0, y.0)?;
                }
                write!(f, "],{b}radius:{b}{})", radius.0)
            }
        }
    }
}

/// Writes an input as the canonical text has it.
struct InputText<'a>(&'a RobotInput);

impl std::fmt::Display for InputText<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |f: &mut std::fmt::Formatter<'_>, name: &str, coordinates: &[Quantized]| {
            write!(f, "{name}([")?;
            for (i, c) in coordinates.iter().enumerate() {
                write!(f, "{}{}", if i == 0 { "" } else { ", " }, c.0)?;
            }
            write!(f, "])")
        };
        match self.0 {
            RobotInput::Drive(a, b) => write!(f, "Drive({a}, {b})"),
            RobotInput::MoveTo(q) => list(f, "MoveTo", q),
            RobotInput::Teleport(q) => list(f, "Teleport", q),
            RobotInput::SetTrailer(on) => write!(f, "SetTrailer({on})"),
            RobotInput::Release => write!(f, "Release"),
        }
    }
}

#[cfg(test)]
mod tests;
