//! A row of comma-separated values for each tick and robot.

use std::fmt::Write;
use std::io;

use super::{ExportError, frames};
use crate::run::{DT, Frame, Log, RobotState};

/// The number of columns of each list: its largest number of items in the log.
#[derive(Default)]
struct Widths {
    configuration: usize,
    extra: usize,
    target: usize,
    /// For each of a robot's sensors, from the first on.
    ranges: Vec<usize>,
}

/// Writes a log as CSV: the names of the columns, then a row for each tick from 0 on and each robot by id. A cell
/// without a value is empty. Times are seconds, lengths metres, angles radians.
///
/// With `ranges` there is a column for each ray too: those of a robot's first sensor are `range0` and so on, those of
/// its second one `scan2_range0`. Robots of a program's own kinds are written as any other.
///
/// # Errors
/// [`ExportError::Write`] when `out` fails.
pub fn write_csv(log: &Log, ranges: bool, mut out: impl io::Write) -> Result<(), ExportError> {
    let mut widths = Widths::default();
    for frame in frames(log) {
        for robot in &frame.robots {
            widths.configuration = widths.configuration.max(robot.configuration.len());
            widths.extra = widths.extra.max(robot.extra.len());
            widths.target = widths.target.max(robot.target.len());
        }
        for scans in frame.scans.chunk_by(|a, b| a.robot == b.robot).filter(|_| ranges) {
            widths.ranges.resize(widths.ranges.len().max(scans.len()), 0);
            for (width, scan) in widths.ranges.iter_mut().zip(scans) {
                *width = (*width).max(scan.ranges.len());
            }
        }
    }
    writeln!(out, "{}", widths.head())?;
    let names: Vec<String> = log.config.robot_names().map(cell).collect();
    let mut row = String::new();
    for frame in frames(log) {
        for (name, robot) in names.iter().zip(&frame.robots) {
            row.clear();
            widths.row(frame, name, robot, &mut row);
            row.push('\n');
            out.write_all(row.as_bytes())?;
        }
    }
    Ok(())
}

impl Widths {
    fn head(&self) -> String {
        let mut head = "tick,time,id,robot".to_owned();
        let mut list = |name: &str, width: usize| {
            for i in 0..width {
                let _ = write!(head, ",{name}{i}");
            }
        };
        list("configuration", self.configuration);
        list("extra", self.extra);
        list("channel", 2);
        list("target", self.target);
        head.push_str(",manual,in_contact,contacts,flash,refusals");
        for (sensor, width) in self.ranges.iter().enumerate() {
            for i in 0..*width {
                let _ = match sensor {
                    0 => write!(head, ",range{i}"),
                    _ => write!(head, ",scan{}_range{i}", sensor + 1),
                };
            }
        }
        head
    }

    fn row(&self, frame: &Frame, name: &str, robot: &RobotState, row: &mut String) {
        let RobotState { id, configuration, extra, channels, target, manual, in_contact, contacts, flash, refusals } =
            robot;
        let Frame { tick, .. } = frame;
        // writing into a string can't fail
        let _ = write!(row, "{tick},{:?},{id},{name}", *tick as f64 * DT);
        list(configuration, self.configuration, row);
        list(extra, self.extra, row);
        let _ = write!(row, ",{},{}", channels[0], channels[1]);
        list(target, self.target, row);
        let _ = write!(row, ",{manual},{in_contact},{contacts},{flash},{refusals}");
        let mut scans = frame.scans.iter().filter(|scan| scan.robot == *id);
        for width in &self.ranges {
            list(scans.next().map_or(&[], |scan| &scan.ranges), *width, row);
        }
    }
}

fn list(numbers: &[f64], width: usize, row: &mut String) {
    for i in 0..width {
        row.push(',');
        if let Some(x) = numbers.get(i) {
            let _ = write!(row, "{x:?}");
        }
    }
}

/// A text as a cell: in quotes where it has to be.
fn cell(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_must_be() {
        assert_eq!(cell("Rusty 2"), "Rusty 2");
        assert_eq!(cell("a,b \"c\"\n"), "\"a,b \"\"c\"\"\n\"");
    }

    #[test]
    fn numbers_keep_every_bit_and_missing_ones_are_empty() {
        let mut row = String::new();
        list(&[0.1 + 0.2, -0.0, f64::INFINITY, 5e-324], 5, &mut row);
        assert_eq!(row, ",0.30000000000000004,-0.0,inf,5e-324,");
    }
}
