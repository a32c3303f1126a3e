//! `Assignment`, what is to be done: read from a file, checked within its world.

use ron::value::RawValue;
use serde::Deserialize;

use super::{AssignmentError, AssignmentProblem, MAX_SEEDS};
use crate::collision::{Collision, Scene};
use crate::random::Seed;
use crate::recording::{Recorder, RunError};
use crate::run::Script;
use crate::tour::{MAX_TICKS, TourConfig};
use crate::worlds::{Resident, World};

/// Where the robot shall be.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// The coordinates of its configuration: metres and radians.
    pub at: Vec<f64>,
    /// How far each may be off, angles the short way round.
    pub within: Vec<f64>,
    /// For how many ticks in a row it has to be there; 1 when left out.
    #[serde(default = "one")]
    pub ticks: u64,
}

fn one() -> u64 {
    1
}

/// What it may take. A limit itself is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// The ticks until it has been at the goal.
    pub ticks: u64,
    /// The contact episodes until then; any number when left out.
    #[serde(default)]
    pub contacts: Option<u32>,
    /// How often a robot that drives may change between ahead and back until then; any number when left out.
    #[serde(default)]
    pub reversals: Option<u32>,
}

/// An assignment file as written. Its world is but a name.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignmentFile {
    file: String,
    source: String,
    text: AssignmentText,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename = "Assignment", deny_unknown_fields)]
struct AssignmentText {
    version: u64,
    world: String,
    robot: String,
    #[serde(default)]
    start: Option<Vec<f64>>,
    goal: Goal,
    limits: Limits,
    seeds: Vec<u64>,
}

/// The version alone, whatever else a file of another version holds.
#[derive(Deserialize)]
#[serde(rename = "Assignment")]
struct Version {
    version: u64,
}

/// The items unread, for their places in the text.
#[derive(Deserialize)]
#[serde(rename = "Assignment")]
struct Places<'a> {
    #[serde(borrow)]
    version: &'a RawValue,
    #[serde(borrow, default)]
    robot: Option<&'a RawValue>,
    #[serde(borrow, default)]
    start: Option<&'a RawValue>,
    #[serde(borrow, default)]
    goal: Option<&'a RawValue>,
    #[serde(borrow, default)]
    limits: Option<&'a RawValue>,
    #[serde(borrow, default)]
    seeds: Option<&'a RawValue>,
}

impl AssignmentFile {
    /// Reads an assignment file. `file` is what errors call it.
    ///
    /// # Errors
    /// [`AssignmentError`] names file, line and item: no RON, another version, an unknown or missing field.
    pub fn parse(file: &str, text: &str) -> Result<Self, AssignmentError> {
        let read: Result<AssignmentText, _> = options().from_str(text);
        // the version before all else: the rest of another version's file may look different
        let version = match &read {
            Ok(read) => read.version,
            Err(_) => ron::from_str(text).map_or(1, |Version { version }| version),
        };
        let error =
            |line, item, problem| AssignmentError { file: file.to_owned(), line, item, problem: Box::new(problem) };
        if version != 1 {
            return Err(error(line_of(text, "version"), "version", AssignmentProblem::Version(version)));
        }
        let read = read.map_err(|e| error(e.span.start.line, "", AssignmentProblem::Syntax(e.code.to_string())))?;
        Ok(AssignmentFile { file: file.to_owned(), source: text.to_owned(), text: read })
    }

    /// The world it names: a built-in one, or a world file, seen from the folder of this one.
    pub fn world_name(&self) -> &str {
        &self.text.world
    }

