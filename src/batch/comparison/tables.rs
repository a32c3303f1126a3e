//! The attempts of a comparison as tables: a row for each attempt, and the lengths of paths as they fell.

use std::io::Write;

use motion_lab_core::configuration::{AnyConfiguration, Configuration as _};
use motion_lab_core::planning::Effort;
use motion_lab_sim::plans::PathLengths;

use super::case::AskedPath;
use super::compared::{ComparedAttempt, PlannerComparison};
use crate::batch::columns::{CellKind, Column};
use crate::batch::failure_kind::RunFailure;
use crate::batch::problem_set::KnownProblem;
use crate::batch::row::RowValue;
use crate::batch::table::{TableError, TableWriter};

/// What the columns are of that each attempt has.
const OF_ATTEMPT: [(&str, CellKind, &str, &str); 17] = [
    ("planner", CellKind::Text, "", "who planned"),
    ("seed", CellKind::Whole, "", "the seed of its samples"),
    ("solved", CellKind::Text, "", "true or false"),
    ("time", CellKind::Number, "s", "how long it took, which differs from run to run"),
    ("iterations", CellKind::Whole, "", "iterations done"),
    ("samples", CellKind::Whole, "", "samples drawn"),
    ("edges", CellKind::Whole, "", "edges asked about"),
    ("free", CellKind::Whole, "", "edges that were free"),
    ("length", CellKind::Number, PATH, "length of the path"),
    ("clearance", CellKind::Number, "m", "clearance proven along the whole path"),
    ("clearance_asked", CellKind::Number, "m", "clearance that was asked of the path"),
    ("reason", CellKind::Text, "", "why there is no path"),
    ("failure_kind", CellKind::Text, "", "what sort of failure that is, of few"),
    ("robot", CellKind::Text, "", "the robot's name"),
    ("world", CellKind::Text, "", "the world's name"),
    (START, CellKind::Text, "", "where the path begins: coordinates in metres and radians, joined by commas"),
    (GOAL, CellKind::Text, "", "where it ends"),
];

/// The columns that the problems of a file have too.
const OF_PROBLEM: [(&str, CellKind, &str, &str); 5] = [
    ("problem", CellKind::Whole, "", "number of the problem in its file, from 1"),
    ("set", CellKind::Text, "", "its set; a scenario's name"),
    ("known", CellKind::Text, "", "`path` or `none` where it is known whether there is one"),
    ("bucket", CellKind::Whole, "", "its bucket by the scenario"),
    ("optimal", CellKind::Number, "m", "length of the shortest way by the scenario"),
];

/// The columns of the lengths as they fell.
const OF_COST: [(&str, CellKind, &str, &str); 4] = [
    ("planner", CellKind::Text, "", "who planned"),
    ("seed", CellKind::Whole, "", "the seed of its samples"),
    ("iterations", CellKind::Whole, "", "iterations done by then"),
    ("length", CellKind::Number, PATH, "length of the best path by then"),
];

/// The unit of a path's length, which is that of the robot.
const PATH: &str = "m or rad";

const START: &str = "start";
const GOAL: &str = "goal";

impl PlannerComparison {
    fn is_of_problems(&self) -> bool {
        !self.problems().names().is_empty()
    }

    fn named(&self, column: &(&str, CellKind, &str, &str)) -> Column {
        let (name, kind, of, about) = *column;
        let of = if of == PATH { self.unit() } else { of };
        let name = if of.is_empty() { name.to_owned() } else { format!("{name}_{of}") };
        Column { name, kind, unit: of.to_owned(), about: about.to_owned() }
    }

    /// The columns of the table of attempts.
    pub fn columns(&self) -> Vec<Column> {
        let of_problem = if self.is_of_problems() { &OF_PROBLEM[..] } else { &[] };
        OF_ATTEMPT.iter().chain(of_problem).map(|column| self.named(column)).collect()
    }

