//! A script as a table of comma-separated values.

use std::collections::BTreeMap;

use motion_lab_core::configuration::{RobotKind, WrittenCoordinate};
use motion_lab_core::one_line::OneLine;
use motion_lab_sim::run::{Event, Quantized, RobotInput, Script, ScriptProblem};
use motion_lab_sim::tour::TourConfig;

/// What is wrong with a table, and where. Prints as `7:12: "fast" is no whole number`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{line}:{column}: {}", OneLine(.reason))]
pub struct ScriptTableError {
    /// The line, from 1.
    line: usize,
    /// The column in characters, from 1.
    column: usize,
    /// What is wrong.
    reason: String,
}

/// The largest number of cells in a row; empty ones at its end count, too.
const MAX_CELLS: usize = 1000;

/// The signs that end a row; a carriage return may have a line feed behind it. Spreadsheets of old Macs write the
/// former alone. Other programs end rows with signs that part lines, pages or records, as Python splits lines.
const ROW_ENDS: [char; 10] =
    ['\n', '\r', '\u{b}', '\u{c}', '\u{1c}', '\u{1d}', '\u{1e}', '\u{85}', '\u{2028}', '\u{2029}'];

/// The signs that may stand between cells.
const SEPARATORS: [char; 4] = [',', ';', '\t', '|'];

/// A cell and the column where it begins, from 1.
type TableCell = (usize, String);

/// How a table is written, as its first row shows.
#[derive(Clone, Copy)]
struct TableDialect {
    /// The sign between cells. If it is no comma, a comma may stand for a decimal point.
    separator: char,
    /// The cells of each row that come before the tick: a data frame's index, where the heading shows one.
    index: usize,
}

/// The script that a table describes, checked against a run's worlds and robots where they are given; and what its
/// writer may have meant by angles of more than a turn, each with its line and column.
pub fn script(text: &str, config: Option<&TourConfig>) -> Result<(Script, Vec<String>), ScriptTableError> {
    let mut turns = Vec::new();
    let robots = config.into_iter().flat_map(|config| &config.worlds).flat_map(|world| &world.robots);
    let lengths = robots.filter_map(|robot| Some((robot.name.as_str(), RobotKind::of(&robot.kind)?.lengths)));
    let lengths: BTreeMap<&str, usize> = lengths.collect();
    let mut script = Script::new(Vec::new(), vec![]);
    // of each event the line, and the columns of its tick, its robot, its input and that input's first value
    let mut rows: Vec<(usize, [usize; 4])> = Vec::new();
    let text = text.trim_start_matches('\u{feff}'); // spreadsheets put a mark in front
    let mut form: Option<TableDialect> = None;
    for (line, row) in (1..).zip(rows_of(text)) {
        if row.trim().is_empty() || row.trim_start_matches('"').starts_with('#') {
            continue;
        }
        if form.is_none() && row.trim().trim_matches('"').to_ascii_lowercase().starts_with("sep=") {
            form = row.trim().trim_matches('"').chars().nth(4).map(|separator| TableDialect { separator, index: 0 });
            continue;
        }
        let at = |(column, reason): (usize, String)| ScriptTableError { line, column, reason };
        let used = *form.get_or_insert_with(|| TableDialect { separator: separator(row), index: 0 });
        let mut cells = cells(row, used.separator).map_err(at)?;
        if cells.iter().all(|(_, text)| text.is_empty()) {
            continue;
        }
        let heading = cells.iter().take(2).position(|(_, text)| text.eq_ignore_ascii_case("tick"));
        // a robot may be called tick
        if let (true, Some(index)) = (rows.is_empty(), heading.filter(|_| decimal(&cells[0].1).is_none())) {
            form = Some(TableDialect { index, ..used });
            continue;
        }
        cells.drain(..used.index.min(cells.len()));
        let row = TableRow { cells: &cells, end: row.chars().count() + 1, form: used, lengths: &lengths };
        script.events.push(row.event().map_err(at)?);
        turns.extend(row.turns().into_iter().map(|(column, note)| format!("{line}:{column}: {note}")));
        rows.push((line, [0, 1, 2, 3].map(|i| cells.get(i).map_or(1, |cell: &TableCell| cell.0))));
    }
    // the script's own checks: ticks in order, sizes
    let checked = config.map_or_else(|| script.check(), |config| script.check_for(config));
    checked.map_err(|error| {
        let (line, [tick, robot, input, value]) = error.event.and_then(|i| rows.get(i)).copied().unwrap_or((1, [1; 4]));
        let column = match error.problem {
            ScriptProblem::Tick(_) | ScriptProblem::Order { .. } => tick,
            ScriptProblem::Robot(_) => robot,
            ScriptProblem::NotTaken(_) => input,
            _ => value,
        };
        ScriptTableError { line, column, reason: error.problem.to_string() }
    })?;
    Ok((script, turns))
}

