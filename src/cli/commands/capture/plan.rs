//! The figure of the widget Plan: a task, and what a planner makes of it.

use crate::capture::{CaptureForm, Paper, PlanOutcome};
use motion_lab_core::random::Seed;
use motion_lab_sim::plans::{PlannerName, Task};
use motion_lab_sim::tour::BOOK_SEED;

use super::args::{Capture, SceneArgs};
use crate::cli::commands::plan::{drawing, film, solve, task};
use crate::cli::support::paper::write_picture;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::{Failure, Outcome};

impl Capture {
    /// Plans, and writes the path with what the planner has grown, or as GIF how it grows.
    pub(super) fn of_plan(&self, form: CaptureForm, paper: &Paper, target: &Target) -> Result<Outcome, Failure> {
        let task = asked(&self.scene)?;
        let name = self.scene.planner.unwrap_or(PlannerName::default_for(&task.robot));
        let seed = self.run.seed.unwrap_or(BOOK_SEED.0);
        let no_problem = |reason| Failure::usage(reason, "Change --q or --goal.");
        let mut attempt = task::attempt(&task, name, Seed(seed))?.map_err(no_problem)?;
        let progress = CommandProgress::uncounted("iterations");
        let solved = solve(attempt.as_mut(), name, None, |done| progress.at(done));
        drop(progress);
        if solved.is_none() {
            return Ok(Outcome::Stopped);
        }
        if form == CaptureForm::Gif {
            film::write(&task, name, seed, attempt.effort().iterations, paper, target)?;
        } else {
            let background = film::background(&task);
            let cells = attempt.cells().or(background.as_ref());
            let captured = drawing::captured(&task, name, seed, attempt.as_ref(), PlanOutcome::None, cells);
            write_picture(&captured, paper, form, target)?;
        }
        Ok(Outcome::Done)
    }
}

/// The task of these arguments: the chapter's where they say nothing.
fn asked(scene: &SceneArgs) -> Result<Task, Failure> {
    let SceneArgs { robot, world, q, goal, .. } = scene;
    let Some(goal) = goal else {
        return match robot.is_some() || world.is_some() || q.is_some() {
            true => Err(Failure::usage("where the path is to end is not said", "Say it with --goal.")),
            false => Ok(Task::round_the_post()),
        };
    };
    task::find(robot.as_deref().unwrap_or("Reach"), world.as_deref(), q.as_ref(), goal, motion_lab_sim::plans::TUBE)
}
