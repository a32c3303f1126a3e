//! `Progress`, what an iteration of a planner came to.

use super::NoPath;

/// What an iteration came to.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// There is no path yet, and further iterations may find one.
    Growing,
    /// There is a path. Further iterations improve it if the planner is one that goes on; otherwise they do nothing.
    Solved,
    /// There will be no path: further iterations do nothing.
    Ended(NoPath),
}
