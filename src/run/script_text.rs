//! Reads scripts from text, with every check, and writes them in their one canonical form.

use std::collections::BTreeSet;
use std::fmt::Write;

use ron::value::RawValue;
use serde::Deserialize;

use super::{Event, Quantized, RobotInput, SCRIPT_VERSION, Script};
use crate::geometry::MAX_COORDINATE;
use crate::text_position::{line_at, line_ends, offset_of};
use crate::tour::MAX_TICKS;

/// Largest number of events in a script.
pub const MAX_EVENTS: usize = 1_000_000;
/// Largest number of coordinates in a `MoveTo` or `Teleport`.
pub const MAX_COORDINATES: usize = 64;
/// The greatest absolute value of a control channel: the robot's maximum.
pub const MAX_CHANNEL: i16 = 128;

/// A script that is refused: where, which event, and why.
///
/// Prints as `drive.ron:7: events[3]: channel 129: it must be in -128 to 128`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError {
    /// The file, as the caller named it; empty for a script that was not read from text.
    pub file: String,
    /// The line, from 1: where the event begins, or where reading stopped; 0 for a script that was not read from text.
    pub line: usize,
    /// The event's index, from 0; `None` if the error lies outside the list.
    pub event: Option<usize>,
    /// The reason.
    pub problem: ScriptProblem,
}

impl std::fmt::Display for ScriptError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.line > 0 {
            write!(f, "{}:{}: ", self.file, self.line)?;
        }
        if let Some(event) = self.event {
            write!(f, "events[{event}]: ")?;
        }
        write!(f, "{}", self.problem)
    }
}

impl std::error::Error for ScriptError {}

/// Why a script is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ScriptProblem {
    /// Not RON, or not of the expected form: an unknown or missing field, a number that doesn't fit its type.
    #[error("{0}")]
    Syntax(String),
    /// A version of the format that this program does not read.
    #[error("version {0}: this program reads version {SCRIPT_VERSION}")]
    Version(u64),
    /// More than [`MAX_EVENTS`] events.
    #[error("{0} events: at most {MAX_EVENTS}")]
    TooMany(usize),
    /// A tick that is 0 or beyond the longest run.
    #[error("tick {0}: it must be in 1 to {MAX_TICKS}")]
    Tick(u64),
    /// A tick before that of the event before it.
    #[error("tick {tick} comes after tick {before}: ticks must ascend")]
    Order {
        /// The event's tick.
        tick: u64,
        /// The tick of the event before it.
        before: u64,
    },
    /// A control channel beyond the maximum.
    #[error("channel {0}: it must be in -{MAX_CHANNEL} to {MAX_CHANNEL}")]
    Channel(i16),
    /// A coordinate that is too large.
    #[error("coordinate {0} (in units of 2^-20): its size must be at most {MAX_COORDINATE} m or rad")]
    Coordinate(i64),
    /// Too few or too many coordinates.
    #[error("{0} coordinates: there must be 1 to {MAX_COORDINATES}")]
    Coordinates(usize),
    /// A robot that the run does not have.
    #[error("there is no robot {0:?}")]
    Robot(String),
}

impl ScriptProblem {
    fn at(self, event: impl Into<Option<usize>>) -> ScriptError {
        ScriptError { file: String::new(), line: 0, event: event.into(), problem: self }
    }
}

