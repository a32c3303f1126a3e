//! Grading: checks a submission against an instructor's [`Assignment`] by running it.
//!
//! A submission is a script, or a log, which holds a script. The script is run at every seed of the assignment. A log's
//! frames are not trusted: its run is simulated again, and a log whose frames differ is refused as forged.
//!
//! A robot that the script does not drive stands; it tours in no assignment. Other robots of the world that follow a
//! route go on. Teleports and changes of the world are refused, and so is dropping or taking a trailer unless the
//! assignment says `set_trailer: true`.
//!
//! ```
//! use motion_lab_sim::course::{AssignmentFile, Submission};
//! use motion_lab_sim::run::Script;
//! use motion_lab_core::worlds::World;
//!
//! let text = r#"Assignment(
//!     version: 1,
//!     world: "lot",                                     // a built-in world, or a world file
//!     robot: "Hitch",
//!     start: [6.5, 2.5, 0],                             // left out: where the world has it
//!     goal: (at: [7.5, 2.5, 0], within: [0.1, 0.1, 0.1]),
//!     stay: (hold: 20, at: end),                        // left out: once there, however shortly, it has passed
//!     limits: (ticks: 200, contacts: 0, reversals: 0),  // the last two may be left out
//!     points: (goal: 6, contacts: 2, reversals: 2),     // left out: 1 point for passing
//!     set_trailer: false,                               // left out: the same, no trailer is dropped or taken
//!     seeds: "0..10",                                   // or a list: [1, 2005]
//! )"#;
//! let file = AssignmentFile::parse("forward.ron", text)?;
//! let assignment = file.in_world(World::lot())?;
//! let script = Script::parse("mine.ron", r#"Script(version: 1, events: [
//!     (tick: 1, robot: "Hitch", input: Drive(128, 0)),
//!     (tick: 14, robot: "Hitch", input: Drive(0, 0)),
//! ])"#)?;
//! let grade = assignment.grade(&Submission::Script(script));
//! assert!(grade.passed(), "{grade:?}");
//! assert_eq!((grade.score.points, grade.score.of), (10.0, 10.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod added_kinds;
mod assignment;
mod assignment_text;
mod attempt;
mod error;
mod points;
mod score;
mod seeds;
mod stay;

pub use assignment::{Assignment, AssignmentFile};
pub use assignment_text::{Goal, Limits};
pub use attempt::{Attempt, AttemptOutcome, GoalDistance, Met};
pub use error::{AssignmentError, AssignmentProblem, MAX_SEEDS};
pub use points::Points;
pub use score::{Criterion, Score};
pub use stay::{Stay, When};

use crate::recording::RunError;
use crate::run::{Difference, Log, RobotInput, Script, ScriptError};

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
    /// The script drops or takes a trailer, which the assignment does not allow.
    #[error(
        "events[{0}]: SetTrailer is not allowed: it puts a trailer straight behind its car, wherever that was; \
         the assignment would have to say set_trailer: true"
    )]
    Trailer(usize),
    /// The run of a log, or of an assignment, cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The log was recorded in another world, or from another start.
    #[error("the log was recorded in another world, or from another start")]
    OtherWorld,
    /// The log differs from the run of its seed, configuration and script.
    #[error("forged at {0}")]
    Forged(Box<Difference>),
}

/// The result of a submission.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Grade {
    /// Why it was not graded; `None` when it was.
    pub refusal: Option<Refusal>,
    /// One attempt for each of the assignment's seeds, in order; empty when it was refused.
    pub attempts: Vec<Attempt>,
    /// Its points; none of them when it was refused.
    pub score: Score,
}

impl Grade {
    /// Whether the submission does what the assignment asks for, at every seed.
    pub fn passed(&self) -> bool {
        self.refusal.is_none() && self.attempts.iter().all(Attempt::passed)
    }
}

impl Assignment {
    /// Grades a submission: the same grade on every machine. Kinds of robots that the assignment does not know are
    /// refused: [`AssignmentFile::in_world_with_robots`] makes one that knows a program's own.
    pub fn grade(&self, submission: &Submission) -> Grade {
        self.grade_watched(submission, |_, _| {})
    }

