//! The values of an axis, as a study writes them and as a run gets them.

use std::fmt;
use std::sync::Arc;

use super::problem_set::{ProblemSet, SetProblem};
use motion_lab_core::configuration::WrittenCoordinate;
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_import::{Scenario, ScenarioProblem};
use serde::de::{Deserializer, Error, IntoDeserializer, Visitor};
use serde::{Deserialize, Serialize, Serializer};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WrittenNumber {
    /// A number that a double holds as well as any.
    Real(f64),
    /// A whole number from [`FIRST_INEXACT`] on, written without a point.
    Whole(u64),
    /// An angle that was written in degrees.
    Degrees(WrittenCoordinate),
}

/// 2^53, the first whole number that doubles do not tell from its successor.
pub(super) const FIRST_INEXACT: u64 = 1 << 53;

impl WrittenNumber {
    /// The nearest double.
    pub fn real(self) -> f64 {
        match self {
            WrittenNumber::Real(x) => x,
            WrittenNumber::Whole(n) => n as f64,
            WrittenNumber::Degrees(angle) => angle.value(),
        }
    }

    /// Of an angle that was written in radians and is more than a turn, what its writer may have meant.
    pub fn turns(self) -> Option<String> {
        match self {
            WrittenNumber::Real(x) => WrittenCoordinate::number(x).turns_in_ron(),
            WrittenNumber::Whole(_) | WrittenNumber::Degrees(_) => None,
        }
    }

    /// The whole number from 0 on that was written; `None` for another number, and for one that was rounded.
    pub fn whole(self) -> Option<u64> {
        match self {
            WrittenNumber::Real(x) => {
                ((0.0..FIRST_INEXACT as f64).contains(&x) && x.fract() == 0.0).then_some(x as u64)
            }
            WrittenNumber::Whole(n) => Some(n),
            WrittenNumber::Degrees(_) => None,
        }
    }
}

impl Serialize for WrittenNumber {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            WrittenNumber::Real(x) => serializer.serialize_f64(*x),
            WrittenNumber::Whole(n) => serializer.serialize_u64(*n),
            WrittenNumber::Degrees(angle) => angle.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for WrittenNumber {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(WrittenNumberVisitor)
    }
}

struct WrittenNumberVisitor;

impl Visitor<'_> for WrittenNumberVisitor {
    type Value = WrittenNumber;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or degrees in quotes, as \"90deg\"")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<WrittenNumber, E> {
        WrittenCoordinate::deserialize(text.into_deserializer()).map(WrittenNumber::Degrees)
    }

    fn visit_u64<E: Error>(self, n: u64) -> Result<WrittenNumber, E> {
        Ok(if n < FIRST_INEXACT { WrittenNumber::Real(n as f64) } else { WrittenNumber::Whole(n) })
    }

    fn visit_i64<E: Error>(self, n: i64) -> Result<WrittenNumber, E> {
        u64::try_from(n).map_or(Ok(WrittenNumber::Real(n as f64)), |n| self.visit_u64(n))
    }

    fn visit_f64<E: Error>(self, x: f64) -> Result<WrittenNumber, E> {
        Ok(WrittenNumber::Real(x))
    }
}

/// The values of an axis as written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Over {
    /// The whole numbers from the first to the second, without it.
    Range(u64, u64),
    Values(Vec<WrittenNumber>),
    /// This many numbers evenly from the first to the second, both included.
    Steps(WrittenNumber, WrittenNumber, u64),
    /// Drawn uniformly from the first to the second, without it.
    Uniform(WrittenNumber, WrittenNumber),
    /// Names: built-in worlds, or files.
    Names(Vec<String>),
    Starts(Vec<Vec<WrittenCoordinate>>),
    /// Configurations of the goal's robot.
    Goals(Vec<Vec<WrittenCoordinate>>),
    /// The problems of a problem file, which ends in `.ron`, or of a scenario, relative to the study's folder.
    Problems(String),
}

/// The value of an axis in a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum AxisValue {
    Whole(u64),
    /// A number, in the parameter's unit.
    Number(f64),
    Name(String),
    /// The coordinates of a configuration.
    Configuration(Vec<f64>),
    /// A problem of a scenario.
    Problem(NumberedProblem),
    /// A problem of a problem file.
    Filed(FiledProblem),
}

