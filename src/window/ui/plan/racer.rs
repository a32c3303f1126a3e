//! `Racer`, a planner in the race, and how far it has come.

use super::work::PlannerWork;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::planning::{Bound, Effort, NoPath, Progress};
use motion_lab_core::random::Seed;
use motion_lab_sim::plans::{JudgedPath, PathLengths, PlannerName, Task};

/// How far a planner has come.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanStage {
    /// It has not begun, or has no path yet.
    Growing,
    Solved,
    /// There is no path, for this reason.
    Ended(NoPath),
    /// The path is a file's, of this name, with what the exact scene says of it; nothing where nothing was judged.
    Read(String, Option<JudgedPath>),
}

/// A planner with its work.
#[derive(Clone, Debug)]
pub struct Racer {
    pub planner: PlannerName,
    /// Nothing where no planner is at work, as for a file's path.
    pub work: Option<PlannerWork>,
    pub stage: PlanStage,
    /// The greatest number of iterations.
    pub(super) bound: u64,
}

impl Racer {
    /// A planner that has grown nothing. Says at once where there is no problem to solve.
    pub fn new(planner: PlannerName, task: &Task, seed: Seed) -> Self {
        let (work, stage) = match task.attempt(planner, seed) {
            Ok(attempt) => (Some(PlannerWork::new(attempt)), PlanStage::Growing),
            Err(reason) => (None, PlanStage::Ended(reason)),
        };
        Racer { planner, work, stage, bound: planner.iterations() }
    }

    /// What it has done.
    pub fn effort(&self) -> Effort {
        self.work.as_ref().map_or_else(Effort::default, |work| work.with(|attempt| attempt.effort()))
    }

    /// Whether it is at work and has no path yet.
    pub fn grows(&self) -> bool {
        self.work.is_some() && self.stage == PlanStage::Growing
    }

    /// Whether it goes on to improve a path that it has.
    pub fn improves(&self) -> bool {
        self.stage == PlanStage::Solved && self.planner.improves() && self.effort().iterations < self.bound
    }

    /// Whether another iteration does anything.
    pub fn goes_on(&self) -> bool {
        self.grows() || self.improves()
    }

    /// Does one iteration, if that does anything.
    pub fn step(&mut self) {
        let Some(work) = self.work.as_ref().filter(|_| self.goes_on()) else { return };
        let effort = self.effort();
        if effort.iterations >= self.bound {
            self.stage = PlanStage::Ended(NoPath::Exhausted { bound: Bound::Iterations, effort });
            return;
        }
        match work.with(|attempt| attempt.step()) {
            Progress::Growing => {}
            Progress::Solved => self.stage = PlanStage::Solved,
            Progress::Ended(reason) => self.stage = PlanStage::Ended(reason),
        }
    }

    /// Its work, if that has found a path.
    fn solved(&self) -> Option<&PlannerWork> {
        self.work.as_ref().filter(|_| self.stage == PlanStage::Solved)
    }

    /// The length and the clearance of its own path, if it has one.
    pub fn lengths(&self) -> Option<PathLengths> {
        self.solved().map(|work| work.with(|attempt| attempt.lengths()))
    }

    /// Its own path; empty while it has none.
    pub fn path(&self) -> Vec<AnyConfiguration> {
        self.solved().map_or_else(Vec::new, |work| work.with(|attempt| attempt.drawn().path))
    }
}
