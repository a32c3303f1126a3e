//! `Program`, the lab's program as a value: runs one command and maps its outcome to an exit code. No other file does.

use std::process::ExitCode;

use clap::FromArgMatches;

use super::command_line::{Cli, command_line};
use super::commands::plan::planners;
use super::help::exit;
use super::support::console::{Data, say};
use super::support::end::{Failure, Outcome};
use motion_lab_sim::plans::{OwnPlanner, PlannerError, Planners};

/// The program `motion-lab`, to which a program of one's own may add.
///
/// A planner that is added is one among the lab's: `plan --planner` and `--compare`, GIFs of its growth, studies of
/// `sweep`, the chooser of the widget *Plan*. Whatever the program is called, it calls itself `motion-lab` in examples,
/// in commands to copy and in completions.
///
/// ```no_run
/// use motion_lab::cli::Program;
/// use motion_lab::configuration::Chart;
/// use motion_lab::planning::{Planner, PotentialField};
/// use motion_lab::plans::{LinePlanner, MadePlanner, OwnPlanner, PlannerError};
/// use motion_lab::prelude::*;
///
/// #[derive(Default)]
/// struct Downhill;
///
/// impl LinePlanner for Downhill {
///     fn for_problem<R: Robot<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
///         Ok(Box::new(PotentialField::new(problem))) // or one that implements `Planner`
///     }
/// }
///
/// static DOWNHILL: OwnPlanner =
///     OwnPlanner::new("downhill", "Downhill", "Down the gradient of a field").by_lines::<Downhill>();
///
/// fn main() -> Result<std::process::ExitCode, PlannerError> {
///     Ok(Program::default().with_planner(&DOWNHILL)?.run())
/// }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Program {
    planners: Planners,
}

impl Program {
    /// The program with one planner more.
    ///
    /// # Errors
    /// [`PlannerError`]: it has no name of its own, or is made for no robot.
    pub fn with_planner(mut self, planner: &'static OwnPlanner) -> Result<Self, PlannerError> {
        self.planners.register(planner)?;
        Ok(self)
    }

    /// Reads the command line of this process, runs its command, and returns the exit code. Once in a process: the
    /// planners of the first program count.
    pub fn run(self) -> ExitCode {
        planners::have(self.planners);
        let cli = command_line()
            .try_get_matches()
            .and_then(|given| Cli::from_arg_matches(&given))
            .unwrap_or_else(|error| exit(&error));
        let mut data = Data::stdout();
        let ended = cli.run(&mut data).and_then(|outcome| data.finish().map(|()| outcome));
        ExitCode::from(match ended {
            Ok(Outcome::Done) => 0,
            Ok(Outcome::BadInput) => 3,
            Ok(Outcome::Differs | Outcome::NotPassed | Outcome::NoPath) => 4,
            Ok(Outcome::Recovered) => 5,
            Ok(Outcome::Unreachable) => 7,
            Ok(Outcome::Stopped) => 75,
            Err(failure) => {
                say(&failure);
                match failure {
                    Failure::Internal(_) | Failure::Output { .. } => 1,
                    Failure::Usage { .. } => 2,
                    Failure::Input { .. } => 3,
                    Failure::NoDisplay(_) => 6,
                }
            }
        })
    }
}