/// The file as written. The events stay text here and are parsed one by one, so that an error knows its event and line.
#[derive(Deserialize)]
#[serde(rename = "Script", deny_unknown_fields)]
struct ScriptText<'a> {
    version: u64,
    #[serde(borrow)]
    events: Vec<&'a RawValue>,
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
    /// -128 to 128; coordinates beyond [`MAX_COORDINATE`]; more than [`MAX_EVENTS`] events.
    ///
    /// ```
    /// use motion_lab::run::Script;
    /// let text = "Script(version: 1, events: [\n    (tick: 9, robot: \"Rusty\", input: Drive(129, 0)),\n])";
    /// let error = Script::parse("drive.ron", text).unwrap_err();
    /// assert_eq!(error.to_string(), "drive.ron:2: events[0]: channel 129: it must be in -128 to 128");
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, ScriptError> {
        let error = |line: usize, event: Option<usize>, problem: ScriptProblem| ScriptError {
            file: source_name.to_owned(),
            line,
            event,
            problem,
        };
        let syntax = |first_line: usize, event: Option<usize>, e: ron::error::SpannedError| {
            error(first_line + e.span.start.line - 1, event, ScriptProblem::Syntax(e.code.to_string()))
        };
        let read: Result<ScriptText, _> = ron::from_str(text);
        // the version is checked first: a file of another version may have another form
        let version = match &read {
            Ok(file) => file.version,
            Err(_) => ron::from_str(text).map_or(u64::from(SCRIPT_VERSION), |VersionText { version }| version),
        };
        if version != u64::from(SCRIPT_VERSION) {
            return Err(error(line_at(text, text.find("version").unwrap_or(0)), None, ScriptProblem::Version(version)));
        }
        let file = read.map_err(|e| syntax(1, None, e))?;
        let mut script = Script::empty();
        if file.events.len() > MAX_EVENTS {
            return Err(error(1, None, ScriptProblem::TooMany(file.events.len())));
        }
        // lines are counted from event to event
        let (mut line, mut counted) = (1, 0);
        for (i, raw) in file.events.iter().enumerate() {
            let offset = offset_of(text, raw.trim().get_ron());
            line += line_ends(text, counted, offset);
            counted = offset;
            let event: Event = ron::from_str(raw.trim().get_ron()).map_err(|e| syntax(line, Some(i), e))?;
            let before = script.events.last().map_or(0, |e| e.tick);
            event.check(before).map_err(|problem| error(line, Some(i), problem))?;
            script.events.push(event);
        }
        Ok(script)
    }

    /// The canonical text: one event a line, every number and name written in one way. Reading it gives the script
    /// back.
    pub fn to_ron(&self) -> String {
        let mut text = format!("Script(\n    version: {},\n    events: [\n", self.version);
        for Event { tick, robot, input } in &self.events {
            // writing into a string can't fail
            let _ = writeln!(text, "        (tick: {tick}, robot: {robot:?}, input: {}),", InputText(input));
        }
        text.push_str("    ],\n)\n");
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
        text + "])"
    }

    /// Checks a script made by a program: whether [`parse`](Self::parse) could have returned it.
    ///
    /// # Errors
    /// [`ScriptError`] without file and line.
    pub fn check(&self) -> Result<(), ScriptError> {
        if self.version != SCRIPT_VERSION {
            return Err(ScriptProblem::Version(u64::from(self.version)).at(None));
        }
        if self.events.len() > MAX_EVENTS {
            return Err(ScriptProblem::TooMany(self.events.len()).at(None));
        }
        let mut before = 0;
        for (i, event) in self.events.iter().enumerate() {
            event.check(before).map_err(|problem| problem.at(i))?;
            before = event.tick;
        }
        Ok(())
    }

    /// Checks that every event's robot is among `names`.
    ///
    /// # Errors
    /// [`ScriptError`] without file and line, naming the first event of an unknown robot.
    pub fn check_robots(&self, names: &[&str]) -> Result<(), ScriptError> {
        let names: BTreeSet<&str> = names.iter().copied().collect();
        match self.events.iter().position(|e| !names.contains(e.robot.as_str())) {
            Some(i) => Err(ScriptProblem::Robot(self.events[i].robot.clone()).at(i)),
            None => Ok(()),
        }
    }
}

