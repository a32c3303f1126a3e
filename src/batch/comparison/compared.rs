//! What is compared, and what came of it.

use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use motion_lab_core::planning::{Effort, NoPath};
use motion_lab_core::random::Seed;
use motion_lab_sim::plans::{PathLengths, PlanAttempt, PlannerName, Task, solve_in_rounds};

use super::case::{AskedPath, PlanCase};
use crate::batch::failure_kind::{FailureKind, RunFailure};
use crate::batch::problem_set::{ProblemSet, SetProblem};

/// What is compared: every planner works on every problem, from every seed.
#[derive(Clone, Debug)]
pub struct PlannerComparison {
    problems: ProblemSet,
    /// The planners.
    pub planners: Vec<PlannerName>,
    /// The seeds of the planners' samples.
    pub seeds: Range<u64>,
    /// The greatest number of iterations, up to which a planner that can shortens its path; without it, its usual
    /// number, and the first path is taken.
    pub iterations: Option<u64>,
}

/// Problems of several kinds of robot, whose planners and units are not the same.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the problems are for several kinds of robot: {}", .0.join(", "))]
pub struct MixedKinds(pub Vec<&'static str>);

/// The length of the best path after some iterations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathCost {
    /// The number of iterations.
    pub iterations: u64,
    /// The length, in the unit of [`PathLengths`].
    pub length: f64,
}

/// What came of one planner by one problem from one seed.
#[derive(Clone, Debug)]
pub struct ComparedAttempt {
    /// The problem.
    pub case: Arc<PlanCase>,
    /// The planner.
    pub planner: PlannerName,
    /// The seed.
    pub seed: Seed,
    /// What the planner did.
    pub effort: Effort,
    /// How long it took, seconds; this differs from run to run.
    pub seconds: f64,
    /// The clearance that was asked of the path, metres: what the task says, or what is usual for the planner, which
    /// may keep more by itself; `None` where there is no problem. Attempts that were asked for another are not
    /// compared alike.
    pub clearance_asked: Option<f64>,
    /// Length and clearance of the path, or why there is none.
    pub path: Result<PathLengths, RunFailure>,
    /// The first path's length, and that of each shorter one, at every 500th iteration and at the end.
    pub costs: Vec<PathCost>,
}

/// There is nothing to be planned: the start or the goal is in contact, outside, or none of the robot's.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}")]
pub struct NoProblem {
    /// The planner that met it first.
    pub planner: PlannerName,
    /// Its seed.
    pub seed: Seed,
    /// What is wrong.
    pub reason: NoPath,
}

impl PlannerComparison {
    /// Planners by a task's own problem.
    pub fn of(task: Task, planners: Vec<PlannerName>, seeds: Range<u64>) -> Self {
        PlannerComparison { problems: ProblemSet::of_task(task), planners, seeds, iterations: None }
    }

    /// Planners by the problems of a file, which are for robots of one kind.
    ///
    /// # Errors
    /// [`MixedKinds`]: they are not. [`ProblemSet::of_robot`] has those of one.
    pub fn of_problems(
        problems: ProblemSet,
        planners: Vec<PlannerName>,
        seeds: Range<u64>,
    ) -> Result<Self, MixedKinds> {
        match problems.kinds()[..] {
            [] | [_] => Ok(PlannerComparison { problems, planners, seeds, iterations: None }),
            ref kinds => Err(MixedKinds(kinds.iter().map(|kind| kind.name).collect())),
        }
    }

    /// The problems.
    pub fn problems(&self) -> &ProblemSet {
        &self.problems
    }

