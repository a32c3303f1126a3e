//! A row of comma-separated values for each tick and robot.

use std::fmt::Write;
use std::io;

use super::ExportError;
use super::every_frame::every_frame;
use super::table::{LogCell, NamedRobot, TableHead};
use crate::run::Log;
use motion_lab_core::configuration::Kinds;

/// Writes a log as CSV: the names of the columns, then a row for each tick from 0 on and each robot by id. A cell
/// without a value is empty. A name ends with its unit: `_s` seconds, `_m` metres, `_rad` radians.
///
/// A robot's numbers are called as its kind's coordinates, `x_m` or `theta1_rad`. A kind has the same columns in every
/// run; robots of several kinds share those that have one name. Numbers of a program's own kinds are `configuration0`,
/// `extra0`, `target0` and so on; [`write_csv_of_kinds`] has names for them.
///
/// With `ranges` there is a column for each ray too: those of a robot's first sensor are `range0_m` and so on, those of
/// its second one `scan2_range0_m`. `inf` is the range of a ray that meets nothing within reach.
///
/// # Errors
/// [`ExportError::Write`] when `out` fails.
pub fn write_csv(log: &Log, ranges: bool, out: impl io::Write) -> Result<(), ExportError> {
    write_csv_of_kinds(log, &Kinds::default(), ranges, out)
}

/// [`write_csv`] with kinds of robots that a program added: their configurations, and the targets of those that take
/// `MoveTo`, are called by the coordinates of their [descriptions](motion_lab_core::configuration::RobotKind). The
/// lab's kinds have their columns before them.
///
/// # Errors
/// As [`write_csv`].
pub fn write_csv_of_kinds(log: &Log, kinds: &Kinds, ranges: bool, mut out: impl io::Write) -> Result<(), ExportError> {
    let head = TableHead::of(log, kinds, ranges);
    writeln!(out, "{}", head.names().join(","))?;
    let names: Vec<String> = log.recipe.config.robot_names().map(csv_cell).collect();
    let mut row = String::new();
    for frame in every_frame(log) {
        for (number, (name, robot)) in names.iter().zip(&frame.robots).enumerate() {
            row.clear();
            head.cells(frame, NamedRobot { number, name }, robot, |cell| print(cell, &mut row));
            row.push('\n');
            out.write_all(row.as_bytes())?;
        }
    }
    Ok(())
}

/// Adds a cell to a row, after a comma if it is not the first.
fn print(cell: LogCell<'_>, row: &mut String) {
    if !row.is_empty() {
        row.push(',');
    }
    // writing into a string can't fail
    let _ = match cell {
        LogCell::Integer(x) => write!(row, "{x}"),
        LogCell::Number(Some(x)) => write!(row, "{x:?}"),
        LogCell::Number(None) => Ok(()),
        LogCell::Flag(x) => write!(row, "{x}"),
        LogCell::Name(name) => row.write_str(name),
    };
}

/// A text as a cell: in quotes where it has to be, also for programs that take `;` or a tab for the comma.
///
/// A text that a spreadsheet would take for a formula, because it begins with `=`, `+`, `-`, `@`, one of these in full
/// width, a tab or a line end, gets an apostrophe before it.
pub fn csv_cell(text: &str) -> String {
    let is_formula = text.starts_with(FORMULA_SIGNS) || text.starts_with(LINE_ENDS);
    let text = if is_formula { format!("'{text}") } else { text.to_owned() };
    let has_signs = text.contains([',', ';', '\t', '"']) || text.contains(LINE_ENDS);
    if has_signs { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

/// What a formula begins with, also as East Asian keyboards write it.
const FORMULA_SIGNS: [char; 9] = ['=', '+', '-', '@', '\t', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}'];

/// What some reader takes for the end of a row: Unicode's line ends, and the separators that Python splits lines at.
const LINE_ENDS: [char; 10] =
    ['\n', '\r', '\u{b}', '\u{c}', '\u{1c}', '\u{1d}', '\u{1e}', '\u{85}', '\u{2028}', '\u{2029}'];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_must_be() {
        assert_eq!(csv_cell("Rusty 2"), "Rusty 2");
        assert_eq!(csv_cell("a,b \"c\"\n"), "\"a,b \"\"c\"\"\n\"");
        assert_eq!(csv_cell("x;y\\"), "\"x;y\\\"");
    }

    /// The signs by which spreadsheets know a formula, as OWASP's page on CSV injection lists them.
    #[test]
    fn a_text_that_a_spreadsheet_would_calculate_is_shown_as_text() {
        assert_eq!(csv_cell("=1+1"), "'=1+1");
        assert_eq!(csv_cell("=A1,B1"), "\"'=A1,B1\"");
        assert_eq!(csv_cell("\t=1"), "\"'\t=1\"");
        for begin in ["+", "-", "@"] {
            assert_eq!(csv_cell(&format!("{begin}x")), format!("'{begin}x"));
        }
        for begin in ["\u{ff1d}", "\u{ff0b}", "\u{ff0d}", "\u{ff20}"] {
            assert_eq!(csv_cell(&format!("{begin}x")), format!("'{begin}x"));
        }
        assert_eq!((csv_cell("a=1"), csv_cell("")), ("a=1".into(), String::new()));
    }

    /// The ends of lines as Python's `str.splitlines` lists them.
    #[test]
    fn a_text_with_the_end_of_a_row_stands_in_quotes() {
        for end in "\n\r\u{b}\u{c}\u{1c}\u{1d}\u{1e}\u{85}\u{2028}\u{2029}".chars() {
            assert_eq!(csv_cell(&format!("a{end}b")), format!("\"a{end}b\""));
            assert_eq!(csv_cell(&format!("{end}=1")), format!("\"'{end}=1\""));
        }
    }

    #[test]
    fn numbers_keep_every_bit_and_missing_ones_are_empty() {
        let mut row = String::new();
        let numbers = [Some(0.1 + 0.2), Some(-0.0), None, Some(f64::INFINITY), Some(5e-324)];
        numbers.into_iter().for_each(|x| print(LogCell::Number(x), &mut row));
        assert_eq!(row, "0.30000000000000004,-0.0,,inf,5e-324");
    }
}
