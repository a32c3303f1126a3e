//! `Assignment`, a robot's goal and limits: read from a file, checked within its world.

use bevy::app::App;
use ron::error::SpannedError;
use ron::value::RawValue;
use serde::Deserialize;

use super::added_kinds::AddedKinds;
use super::seeds::Seeds;
use super::{AssignmentError, AssignmentProblem, MAX_SEEDS, Points, Stay, When};
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::random::Seed;
use motion_lab_core::text_position::{byte_at, line_at, offset_of};
use motion_lab_core::worlds::{Resident, World, begin_of, ron_in_words};
use motion_lab_sim::recording::{Recorder, RunError, Verification, verify_with_robots};
use motion_lab_sim::run::{Log, Script};
use motion_lab_sim::tour::{MAX_TICKS, TourConfig};

/// The configuration to reach, with tolerances.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// The coordinates of its configuration: metres and radians.
    pub at: Vec<f64>,
    /// The tolerance of each coordinate, 0 or more; angles compare the short way round.
    pub within: Vec<f64>,
    /// Number of ticks in a row that the robot has to be there; 1 when left out. The older way to say [`Stay::hold`].
    #[serde(default = "one")]
    pub ticks: u64,
}

fn one() -> u64 {
    1
}

/// The limits of an attempt, each inclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// The last tick at which the goal may be reached.
    pub ticks: u64,
    /// Largest number of contact episodes until then; any number when left out.
    #[serde(default)]
    pub contacts: Option<u32>,
    /// Largest number of changes between forward and backward until then, for a robot that drives; any number when left
    /// out.
    #[serde(default)]
    pub reversals: Option<u32>,
}

/// An assignment file as written. It names its world and does not hold it.
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
    #[serde(default)]
    stay: Option<Stay>,
    limits: Limits,
    #[serde(default)]
    points: Option<Points>,
    seeds: Seeds,
}

/// The version alone, for files of other versions.
#[derive(Deserialize)]
#[serde(rename = "Assignment")]
struct AssignmentVersion {
    version: u64,
}

/// The items as raw text, for their lines in the file.
#[derive(Deserialize)]
#[serde(rename = "Assignment")]
struct RawAssignment<'a> {
    #[serde(borrow, default)]
    version: Option<&'a RawValue>,
    #[serde(borrow, default)]
    world: Option<&'a RawValue>,
    #[serde(borrow, default)]
    robot: Option<&'a RawValue>,
    #[serde(borrow, default)]
    start: Option<&'a RawValue>,
    #[serde(borrow, default)]
    goal: Option<&'a RawValue>,
    #[serde(borrow, default)]
    stay: Option<&'a RawValue>,
    #[serde(borrow, default)]
    limits: Option<&'a RawValue>,
    #[serde(borrow, default)]
    points: Option<&'a RawValue>,
    #[serde(borrow, default)]
    seeds: Option<&'a RawValue>,
}

impl AssignmentFile {
    /// Reads an assignment file. Errors call it `file`.
    ///
    /// # Errors
    /// [`AssignmentError`] names file, line and item, for invalid RON, another version, or an unknown or missing field.
    pub fn parse(file: &str, text: &str) -> Result<Self, AssignmentError> {
        let read: Result<AssignmentText, _> = options().from_str(text);
        // the version comes first: the rest of another version's file may look different
        let version = match &read {
            Ok(read) => read.version,
            Err(_) => ron::from_str(text).map_or(1, |AssignmentVersion { version }| version),
        };
        let error =
            |line, item, problem| AssignmentError { file: file.to_owned(), line, item, problem: Box::new(problem) };
        if version != 1 {
            return Err(error(line_of(text, "version"), "version", AssignmentProblem::Version(version)));
        }
        let read = read.map_err(|e| {
            let problem = AssignmentProblem::Syntax(ron_in_words(text, &e));
            error(begin_of(&e).line, item_of(text, &e), problem)
        })?;
        Ok(AssignmentFile { file: file.to_owned(), source: text.to_owned(), text: read })
    }

    /// The name of its world: a built-in one, or the path of a world file relative to this file's folder.
    pub fn world_name(&self) -> &str {
        &self.text.world
    }

