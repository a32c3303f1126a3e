//! `Answer`, what came of planning.

use motion_lab::capture::{proven, unit};
use motion_lab::export::JsonNumber;
use motion_lab::planning::{Effort, NoPath};
use motion_lab::plans::{Attempt, Counts, PathLengths, PlannerName, Task};
use serde::Serialize;

use super::next;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure};

/// What came of planning.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    solved: bool,
    planner: String,
    robot: String,
    world: String,
    seed: u64,
    effort: Option<Counts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    legs: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<JsonNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    clearance: Option<JsonNumber>,
    /// Why there is no path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// What to do then.
    #[serde(skip)]
    pub next: &'static str,
    /// The unit of the length.
    #[serde(skip)]
    unit: &'static str,
}

impl Answer {
    fn new(task: &Task, planner: PlannerName, seed: u64) -> Self {
        Answer {
            solved: false,
            planner: planner.id().to_owned(),
            robot: task.name.clone(),
            world: task.world.name.clone(),
            seed,
            effort: None,
            seconds: None,
            legs: None,
            length: None,
            clearance: None,
            reason: None,
            next: "",
            unit: unit(&task.robot),
        }
    }

    /// There is no path.
    pub fn of_none(task: &Task, planner: PlannerName, seed: u64, reason: &NoPath) -> Self {
        Answer { reason: Some(reason.to_string()), next: next(reason), ..Self::new(task, planner, seed) }
    }

    /// The same answer with what the planner has done.
    pub fn after(self, effort: Effort) -> Self {
        Answer { effort: Some(effort.into()), ..self }
    }

    /// There is a path.
    pub fn of_path(task: &Task, planner: PlannerName, seed: u64, attempt: &dyn Attempt, seconds: f64) -> Self {
        let PathLengths { length, clearance } = attempt.lengths();
        Answer {
            solved: true,
            effort: Some(attempt.effort().into()),
            seconds: Some(seconds),
            legs: Some(attempt.legs().len()),
            length: Some(JsonNumber(length)),
            clearance: Some(JsonNumber(clearance)),
            ..Self::new(task, planner, seed)
        }
    }

    /// Prints the path in words.
    pub fn print(&self, data: &mut Data) -> Result<(), Failure> {
        let (legs, length) = (self.legs.unwrap_or(0), self.length.map_or(0.0, |length| length.0));
        let clearance = self.clearance.map_or(0.0, |clearance| clearance.0);
        let seconds = self.seconds.unwrap_or(0.0);
        data.line(format!("{} at seed {}: {} in {}", self.planner, self.seed, self.robot, self.world))?;
        data.line(format!("path       {}, {length:.3} {}", counted(legs, "leg"), self.unit))?;
        data.line(format!("clearance  {} m, proven along the whole path", proven(clearance)))?;
        if let Some(Counts { iterations, samples, edges, free }) = self.effort {
            let count = |n: u64, what: &str| counted(usize::try_from(n).unwrap_or(usize::MAX), what);
            let (rounds, draws) = (count(iterations, "iteration"), count(samples, "sample"));
            let work = format!("{rounds}, {draws}, {} asked, {free} of them free", count(edges, "edge"));
            data.line(format!("work       {work}, {:.1} ms", 1000.0 * seconds))?;
        }
        Ok(())
    }
}
