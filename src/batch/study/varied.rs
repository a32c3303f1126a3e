//! `VariedAxis`, an axis of few values, by which the runs of a sweep are told apart.

use crate::batch::axis::CheckedAxis;
use crate::batch::problem_set::ProblemSet;
use crate::batch::values::{AxisValue, FiledProblem};

/// The greatest number of values of an axis by which runs are grouped.
const MAX_VALUES: u64 = 12;

/// An axis of two to twelve values.
#[derive(Clone, Debug, PartialEq)]
pub struct VariedAxis {
    /// The parameter, as the study calls it.
    pub name: String,
    /// Its values in words, in the axis's order, each once.
    pub values: Vec<String>,
    /// The number of the axis in the study.
    number: usize,
    own: Vec<AxisValue>,
}

impl VariedAxis {
    /// The axis with this number in the study; `None` with too few or too many values.
    pub(in crate::batch) fn of(number: usize, axis: &CheckedAxis) -> Option<Self> {
        if let Some(problems) = axis.filed() {
            return Self::of_sets(number, axis, problems);
        }
        let count = axis.len().filter(|count| *count <= MAX_VALUES)?;
        let mut own: Vec<AxisValue> = Vec::new();
        for value in (0..count).map(|i| axis.value(i)) {
            if !own.contains(&value) {
                own.push(value);
            }
        }
        let values = own.iter().map(words).collect();
        (own.len() > 1).then(|| VariedAxis { name: axis.parameter.name(), values, number, own })
    }

    /// The sets of a problem file, of which there may be many problems.
    fn of_sets(number: usize, axis: &CheckedAxis, problems: &ProblemSet) -> Option<Self> {
        let values: Vec<String> = problems.names().into_iter().map(str::to_owned).collect();
        let own = values.iter().cloned().map(AxisValue::Name).collect();
        let is_few = (2..=MAX_VALUES).contains(&(values.len() as u64));
        is_few.then(|| VariedAxis { name: format!("{}.set", axis.parameter.name()), values, number, own })
    }

    /// The number of its value among those of all axes of a row. Every value of the axis is there.
    pub(in crate::batch) fn number_of(&self, row: &[AxisValue]) -> usize {
        let set = match &row[self.number] {
            AxisValue::Filed(FiledProblem { problems, index }) => problems.set_of(*index),
            _ => None,
        };
        let value = set.map(|set| AxisValue::Name(set.to_owned()));
        let value = value.as_ref().unwrap_or(&row[self.number]);
        self.own.iter().position(|own| own == value).unwrap_or(0)
    }
}

/// A value in words.
fn words(value: &AxisValue) -> String {
    match value {
        AxisValue::Whole(n) => n.to_string(),
        AxisValue::Number(x) => x.to_string(),
        AxisValue::Name(name) => name.clone(),
        AxisValue::Configuration(start) => start.iter().map(f64::to_string).collect::<Vec<_>>().join(", "),
        AxisValue::Problem(problem) => format!("problem {}", problem.number),
        AxisValue::Filed(problem) => format!("problem {}", problem.index + 1),
    }
}