    /// An attempt's cells; a path's are empty where there is none.
    fn cells(&self, attempt: &ComparedAttempt) -> Vec<RowValue> {
        let ComparedAttempt { case, planner, seed, effort, seconds, clearance_asked, path, costs: _ } = attempt;
        let Effort { iterations, samples, edges, free } = *effort;
        let number = |x: Option<f64>| x.map_or(RowValue::Empty, RowValue::Number);
        let path_number = |of: fn(&PathLengths) -> f64| number(path.as_ref().ok().map(of));
        let numbers = |q: &AnyConfiguration| {
            RowValue::text(q.coordinates().iter().map(f64::to_string).collect::<Vec<_>>().join(","))
        };
        let mut cells = vec![
            RowValue::text(planner.id()),
            RowValue::Whole(seed.0),
            RowValue::text(path.is_ok().to_string()),
            RowValue::Number(*seconds),
        ];
        cells.extend([iterations, samples, edges, free].map(RowValue::Whole));
        cells.extend([path_number(|path| path.length), path_number(|path| path.clearance)]);
        cells.push(number(*clearance_asked));
        cells.extend(path.as_ref().err().map_or([RowValue::Empty, RowValue::Empty], RunFailure::cells));
        match &case.asked {
            Some(AskedPath { robot, world, ends }) => {
                cells.extend([robot, world].map(RowValue::text));
                cells.extend(ends.iter().map(numbers));
            }
            None => cells.extend([(); 4].map(|()| RowValue::Empty)),
        }
        if let Some(known) = &case.known {
            let KnownProblem { number, set, bucket, optimal, .. } = known;
            cells.extend([RowValue::Whole(*number), RowValue::text(set)]);
            cells.push(known.path_in_words().map_or(RowValue::Empty, RowValue::text));
            cells.extend([bucket.map_or(RowValue::Empty, RowValue::Whole), RowValue::finite(*optimal)]);
        }
        cells
    }

    /// The attempts as CSV, a row for each.
    pub fn csv(&self, attempts: &[ComparedAttempt]) -> String {
        csv(&self.columns(), attempts.iter().map(|attempt| self.cells(attempt)))
    }

    /// The attempts as Parquet, a row for each, with each column's unit and meaning in the file's own metadata.
    ///
    /// # Errors
    /// [`TableError`] when the output can't be written.
    pub fn parquet<W: Write + Send>(&self, attempts: &[ComparedAttempt], output: W) -> Result<W, TableError> {
        let mut table = TableWriter::of_columns(output, &self.columns(), &[])?;
        attempts.iter().try_for_each(|attempt| table.cells(self.cells(attempt)))?;
        table.finish()
    }

    /// The lengths of the attempts' paths as they fell, as CSV: a row for each first path and for each shorter one, so
    /// that they tell how many attempts had a path after some iterations, and how good it was.
    pub fn costs_csv(&self, attempts: &[ComparedAttempt]) -> String {
        let of_problem = if self.is_of_problems() { &OF_PROBLEM[..1] } else { &[] };
        let columns: Vec<Column> = OF_COST.iter().chain(of_problem).map(|column| self.named(column)).collect();
        let rows = attempts.iter().flat_map(|attempt| {
            attempt.costs.iter().map(|cost| {
                let counts = [attempt.seed.0, cost.iterations].map(RowValue::Whole);
                let number = attempt.case.known.as_ref().map(|known| RowValue::Whole(known.number));
                let cells = [RowValue::text(attempt.planner.id())].into_iter().chain(counts);
                cells.chain([RowValue::Number(cost.length)]).chain(number).collect()
            })
        });
        csv(&columns, rows)
    }
}

/// Rows under the names of their columns. Coordinates are numbers, which no spreadsheet takes for a formula.
fn csv(columns: &[Column], rows: impl Iterator<Item = Vec<RowValue>>) -> String {
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    let cell = |(column, value): (&Column, RowValue)| match column.name.as_str() {
        START | GOAL => format!("\"{}\"", value.to_text()),
        _ => value.to_table_cell(),
    };
    let head = line(columns.iter().map(|column| column.name.clone()).collect());
    rows.fold(head, |text, row| text + &line(columns.iter().zip(row).map(cell).collect()))
}
