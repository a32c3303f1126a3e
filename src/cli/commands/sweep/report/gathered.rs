//! `Gathered`, what a report is made of.

use std::path::Path;

use crate::batch::{Column, RowValue, RunRow, Study, TableError, TableFile, VariedAxis};
use crate::capture::{ByValue, Captured, Distribution, boxes, histograms};
use crate::cli::Failure;
use crate::cli::commands::sweep::verify;
use crate::cli::support::input::open;
use crate::cli::support::words::counted;

/// Runs that are listed of each sort.
const LISTED: usize = 20;

/// The results of a whole run that have a distribution.
const SHOWN: [&str; 12] = [
    "contacts",
    "first_contact_s",
    "least_clearance_m",
    "path_m",
    "at_goal_s",
    "first_at_goal_s",
    "iterations",
    "edges",
    "planned_path_m",
    "planned_path_rad",
    "planned_clearance_m",
    "planned_time_s",
];

/// What a report is made of.
pub struct Gathered {
    pub study: Study,
    pub rows: u64,
    pub failed: u64,
    /// The results, each with a number for each row; NaN for one that has none.
    pub results: Vec<Distribution>,
    /// The axes of few values.
    pub axes: Vec<VariedAxis>,
    /// For each of them, the number of the value of each row.
    values: Vec<Vec<u8>>,
    /// Whether each row failed, and whether its planner had a path.
    ended: Vec<RowEnd>,
    /// Whether the study has a planner.
    pub is_planned: bool,
    /// The runs with the most contacts, then the least clearance; worst first.
    pub worst: Vec<RunRow>,
    /// The first runs that failed.
    pub failures: Vec<RunRow>,
}

/// How a row ended.
#[derive(Clone, Copy)]
struct RowEnd {
    is_failure: bool,
    is_solved: bool,
}

/// How the runs of a value ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ValueCounts {
    pub runs: u64,
    pub solved: u64,
    pub failed: u64,
}

/// The number in a cell.
fn number(cell: Option<&RowValue>) -> Option<f64> {
    match cell {
        Some(RowValue::Whole(n)) => Some(*n as f64),
        Some(RowValue::Number(x)) => Some(*x),
        _ => None,
    }
}

/// The name of a column without its unit, and the unit where the name does not say it.
fn parts_of(column: &Column) -> (&str, Option<&str>) {
    let unit = Some(column.unit.as_str()).filter(|unit| !unit.is_empty() && *unit != column.name);
    let name = unit.and_then(|unit| column.name.strip_suffix(unit)?.strip_suffix('_'));
    (name.unwrap_or(&column.name), unit)
}

/// What a parameter is, called as the study calls it, with its unit.
pub fn parameter_title(column: &Column) -> String {
    let (name, unit) = parts_of(column);
    unit.map_or_else(|| name.to_owned(), |unit| format!("{name}, {unit}"))
}

/// What a result is, in words, with its unit.
pub fn title(column: &Column) -> String {
    let (name, unit) = parts_of(column);
    let name = name.replace('_', " ");
    unit.map_or_else(|| name.clone(), |unit| format!("{name}, {unit}"))
}