/// The rows of a text, whatever ends them.
fn rows_of(mut text: &str) -> impl Iterator<Item = &str> {
    std::iter::from_fn(move || {
        if text.is_empty() {
            return None;
        }
        let (row, rest) = text.split_at(text.find(ROW_ENDS).unwrap_or(text.len()));
        text = rest.strip_prefix("\r\n").or_else(|| rest.strip_prefix(ROW_ENDS)).unwrap_or(rest);
        Some(row)
    })
}

/// The sign between the cells of a first row: the first there is outside quotes. A comma before it is taken for a
/// decimal one if a number stands there.
fn separator(row: &str) -> char {
    let mut is_quoted = false;
    let mut signs = row.char_indices().filter(|(_, c)| {
        is_quoted ^= *c == '"';
        !is_quoted && SEPARATORS.contains(c)
    });
    let Some((_, first)) = signs.next() else { return ',' };
    let other = signs.find(|(_, c)| *c != ',').filter(|_| first == ',');
    match other {
        Some((at, other)) if decimal(row[..at].trim()).is_some() => other,
        _ => first,
    }
}

/// A number with a decimal comma.
fn decimal(text: &str) -> Option<f64> {
    let has_point = text.contains('.') || text.matches(',').count() > 1;
    text.replace(',', ".").parse().ok().filter(|_| !has_point)
}

/// A row of a table whose text ends before column `end`.
struct TableRow<'a> {
    cells: &'a [TableCell],
    end: usize,
    form: TableDialect,
    /// The numbers of lengths that the coordinates of known robots begin with.
    lengths: &'a BTreeMap<&'a str, usize>,
}

impl TableRow<'_> {
    fn event(&self) -> Result<Event, (usize, String)> {
        let tick = self.whole(self.cell(0, "the tick")?, "is no tick: a whole number from 1 on")?;
        let tick = u64::try_from(tick)
            .map_err(|_| (self.cells[0].0, format!("{tick} is no tick: a whole number from 1 on")))?;
        let (_, robot) = self.cell(1, "the robot")?;
        let (column, input) = self.cell(2, "the input")?;
        let values = self.cells.get(3..).unwrap_or_default();
        let at_most = |n: usize| match values.get(n) {
            Some((column, _)) => Err((*column, format!("{input} has no more than {n} values"))),
            None => Ok(()),
        };
        let input = match input {
            "Drive" => {
                at_most(2)?;
                RobotInput::Drive(self.channel(3, "the first channel")?, self.channel(4, "the second channel")?)
            }
            "MoveTo" => RobotInput::MoveTo(self.coordinates(values)?),
            "Teleport" => RobotInput::Teleport(self.coordinates(values)?),
            "SetTrailer" => {
                at_most(1)?;
                RobotInput::SetTrailer(on_or_off(self.cell(3, "on or off")?)?)
            }
            "Release" => {
                at_most(0)?;
                RobotInput::Release
            }
            _ => {
                let known = "Drive, MoveTo, Teleport, SetTrailer or Release";
                return Err((column, format!("{input:?} is no input: it must be {known}")));
            }
        };
        Ok(Event { tick, robot: robot.to_owned(), input })
    }

    fn cell(&self, i: usize, what: &str) -> Result<(usize, &str), (usize, String)> {
        match self.cells.get(i) {
            Some((column, text)) if text.is_empty() => Err((*column, format!("{what} is missing"))),
            Some((column, text)) => Ok((*column, text.as_str())),
            None => Err((self.end, format!("{what} is missing"))),
        }
    }

    /// A number, with a decimal comma where commas are not between cells.
    fn number(&self, text: &str) -> Option<f64> {
        text.parse().ok().or_else(|| decimal(text).filter(|_| self.form.separator != ','))
    }

    /// A whole number, which may be written as `1.0`.
    fn whole(&self, (column, text): (usize, &str), is_none: &str) -> Result<i64, (usize, String)> {
        // beyond 2^53 a number with a point may be another
        let float = || self.number(text).filter(|x| x.fract() == 0.0 && x.abs() <= 9_007_199_254_740_992.0);
        let whole = text.parse().ok().or_else(|| float().map(|x| x as i64));
        whole.ok_or_else(|| (column, format!("{text:?} {is_none}")))
    }

    fn channel(&self, i: usize, what: &str) -> Result<i16, (usize, String)> {
        let at = self.cell(i, what)?;
        let whole = self.whole(at, "is no whole number")?;
        i16::try_from(whole).map_err(|_| (at.0, format!("{what} {} is too large", at.1)))
    }

    /// A coordinate as it is written: a number, or degrees.
    fn written(&self, text: &str) -> Option<WrittenCoordinate> {
        match text.strip_suffix("deg") {
            Some(degrees) => self.number(degrees.trim_end()).map(WrittenCoordinate::degrees),
            None => self.number(text).map(WrittenCoordinate::number),
        }
    }

    /// The number of lengths that the coordinates of the row's robot begin with; `None` where its world is not known.
    fn lengths(&self) -> Option<usize> {
        self.lengths.get(self.cells[1].1.as_str()).copied()
    }

    /// What the writer may have meant by the row's angles that are more than a turn, each with its column.
    fn turns(&self) -> Vec<(usize, String)> {
        // in a world that is not known the first two coordinates of a teleport may be lengths
        let lengths = match self.cells[2].1.as_str() {
            "MoveTo" => 0,
            "Teleport" => self.lengths().unwrap_or(2),
            _ => return Vec::new(),
        };
        let note = |(column, text): &TableCell| Some((*column, self.written(text)?.turns()?));
        self.cells.iter().skip(3 + lengths).filter_map(note).collect()
    }

    /// Metres and radians, or degrees.
    fn coordinates(&self, cells: &[TableCell]) -> Result<Vec<Quantized>, (usize, String)> {
        if cells.is_empty() {
            return Err((self.end, "the coordinates are missing".to_owned()));
        }
        let lengths = self.lengths().unwrap_or(0);
        let coordinate = |(index, (column, text)): (usize, &TableCell)| {
            let written = self.written(text).ok_or_else(|| (*column, format!("{text:?} is no number")))?;
            if index < lengths && written.is_degrees() {
                return Err((*column, format!("coordinate {index} is a length in metres, and {text} is an angle")));
            }
            Quantized::try_new(written.value()).ok_or_else(|| (*column, format!("{text} is too large or not finite")))
        };
        cells.iter().enumerate().map(coordinate).collect()
    }
}

