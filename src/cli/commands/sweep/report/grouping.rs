//! `RowGroups`, the rows told apart by the values of one parameter or of several.

use crate::batch::{RowValue, RunRow, Study, VariedAxis};

/// The rows of a sweep by the values of parameters of few values.
pub struct RowGroups {
    /// The parameters, as the study calls them.
    pub parameters: Vec<String>,
    /// The values of each group in words, one for each parameter.
    pub groups: Vec<Vec<String>>,
    /// The number of the group of each row.
    pub of_rows: Vec<u16>,
}

/// The number in a cell.
pub fn number(cell: Option<&RowValue>) -> Option<f64> {
    match cell {
        Some(RowValue::Whole(n)) => Some(*n as f64),
        Some(RowValue::Number(x)) => Some(*x),
        _ => None,
    }
}

/// How a row ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowEnd {
    /// Whether its planner had a path.
    pub is_solved: bool,
    /// The number of the kind of its failure, if it failed.
    pub failure: Option<u16>,
}

impl RowEnd {
    /// How a row of a study ended. A kind of failure that is not among these is added to them.
    pub fn of(study: &Study, row: &RunRow, kinds: &mut Vec<String>) -> Self {
        let columns = study.columns();
        let is_solved = number(row.cell(columns, "solved")) == Some(1.0);
        if !row.is_failure(columns) {
            return RowEnd { is_solved, failure: None };
        }
        let kind = row.cell(columns, "failure_kind").map_or_else(String::new, RowValue::to_text);
        let known = kinds.iter().position(|known| *known == kind).unwrap_or_else(|| {
            kinds.push(kind);
            kinds.len() - 1
        });
        RowEnd { is_solved, failure: Some(u16::try_from(known).unwrap_or(u16::MAX)) }
    }
}

/// The greatest number of groups of several parameters together.
pub const MAX_GROUPS: usize = 144;

impl RowGroups {
    /// The rows by the values of an axis.
    pub fn of_axis(axis: &VariedAxis) -> Self {
        let groups = axis.values.iter().map(|value| vec![value.clone()]).collect();
        RowGroups { parameters: vec![axis.name.clone()], groups, of_rows: Vec::new() }
    }

    /// The rows by the values of all of these together, without the combinations that no row has. `None` where there
    /// are too many.
    pub fn crossed(of: &[&RowGroups]) -> Option<Self> {
        let (first, others) = of.split_first()?;
        let mut crossed = RowGroups {
            parameters: first.parameters.clone(),
            groups: first.groups.clone(),
            of_rows: first.of_rows.clone(),
        };
        for other in others {
            crossed.parameters.extend(other.parameters.iter().cloned());
            let count = other.groups.len();
            let numbers = crossed.of_rows.iter().zip(&other.of_rows);
            let all: Vec<usize> = numbers.map(|(a, b)| usize::from(*a) * count + usize::from(*b)).collect();
            let mut kept = all.clone();
            kept.sort_unstable();
            kept.dedup();
            if kept.len() > MAX_GROUPS {
                return None;
            }
            let words = |group: &usize| [&*crossed.groups[group / count], &other.groups[group % count]].concat();
            crossed.groups = kept.iter().map(words).collect();
            crossed.of_rows = all.iter().map(|group| kept.partition_point(|known| known < group) as u16).collect();
        }
        Some(crossed)
    }

    /// The parameters, as a heading has them.
    pub fn name(&self) -> String {
        self.parameters.join(", ")
    }

    /// The rows' numbers of a group.
    pub fn rows_of(&self, group: usize) -> impl Iterator<Item = usize> {
        self.of_rows.iter().enumerate().filter(move |(_, of)| usize::from(**of) == group).map(|(row, _)| row)
    }
}
