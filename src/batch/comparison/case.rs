//! `PlanCase`, a problem that planners are compared by.

use motion_lab_core::configuration::AnyConfiguration;

/// Where a path begins and ends.
#[derive(Clone, Copy, Debug)]
pub struct PlanCase {
    /// The start and the goal.
    pub ends: [AnyConfiguration; 2],
    /// The problem of a scenario that it is.
    pub problem: Option<KnownProblem>,
}

/// What is known of a problem of a scenario.
#[derive(Clone, Copy, Debug)]
pub struct KnownProblem {
    /// Its number in the file, from 1.
    pub number: usize,
    /// Its bucket: the file sorts problems by their lengths.
    pub bucket: u64,
    /// The length that the file says is the shortest, metres.
    pub optimal: f64,
}

impl PlanCase {
    /// A path's length as a share of the shortest one that the scenario says; `None` where it says none, or 0.
    pub fn of_optimal(&self, length: f64) -> Option<f64> {
        let optimal = self.problem?.optimal;
        (optimal > 0.0).then(|| length / optimal)
    }
}
