//! `Answer`, what came of planning, and `PathFile`, a path as JSON.

use motion_lab::export::JsonNumber;
use motion_lab::planning::{Effort, NoPath};
use motion_lab::robots::AnyRobot;
use serde::Serialize;

use super::attempt::{Attempt, Driven, Leg};
use super::named::PlannerName;
use super::next;
use super::task::Task;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure};

/// The version of the format. Readers refuse versions that they don't know.
const VERSION: u32 = 1;

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

/// What a planner has done.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Counts {
    /// The iterations.
    pub iterations: u64,
    /// The samples drawn.
    pub samples: u64,
    /// The edges asked about.
    pub edges: u64,
    /// Those of them that were proven free.
    pub free: u64,
}

impl From<Effort> for Counts {
    fn from(effort: Effort) -> Self {
        let Effort { iterations, samples, edges, free } = effort;
        Counts { iterations, samples, edges, free }
    }
}

/// The unit in which a robot's paths are measured.
pub fn unit(robot: &AnyRobot) -> &'static str {
    if matches!(robot, AnyRobot::Reach(_) | AnyRobot::Reach3(_)) { "rad" } else { "m" }
}

/// A proven clearance in metres, in words: rounded down, so that no more is claimed than is proven, with the digits
/// that show that it is above 0.
pub fn proven(clearance: f64) -> String {
    let (mut digits, mut scale) = (4, 1e4);
    while clearance * scale < 1.0 && digits < 12 {
        (digits, scale) = (digits + 1, 10.0 * scale);
    }
    format!("{:.digits$}", (clearance * scale).floor() / scale)
}

impl Answer {
    fn new(task: &Task, planner: PlannerName, seed: u64) -> Self {
        Answer {
            solved: false,
            planner: planner.name(),
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
        Answer {
            solved: true,
            effort: Some(attempt.effort().into()),
            seconds: Some(seconds),
            legs: Some(attempt.legs().len()),
            length: Some(JsonNumber(attempt.length())),
            clearance: Some(JsonNumber(attempt.clearance())),
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

/// A path as JSON.
#[derive(Debug, Serialize)]
pub struct PathFile {
    version: u32,
    program: &'static str,
    world: WorldLine,
    robot: RobotLine,
    planner: String,
    seed: u64,
    effort: Option<Counts>,
    start: Vec<JsonNumber>,
    goal: Vec<JsonNumber>,
    length: Option<JsonNumber>,
    clearance: Option<JsonNumber>,
    legs: Vec<LegLine>,
    #[serde(skip_serializing_if = "Option::is_none")]
    growth: Option<GrowthLines>,
}

#[derive(Debug, Serialize)]
struct WorldLine {
    name: String,
    content_hash: String,
}

#[derive(Debug, Serialize)]
struct RobotLine {
    name: String,
    kind: &'static str,
}

#[derive(Debug, Serialize)]
struct LegLine {
    kind: &'static str,
    from: Vec<JsonNumber>,
    to: Vec<JsonNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    control: Option<ControlLine>,
    /// `[from, to, clearance]`
    steps: Vec<[JsonNumber; 3]>,
}

#[derive(Debug, Serialize)]
struct ControlLine {
    v: JsonNumber,
    phi: JsonNumber,
    seconds: JsonNumber,
}

#[derive(Debug, Serialize)]
struct GrowthLines {
    nodes: Vec<Vec<JsonNumber>>,
    edges: Vec<[usize; 2]>,
}

fn numbers(numbers: &[f64]) -> Vec<JsonNumber> {
    numbers.iter().copied().map(JsonNumber).collect()
}

impl LegLine {
    fn of(leg: &Leg) -> Self {
        let control = |Driven { v, phi, seconds }: Driven| ControlLine {
            v: JsonNumber(v),
            phi: JsonNumber(phi),
            seconds: JsonNumber(seconds),
        };
        LegLine {
            kind: if leg.driven.is_some() { "drive" } else { "chart line" },
            from: numbers(&leg.from),
            to: numbers(&leg.to),
            control: leg.driven.map(control),
            steps: leg.steps.iter().map(|step| [step.from, step.to, step.clearance].map(JsonNumber)).collect(),
        }
    }
}

impl PathFile {
    /// The path that an attempt has found, with what it has grown if that is asked for.
    pub fn new(answer: &Answer, task: &Task, attempt: &dyn Attempt, with_growth: bool) -> Self {
        let growth = || {
            let (nodes, edges) = attempt.growth();
            GrowthLines { nodes: nodes.iter().map(|node| numbers(node)).collect(), edges }
        };
        PathFile {
            version: VERSION,
            program: concat!("motion-lab ", env!("CARGO_PKG_VERSION")),
            world: WorldLine {
                name: task.world.name.clone(),
                content_hash: format!("{:032x}", task.world.content_hash()),
            },
            robot: RobotLine { name: task.name.clone(), kind: task.robot.kind() },
            planner: answer.planner.clone(),
            seed: answer.seed,
            effort: answer.effort,
            start: numbers(&Task::coordinates(&task.start)),
            goal: numbers(&Task::coordinates(&task.goal)),
            length: answer.length,
            clearance: answer.clearance,
            legs: attempt.legs().iter().map(LegLine::of).collect(),
            growth: with_growth.then(growth),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::proven;

    #[test]
    fn a_clearance_is_never_shown_larger_than_it_is_proven_nor_as_none() {
        for (clearance, shown) in
            [(0.25, "0.2500"), (0.00996, "0.0099"), (1.98e-5, "0.00001"), (4e-9, "0.000000004"), (f64::INFINITY, "inf")]
        {
            assert_eq!(proven(clearance), shown);
        }
    }
}