impl Event {
    fn check(&self, before: u64) -> Result<(), ScriptProblem> {
        let Event { tick, input, .. } = self;
        if *tick < 1 || *tick > MAX_TICKS {
            return Err(ScriptProblem::Tick(*tick));
        }
        if *tick < before {
            return Err(ScriptProblem::Order { tick: *tick, before });
        }
        match input {
            RobotInput::Drive(a, b) => match [a, b].into_iter().find(|c| c.unsigned_abs() > MAX_CHANNEL.unsigned_abs())
            {
                Some(channel) => Err(ScriptProblem::Channel(*channel)),
                None => Ok(()),
            },
            RobotInput::MoveTo(q) | RobotInput::Teleport(q) => {
                if q.is_empty() || q.len() > MAX_COORDINATES {
                    return Err(ScriptProblem::Coordinates(q.len()));
                }
                let most = (MAX_COORDINATE * Quantized::UNITS) as u64;
                match q.iter().find(|c| c.0.unsigned_abs() > most) {
                    Some(coordinate) => Err(ScriptProblem::Coordinate(coordinate.0)),
                    None => Ok(()),
                }
            }
            RobotInput::SetTrailer(_) | RobotInput::Release => Ok(()),
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
mod tests {
    use super::*;

    const GOOD: &str = "// a drive\nScript(version: 1, events: [\n  (tick: 1, robot: \"Rusty\", input: Drive(128, -128)),\n\n  \
        // the arm\n  (tick: 1, robot: \"Reach\",\n   input: MoveTo([1048576, -5])),\n  (robot: \"a \\\"b\\\" \\u{e9}\\t\\\\\", \
        input: Teleport([0]), tick: 7), (tick: 7, robot: \"Hitch\", input: SetTrailer(true)),\n  \
        (tick: 4294967296, robot: \"Hitch\", input: Release)])";

    fn refused(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from), "{from}");
        Script::parse("s.ron", &GOOD.replacen(from, to, 1)).unwrap_err().to_string()
    }

    #[test]
    fn a_script_is_read_and_its_text_gives_it_back() {
        let script = Script::parse("s.ron", GOOD).unwrap();
        assert_eq!(script.events.len(), 5);
        let quantized = vec![Quantized(1 << 20), Quantized(-5)];
        assert_eq!(script.events[1], Event { tick: 1, robot: "Reach".into(), input: RobotInput::MoveTo(quantized) });
        assert_eq!(script.events[2].robot, "a \"b\" é\t\\");
        let text = script.to_ron();
        assert_eq!(Script::parse("again", &text).unwrap(), script);
        assert_eq!(Script::parse("again", &text).unwrap().to_ron(), text);
        assert_eq!(Script::parse("empty", &Script::empty().to_ron()).unwrap(), Script::empty());
        script.check().unwrap();
        // the derived form is read as well
        assert_eq!(Script::parse("serde", &ron::to_string(&script).unwrap()).unwrap(), script);
    }

    #[test]
    fn names_of_every_sort_survive() {
        for name in ["", "\u{0}\u{1}\u{7f}", "\r\n", "'", "\u{301}e\u{202e}", "\u{10ffff}", "// no", "r#\"", "🤖"] {
            let event = Event { tick: 1, robot: name.into(), input: RobotInput::Release };
            let script = Script { version: SCRIPT_VERSION, events: vec![event] };
            assert_eq!(Script::parse("s", &script.to_ron()).as_ref(), Ok(&script), "{}", script.to_ron());
        }
    }

    #[test]
    fn errors_name_file_line_event_and_reason() {
        assert_eq!(refused("-128", "-129"), "s.ron:3: events[0]: channel -129: it must be in -128 to 128");
        assert_eq!(refused("Drive(128", "Drive(129"), "s.ron:3: events[0]: channel 129: it must be in -128 to 128");
        assert!(refused("Drive(128", "Drive(32768").starts_with("s.ron:3: events[0]: "), "does not fit i16");
        assert!(refused("Drive(128", "Drive(-32768").ends_with("channel -32768: it must be in -128 to 128"));
        assert_eq!(refused("tick: 1,", "tick: 0,"), "s.ron:3: events[0]: tick 0: it must be in 1 to 4294967296");
        assert_eq!(refused("tick: 1,", "tick: 2,"), "s.ron:6: events[1]: tick 1 comes after tick 2: ticks must ascend");
        assert_eq!(
            refused("4294967296", "4294967297"),
            "s.ron:9: events[4]: tick 4294967297: it must be in 1 to 4294967296"
        );
        let most = 10_000_i64 << 20;
        assert!(Script::parse("s", &GOOD.replace("1048576", &(-most).to_string())).is_ok());
        assert_eq!(
            refused("1048576", &(-most - 1).to_string()),
            "s.ron:6: events[1]: coordinate -10485760001 (in units of 2^-20): its size must be at most 10000 m or rad"
        );
        assert!(refused("1048576", "-9223372036854775808").contains("coordinate -9223372036854775808"));
        assert_eq!(refused("[0]", "[]"), "s.ron:8: events[2]: 0 coordinates: there must be 1 to 64");
        assert!(refused("[0]", &format!("{:?}", [0; 65])).contains("65 coordinates"));
        assert!(refused("1048576", "0.5").starts_with("s.ron:7: events[1]: "), "the line within the event");
        assert!(refused("SetTrailer(true)", "SetTrailer(1)").starts_with("s.ron:8: events[3]: "));
        assert!(refused("Release", "Explode").starts_with("s.ron:9: events[4]: "));
        assert!(refused("tick: 7)", "tick: 7, mood: 1)").contains("mood"));
        assert!(refused("version: 1,", "version: 1, mood: 2,").contains("mood"));
        assert_eq!(refused("version: 1", "version: 2"), "s.ron:2: version 2: this program reads version 1");
        assert!(refused("version: 1,", "").starts_with("s.ron:"), "no version");
        assert!(refused("events: [", "events: ").starts_with("s.ron:"));
        assert!(Script::parse("s.ron", "").is_err());
        assert!(Script::parse("s.ron", &"(".repeat(100_000)).is_err(), "deep nesting is an error, not a crash");
        assert!(Script::parse("s.ron", &GOOD.replace("[0]", &"[".repeat(100_000))).is_err());
    }

    #[test]
    fn unknown_robots_are_named_with_their_event() {
        let script = Script::parse("s.ron", GOOD).unwrap();
        let all = ["Hitch", "Reach", "Rusty", "a \"b\" é\t\\"];
        assert_eq!(script.check_robots(&all), Ok(()));
        assert_eq!(script.check_robots(&all[1..]).unwrap_err().to_string(), "events[3]: there is no robot \"Hitch\"");
    }

    /// Pairwise this would take ten thousand million comparisons.
    #[test]
    fn a_hundred_thousand_names_are_looked_up_not_compared_with_one_another() {
        let names: Vec<String> = (0..100_000).map(|i| format!("a robot with the number {i:06}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let event = |name: &&str| Event { tick: 1, robot: (*name).into(), input: RobotInput::Release };
        let mut script = Script { version: SCRIPT_VERSION, events: names.iter().rev().map(event).collect() };
        assert_eq!(script.check_robots(&names), Ok(()));
        script.events[77_777].robot.push('!');
        let error = script.check_robots(&names).unwrap_err();
        assert!(error.to_string().starts_with("events[77777]: there is no robot"), "{error}");
    }

    #[test]
    fn a_script_made_by_a_program_gets_the_same_checks() {
        let event = |tick, input| Event { tick, robot: "r".into(), input };
        let check = |events| Script { version: SCRIPT_VERSION, events }.check().map_err(|e| e.to_string());
        assert_eq!(check(vec![event(2, RobotInput::Release), event(2, RobotInput::Release)]), Ok(()));
        assert!(check(vec![event(2, RobotInput::Release), event(1, RobotInput::Release)]).is_err());
        assert_eq!(
            check(vec![event(1, RobotInput::Drive(0, i16::MIN))]),
            Err("events[0]: channel -32768: it must be in -128 to 128".into())
        );
        let other = Script { version: 9, events: vec![] };
        assert_eq!(other.check().unwrap_err().problem, ScriptProblem::Version(9));
        let many = Script { version: SCRIPT_VERSION, events: vec![event(1, RobotInput::Release); MAX_EVENTS + 1] };
        assert_eq!(many.check().unwrap_err().problem, ScriptProblem::TooMany(MAX_EVENTS + 1));
    }
}
