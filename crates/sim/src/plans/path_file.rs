//! `PathFile`, a path as JSON, with what its planner has grown: written by the lab, or by a planner of one's own.

use serde::{Deserialize, Serialize};

use super::attempt::{FileLeg, LegControl, PlanAttempt};
use super::drawn::Drawn;
use super::judged::{DRAWN, FileMotion, JudgedPath};
use super::task::Task;
use crate::export::{JsonNumber, json_seed, read_json_seed};
use motion_lab_core::configuration::{AnyConfiguration, Configuration, RobotKind};
use motion_lab_core::one_line::{OneLine, quoted};
use motion_lab_core::planning::Effort;
use motion_lab_core::robots::{AnyRobot, CarCmd, Drivable, Robot};

/// The version of the format. Readers refuse versions that they don't know.
const VERSION: u32 = 1;

/// Largest size of a path's file that is read, bytes.
pub const MAX_PATH_BYTES: usize = 64 << 20;

/// Largest number of legs, of nodes and of edges that are read: each line becomes some hundred bytes of a picture.
const MAX_LINES: usize = 300_000;

/// Longest drive of one leg that is read, seconds.
const MAX_SECONDS: f64 = 3600.0;

/// What a planner has done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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

/// A path as JSON. A reader needs `version`, `robot.kind`, `start` and `goal`; all else may be left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathFile {
    version: u32,
    #[serde(default)]
    program: String,
    #[serde(default)]
    world: WorldLine,
    robot: RobotLine,
    #[serde(default)]
    planner: String,
    #[serde(default, serialize_with = "json_seed", deserialize_with = "read_json_seed")]
    seed: u64,
    #[serde(default)]
    effort: Option<Counts>,
    start: Vec<JsonNumber>,
    goal: Vec<JsonNumber>,
    #[serde(default)]
    length: Option<JsonNumber>,
    #[serde(default)]
    clearance: Option<JsonNumber>,
    /// Who called the path free, and that this is no proof; left out where the path is proven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    checker: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    proven: Option<bool>,
    #[serde(default)]
    legs: Vec<LegLine>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    growth: Option<GrowthLines>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct WorldLine {
    name: String,
    #[serde(default)]
    content_hash: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct RobotLine {
    #[serde(default)]
    name: String,
    kind: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct LegLine {
    kind: String,
    from: Vec<JsonNumber>,
    to: Vec<JsonNumber>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    control: Option<ControlLine>,
    /// `[from, to, clearance]`
    #[serde(default)]
    steps: Vec<[JsonNumber; 3]>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct ControlLine {
    v: JsonNumber,
    phi: JsonNumber,
    seconds: JsonNumber,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct GrowthLines {
    nodes: Vec<Vec<JsonNumber>>,
    edges: Vec<[usize; 2]>,
}

/// Why a path's file is refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PathFileError {
    /// A file beyond the limit.
    #[error("{found} bytes: a path's file has at most {MAX_PATH_BYTES}")]
    TooLarge {
        /// Its size, bytes.
        found: usize,
    },
    /// No JSON, or a field that is missing or of another type.
    #[error("{}", OneLine(.0))]
    Json(#[from] serde_json::Error),
    /// A version of a later program.
    #[error("version {0}: this program reads version {VERSION}")]
    Version(u32),
    /// No robot of the lab.
    #[error("robot.kind: no kind of the lab is called {}, or it has another number of coordinates than `start`", quoted(.0))]
    Kind(String),
    /// Numbers that are no configuration of the robot.
    #[error("{field}: no configuration of this robot")]
    Configuration {
        /// Where they stand: `legs[3].to`.
        field: String,
    },
    /// More to draw than fits a window's or a page's memory.
    #[error("{what}: {found}; at most {MAX_LINES} are drawn")]
    TooMany {
        /// The list: `growth.edges`.
        what: &'static str,
        /// Its length.
        found: usize,
    },
    /// An edge of the growth between nodes that are not there.
    #[error("growth.edges[{0}]: there is no such node")]
    Edge(usize),
    /// A leg of a kind that the robot has not.
    #[error("legs[{leg}].kind: {} is neither \"chart line\" nor, with a control and for a car, \"drive\"", quoted(.kind))]
    Leg {
        /// The leg's number, from 0.
        leg: usize,
        /// Its kind.
        kind: String,
    },
}

fn numbers(numbers: &[f64]) -> Vec<JsonNumber> {
    numbers.iter().copied().map(JsonNumber).collect()
}

impl LegLine {
    fn of(leg: &FileLeg) -> Self {
        let control = |LegControl { v, phi, seconds }: LegControl| ControlLine {
            v: JsonNumber(v),
            phi: JsonNumber(phi),
            seconds: JsonNumber(seconds),
        };
        LegLine {
            kind: if leg.driven.is_some() { "drive" } else { "chart line" }.to_owned(),
            from: numbers(&leg.from),
            to: numbers(&leg.to),
            control: leg.driven.map(control),
            steps: leg.steps.iter().map(|step| [step.from, step.to, step.clearance].map(JsonNumber)).collect(),
        }
    }

    /// The motion that it says.
    fn motion(&self, leg: usize, robot: &AnyRobot) -> Result<FileMotion, PathFileError> {
        let [from, to] = [("from", &self.from), ("to", &self.to)];
        let at =
            |(end, numbers): (&str, &Vec<JsonNumber>)| configuration(robot, numbers, || format!("legs[{leg}].{end}"));
        let (a, b) = (at(from)?, at(to)?);
        let kind = || PathFileError::Leg { leg, kind: self.kind.clone() };
        match (&*self.kind, &self.control, robot, a) {
            ("chart line", None, ..) => {
                let other = |_| PathFileError::Configuration { field: format!("legs[{leg}].to") };
                Ok(FileMotion::Line(Box::new(robot.edge(&a, &b).map_err(other)?)))
            }
            ("drive", Some(control), AnyRobot::Hitch(car), AnyConfiguration::Hitch(q)) => {
                let ControlLine { v, phi, seconds } = control;
                let command = CarCmd { v: v.0, phi: phi.0 };
                let is_short = seconds.0 >= 0.0 && seconds.0 <= MAX_SECONDS;
                let arc = is_short.then(|| car.drive(&q, &command, seconds.0).ok()).flatten().ok_or_else(kind)?;
                Ok(FileMotion::Drive(Box::new(arc)))
            }
            _ => Err(kind()),
        }
    }
}

/// The configuration of a robot with these coordinates; of a rover x and y are enough.
fn configuration(
    robot: &AnyRobot,
    numbers: &[JsonNumber],
    field: impl FnOnce() -> String,
) -> Result<AnyConfiguration, PathFileError> {
    let mut coordinates: Vec<f64> = numbers.iter().map(|number| number.0).collect();
    if matches!(robot, AnyRobot::Rusty(_)) && coordinates.len() == 2 {
        coordinates.push(0.0);
    }
    let known = AnyRobot::of_kind(robot.kind(), &coordinates).map(|(_, q)| q);
    known.and_then(|q| robot.like(&q)).ok_or_else(|| PathFileError::Configuration { field: field() })
}

/// The chart line between two configurations of one robot.
fn chart_line(a: &AnyConfiguration, b: &AnyConfiguration) -> Vec<AnyConfiguration> {
    let parts = (0..=DRAWN).map(|i| a.interpolate(b, f64::from(i) / f64::from(DRAWN)));
    parts.filter_map(Result::ok).collect()
}

impl PathFile {
    /// The path that an attempt has found by the planner of this name, with what it has grown if that is asked for.
    pub fn new(planner: &str, seed: u64, task: &Task, attempt: &dyn PlanAttempt, with_growth: bool) -> Self {
        let growth = || {
            let (nodes, edges) = attempt.growth();
            GrowthLines { nodes: nodes.iter().map(|node| numbers(node)).collect(), edges }
        };
        let (lengths, proves) = (attempt.lengths(), task.checker.proves());
        PathFile {
            version: VERSION,
            program: concat!("motion-lab ", env!("CARGO_PKG_VERSION")).to_owned(),
            world: WorldLine {
                name: task.world.name.clone(),
                content_hash: format!("{:032x}", task.world.content_hash()),
            },
            robot: RobotLine { name: task.name.clone(), kind: task.robot.kind().to_owned() },
            planner: planner.to_owned(),
            seed,
            effort: Some(attempt.effort().into()),
            start: numbers(&task.start.coordinates()),
            goal: numbers(&task.goal.coordinates()),
            length: Some(JsonNumber(lengths.length)),
            clearance: proves.then_some(JsonNumber(lengths.clearance)),
            checker: (!proves).then(|| task.checker.id().to_owned()),
            proven: (!proves).then_some(false),
            legs: attempt.legs().iter().map(LegLine::of).collect(),
            growth: with_growth.then(growth),
        }
    }

    /// The file's one line.
    ///
    /// # Errors
    /// None for a path of the lab's: every number is one of JSON's or a text.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self).map(|line| line + "\n")
    }

    /// Reads a file. Nothing of it is believed but where its motions lie: whether they are free is
    /// [asked anew](Self::judged).
    ///
    /// # Errors
    /// [`PathFileError`] names the field.
    pub fn read(text: &str) -> Result<Self, PathFileError> {
        if text.len() > MAX_PATH_BYTES {
            return Err(PathFileError::TooLarge { found: text.len() });
        }
        let file: PathFile = serde_json::from_str(text)?;
        if file.version != VERSION {
            return Err(PathFileError::Version(file.version));
        }
        let [nodes, edges] = file.growth.as_ref().map_or([0; 2], |growth| [growth.nodes.len(), growth.edges.len()]);
        let lists = [("legs", file.legs.len()), ("growth.nodes", nodes), ("growth.edges", edges)];
        if let Some((what, found)) = lists.into_iter().find(|(_, length)| *length > MAX_LINES) {
            return Err(PathFileError::TooMany { what, found });
        }
        file.drawn(&file.robot()?.0).map(|_| file)
    }

    /// The name of the world, and of the robot in it; empty where the file names none.
    pub fn names(&self) -> [&str; 2] {
        [&self.world.name, &self.robot.name]
    }

    /// The robot of its kind, and its ends.
    ///
    /// # Errors
    /// [`PathFileError`]: no kind of the lab, or ends that are none of its configurations.
    pub fn robot(&self) -> Result<(AnyRobot, [AnyConfiguration; 2]), PathFileError> {
        let kind = &self.robot.kind;
        let mut start: Vec<f64> = self.start.iter().map(|number| number.0).collect();
        if *kind == RobotKind::RUSTY.name && start.len() == 2 {
            start.push(0.0);
        }
        let (robot, start) = AnyRobot::of_kind(kind, &start).ok_or_else(|| PathFileError::Kind(kind.clone()))?;
        let goal = configuration(&robot, &self.goal, || "goal".to_owned())?;
        Ok((robot, [start, goal]))
    }

    /// The motions of its legs, for `robot`, one of its kind that may have sizes of its own.
    fn motions(&self, robot: &AnyRobot) -> Result<Vec<FileMotion>, PathFileError> {
        self.legs.iter().enumerate().map(|(number, leg)| leg.motion(number, robot)).collect()
    }

    /// What the exact scene says of its path for a task, whose robot, scene and ends count. `None` where there is
    /// nothing to judge: no leg, or more than [`MAX_JUDGED`](super::MAX_JUDGED).
    ///
    /// # Errors
    /// [`PathFileError`] names what is not a plan of the task's robot.
    pub fn judged(&self, task: &Task) -> Result<Option<JudgedPath>, PathFileError> {
        Ok(JudgedPath::of(&self.motions(&task.robot)?, task))
    }

    /// What there is to draw of it for `robot`, one of its kind that may have sizes of its own.
    ///
    /// # Errors
    /// [`PathFileError`] names what is not a plan of its robot.
    pub fn drawn(&self, robot: &AnyRobot) -> Result<Drawn, PathFileError> {
        let (_, ends) = self.robot()?;
        let (mut path, mut corners) = (Vec::new(), Vec::new());
        for motion in self.motions(robot)? {
            let along = motion.drawn();
            if corners.is_empty() {
                corners.extend(along.first());
            }
            corners.extend(along.last());
            path.extend(along);
        }
        let mut edges = Vec::new();
        if let Some(GrowthLines { nodes, edges: pairs }) = &self.growth {
            let node =
                |(i, node): (usize, &Vec<JsonNumber>)| configuration(robot, node, || format!("growth.nodes[{i}]"));
            let nodes: Vec<AnyConfiguration> = nodes.iter().enumerate().map(node).collect::<Result<_, _>>()?;
            for (number, [a, b]) in pairs.iter().enumerate() {
                let ends = nodes.get(*a).zip(nodes.get(*b)).ok_or(PathFileError::Edge(number))?;
                edges.push(chart_line(ends.0, ends.1));
            }
        }
        Ok(Drawn { edges, path, corners, ..Drawn::of_ends(ends) })
    }
}

#[cfg(test)]
mod tests;
