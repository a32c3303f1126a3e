//! A row of comma-separated values for each tick and robot.

use std::fmt::Write;
use std::io;

use super::ExportError;
use super::columns::{Columns, StateList, residents};
use super::every_frame::every_frame;
use crate::run::{DT, Frame, Log, RobotState};
use motion_lab_core::configuration::Kinds;

/// The columns of a log.
struct CsvHead {
    configuration: Columns,
    extra: Columns,
    target: Columns,
    /// The number of rays of each of a robot's sensors, from the first on: the largest in the log.
    ranges: Vec<usize>,
}

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
    let head = CsvHead::of(log, kinds, ranges);
    writeln!(out, "{}", head.names())?;
    let names: Vec<String> = log.recipe.config.robot_names().map(csv_cell).collect();
    let mut row = String::new();
    for frame in every_frame(log) {
        for (number, (name, robot)) in names.iter().zip(&frame.robots).enumerate() {
            row.clear();
            head.row(frame, NamedRobot { number, name }, robot, &mut row);
            row.push('\n');
            out.write_all(row.as_bytes())?;
        }
    }
    Ok(())
}

/// A robot's number by id, and its name as a cell.
#[derive(Clone, Copy)]
struct NamedRobot<'a> {
    number: usize,
    name: &'a str,
}

impl CsvHead {
    fn of(log: &Log, kinds: &Kinds, ranges: bool) -> Self {
        let mut widths = [StateList::Configuration, StateList::Extra, StateList::Target]
            .map(|list| (list, vec![0; residents(log).count()]));
        let mut of_sensors: Vec<usize> = Vec::new();
        for frame in every_frame(log) {
            for (list, widths) in &mut widths {
                for (width, robot) in widths.iter_mut().zip(&frame.robots) {
                    *width = (*width).max(list.of(robot).len());
                }
            }
            for scans in frame.scans.chunk_by(|a, b| a.robot == b.robot).filter(|_| ranges) {
                of_sensors.resize(of_sensors.len().max(scans.len()), 0);
                for (width, scan) in of_sensors.iter_mut().zip(scans) {
                    *width = (*width).max(scan.ranges.len());
                }
            }
        }
        let [configuration, extra, target] = widths.map(|(list, widths)| Columns::new(list, log, kinds, &widths));
        CsvHead { configuration, extra, target, ranges: of_sensors }
    }

    fn names(&self) -> String {
        let mut head = "tick,time_s,id,robot".to_owned();
        let mut list = |names: &[String]| names.iter().for_each(|name| _ = write!(head, ",{name}"));
        list(&self.configuration.names);
        list(&self.extra.names);
        list(&["channel0", "channel1"].map(str::to_owned));
        list(&self.target.names);
        head.push_str(",manual,in_contact,contacts,flash,refusals");
        for (sensor, width) in self.ranges.iter().enumerate() {
            for i in 0..*width {
                let _ = match sensor {
                    0 => write!(head, ",range{i}_m"),
                    _ => write!(head, ",scan{}_range{i}_m", sensor + 1),
                };
            }
        }
        head
    }

    fn row(&self, frame: &Frame, NamedRobot { number, name }: NamedRobot<'_>, robot: &RobotState, row: &mut String) {
        // taken apart by name, so that a field added later can't be forgotten here
        let RobotState {
            id,
            configuration: _,
            extra: _,
            channels,
            target: _,
            manual,
            in_contact,
            contacts,
            flash,
            refusals,
        } = robot;
        let Frame { tick, .. } = frame;
        // writing into a string can't fail
        let _ = write!(row, "{tick},{:?},{id},{name}", *tick as f64 * DT);
        cells(self.configuration.numbers(number, robot), row);
        cells(self.extra.numbers(number, robot), row);
        let _ = write!(row, ",{},{}", channels[0], channels[1]);
        cells(self.target.numbers(number, robot), row);
        let _ = write!(row, ",{manual},{in_contact},{contacts},{flash},{refusals}");
        let mut scans = frame.scans.iter().filter(|scan| scan.robot == *id);
        for width in &self.ranges {
            let ranges = scans.next().map_or(&[][..], |scan| &scan.ranges);
            cells((0..*width).map(|i| ranges.get(i).copied()), row);
        }
    }
}

fn cells(numbers: impl Iterator<Item = Option<f64>>, row: &mut String) {
    for number in numbers {
        row.push(',');
        if let Some(x) = number {
            let _ = write!(row, "{x:?}");
        }
    }
}

/// A text as a cell: in quotes where it has to be, also for programs that take `;` or a tab for the comma.
///
/// A text that a spreadsheet would take for a formula, because it begins with `=`, `+`, `-`, `@`, a tab or a line end,
/// gets an apostrophe before it.
pub fn csv_cell(text: &str) -> String {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']);
    let text = if is_formula { format!("'{text}") } else { text.to_owned() };
    let has_signs = text.contains([',', ';', '\t', '"', '\n', '\r']);
    if has_signs { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

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
        assert_eq!((csv_cell("a=1"), csv_cell("")), ("a=1".into(), String::new()));
    }

    #[test]
    fn numbers_keep_every_bit_and_missing_ones_are_empty() {
        let mut row = String::new();
        cells([Some(0.1 + 0.2), Some(-0.0), None, Some(f64::INFINITY), Some(5e-324)].into_iter(), &mut row);
        assert_eq!(row, ",0.30000000000000004,-0.0,,inf,5e-324");
    }
}
