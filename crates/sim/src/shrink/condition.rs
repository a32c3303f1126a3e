//! `Condition`, what a run has to show.

use super::condition_error::{ConditionError, ConditionProblem};
use super::reading::RunReading;
use crate::recording::RunError;
use crate::run::{Digest, Recipe, StatsColumn};
use crate::tour::TourConfig;
use motion_lab_core::names::nearest;

/// What a run has to show: comparisons of the [stats](StatsColumn) of its robots, and of its digest, joined by `&&` and
/// `||`, of which `&&` binds closer.
///
/// A comparison of a robot that the run does not have, or of a number that is not known, is not met.
///
/// ```
/// use motion_lab_core::random::Seed;
/// use motion_lab_sim::run::Recipe;
/// use motion_lab_sim::shrink::Condition;
/// use motion_lab_sim::tour::TourConfig;
/// let recipe = Recipe::new(TourConfig { ticks: 40, ..TourConfig::default() }, Seed(7));
/// let met = |text: &str| Condition::parse(text).unwrap().holds(&recipe);
/// assert!(met("Rusty.contacts == 0 && Hitch.path_m > 0.1 || Reach.refusals > 0"));
/// assert!(!met("Rusty.contacts != 0") && !met("Robby.contacts == 0") && !met("Robby.contacts != 0"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// One of these has to be met, each of which is met with all of its comparisons.
    pub(super) any: Vec<Vec<Requirement>>,
}

/// How a number is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `<=`
    AtMost,
    /// `>=`
    AtLeast,
    /// `==`
    Equal,
    /// `!=`
    Unequal,
    /// `<`
    Below,
    /// `>`
    Above,
}

/// A comparison, and the character of the text at which it begins, from 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Requirement {
    pub(super) at: usize,
    pub(super) of: Compared,
}

/// What is compared with what.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Compared {
    Robot { name: String, column: StatsColumn, relation: Relation, number: f64 },
    Digest { is_equal: bool, digest: Digest },
}

impl Relation {
    /// The relations as they are written; of two that begin alike, the longer one first.
    pub(super) const WRITTEN: [(&str, Relation); 6] = [
        ("<=", Relation::AtMost),
        (">=", Relation::AtLeast),
        ("==", Relation::Equal),
        ("!=", Relation::Unequal),
        ("<", Relation::Below),
        (">", Relation::Above),
    ];

    /// Whether the first number has this relation to the second.
    pub fn holds(self, first: f64, second: f64) -> bool {
        match self {
            Relation::AtMost => first <= second,
            Relation::AtLeast => first >= second,
            Relation::Equal => first == second,
            Relation::Unequal => first != second,
            Relation::Below => first < second,
            Relation::Above => first > second,
        }
    }
}

impl Condition {
    /// Checks that a run of this configuration has the robots of the condition.
    ///
    /// # Errors
    /// [`ConditionError`] names the first that it does not have, and where the condition names it.
    pub fn check_for(&self, config: &TourConfig) -> Result<(), ConditionError> {
        for Requirement { at, of } in self.any.iter().flatten() {
            if let Compared::Robot { name, .. } = of
                && !config.robot_names().any(|known| known == name)
            {
                let meant = nearest(name, config.robot_names()).map(str::to_owned);
                return Err(ConditionProblem::Robot { name: name.clone(), meant }.at(*at));
            }
        }
        Ok(())
    }

    /// Simulates a run and reads what the condition is about. Asks `go_on` after each tick; `None` once it says no.
    ///
    /// # Errors
    /// [`RunError`] when the run cannot start.
    pub fn read(&self, recipe: &Recipe, go_on: impl FnMut() -> bool) -> Result<Option<RunReading>, RunError> {
        let compared = || self.any.iter().flatten().map(|requirement| &requirement.of);
        let clearance = |of: &Compared| matches!(of, Compared::Robot { column, .. } if column.needs_clearance());
        let digest = |of: &Compared| matches!(of, Compared::Digest { .. });
        RunReading::of(recipe, compared().any(clearance), compared().any(digest), go_on)
    }

    /// Whether the condition is met by what was read of a run.
    pub fn is_met(&self, reading: &RunReading) -> bool {
        self.any.iter().any(|all| all.iter().all(|requirement| requirement.of.is_met(reading)))
    }

    /// Whether a recipe's run meets the condition; false for one that cannot start.
    pub fn holds(&self, recipe: &Recipe) -> bool {
        matches!(self.read(recipe, || true), Ok(Some(reading)) if self.is_met(&reading))
    }

    /// What was read for each comparison that is not met: `Hitch.contacts is 0`.
    pub fn unmet(&self, reading: &RunReading) -> Vec<String> {
        let compared = self.any.iter().flatten().map(|requirement| &requirement.of);
        compared.filter(|of| !of.is_met(reading)).map(|of| of.found(reading)).collect()
    }
}

impl Compared {
    fn is_met(&self, reading: &RunReading) -> bool {
        match self {
            Compared::Robot { name, column, relation, number } => {
                let found = reading.robot(name).and_then(|robot| column.number(robot));
                found.is_some_and(|found| relation.holds(found.value(), *number))
            }
            Compared::Digest { is_equal, digest } => {
                reading.digest.is_some_and(|found| (found == *digest) == *is_equal)
            }
        }
    }

    /// What was read, in words.
    fn found(&self, reading: &RunReading) -> String {
        match self {
            Compared::Robot { name, column, .. } => match reading.robot(name).map(|robot| column.number(robot)) {
                Some(Some(found)) => format!("{name}.{} is {found}", column.name),
                Some(None) => format!("{name}.{} is not known", column.name),
                None => format!("there is no robot {name:?}"),
            },
            Compared::Digest { .. } => match reading.digest {
                Some(found) => format!("the digest is {found}"),
                None => "the digest is not known".to_owned(),
            },
        }
    }
}

#[cfg(test)]
mod tests;
