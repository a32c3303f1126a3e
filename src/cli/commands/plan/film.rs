//! The film of a planner's growth: workspace and configuration space side by side, iteration after iteration.

use crate::capture::{Paper, PlanOutcome, slides};
use motion_lab_core::collision::Checker;
use motion_lab_core::cspace::{CellMap, Slice};
use motion_lab_core::planning::Progress as Grown;
use motion_lab_core::random::Seed;
use motion_lab_sim::plans::{PlannerName, Task};

use super::drawing::captured;
use super::task::attempt as attempt_by;
use crate::cli::Failure;
use crate::cli::support::paper::not_written;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;

/// The greatest number of pictures.
const PICTURES: u64 = 72;

/// The time that the film takes, hundredths of a second; with few iterations each is shown for half a second.
const TIME: u64 = 600;

/// The level of the finest cells in the background.
const FINEST: u32 = 7;

/// Plans once more, `iterations` long, and writes a picture after every iteration, or after every few of many.
pub fn write(
    task: &Task,
    name: PlannerName,
    seed: u64,
    iterations: u64,
    paper: &Paper,
    target: &Target,
) -> Result<(), Failure> {
    let Ok(mut attempt) = attempt_by(task, name, Seed(seed))? else { return Ok(()) };
    let pictures = iterations.clamp(1, PICTURES);
    let progress = CommandProgress::of(pictures, "pictures");
    let background = background(task);
    let (mut done, mut captures) = (0, Vec::new());
    for picture in 1..=pictures {
        let until = picture * iterations / pictures;
        while done < until && attempt.step() == Grown::Growing {
            done += 1;
        }
        done = until;
        let cells = attempt.cells().or(background.as_ref());
        captures.push(captured(task, name, seed, attempt.as_ref(), PlanOutcome::Growing, cells));
        progress.at(picture);
    }
    drop(progress);
    let hundredths = (TIME / pictures).clamp(4, 50) as u16;
    slides(&captures, hundredths, paper, target.path()).map_err(|error| not_written(target.path(), error))?;
    Ok(())
}

/// The slice of the configuration space through the start, its cells judged; `None` where there is no such slice.
pub fn background(task: &Task) -> Option<CellMap> {
    let checker = Checker::new(task.planned_scene(), task.planned());
    let mut map = CellMap::new(Slice::through(&checker, &task.start).ok()?, FINEST);
    map.refine(u32::MAX);
    Some(map)
}
