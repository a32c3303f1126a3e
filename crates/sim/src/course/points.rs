//! `Points`, what the criteria of an assignment are worth.

use serde::Deserialize;

use super::AssignmentProblem;

/// Largest number of points for a criterion.
const MAX_POINTS: f64 = 1e6;

/// The points for each criterion of an assignment, 0 or more; 0 when left out.
///
/// A criterion earns its points in proportion to the seeds at which it is met. The points for a limit are earned only
/// where the goal is reached, so that a robot that does nothing earns nothing.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// For reaching the goal in time, and staying as long as asked for.
    #[serde(default)]
    pub goal: f64,
    /// For reaching it with at most as many contacts as allowed.
    #[serde(default)]
    pub contacts: f64,
    /// For reaching it with at most as many reversals as allowed.
    #[serde(default)]
    pub reversals: f64,
}

impl Points {
    /// Checks that the points are 0 or more, some of them above, and that each is for something that is limited:
    /// whether contacts and reversals are.
    pub(super) fn check(&self, limited: [bool; 2]) -> Result<(), AssignmentProblem> {
        let Points { goal, contacts, reversals } = *self;
        let all = [goal, contacts, reversals];
        // written so that NaN is refused
        if let Some(wrong) = all.into_iter().find(|points| !(0.0..=MAX_POINTS).contains(points)) {
            return Err(AssignmentProblem::Points(wrong));
        }
        if all == [0.0; 3] {
            return Err(AssignmentProblem::NoPoints);
        }
        let [has_contacts, has_reversals] = limited;
        if contacts > 0.0 && !has_contacts {
            return Err(AssignmentProblem::Unlimited("contacts"));
        }
        if reversals > 0.0 && !has_reversals {
            return Err(AssignmentProblem::Unlimited("reversals"));
        }
        Ok(())
    }
}