    /// The unit of the paths' lengths.
    pub fn unit(&self) -> &'static str {
        self.problems.kinds().first().map_or("m", |kind| kind.unit_of(0))
    }

    /// The number of attempts.
    pub fn count(&self) -> u64 {
        let seeds = self.seeds.end.saturating_sub(self.seeds.start);
        seeds.saturating_mul(self.planners.len() as u64).saturating_mul(self.problems.len())
    }

    /// Makes all attempts, one after the other: by planner, problem and seed. Before each, and after every few
    /// iterations, `goes_on` gets the number of those that are done, and says whether to go on. Fewer than
    /// [`count`](Self::count) are those until it did not.
    ///
    /// # Errors
    /// [`NoProblem`]: the problem is none, which is so for every planner and every seed. A file's problem that is none
    /// has attempts without a path instead.
    pub fn run(&self, mut goes_on: impl FnMut(u64) -> bool) -> Result<Vec<ComparedAttempt>, NoProblem> {
        let mut done = Vec::new();
        for &planner in &self.planners {
            for SetProblem { task, known } in (0..self.problems.len()).map_while(|index| self.problems.problem(index)) {
                let case = Arc::new(PlanCase { known, asked: task.as_ref().ok().map(AskedPath::of) });
                for seed in self.seeds.clone() {
                    let count = done.len() as u64;
                    let goes_on = || goes_on(count);
                    let Some(attempt) = self.attempt(&task, &case, (planner, Seed(seed)), goes_on)? else {
                        return Ok(done);
                    };
                    done.push(attempt);
                }
            }
        }
        Ok(done)
    }

    /// An attempt, or why there is no problem. `None` where it is not to go on.
    fn attempt(
        &self,
        task: &Result<Task, String>,
        case: &Arc<PlanCase>,
        (planner, seed): (PlannerName, Seed),
        mut goes_on: impl FnMut() -> bool,
    ) -> Result<Option<ComparedAttempt>, NoProblem> {
        if !goes_on() {
            return Ok(None);
        }
        let begun = Instant::now();
        let none = |failure: RunFailure| ComparedAttempt {
            case: Arc::clone(case),
            planner,
            seed,
            effort: Effort::default(),
            seconds: 0.0,
            clearance_asked: task.as_ref().ok().map(|task| clearance_asked(task, planner)),
            path: Err(failure),
            costs: Vec::new(),
        };
        let task = match task {
            Ok(task) => task,
            Err(reason) => return Ok(Some(none(RunFailure::new(FailureKind::Setup, reason.as_str())))),
        };
        let mut attempt = match task.attempt(planner, seed) {
            Ok(attempt) => attempt,
            Err(reason @ NoPath::Problem(_)) if case.known.is_none() => {
                return Err(NoProblem { planner, seed, reason });
            }
            Err(reason) => return Ok(Some(none(reason.into()))),
        };
        let mut costs = Vec::new();
        let solved = solve_in_rounds(attempt.as_mut(), planner, self.iterations, |attempt| {
            see_cost(attempt, &mut costs);
            goes_on()
        });
        let Some(solved) = solved else { return Ok(None) };
        let seconds = begun.elapsed().as_secs_f64();
        see_cost(attempt.as_ref(), &mut costs);
        let path = solved.map(|()| attempt.lengths()).map_err(RunFailure::from);
        let unknown = RunFailure::new(FailureKind::NoPath, "");
        Ok(Some(ComparedAttempt { effort: attempt.effort(), seconds, path, costs, ..none(unknown) }))
    }

    /// The number of a planner's attempts that had a path by a number of iterations.
    pub fn solved_within(attempts: &[ComparedAttempt], planner: PlannerName, iterations: u64) -> usize {
        let own = attempts.iter().filter(|attempt| attempt.planner == planner);
        own.filter(|attempt| attempt.costs.first().is_some_and(|first| first.iterations <= iterations)).count()
    }
}

/// The clearance that is asked of a planner's path, metres: who walks by a sensor keeps none.
fn clearance_asked(task: &Task, planner: PlannerName) -> f64 {
    let usual = || task.usual_clearance(planner.draws_samples());
    if planner == PlannerName::Bug1Sensor { 0.0 } else { task.clearance.unwrap_or_else(usual) }
}

/// Notes the length of the best path, where it is the first or shorter than the last.
fn see_cost(attempt: &dyn PlanAttempt, costs: &mut Vec<PathCost>) {
    let cost = PathCost { iterations: attempt.effort().iterations, length: attempt.lengths().length };
    if attempt.has_path() && costs.last().is_none_or(|last| cost.length < last.length) {
        costs.push(cost);
    }
}