    /// The assignment in the world it names.
    ///
    /// # Errors
    /// [`AssignmentError`] when the world has no such robot, when the start or goal is no free configuration of it, or
    /// when a tolerance, a limit or the number of seeds is out of range.
    pub fn in_world(&self, world: World) -> Result<Assignment, AssignmentError> {
        self.with_kinds(world, AddedKinds::default())
    }

    /// [`in_world`](Self::in_world) for a world with kinds of robots that a program added: `add` adds them to each run
    /// that grading begins, by [`RobotPlugin`](motion_lab_sim::simulation::RobotPlugin). A kind's description decides
    /// how far a configuration is from the goal and which way is forward; without one, coordinates are compared one by
    /// one.
    ///
    /// # Errors
    /// As [`in_world`](Self::in_world), and when the world has a robot of a kind that `add` does not add.
    pub fn in_world_with_robots(
        &self,
        world: World,
        add: impl Fn(&mut App) + Send + Sync + 'static,
    ) -> Result<Assignment, AssignmentError> {
        self.with_kinds(world, AddedKinds::by(add))
    }

    fn with_kinds(&self, mut world: World, added: AddedKinds) -> Result<Assignment, AssignmentError> {
        let AssignmentText { robot, start, goal, stay, limits, points, seeds: Seeds(seeds), .. } = &self.text;
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
        let about = check_place(&world, number, &added).map_err(|problem| error("start", problem))?;
        let (coordinates, tolerances) = (goal.at.len(), goal.within.len());
        if coordinates != tolerances {
            return Err(error("goal", AssignmentProblem::Tolerances { coordinates, tolerances }));
        }
        if let Some(wrong) = goal.within.iter().find(|t| t.is_nan() || **t < 0.0) {
            return Err(error("goal", AssignmentProblem::Tolerance(*wrong)));
        }
        let mut there = world.clone();
        there.robots[number].start.clone_from(&goal.at);
        check_place(&there, number, &added).map_err(|problem| error("goal", problem))?;
        for (item, ticks) in [("limits", limits.ticks), ("goal", goal.ticks)] {
            if !(1..=MAX_TICKS).contains(&ticks) {
                return Err(error(item, AssignmentProblem::Ticks(ticks)));
            }
        }
        let stay = stay.unwrap_or(Stay { hold: None, at: When::Any });
        if let Some(hold) = stay.hold {
            if !(1..=limits.ticks).contains(&hold) {
                return Err(error("stay", AssignmentProblem::Hold { hold, ticks: limits.ticks }));
            }
            if goal.ticks != 1 {
                return Err(error("stay", AssignmentProblem::HeldTwice));
            }
        }
        let kind = world.robots[number].kind.clone();
        if limits.reversals.is_some() && about.is_none_or(|known| !known.drives) {
            return Err(error("limits", AssignmentProblem::Reversals));
        }
        let is_pair = |part: &RawValue| part.trim().get_ron().starts_with('(');
        if items(&self.source).any(|(item, part)| item == "seeds" && is_pair(part)) {
            return Err(error("seeds", AssignmentProblem::SeedsInParentheses));
        }
        if !(1..=MAX_SEEDS).contains(&seeds.len()) {
            return Err(error("seeds", AssignmentProblem::Seeds(seeds.len())));
        }
        if let Some(points) = points {
            points
                .check([limits.contacts.is_some(), limits.reversals.is_some()])
                .map_err(|problem| error("points", problem))?;
        }
        let seeds = seeds.iter().copied().map(Seed).collect();
        let (goal, limits, points) = (goal.clone(), *limits, *points);
        Ok(Assignment { world, number, kind, goal, stay, limits, points, seeds, added, about })
    }
}

/// Checks that the robot with this number has a valid start in the world and touches no obstacle there. Returns the
/// description of its kind, if it has one.
fn check_place(
    world: &World,
    number: usize,
    added: &AddedKinds,
) -> Result<Option<&'static RobotKind>, AssignmentProblem> {
    let config = TourConfig { worlds: vec![world.clone()], ticks: 0, sensor: None };
    let run = Recorder::with_robots(config, Script::empty(), |app| added.add_to(app));
    let run = run.map_err(AssignmentProblem::Configuration)?;
    let Resident { name, kind, start, .. } = &world.robots[number];
    Resident::try_new(name.clone(), kind.clone(), start.clone(), None).map_err(AssignmentProblem::Place)?;
    let scene = Scene::of_world(world);
    let Some(robot) = run.view().into_iter().nth(number) else { return Ok(None) };
    match scene.witness(&robot.footprint).filter(|w| w.dist == 0.0) {
        Some(touched) => {
            Err(AssignmentProblem::Touches(scene.obstacle_name(touched.obstacle).unwrap_or("an obstacle").to_owned()))
        }
        None => Ok(robot.about),
    }
}

