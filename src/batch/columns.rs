//! `Column`, what stands in a column of a sweep's table: its name with its unit, and what it is.

use serde::{Deserialize, Serialize};

use super::axis::CheckedAxis;
use super::csv;
use super::parameter::ValueForm;
use super::problem_set::ProblemSet;
use motion_lab_core::configuration::RobotKind;
use motion_lab_sim::export::csv_cell;

/// The kind of a column's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CellKind {
    /// Whole numbers from 0 on.
    Whole,
    /// Finite numbers.
    Number,
    /// Texts.
    Text,
}

/// A column of a sweep's table. In every column but the first a cell may be empty.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// The name, which ends with the unit, if there is one.
    pub name: String,
    /// The kind of its values.
    pub kind: CellKind,
    /// The unit: `m`, `rad`, `s`, `ticks`, `per_m`; empty for none.
    pub unit: String,
    /// What it is, in words.
    pub about: String,
}

/// Largest number of robots that have columns of their own. With more, rows hold what is known of all robots together.
pub const MAX_ROBOT_COLUMNS: usize = 32;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct RobotColumns {
    pub name: String,
    pub kind: String,
}

/// What is known of each robot beside its last configuration: the ends of the names, and what they are.
pub(super) const OF_ROBOT: [(&str, CellKind, &str, &str); 6] = [
    ("contacts", CellKind::Whole, "", "contact episodes"),
    ("in_contact", CellKind::Number, "s", "time in contact"),
    ("first_contact", CellKind::Number, "s", "when it was first in contact; empty if never"),
    ("least_clearance", CellKind::Number, "m", "least distance from an obstacle; empty without any"),
    ("path", CellKind::Number, "m", "length of its path"),
    ("refusals", CellKind::Whole, "", "inputs of the script that it refused"),
];

/// What is known of a problem: the names, and what they are.
const OF_PROBLEM: [(&str, CellKind, &str, &str); 7] = [
    ("problem", CellKind::Whole, "", "number of the problem in its scenario, from 1"),
    ("problem.bucket", CellKind::Whole, "", "its bucket by the scenario"),
    ("problem.start.x", CellKind::Number, "m", "where the robot starts"),
    ("problem.start.y", CellKind::Number, "m", "where the robot starts"),
    ("problem.goal.x", CellKind::Number, "m", "where it should go"),
    ("problem.goal.y", CellKind::Number, "m", "where it should go"),
    ("problem.optimal", CellKind::Number, "m", "length of the shortest way in eight directions by the scenario"),
];

/// A column with the unit behind its name.
fn column(name: impl Into<String>, kind: CellKind, unit: &str, about: impl Into<String>) -> Column {
    let name = name.into();
    let name = if unit.is_empty() || name == unit { name } else { format!("{name}_{unit}") };
    Column { name, kind, unit: unit.to_owned(), about: about.into() }
}

fn of_axis(axis: &CheckedAxis) -> Vec<Column> {
    let name = axis.parameter.name();
    let about = "varied by the study";
    match axis.parameter.form() {
        ValueForm::Whole(unit) => vec![column(name, CellKind::Whole, unit, about)],
        ValueForm::Number(unit) => vec![column(name, CellKind::Number, unit, about)],
        ValueForm::Name => vec![column(name, CellKind::Text, "", about)],
        ValueForm::Start | ValueForm::Goal => coordinates(axis.parameter.configured())
            .map(|(c, unit)| column(format!("{name}.{c}"), CellKind::Number, unit, about))
            .collect(),
        ValueForm::Problem if let Some(problems) = axis.filed() => of_filed(problems),
        ValueForm::Problem => OF_PROBLEM.map(|(end, kind, unit, about)| column(end, kind, unit, about)).to_vec(),
    }
}

