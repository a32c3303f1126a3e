//! `Gathered`, what a report is made of.

use std::path::Path;

use super::grouping::{RowEnd, RowGroups, number};
use crate::batch::{Column, RunRow, Study, TableError, TableFile};
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
    /// The rows by the values of each parameter of few values, or of those that were asked for.
    pub groups: Vec<RowGroups>,
    /// How each row ended.
    pub ended: Vec<RowEnd>,
    /// The kinds of failure that there are.
    pub kinds: Vec<String>,
    /// Whether the study has a planner.
    pub is_planned: bool,
    /// The runs with the most contacts, then the least clearance; worst first.
    pub worst: Vec<RunRow>,
    /// The first runs that failed.
    pub failures: Vec<RunRow>,
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
        let mut groups: Vec<RowGroups> = axes.iter().map(RowGroups::of_axis).collect();
        let (mut ended, mut kinds) = (Vec::new(), Vec::new());
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
                for (groups, value) in groups.iter_mut().zip(study.values_of(&axes, row.row)) {
                    groups.of_rows.push(value as u16);
                }
                ended.push(RowEnd::of(&study, &row, &mut kinds));
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
        Ok(Gathered { study, rows, failed, results, groups, ended, kinds, is_planned, worst, failures })
    }

    /// The results of all runs as histograms.
    pub fn figure(&self) -> Captured {
        let title = format!("{} of a sweep", counted(self.rows, "run"));
        histograms(&title, &self.results, vec![("Study", self.study.digest().to_string())])
    }

    /// The results by the values of parameters, as boxes: a figure for each of the groupings.
    pub fn figures_by_value(&self) -> impl Iterator<Item = Captured> {
        self.groups.iter().map(|groups| {
            let results: Vec<ByValue> = self.results_by_value(groups).collect();
            let (title, name) =
                (format!("{} of a sweep by {}", counted(self.rows, "run"), groups.name()), groups.name());
            boxes(&title, &name, &results, vec![("Study", self.study.digest().to_string())])
        })
    }

    /// The results by the values of parameters.
    pub fn results_by_value(&self, groups: &RowGroups) -> impl Iterator<Item = ByValue> {
        self.results.iter().map(move |result| by_value(groups, result))
    }
}

/// A result by the values of parameters.
fn by_value(by: &RowGroups, result: &Distribution) -> ByValue {
    let mut groups: Vec<(String, Vec<f64>)> = by.groups.iter().map(|words| (words.join(", "), Vec::new())).collect();
    for (group, x) in by.of_rows.iter().zip(&result.values) {
        if x.is_finite() {
            groups[usize::from(*group)].1.push(*x);
        }
    }
    ByValue { name: result.name.clone(), groups }
}