/// A problem of a problem file.
#[derive(Clone, Debug)]
pub(super) struct FiledProblem {
    pub problems: Arc<ProblemSet>,
    /// Its index, from 0.
    pub index: u64,
}

impl PartialEq for FiledProblem {
    fn eq(&self, other: &Self) -> bool {
        self.index == other.index && Arc::ptr_eq(&self.problems, &other.problems)
    }
}

impl FiledProblem {
    /// The problem.
    pub fn made(&self) -> SetProblem {
        let none = || SetProblem { task: Err(format!("no problem has the index {}", self.index)), known: None };
        self.problems.problem(self.index).unwrap_or_else(none)
    }
}

/// A problem of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NumberedProblem {
    /// The scenario's name in the study.
    pub file: String,
    /// Its number in the file, from 1.
    pub number: u64,
    pub scenario: Arc<Scenario>,
    pub problem: ScenarioProblem,
}

/// A problem in a world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlacedProblem {
    pub start: Point2,
    pub goal: Point2,
    /// The length that the file says is the shortest, metres.
    pub optimal: f64,
}

impl NumberedProblem {
    /// Where it lies in a world of these bounds, which the scenario's map fills; else the reason against it.
    pub fn placed(&self, bounds: &Aabb) -> Result<PlacedProblem, String> {
        let NumberedProblem { file, scenario, problem, .. } = self;
        let scale = scenario.metres_per_cell(file, bounds).map_err(|error| error.to_string())?;
        let [start, goal] = [problem.start, problem.goal].map(|cell| {
            let middle = scenario.pose(cell, scale);
            Point2::new(bounds.min.x + middle.x, bounds.min.y + middle.y)
        });
        Ok(PlacedProblem { start, goal, optimal: problem.length * scale })
    }
}

impl Over {
    /// The configurations that are written.
    pub fn configurations(&self) -> &[Vec<WrittenCoordinate>] {
        if let Over::Starts(written) | Over::Goals(written) = self { written } else { &[] }
    }

    /// The numbers that are written, but those of configurations.
    pub fn written(&self) -> impl Iterator<Item = WrittenNumber> {
        let (list, ends) = match self {
            Over::Range(..) | Over::Names(_) | Over::Starts(_) | Over::Goals(_) | Over::Problems(_) => (&[][..], None),
            Over::Values(values) => (&values[..], None),
            Over::Steps(from, to, _) | Over::Uniform(from, to) => (&[][..], Some([*from, *to])),
        };
        list.iter().copied().chain(ends.into_iter().flatten())
    }

    /// The numbers that are written.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let coordinates = self.configurations().iter().flatten().map(|coordinate| coordinate.value());
        self.written().map(WrittenNumber::real).chain(coordinates)
    }

    /// The file of its problems, and whether it is a problem file rather than a scenario.
    pub fn problem_file(&self) -> Option<(&str, bool)> {
        match self {
            Over::Problems(file) => Some((file, file.ends_with(".ron"))),
            _ => None,
        }
    }

    /// Their form, in words.
    pub fn in_words(&self) -> &'static str {
        match self {
            Over::Range(..) => "whole numbers",
            Over::Values(_) | Over::Steps(..) | Over::Uniform(..) => "numbers",
            Over::Names(_) => "names",
            Over::Starts(_) => "start configurations",
            Over::Goals(_) => "goal configurations",
            Over::Problems(_) => "problems",
        }
    }

    /// The number of values; `None` for a range without steps, and for problems, which stand in their file.
    pub fn len(&self) -> Option<u64> {
        match self {
            Over::Range(from, to) => Some(to.saturating_sub(*from)),
            Over::Values(values) => Some(values.len() as u64),
            Over::Steps(_, _, count) => Some(*count),
            Over::Uniform(..) | Over::Problems(_) => None,
            Over::Names(names) => Some(names.len() as u64),
            Over::Starts(_) | Over::Goals(_) => Some(self.configurations().len() as u64),
        }
    }
}