    /// [`grade`](Self::grade), which calls `on_tick` after each tick with the number of the attempt, from 0, and the
    /// tick.
    pub fn grade_watched(&self, submission: &Submission, mut on_tick: impl FnMut(usize, u64)) -> Grade {
        let all = self.grade_while(submission, |attempt, tick| {
            on_tick(attempt, tick);
            true
        });
        // nothing stops it
        all.unwrap_or_else(|| self.graded(Ok(Vec::new())))
    }

    /// [`grade`](Self::grade), which asks after each tick, by the number of the attempt, from 0, and the tick, whether
    /// to go on; `None` once it is not to. A log is simulated again before, without asking.
    pub fn grade_while(&self, submission: &Submission, mut goes_on: impl FnMut(usize, u64) -> bool) -> Option<Grade> {
        let script = match submission {
            Submission::Script(script) => script,
            Submission::Log(log) => &log.recipe.script,
        };
        let mut attempts = Vec::new();
        if let Err(refusal) = self.accept(submission) {
            return Some(self.graded(Err(refusal)));
        }
        for (i, &seed) in self.seeds().iter().enumerate() {
            match Attempt::run(self, seed, script, |tick| goes_on(i, tick)) {
                Ok(attempt) => attempts.push(attempt?),
                Err(reason) => return Some(self.graded(Err(reason.into()))),
            }
        }
        Some(self.graded(Ok(attempts)))
    }

    fn graded(&self, attempts: Result<Vec<Attempt>, Refusal>) -> Grade {
        let (refusal, attempts) = match attempts {
            Ok(attempts) => (None, attempts),
            Err(refusal) => (Some(refusal), Vec::new()),
        };
        let score = self.score(&attempts);
        Grade { refusal, attempts, score }
    }

    /// The points of a submission with these attempts; without any, of one that could not be graded.
    pub fn score(&self, attempts: &[Attempt]) -> Score {
        Score::of(self.points(), attempts, self.seeds().len())
    }

    fn accept(&self, submission: &Submission) -> Result<(), Refusal> {
        let script = match submission {
            Submission::Script(script) => script,
            Submission::Log(log) => {
                // the log's frames are not trusted: its run is simulated again
                if let Some(difference) = self.verify(log)?.difference {
                    return Err(Refusal::Forged(Box::new(difference)));
                }
                let hash = self.world().content_hash();
                if !log.recipe.config.worlds.iter().any(|world| world.content_hash() == hash) {
                    return Err(Refusal::OtherWorld);
                }
                &log.recipe.script
            }
        };
        script.check()?;
        let names: Vec<&str> = self.world().robots.iter().map(|robot| robot.name.as_str()).collect();
        script.check_robots(&names)?;
        if !script.changes.is_empty() {
            return Err(Refusal::Change);
        }
        if let Some(event) = script.events.iter().position(|event| matches!(event.input, RobotInput::Teleport(_))) {
            return Err(Refusal::Teleport(event));
        }
        match script.events.iter().position(|event| matches!(event.input, RobotInput::SetTrailer(_))) {
            Some(event) if !self.may_set_trailer() => Err(Refusal::Trailer(event)),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::worlds::World;

    #[test]
    fn grading_goes_on_as_long_as_it_is_told_to() {
        let text = r#"Assignment(version: 1, world: "lot", robot: "Hitch", goal: (at: [7.5, 2.5, 0],
            within: [0.1, 0.1, 0.1]), limits: (ticks: 20), seeds: "0..3")"#;
        let assignment = AssignmentFile::parse("exam.ron", text).unwrap().in_world(World::lot()).unwrap();
        let stands = Submission::Script(Script::empty());
        let mut asked = Vec::new();
        let stopped = assignment.grade_while(&stands, |attempt, tick| {
            asked.push((attempt, tick));
            (attempt, tick) != (1, 7)
        });
        assert_eq!(stopped, None);
        let first = (1..=20).map(|tick| (0, tick));
        assert_eq!(asked, first.chain((1..=7).map(|tick| (1, tick))).collect::<Vec<_>>());
        let mut count = 0;
        let whole = assignment.grade_watched(&stands, |_, _| count += 1);
        assert_eq!((count, whole.attempts.len()), (60, 3));
        assert_eq!(assignment.grade_while(&stands, |_, _| true), Some(whole.clone()));
        assert_eq!(assignment.grade(&stands), whole);
    }
}
