//! `Shown`, what a run has to show: a condition, a command's exit code, or both.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use motion_lab_sim::run::Recipe;
use motion_lab_sim::shrink::Condition;

use super::exec::ExitCheck;
use crate::cli::Failure;
use crate::cli::support::input::shown;
use crate::cli::support::interrupt;
use crate::cli::support::simulate::begin;

/// What a run has to show.
pub struct Shown<'a> {
    condition: Option<&'a Condition>,
    command: Option<ExitCheck>,
    /// The first failure, after which nothing is tried any more.
    failed: Mutex<Option<Failure>>,
}

impl<'a> Shown<'a> {
    /// What a condition, a command or both ask for.
    pub fn new(condition: Option<&'a Condition>, command: Option<ExitCheck>) -> Self {
        Shown { condition, command, failed: Mutex::new(None) }
    }

    /// Whether a candidate shows it.
    pub fn holds(&self, recipe: &Recipe) -> bool {
        let is_met = |condition: &Condition| {
            let reading = condition.read(recipe, || !interrupt::asked_to_stop());
            matches!(reading, Ok(Some(reading)) if condition.is_met(&reading))
        };
        if !self.condition.is_none_or(is_met) {
            return false;
        }
        let Some(command) = &self.command else { return true };
        command.holds(recipe).unwrap_or_else(|failure| {
            self.failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(failure);
            false
        })
    }

    /// Whether to go on: nobody asked to stop, and nothing has failed.
    pub fn goes_on(&self) -> bool {
        !interrupt::asked_to_stop() && self.failed.lock().unwrap_or_else(PoisonError::into_inner).is_none()
    }

    /// The failure, if there was one.
    pub fn failure(&self) -> Result<(), Failure> {
        self.failed.lock().unwrap_or_else(PoisonError::into_inner).take().map_or(Ok(()), Err)
    }

    /// Checks that the run itself shows it. False where somebody asked to stop.
    pub fn check(&self, file: &Path, recipe: &Recipe) -> Result<bool, Failure> {
        begin(recipe)?;
        let not_shown = |found: String, next: &str| {
            let reason = format!("{}: the run itself does not show it: {found}", shown(file));
            Failure::input(reason, next)
        };
        if let Some(condition) = self.condition {
            condition.check_for(&recipe.config).map_err(|error| {
                let robots: Vec<&str> = recipe.config.robot_names().take(20).collect();
                let next = match robots.join(", ") {
                    none if none.is_empty() => "The run has no robots; ask for its digest, or --exec.".to_owned(),
                    robots => format!("The robots there are {robots}."),
                };
                Failure::usage(format!("--while: {error}"), next)
            })?;
            let read = condition.read(recipe, || !interrupt::asked_to_stop()).map_err(Failure::internal)?;
            let Some(reading) = read else { return Ok(false) };
            if !condition.is_met(&reading) {
                return Err(not_shown(
                    condition.unmet(&reading).join(", "),
                    "Say what it does show; `motion-lab stats` counts it.",
                ));
            }
        }
        match self.command.as_ref().map(|command| command.refusal(recipe)).transpose()?.flatten() {
            Some(_) if interrupt::asked_to_stop() => Ok(false),
            Some(found) => {
                Err(not_shown(found, "Correct the command, or say by --exit which code it has where a run shows it."))
            }
            None => Ok(true),
        }
    }
}
