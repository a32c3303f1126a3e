//! Grading: checks a submission against an instructor's [`Assignment`] by running it.
//!
//! A submission is a script, or a log, which holds a script. The script is run at every seed of the assignment. A log's
//! frames are not trusted: its run is simulated again, and a log whose frames differ is refused as forged.
//!
//! ```
//! use motion_lab::recording::{AssignmentFile, Submission, Verdict};
//! use motion_lab::run::Script;
//! use motion_lab::worlds::World;
//!
//! let text = r#"Assignment(
//!     version: 1,
//!     world: "lot",                                     // a built-in world, or a world file
//!     robot: "Hitch",
//!     start: [6.5, 2.5, 0],                             // left out: where the world has it
//!     goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1], ticks: 1),
//!     limits: (ticks: 200, contacts: 0, reversals: 0),  // the last two may be left out
//!     seeds: [1, 2005],
//! )"#;
//! let file = AssignmentFile::parse("forward.ron", text)?;
//! let assignment = file.in_world(World::lot())?;
//! let script = Script::parse("mine.ron", r#"Script(version: 1, events: [
//!     (tick: 1, robot: "Hitch", input: Drive(128, 0)),
//! ])"#)?;
//! let grade = assignment.grade(&Submission::Script(script));
//! assert!(grade.passed(), "{grade:?}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod added_kinds;
mod assignment;
mod attempt;
mod error;

pub use assignment::{Assignment, AssignmentFile, Goal, Limits};
pub use attempt::{Attempt, Verdict};
pub use error::{AssignmentError, AssignmentProblem, MAX_SEEDS};

use super::RunError;
use crate::run::{Divergence, Log, RobotInput, Script, ScriptError};

/// The work handed in.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Submission {
    /// A script.
    Script(Script),
    /// A recorded run.
    Log(Box<Log>),
}

/// Why a submission cannot be graded at all.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The script is invalid, or names a robot that the world does not have.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The script changes a world, which assignments do not allow.
    #[error("changes[0]: a change of a world is not allowed")]
    Change,
    /// The script contains a teleport, which assignments do not allow.
    #[error("events[{0}]: a teleport is not allowed")]
    Teleport(usize),
    /// The run of a log, or of an assignment, cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The log was recorded in another world, or from another start.
    #[error("the log was recorded in another world, or from another start")]
    OtherWorld,
    /// A frame of the log differs from the run of its seed, configuration and script.
    #[error("forged at {0}")]
    Forged(Box<Divergence>),
}

/// The result of a submission.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Grade {
    /// Why it was not graded; `None` when it was.
    pub refusal: Option<Refusal>,
    /// One attempt for each of the assignment's seeds, in order; empty when it was refused.
    pub attempts: Vec<Attempt>,
}

impl Grade {
    /// Whether the submission does what the assignment asks for, at every seed.
    pub fn passed(&self) -> bool {
        self.refusal.is_none() && self.attempts.iter().all(|attempt| attempt.verdict == Verdict::Passed)
    }
}

impl Assignment {
    /// Grades a submission: the same grade on every machine. Kinds of robots that the assignment does not know are
    /// refused: [`AssignmentFile::in_world_with_robots`] makes one that knows a program's own.
    pub fn grade(&self, submission: &Submission) -> Grade {
        let script = match submission {
            Submission::Script(script) => script,
            Submission::Log(log) => &log.script,
        };
        let attempts = self.accept(submission).and_then(|()| {
            self.seeds().iter().map(|&seed| Ok(Attempt::run(self, seed, script)?)).collect::<Result<Vec<_>, Refusal>>()
        });
        match attempts {
            Ok(attempts) => Grade { refusal: None, attempts },
            Err(refusal) => Grade { refusal: Some(refusal), attempts: Vec::new() },
        }
    }

    fn accept(&self, submission: &Submission) -> Result<(), Refusal> {
        let script = match submission {
            Submission::Script(script) => script,
            Submission::Log(log) => {
                if let Some(divergence) = self.forgery(log)? {
                    return Err(Refusal::Forged(Box::new(divergence)));
                }
                let hash = self.world().content_hash();
                if !log.config.worlds.iter().any(|world| world.content_hash() == hash) {
                    return Err(Refusal::OtherWorld);
                }
                &log.script
            }
        };
        script.check()?;
        let names: Vec<&str> = self.world().robots.iter().map(|robot| robot.name.as_str()).collect();
        script.check_robots(&names)?;
        if !script.changes.is_empty() {
            return Err(Refusal::Change);
        }
        match script.events.iter().position(|event| matches!(event.input, RobotInput::Teleport(_))) {
            Some(event) => Err(Refusal::Teleport(event)),
            None => Ok(()),
        }
    }

    /// The first value in a log's frames that differs from the run of its seed, configuration and script: `found` in
    /// the log, `expected` by the run.
    fn forgery(&self, log: &Log) -> Result<Option<Divergence>, RunError> {
        let divergence = self.verify(log)?.divergence;
        Ok(divergence.map(|d| Divergence { expected: d.found, found: d.expected, ..d }))
    }
}
