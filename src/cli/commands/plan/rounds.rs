//! Working on a path until somebody asks to stop.

use motion_lab_core::planning::NoPath;
use motion_lab_sim::plans::{PlanAttempt, PlannerName, solve_in_rounds};

use crate::cli::support::interrupt;

/// [Works on a path](solve_in_rounds); `see` gets the number of iterations after each round. `None` where somebody
/// asked to stop.
pub fn solve(
    attempt: &mut dyn PlanAttempt,
    planner: PlannerName,
    given: Option<u64>,
    mut see: impl FnMut(u64),
) -> Option<Result<(), NoPath>> {
    solve_in_rounds(attempt, planner, given, |attempt| {
        see(attempt.effort().iterations);
        !interrupt::asked_to_stop()
    })
}