    /// The assignment in the world it names.
    ///
    /// # Errors
    /// [`AssignmentError`]: no such robot there, a start or goal that is no free configuration of it, limits that make no sense.
    pub fn in_world(&self, mut world: World) -> Result<Assignment, AssignmentError> {
        let AssignmentText { robot, start, goal, limits, seeds, .. } = &self.text;
        let error = |item: &'static str, problem: AssignmentProblem| AssignmentError {
            file: self.file.clone(),
            line: line_of(&self.source, item),
            item,
            problem: Box::new(problem),
        };
        let Some(number) = world.robots.iter().position(|r| r.name == *robot) else {
            let names: Vec<&str> = world.robots.iter().map(|r| r.name.as_str()).collect();
            let there = if names.is_empty() { "none".into() } else { names.join(", ") };
            return Err(error("robot", AssignmentProblem::Robot { robot: robot.clone(), there }));
        };
        if let Some(start) = start {
            world.robots[number].start.clone_from(start);
        }
        check_place(&world, number).map_err(|problem| error("start", problem))?;
        let (coordinates, tolerances) = (goal.at.len(), goal.within.len());
        if coordinates != tolerances {
            return Err(error("goal", AssignmentProblem::Tolerances { coordinates, tolerances }));
        }
        if let Some(wrong) = goal.within.iter().find(|t| t.is_nan() || **t < 0.0) {
            return Err(error("goal", AssignmentProblem::Tolerance(*wrong)));
        }
        let mut there = world.clone();
        there.robots[number].start.clone_from(&goal.at);
        check_place(&there, number).map_err(|problem| error("goal", problem))?;
        for (item, ticks) in [("limits", limits.ticks), ("goal", goal.ticks)] {
            if !(1..=MAX_TICKS).contains(&ticks) {
                return Err(error(item, AssignmentProblem::Ticks(ticks)));
            }
        }
        let kind = world.robots[number].kind.clone();
        if limits.reversals.is_some() && kind.starts_with("reach") {
            return Err(error("limits", AssignmentProblem::Reversals));
        }
        if !(1..=MAX_SEEDS).contains(&seeds.len()) {
            return Err(error("seeds", AssignmentProblem::Seeds(seeds.len())));
        }
        let seeds = seeds.iter().copied().map(Seed).collect();
        Ok(Assignment { world, number, kind, goal: goal.clone(), limits: *limits, seeds })
    }
}

/// Whether the robot with this number can stand where the world has it, touching no obstacle.
fn check_place(world: &World, number: usize) -> Result<(), AssignmentProblem> {
    let config = TourConfig { worlds: vec![world.clone()], ticks: 0, sensor: None };
    let run = Recorder::new(config, Script::empty()).map_err(AssignmentProblem::Configuration)?;
    let Resident { name, kind, start, .. } = &world.robots[number];
    Resident::try_new(name.clone(), kind.clone(), start.clone(), None).map_err(AssignmentProblem::Place)?;
    let scene = Scene::of_world(world);
    let Some(robot) = run.view().into_iter().nth(number) else { return Ok(()) };
    match scene.witness(&robot.footprint).filter(|w| w.dist == 0.0) {
        Some(touched) => {
            Err(AssignmentProblem::Touches(scene.obstacle_name(touched.obstacle).unwrap_or("an obstacle").to_owned()))
        }
        None => Ok(()),
    }
}

/// How assignments are written: an optional value plainly, as in `contacts: 0`.
fn options() -> ron::Options {
    ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

/// The line in which an item begins, from 1; the first when it is not there.
fn line_of(text: &str, item: &str) -> usize {
    let part = options().from_str(text).ok().and_then(|places: Places| match item {
        "version" => Some(places.version),
        "robot" => places.robot,
        "start" => places.start,
        "goal" => places.goal,
        "limits" => places.limits,
        _ => places.seeds,
    });
    let offset = part.map_or(0, |part| part.trim().get_ron().as_ptr() as usize - text.as_ptr() as usize);
    1 + text.get(..offset).map_or(0, |before| before.matches('\n').count())
}

/// What is to be done: lead a robot from its start to a goal, within limits, at each of some seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    world: World,
    number: usize,
    kind: String,
    goal: Goal,
    limits: Limits,
    seeds: Vec<Seed>,
}

impl Assignment {
    /// The world, its robot at the start.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The robot's number in the world.
    pub fn robot(&self) -> usize {
        self.number
    }

    /// The robot's kind.
    pub fn kind(&self) -> &str {
        &self.kind
    }

    /// The goal.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// The limits.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// The seeds.
    pub fn seeds(&self) -> &[Seed] {
        &self.seeds
    }

    /// A run of it at tick 0.
    pub(super) fn begin(&self, seed: Seed, script: &Script) -> Result<Recorder, RunError> {
        let config = TourConfig { worlds: vec![self.world.clone()], ticks: self.limits.ticks, sensor: None };
        Recorder::new(config, (seed, script.clone()))
    }
}