/// What a row says of a problem of a problem file.
fn of_filed(problems: &ProblemSet) -> Vec<Column> {
    let known = "`path` or `none` where it is known whether there is one";
    let [_, bucket, .., optimal] = OF_PROBLEM.map(|(name, kind, unit, about)| column(name, kind, unit, about));
    let mut columns = vec![
        column("problem", CellKind::Whole, "", "number of the problem in its file, from 1"),
        column("problem.set", CellKind::Text, "", "its set"),
        column("problem.known", CellKind::Text, "", known),
        bucket,
        optimal,
    ];
    for (end, about) in [("start", "where the robot starts"), ("goal", "where it should go")] {
        let of = |(c, unit)| column(format!("problem.{end}.{c}"), CellKind::Number, unit, about);
        columns.extend(coordinates(problems.kinds().first().copied()).map(of));
    }
    columns
}

/// The names of a kind's coordinates with their units.
fn coordinates(kind: Option<&'static RobotKind>) -> impl Iterator<Item = (&'static str, &'static str)> {
    let names = kind.map_or(&[][..], |kind| kind.coordinates);
    names.iter().enumerate().map(move |(i, name)| (*name, kind.map_or("", |kind| kind.unit_of(i))))
}

/// The names of columns as a line of comma-separated values.
pub(super) fn heading(columns: &[Column]) -> String {
    csv::line(columns.iter().map(|column| column.name.clone()))
}

/// The names of the columns as the first line of a table for others.
pub(super) fn table_heading(columns: &[Column]) -> String {
    let names: Vec<String> = columns.iter().map(|column| csv_cell(&column.name)).collect();
    names.join(",")
}

/// The columns of a table: the row's number, seed and length, the axes, the run as a whole, then each robot.
/// A planner's are there where its paths have a unit.
pub(super) fn columns(
    axes: &[CheckedAxis],
    has_goal: bool,
    planned: Option<&'static str>,
    robots: &[RobotColumns],
) -> Vec<Column> {
    use CellKind::{Number, Text, Whole};
    let mut columns = vec![
        column("row", Whole, "", "number of the run in the sweep, from 0"),
        column("seed", Whole, "", "seed of the run"),
        column(
            "ticks",
            Whole,
            "ticks",
            "length of the run; 20 are a second; empty where a path says it, or no run plays it",
        ),
    ];
    for axis in axes.iter().flat_map(of_axis) {
        // seed and length have their columns whether they are varied or not
        if !columns.iter().any(|known| known.name == axis.name) {
            columns.push(axis);
        }
    }
    columns.extend([
        column("failure", Text, "", "why it could not be run, or what failed in it; empty if nothing"),
        column("failure_kind", Text, "", "what sort of failure that is, of few; empty if none"),
        column("contacts", Whole, "", "contact episodes of all robots"),
        column("first_contact", Number, "s", "when a robot was first in contact; empty if never"),
        column("least_clearance", Number, "m", "least distance of a robot from an obstacle; empty without any"),
        column("path", Number, "m", "length of all robots' paths"),
    ]);
    if has_goal {
        columns.extend([
            column("at_goal", Number, "s", "time at the goal"),
            column("first_at_goal", Number, "s", "when the robot was first at the goal; empty if never"),
        ]);
    }
    if let Some(unit) = planned {
        columns.extend([
            column("solved", Whole, "", "1 if the planner has found a path, 0 if not"),
            column("iterations", Whole, "", "iterations of the planner"),
            column("edges", Whole, "", "edges that the planner asked about"),
            column("planned_path", Number, unit, "length of the planned path; empty without any"),
            column("planned_clearance", Number, "m", "clearance proven along it; empty without an obstacle"),
            column(
                "planned_time",
                Number,
                "s",
                "when the robot stands at its end; empty if it can't be played, or no run plays it",
            ),
        ]);
    }
    columns.push(column("digest", Text, "", "digest of the run, 32 hexadecimal digits"));
    for RobotColumns { name, kind } in robots {
        let end = |(c, unit)| column(format!("{name}.end.{c}"), Number, unit, "where it was at the end");
        columns.extend(coordinates(RobotKind::of(kind)).map(end));
        columns.extend(OF_ROBOT.map(|(end, kind, unit, about)| column(format!("{name}.{end}"), kind, unit, about)));
    }
    columns
}