/// Reads `on`, `off`, `true` or `false`, in any letters: spreadsheets write `TRUE`, Python `True`.
fn on_or_off((column, text): (usize, &str)) -> Result<bool, (usize, String)> {
    match text.to_ascii_lowercase().as_str() {
        "on" | "true" => Ok(true),
        "off" | "false" => Ok(false),
        _ => Err((column, format!("{text:?} is neither on nor off"))),
    }
}

/// The cells of a row, at least one, without white space around them and without empty ones at its end. A cell may
/// stand in quotes, a quote in it doubled.
fn cells(row: &str, separator: char) -> Result<Vec<TableCell>, (usize, String)> {
    let mut cells = Vec::new();
    let mut rest = row.chars().zip(1..).peekable();
    let is_blank = |c: char| c.is_whitespace() && c != separator;
    loop {
        while rest.next_if(|(c, _)| is_blank(*c)).is_some() {}
        let column = rest.peek().map_or_else(|| row.chars().count() + 1, |(_, column)| *column);
        let mut text = String::new();
        if rest.next_if(|(c, _)| *c == '"').is_some() {
            loop {
                match rest.next() {
                    Some(('"', _)) if rest.next_if(|(c, _)| *c == '"').is_some() => text.push('"'),
                    Some(('"', _)) => break,
                    Some((c, _)) => text.push(c),
                    None => return Err((column, "the quote is not closed".to_owned())),
                }
            }
            while rest.next_if(|(c, _)| is_blank(*c)).is_some() {}
            if let Some((c, column)) = rest.peek().filter(|(c, _)| *c != separator) {
                let sign = if separator == ',' { "a comma".into() } else { format!("{separator:?}") };
                return Err((*column, format!("{c:?} after a quote: {sign} belongs there")));
            }
        } else {
            while let Some((c, _)) = rest.next_if(|(c, _)| *c != separator) {
                text.push(c);
            }
            text.truncate(text.trim_end().len());
        }
        if cells.len() == MAX_CELLS {
            return Err((column, format!("more than {MAX_CELLS} cells in a row")));
        }
        cells.push((column, text));
        if rest.next().is_none() {
            break;
        }
    }
    while cells.len() > 1 && cells.last().is_some_and(|(_, text)| text.is_empty()) {
        cells.pop();
    }
    Ok(cells)
}

// by its path: the fuzz target `script` takes this file in by its own
#[cfg(test)]
#[path = "table/tests.rs"]
mod tests;
