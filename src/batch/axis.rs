//! `CheckedAxis`, one thing that a sweep varies and the values it takes.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::error::SweepProblem;
use super::parameter::{Parameter, ValueForm};
use super::problem_set::ProblemSet;
use super::values::{AxisValue, FiledProblem, NumberedProblem, Over, WrittenNumber};
use motion_lab_core::configuration::{RobotKind, WrittenCoordinate};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_import::Scenario;

/// The problems that a file holds.
#[derive(Clone, Debug)]
pub(super) enum NamedProblems {
    Scenario(Arc<Scenario>),
    Filed(Arc<ProblemSet>),
}

/// The problems of a study's files, by the names it gives them.
pub(super) type ProblemFiles = BTreeMap<String, NamedProblems>;

/// An axis whose values fit its parameter.
#[derive(Clone, Debug)]
pub(super) struct CheckedAxis {
    pub parameter: Parameter,
    over: Arc<Over>,
    /// The problems of an axis of problems.
    problems: Option<NamedProblems>,
}

impl CheckedAxis {
    /// The axis, if its values fit its parameter. `files` have the study's problems, by the names it gives them.
    pub fn try_new(parameter: Parameter, over: Arc<Over>, files: &ProblemFiles) -> Result<Self, SweepProblem> {
        let form = parameter.form();
        let fits = matches!(
            (&*over, form),
            (Over::Range(..) | Over::Values(_) | Over::Steps(..) | Over::Uniform(..), ValueForm::Number(_))
                | (Over::Range(..) | Over::Values(_), ValueForm::Whole(_))
                | (Over::Names(_), ValueForm::Name)
                | (Over::Starts(_), ValueForm::Start)
                | (Over::Goals(_), ValueForm::Goal)
                | (Over::Problems(_), ValueForm::Problem)
        );
        if !fits {
            return Err(SweepProblem::Values { found: over.in_words(), expected: form.in_words() });
        }
        if let Some(wrong) = over.numbers().find(|x| !x.is_finite()) {
            return Err(SweepProblem::NotFinite(wrong));
        }
        if let (ValueForm::Whole(_), Over::Values(values)) = (form, &*over)
            && let Some(wrong) = values.iter().find(|value| value.whole().is_none())
        {
            return Err(SweepProblem::NotWhole(wrong.real()));
        }
        let is_degrees = |number: &WrittenNumber| matches!(number, WrittenNumber::Degrees(_));
        if form != ValueForm::Number("rad") && over.written().any(|number| is_degrees(&number)) {
            return Err(SweepProblem::Degrees);
        }
        let problems = match over.problem_file() {
            Some((file, _)) => {
                let missing = || SweepProblem::Run(format!("there is no scenario {file:?}"));
                Some(files.get(file).ok_or_else(missing)?.clone())
            }
            None => None,
        };
        match &*over {
            Over::Steps(_, _, count @ 0..2) => Err(SweepProblem::Steps(*count)),
            Over::Steps(from, to, _) | Over::Uniform(from, to) if !(to.real() - from.real()).is_finite() => {
                Err(SweepProblem::Span(from.real(), to.real()))
            }
            _ if over.len() == Some(0) => Err(SweepProblem::Empty),
            _ => Ok(CheckedAxis { parameter, over, problems }),
        }
    }

    /// The number of its values; `None` for a range without steps.
    pub fn len(&self) -> Option<u64> {
        match &self.problems {
            Some(NamedProblems::Scenario(scenario)) => Some(scenario.problems.len() as u64),
            Some(NamedProblems::Filed(problems)) => Some(problems.len()),
            None => self.over.len(),
        }
    }

    /// The problems of a problem file, if it has such.
    pub fn filed(&self) -> Option<&Arc<ProblemSet>> {
        match &self.problems {
            Some(NamedProblems::Filed(problems)) => Some(problems),
            _ => None,
        }
    }

    /// The problem with this number, from 0, of an axis of problems; the last one beyond the end.
    fn problem(&self, i: u64) -> Option<AxisValue> {
        let (file, _) = self.over.problem_file()?;
        match self.problems.as_ref()? {
            NamedProblems::Filed(problems) => {
                let index = i.min(problems.len().saturating_sub(1));
                Some(AxisValue::Filed(FiledProblem { problems: Arc::clone(problems), index }))
            }
            NamedProblems::Scenario(scenario) => {
                let number = i.saturating_add(1).min(scenario.problems.len() as u64);
                let problem = scenario.problems.get(usize::try_from(number).ok()?.checked_sub(1)?)?.clone();
                let (file, scenario) = (file.to_owned(), Arc::clone(scenario));
                Some(AxisValue::Problem(NumberedProblem { file, number, scenario, problem }))
            }
        }
    }

    /// Its value with this number, from 0; the last one beyond the end.
    pub fn value(&self, i: u64) -> AxisValue {
        if let Some(problem) = self.problem(i) {
            return problem;
        }
        let at = |len: usize| usize::try_from(i).unwrap_or(usize::MAX).min(len.saturating_sub(1));
        match &*self.over {
            Over::Range(from, _) => self.whole(from.saturating_add(i)),
            Over::Values(values) => self.written(values[at(values.len())]),
            // the last one exactly, whatever the rounding
            Over::Steps(_, to, count) if i + 1 >= *count => self.number(to.real()),
            Over::Steps(from, to, count) => {
                let (from, to) = (from.real(), to.real());
                self.number(from + (to - from) * (i as f64 / (count - 1) as f64))
            }
            Over::Uniform(from, _) => self.number(from.real()),
            Over::Names(names) => AxisValue::Name(names[at(names.len())].clone()),
            // a file has a problem
            Over::Problems(file) => AxisValue::Name(file.clone()),
            Over::Starts(all) | Over::Goals(all) => {
                AxisValue::Configuration(all[at(all.len())].iter().map(|coordinate| coordinate.value()).collect())
            }
        }
    }

    /// Its value in row `row` of a random sample: a function of seed, parameter and row.
    pub fn draw(&self, seed: Seed, row: u64) -> AxisValue {
        let mut stream = Stream::new(seed, &format!("sweep/{}", self.parameter.name())).at(row);
        match (&*self.over, self.len()) {
            (Over::Uniform(from, to), _) => self.number(stream.uniform(from.real(), to.real())),
            (_, len) => self.value(stream.below(len.unwrap_or(1))),
        }
    }

    /// What the writer of its values may have meant by angles of more than a turn, in the first that is one.
    pub fn turns(&self) -> Option<String> {
        match (&*self.over, &self.parameter) {
            (Over::Starts(all), Parameter::Robot { kind, .. }) | (Over::Goals(all), Parameter::Goal { kind }) => {
                let lengths = RobotKind::of(kind)?.lengths;
                all.iter().find_map(|start| WrittenCoordinate::all_turns_in_ron(start, lengths).next())
            }
            (over, parameter) if parameter.form() == ValueForm::Number("rad") => {
                over.written().find_map(WrittenNumber::turns)
            }
            _ => None,
        }
    }

    fn written(&self, value: WrittenNumber) -> AxisValue {
        match (self.parameter.form(), value.whole()) {
            (ValueForm::Whole(_), Some(n)) => AxisValue::Whole(n),
            _ => self.number(value.real()),
        }
    }

    fn number(&self, x: f64) -> AxisValue {
        // a negative zero is a zero
        AxisValue::Number(x + 0.0)
    }

    fn whole(&self, n: u64) -> AxisValue {
        match self.parameter.form() {
            ValueForm::Number(_) => AxisValue::Number(n as f64),
            _ => AxisValue::Whole(n),
        }
    }
}
