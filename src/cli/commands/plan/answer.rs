//! `PlanAnswer`, what came of planning.

use crate::capture::{bounded, proven, unit, within_best};
use motion_lab_core::planning::{Effort, NoPath};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::export::{JsonNumber, json_seed};
use motion_lab_sim::plans::{Counts, PathLengths, PlanAttempt, PlannerName, Task};
use serde::Serialize;

use super::advice::{NO_CELLS, NO_TANGENTS, next};
use super::blockers::BlockersAnswer;
use super::exact::ExactAnswer;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome};

/// What came of planning.
#[derive(Clone, Debug, Serialize)]
pub struct PlanAnswer {
    solved: bool,
    /// `path`; `none` where it is proven that there is no path; `undecided` where none was found.
    answer: &'static str,
    planner: String,
    robot: String,
    world: String,
    #[serde(serialize_with = "json_seed")]
    seed: u64,
    effort: Option<Counts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    legs: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<JsonNumber>,
    /// No path is shorter; left out where that was not asked, where it is not known, and where there is no path at all.
    #[serde(skip_serializing_if = "Option::is_none")]
    length_bound: Option<JsonNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    clearance: Option<JsonNumber>,
    /// Who called the path free, that this is no proof, and what the exact checker says of it; left out where the path
    /// is proven.
    #[serde(skip_serializing_if = "Option::is_none")]
    checker: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    proven: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<ExactAnswer>,
    /// The run that plays it, where one was asked for: its ticks, and how far it strays from the path, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ticks: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strayed: Option<JsonNumber>,
    /// The log's contacts and its digest, where one was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contacts: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub digest: Option<String>,
    /// Why there is no path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// What to move for a path to appear, where that was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blockers: Option<BlockersAnswer>,
    /// What to do then.
    #[serde(skip)]
    pub next: &'static str,
    /// For what the bound is where it is not the robot as it is.
    #[serde(skip)]
    larger: String,
    /// What an infinite bound says, and what to do then.
    #[serde(skip)]
    unbounded: (&'static str, &'static str),
    /// The unit of the length.
    #[serde(skip)]
    unit: &'static str,
}

impl PlanAnswer {
    fn new(task: &Task, planner: PlannerName, seed: u64) -> Self {
        PlanAnswer {
            solved: false,
            answer: "undecided",
            planner: planner.id().to_owned(),
            robot: task.name.clone(),
            world: task.world.name.clone(),
            seed,
            effort: None,
            seconds: None,
            legs: None,
            length: None,
            length_bound: None,
            clearance: None,
            checker: (!task.checker.proves()).then(|| task.checker.id()),
            proven: (!task.checker.proves()).then_some(false),
            exact: None,
            ticks: None,
            strayed: None,
            contacts: None,
            digest: None,
            reason: None,
            blockers: None,
            next: "",
            larger: larger(task),
            unbounded: match task.robot {
                AnyRobot::Rusty(_) => ("no tangents and arcs lead the disc from start to goal", NO_TANGENTS),
                _ => ("cells proven blocked part the goal from the start within the world's bounds", NO_CELLS),
            },
            unit: unit(&task.robot),
        }
    }

    /// There is no path, or none was found.
    pub fn of_none(task: &Task, planner: PlannerName, seed: u64, reason: &NoPath) -> Self {
        let none = Self::new(task, planner, seed);
        let next = next(reason);
        match reason {
            // cells are proven by the exact geometry, whoever answers a planner's questions
            NoPath::Unreachable { .. } => {
                let reason = Some(format!("{reason}{}", larger(task)));
                PlanAnswer { answer: "none", reason, next, checker: None, proven: None, ..none }
            }
            _ => PlanAnswer { reason: Some(reason.to_string()), next, ..none },
        }
    }

    /// How the command ends that gives this answer for want of a path.
    pub fn without_path(&self) -> Outcome {
        if self.answer == "none" { Outcome::Unreachable } else { Outcome::NoPath }
    }

    /// The same answer with a length that no path undercuts: where that is infinite there is none.
    pub fn bounded(self, bound: f64) -> Self {
        // cells have proven as much, and said more
        if self.answer == "none" {
            return self;
        }
        if self.solved || bound < f64::INFINITY {
            return PlanAnswer { length_bound: Some(JsonNumber(bound)), ..self };
        }
        let reason = Some(format!("no path: {}{}", self.unbounded.0, self.larger));
        PlanAnswer { answer: "none", reason, next: self.unbounded.1, checker: None, proven: None, ..self }
    }

