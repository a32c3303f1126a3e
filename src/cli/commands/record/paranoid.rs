//! `--paranoid`: each tick twice, before anything is recorded.

use motion_lab_sim::recording::ParanoidRun;
use motion_lab_sim::run::Recipe;

use crate::cli::support::interrupt;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::{refused, unstarted};
use crate::cli::{Failure, Outcome, say};

/// Runs a recipe with each tick twice. Returns how the command ends where it is not to be recorded.
pub fn check(recipe: &Recipe) -> Result<Option<Outcome>, Failure> {
    let mut run = ParanoidRun::of(recipe, |_| {}).map_err(|error| unstarted(error, recipe))?;
    let progress = CommandProgress::of(recipe.config.ticks, "ticks, each twice");
    for tick in 1..=recipe.config.ticks {
        if interrupt::asked_to_stop() {
            say(format!("stopped before tick {tick} was run twice; nothing was recorded"));
            return Ok(Some(Outcome::Stopped));
        }
        if let Some(found) = run.step().map_err(|error| refused(&error))? {
            say(format!("{found}\nNothing was recorded. Something keeps what no frame holds."));
            return Ok(Some(Outcome::Differs));
        }
        progress.at(tick);
    }
    drop(progress);
    say(format!("{} ticks, each run twice: the same to the last bit", recipe.config.ticks));
    Ok(None)
}
