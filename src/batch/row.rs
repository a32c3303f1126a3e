//! `RunRow`, what is known of a run: one row of a table.

use super::columns::{CellKind, Column};
use super::csv;
use motion_lab_sim::export::csv_cell;

/// A value of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum RowValue {
    /// Nothing: not known, or not there.
    Empty,
    /// A whole number.
    Whole(u64),
    /// A number; a finite one in a sweep's table.
    Number(f64),
    /// A text of one line, not empty.
    Text(String),
}

/// A row: its number in the sweep, and a cell for each further column.
#[derive(Clone, Debug, PartialEq)]
pub struct RunRow {
    /// Its number, from 0.
    pub row: u64,
    /// The cells of all columns, the first of which is that number.
    pub cells: Vec<RowValue>,
}

impl RowValue {
    /// A number; nothing where it is not finite.
    pub(super) fn finite(x: Option<f64>) -> RowValue {
        x.filter(|x| x.is_finite()).map_or(RowValue::Empty, |x| RowValue::Number(x + 0.0))
    }

    /// A text, its line ends as blanks; nothing for an empty one.
    pub(super) fn text(text: impl Into<String>) -> RowValue {
        let text: String = text.into().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        if text.is_empty() { RowValue::Empty } else { RowValue::Text(text) }
    }

    /// The value as a cell of a table for others.
    pub(super) fn to_table_cell(&self) -> String {
        if let RowValue::Text(text) = self { csv_cell(text) } else { self.to_text() }
    }

    /// The value as a text; a number has the fewest digits that read back to the same bits.
    pub fn to_text(&self) -> String {
        match self {
            RowValue::Empty => String::new(),
            RowValue::Whole(n) => n.to_string(),
            RowValue::Number(x) => x.to_string(),
            RowValue::Text(text) => text.clone(),
        }
    }

    fn read(text: String, kind: CellKind) -> Option<RowValue> {
        if text.is_empty() {
            return Some(RowValue::Empty);
        }
        Some(match kind {
            CellKind::Whole => RowValue::Whole(text.parse().ok()?),
            CellKind::Number => RowValue::Number(text.parse().ok().filter(|x: &f64| x.is_finite())?),
            CellKind::Text => RowValue::Text(text),
        })
    }
}

impl RunRow {
    /// The row as a line of comma-separated values, without its end. Numbers have the fewest digits that read back to
    /// the same bits.
    pub fn to_line(&self) -> String {
        csv::line(self.cells.iter().map(RowValue::to_text))
    }

    /// The row as a line of a table for others, without its end: as [`to_line`](Self::to_line), but texts are cells by
    /// [`csv_cell`], so that none is a formula.
    pub fn to_table_line(&self) -> String {
        let cells: Vec<String> = self.cells.iter().map(RowValue::to_table_cell).collect();
        cells.join(",")
    }

    /// The row of a line of a table with these columns; `None` where they do not fit.
    pub fn of_line(line: &str, columns: &[Column]) -> Option<Self> {
        let texts = csv::cells(line)?;
        if texts.len() != columns.len() {
            return None;
        }
        let cells: Vec<RowValue> = texts
            .into_iter()
            .zip(columns)
            .map(|(text, column)| RowValue::read(text, column.kind))
            .collect::<Option<_>>()?;
        let Some(RowValue::Whole(row)) = cells.first() else { return None };
        Some(RunRow { row: *row, cells })
    }

    /// The cell of the column of this name.
    pub fn cell(&self, columns: &[Column], name: &str) -> Option<&RowValue> {
        self.cells.get(columns.iter().position(|column| column.name == name)?)
    }
}
