//! The picture of a path and of what its planner has grown.

use std::path::Path;

use motion_lab::capture::{Captured, Form, Paper, PlanSheet, plan};
use motion_lab::cspace::CellMap;
use motion_lab::plans::{Attempt, Drawn, PlannerName, Task};
use motion_lab::random::Seed;

use crate::cli::Failure;
use crate::cli::support::paper::write_picture;
use crate::cli::support::target::Target;

/// Draws the workspace with the growth, the path and the robot along it, and writes it as SVG, or as PNG by its name.
pub fn write(
    task: &Task,
    planner: PlannerName,
    seed: u64,
    attempt: &dyn Attempt,
    paper: &Paper,
    output: &Path,
) -> Result<(), Failure> {
    let target = Target::file(output)?;
    let form = if Form::of(output) == Some(Form::Png) { Form::Png } else { Form::Svg };
    let captured = captured(task, planner, seed, attempt, &attempt.drawn(), None);
    write_picture(&captured, paper, form, target.path())?;
    target.wrote();
    Ok(())
}

/// The figure of an attempt, with the configuration space beside the workspace where `cells` has it.
pub fn captured(
    task: &Task,
    planner: PlannerName,
    seed: u64,
    attempt: &dyn Attempt,
    drawn: &Drawn,
    cells: Option<&CellMap>,
) -> Captured {
    let lengths = (!drawn.path.is_empty()).then(|| attempt.lengths());
    plan(&PlanSheet { task, planner, seed: Seed(seed), drawn, effort: attempt.effort(), lengths, cells })
}