/// The RON options of assignments: an optional value is written plainly, as in `contacts: 0`.
fn options() -> ron::Options {
    ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

/// The texts of the items of a file, with the blanks and comments around them; none of a text that is not RON.
fn items(text: &str) -> impl Iterator<Item = (&'static str, &RawValue)> {
    let places: Option<RawAssignment> = options().from_str(text).ok();
    let items = places.map(|RawAssignment { version, world, robot, start, goal, stay, limits, points, seeds }| {
        [
            ("version", version),
            ("world", world),
            ("robot", robot),
            ("start", start),
            ("goal", goal),
            ("stay", stay),
            ("limits", limits),
            ("points", points),
            ("seeds", seeds),
        ]
    });
    items.into_iter().flatten().filter_map(|(item, part)| Some((item, part?)))
}

/// The line in which an item begins, from 1; line 1 for a missing item.
fn line_of(text: &str, item: &str) -> usize {
    let part = items(text).find(|(name, _)| *name == item);
    part.map_or(1, |(_, part)| line_at(text, offset_of(text, part.trim().get_ron())))
}

/// The item in which the reader found an error; empty where it is in none.
fn item_of(text: &str, error: &SpannedError) -> &'static str {
    let byte = byte_at(text, begin_of(error));
    let holds = |part: &RawValue| {
        let begin = offset_of(text, part.get_ron());
        // an error in an item's first word begins at the colon before it, one of its whole may begin at its end
        (begin.saturating_sub(1)..=begin + part.get_ron().len()).contains(&byte)
    };
    let found = items(text).find(|(_, part)| holds(part)).map_or("", |(item, _)| item);
    match &error.code {
        // what is missing of the whole is noticed at its end, which may be in the last item's blanks
        ron::Error::MissingStructField { outer: Some(outer), .. } if outer == "Assignment" => "",
        _ => found,
    }
}

/// A task: lead a robot from its start to a goal, within limits, at each of several seeds.
///
/// It keeps what adds the kinds of robots it was made with, so that it is graded with no others. Two assignments with
/// added kinds are equal when one is a copy of the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    world: World,
    number: usize,
    kind: String,
    goal: Goal,
    stay: Stay,
    limits: Limits,
    points: Option<Points>,
    seeds: Vec<Seed>,
    added: AddedKinds,
    about: Option<&'static RobotKind>,
}

impl Assignment {
    /// The world, with the robot at the assignment's start.
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

    /// The description of the robot's kind, if it has one.
    pub fn about(&self) -> Option<&'static RobotKind> {
        self.about
    }

    /// The goal.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// When and for how long the robot has to be at the goal.
    pub fn stay(&self) -> Stay {
        self.stay
    }

    /// Number of ticks in a row that the robot has to be there, at least 1.
    pub fn hold(&self) -> u64 {
        self.stay.hold.unwrap_or(self.goal.ticks)
    }

    /// The points for each criterion; `None` for one point for passing.
    pub fn points(&self) -> Option<Points> {
        self.points
    }

    /// The limits.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// The seeds.
    pub fn seeds(&self) -> &[Seed] {
        &self.seeds
    }

    /// Begins a run of the assignment, at tick 0.
    pub(super) fn begin(&self, seed: Seed, script: &Script) -> Result<Recorder, RunError> {
        let config = TourConfig { worlds: vec![self.world.clone()], ticks: self.limits.ticks, sensor: None };
        Recorder::with_robots(config, (seed, script.clone()), |app| self.added.add_to(app))
    }

    /// Simulates a log's run again and compares it, with the assignment's kinds of robots.
    pub(super) fn verify(&self, log: &Log) -> Result<Verification, RunError> {
        verify_with_robots(log, |app| self.added.add_to(app), |_| {})
    }
}