impl Gathered {
    /// What the table in a file says.
    pub fn of(file: &Path) -> Result<Self, Failure> {
        if file.extension().is_some_and(|ending| ending == "csv") {
            return Err(verify::has_no_study(file));
        }
        let refused = |error: TableError| verify::refused(file, &error);
        let table = TableFile::open(open(file)?).map_err(refused)?;
        let study = table.study().clone();
        let columns = study.columns();
        let shown: Vec<&Column> = columns.iter().filter(|column| SHOWN.contains(&column.name.as_str())).collect();
        let is_planned = columns.iter().any(|column| column.name == "solved");
        let axes = study.varied();
        let (mut values, mut ended) = (vec![Vec::new(); axes.len()], Vec::new());
        let mut results: Vec<Distribution> =
            shown.iter().map(|column| Distribution { name: title(column), values: Vec::new() }).collect();
        let mut failed = 0;
        let (mut worst, mut failures): (Vec<RunRow>, Vec<RunRow>) = (Vec::new(), Vec::new());
        // worst first; of equals the one of the lesser number
        let badness = |row: &RunRow| {
            let contacts = number(row.cell(columns, "contacts")).unwrap_or(0.0);
            (contacts, number(row.cell(columns, "least_clearance_m")).unwrap_or(f64::INFINITY))
        };
        let order = |a: &RunRow, b: &RunRow| {
            let ((contacts, clearance), (others, other)) = (badness(a), badness(b));
            others.total_cmp(&contacts).then(clearance.total_cmp(&other)).then(a.row.cmp(&b.row))
        };
        let rows = table
            .each(|row| {
                for (result, column) in results.iter_mut().zip(&shown) {
                    result.values.push(number(row.cell(columns, &column.name)).unwrap_or(f64::NAN));
                }
                for (values, value) in values.iter_mut().zip(study.values_of(&axes, row.row)) {
                    values.push(value as u8);
                }
                let is_solved = row.cell(columns, "solved") == Some(&RowValue::Whole(1));
                ended.push(RowEnd { is_failure: row.is_failure(columns), is_solved });
                if row.is_failure(columns) {
                    failed += 1;
                    if failures.len() < LISTED {
                        failures.push(row.clone());
                    }
                }
                if row.has_contacts(columns) || number(row.cell(columns, "least_clearance_m")).is_some() {
                    let at = worst.partition_point(|known| order(known, &row).is_lt());
                    if at < LISTED {
                        worst.insert(at, row);
                        worst.truncate(LISTED);
                    }
                }
            })
            .map_err(refused)?;
        Ok(Gathered { study, rows, failed, results, axes, values, ended, is_planned, worst, failures })
    }

    /// The same, with figures for the values of the axis of this name alone; `None` without it.
    pub fn only(mut self, name: &str) -> Option<Self> {
        let at = self.axes.iter().position(|axis| axis.name == name)?;
        (self.axes, self.values) = (vec![self.axes.swap_remove(at)], vec![self.values.swap_remove(at)]);
        Some(self)
    }

    /// The results of all runs as histograms.
    pub fn figure(&self) -> Captured {
        let title = format!("{} of a sweep", counted(self.rows, "run"));
        histograms(&title, &self.results, vec![("Study", self.study.digest().to_string())])
    }

    /// The results by the values of each axis, as boxes.
    pub fn figures_by_value(&self) -> impl Iterator<Item = Captured> {
        self.axes.iter().zip(&self.values).map(|(axis, values)| {
            let results: Vec<ByValue> = self.results.iter().map(|result| by_value(axis, values, result)).collect();
            let title = format!("{} of a sweep by {}", counted(self.rows, "run"), axis.name);
            boxes(&title, &axis.name, &results, vec![("Study", self.study.digest().to_string())])
        })
    }

    /// For each axis, for each of its values, how its runs ended.
    pub fn counts(&self) -> impl Iterator<Item = Vec<ValueCounts>> {
        self.axes.iter().zip(&self.values).map(|(axis, values)| {
            let mut counts = vec![ValueCounts::default(); axis.values.len()];
            for (value, ended) in values.iter().zip(&self.ended) {
                let of_value = &mut counts[usize::from(*value)];
                of_value.runs += 1;
                of_value.solved += u64::from(ended.is_solved);
                of_value.failed += u64::from(ended.is_failure);
            }
            counts
        })
    }

    /// The results by the values of the axis of this number.
    pub fn results_by_value(&self, axis: usize) -> impl Iterator<Item = ByValue> {
        self.results.iter().map(move |result| by_value(&self.axes[axis], &self.values[axis], result))
    }
}

/// A result by the values of an axis.
fn by_value(axis: &VariedAxis, values: &[u8], result: &Distribution) -> ByValue {
    let mut groups: Vec<(String, Vec<f64>)> = axis.values.iter().map(|value| (value.clone(), Vec::new())).collect();
    for (value, x) in values.iter().zip(&result.values) {
        if x.is_finite() {
            groups[usize::from(*value)].1.push(*x);
        }
    }
    ByValue { name: result.name.clone(), groups }
}
