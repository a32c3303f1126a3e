//! The picture of a path and of what its planner has grown.

use std::path::Path;

use motion_lab::capture::{CaptureForm, Captured, Paper, PlanOutcome, PlanSheet, plan};
use motion_lab::cspace::CellMap;
use motion_lab::plans::{PlanAttempt, PlannerName, Task};
use motion_lab::random::Seed;

use crate::cli::Failure;
use crate::cli::support::paper::write_picture;
use crate::cli::support::target::Target;

/// Draws the workspace with the growth, the path and the robot along it, and writes it as SVG, or as PNG by its name.
pub fn write(
    task: &Task,
    planner: PlannerName,
    seed: u64,
    attempt: &dyn PlanAttempt,
    paper: &Paper,
    output: &Path,
) -> Result<(), Failure> {
    let target = Target::file(output)?;
    let form = if CaptureForm::of(output) == Some(CaptureForm::Png) { CaptureForm::Png } else { CaptureForm::Svg };
    let captured = captured(task, planner, seed, attempt, PlanOutcome::None, None);
    write_picture(&captured, paper, form, target.path())?;
    target.wrote();
    Ok(())
}

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