    /// The same answer with what the planner has done.
    pub fn after(self, effort: Effort) -> Self {
        PlanAnswer { effort: Some(effort.into()), ..self }
    }

    /// There is a path.
    pub fn of_path(task: &Task, planner: PlannerName, seed: u64, attempt: &dyn PlanAttempt, seconds: f64) -> Self {
        let PathLengths { length, clearance } = attempt.lengths();
        PlanAnswer {
            solved: true,
            answer: "path",
            effort: Some(attempt.effort().into()),
            seconds: Some(seconds),
            // a leg of a path that stays where it is leads nowhere
            legs: Some(attempt.legs().iter().filter(|leg| leg.from != leg.to).count()),
            length: Some(JsonNumber(length)),
            clearance: task.checker.proves().then_some(JsonNumber(clearance)),
            exact: attempt.judged().map(|judged| ExactAnswer::of(&task.scene, judged)),
            ..Self::new(task, planner, seed)
        }
    }

    /// Prints the run that plays the path in words.
    pub fn print_run(&self, data: &mut Data) -> Result<(), Failure> {
        if let (Some(ticks), Some(strayed)) = (self.ticks, self.strayed) {
            let (seconds, strayed) = (motion_lab_sim::run::seconds(ticks), 1000.0 * strayed.0);
            let ticks = counted(ticks, "tick");
            data.line(format!("played     {ticks}, {seconds} s, at most {strayed:.3} mm off the path"))?;
        }
        if let (Some(contacts), Some(digest)) = (self.contacts, &self.digest) {
            data.line(format!("recorded   {}, digest {digest}", counted(contacts, "contact")))?;
        }
        Ok(())
    }

    /// The bound behind the length of a path, or behind the reason why none was found.
    pub fn bound_in_words(&self) -> String {
        let Some(bound) = self.length_bound else { return String::new() };
        let near = self.length.and_then(|length| within_best(length.0, bound.0));
        let near = near.map_or_else(String::new, |near| format!(": {near}"));
        format!("; {}{}{near}", bounded(bound.0, self.unit), self.larger)
    }

    /// Prints the path in words.
    pub fn print(&self, data: &mut Data) -> Result<(), Failure> {
        let (legs, length) = (self.legs.unwrap_or(0), self.length.map_or(0.0, |length| length.0));
        let clearance = self.clearance.map_or(0.0, |clearance| clearance.0);
        let seconds = self.seconds.unwrap_or(0.0);
        let by = self.checker.map_or_else(String::new, |checker| format!(", by {checker}"));
        data.line(format!("{} at seed {}: {} in {}{by}", self.planner, self.seed, self.robot, self.world))?;
        let bound = self.bound_in_words();
        // as many digits as the bound has
        let digits = if bound.is_empty() { 3 } else { 4 };
        data.line(format!("path       {}, {length:.digits$} {}{bound}", counted(legs, "leg"), self.unit))?;
        if let Some(checker) = self.checker {
            data.line(format!("clearance  nothing is proven: {checker} calls the path free"))?;
        } else {
            data.line(format!("clearance  {} m, proven along the whole path", proven(clearance)))?;
        }
        if let Some(exact) = &self.exact {
            data.line(format!("exact      {exact}"))?;
        }
        if let Some(Counts { iterations, samples, edges, free }) = self.effort {
            let (rounds, draws) = (counted(iterations, "iteration"), counted(samples, "sample"));
            let work = format!("{rounds}, {draws}, {} asked, {free} of them free", counted(edges, "edge"));
            data.line(format!("work       {work}, {:.1} ms", 1000.0 * seconds))?;
        }
        Ok(())
    }
}

/// For what the proof is where it is not the robot as it is: `, for the robot 0.02 m larger (--tube)`.
fn larger(task: &Task) -> String {
    let tube = if task.planned() == task.robot { 0.0 } else { task.tube };
    let kept = [(tube, "--tube"), (task.clearance.unwrap_or(0.0), "--clearance")];
    let kept = kept.iter().filter(|(kept, _)| *kept > 0.0).map(|(kept, name)| format!("{kept} m ({name})"));
    let kept = kept.collect::<Vec<_>>().join(" and ");
    if kept.is_empty() { kept } else { format!(", for the robot larger by {kept}") }
}
