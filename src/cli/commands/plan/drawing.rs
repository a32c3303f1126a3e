//! The picture of a path and of what its planner has grown.

use crate::capture::{Captured, PlanOutcome, PlanSheet, plan};
use motion_lab_core::cspace::CellMap;
use motion_lab_core::random::Seed;
use motion_lab_sim::plans::{PlanAttempt, PlannerName, Task};

/// The figure of an attempt, of which `without` is said where it has no path, with the configuration space beside the
/// workspace where `cells` has it.
pub fn captured(
    task: &Task,
    planner: PlannerName,
    seed: u64,
    attempt: &dyn PlanAttempt,
    without: PlanOutcome<'_>,
    cells: Option<&CellMap>,
) -> Captured {
    let drawn = attempt.drawn();
    let found = if drawn.path.is_empty() { without } else { PlanOutcome::Path(attempt.lengths()) };
    plan(&PlanSheet { task, planner, seed: Seed(seed), drawn: &drawn, effort: attempt.effort(), found, cells })
}
