//! `Assignment`, a robot's goal and limits: read from a file, checked within its world.

use bevy::app::App;
use ron::value::RawValue;

use super::added_kinds::AddedKinds;
use super::assignment_text::{AssignmentText, AssignmentVersion, Goal, Limits, item_of, items, options, place_of};
use super::seeds::Seeds;
use super::{AssignmentError, AssignmentProblem, MAX_SEEDS, Points, Stay, When};
use crate::recording::{Recorder, RunError, Verification, verify_with_robots};
use crate::run::{Log, Script};
use crate::simulation::{RobotId, StandingRobots};
use crate::tour::{MAX_TICKS, TourConfig};
use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::configuration::{Coordinates, RobotKind, WrittenCoordinate};
use motion_lab_core::random::Seed;
use motion_lab_core::text_position::Position;
use motion_lab_core::worlds::{Resident, World, begin_of, ron_in_words};

/// An assignment file as written. It names its world and does not hold it.
#[derive(Clone, Debug, PartialEq)]
pub struct AssignmentFile {
    file: String,
    source: String,
    text: AssignmentText,
}

impl AssignmentFile {
    /// Reads an assignment file. Errors call it `file`.
    ///
    /// # Errors
    /// [`AssignmentError`] names file, line, column and item, for invalid RON, another version, or an unknown or
    /// missing field.
    pub fn parse(file: &str, text: &str) -> Result<Self, AssignmentError> {
        let read: Result<AssignmentText, _> = options().from_str(text);
        // the version comes first: the rest of another version's file may look different
        let version = match &read {
            Ok(read) => read.version,
            Err(_) => ron::from_str(text).map_or(1, |AssignmentVersion { version }| version),
        };
        let error = |Position { line, column }, item, problem| {
            let (file, problem) = (file.to_owned(), Box::new(problem));
            AssignmentError { file, line, column, item, problem }
        };
        if version != 1 {
            return Err(error(place_of(text, "version"), "version", AssignmentProblem::Version(version)));
        }
        let read = read.map_err(|e| {
            let problem = AssignmentProblem::Syntax(ron_in_words(text, &e));
            error(begin_of(&e), item_of(text, &e), problem)
        })?;
        Ok(AssignmentFile { file: file.to_owned(), source: text.to_owned(), text: read })
    }

    /// The name of its world: a built-in one, or the path of a world file relative to this file's folder.
    pub fn world_name(&self) -> &str {
        &self.text.world
    }

    /// Where an item of it begins, such as `world`, as messages have it: `exam.ron:1:25`.
    pub fn place_of(&self, item: &str) -> String {
        let Position { line, column } = place_of(&self.source, item);
        format!("{}:{line}:{column}", self.file)
    }

    /// What its writer may have meant by angles of more than a turn in the start and the goal, in the world it names.
    pub fn turns(&self, world: &World) -> Vec<String> {
        let AssignmentText { robot, start, goal, .. } = &self.text;
        let about = world.robots.iter().find(|known| known.name == *robot).and_then(|known| RobotKind::of(&known.kind));
        let Some(about) = about else { return Vec::new() };
        let of = |item: &'static str, written: &[WrittenCoordinate]| {
            let turns: Vec<String> = WrittenCoordinate::all_turns_in_ron(written, about.lengths).collect();
            let place = self.place_of(item);
            turns.into_iter().map(move |turns| format!("{place}: {item}: {turns}"))
        };
        let start = start.as_deref().unwrap_or_default();
        of("start", start).chain(of("goal", &goal.at)).chain(of("goal", &goal.within)).collect()
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
    /// that grading begins, by [`RobotPlugin`](crate::simulation::RobotPlugin). A kind's description decides
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
        let AssignmentText { robot, start, goal, stay, limits, points, set_trailer, seeds: Seeds(seeds), .. } =
            &self.text;
        let error = |item: &'static str, problem: AssignmentProblem| {
            let Position { line, column } = place_of(&self.source, item);
            AssignmentError { file: self.file.clone(), line, column, item, problem: Box::new(problem) }
        };
        let Some(number) = world.robots.iter().position(|r| r.name == *robot) else {
            let names: Vec<&str> = world.robots.iter().map(|r| r.name.as_str()).collect();
            let there = if names.is_empty() { "none".into() } else { names.join(", ") };
            return Err(error("robot", AssignmentProblem::Robot { robot: robot.clone(), there }));
        };
        let lengths = RobotKind::of(&world.robots[number].kind).map_or(0, |known| known.lengths);
        if let Some(start) = start {
            let values = WrittenCoordinate::values(start, lengths);
            world.robots[number].start = values.map_err(|reason| error("start", reason.into()))?;
        }
        let goal = goal.goal(lengths).map_err(|reason| error("goal", reason.into()))?;
        let about = check_place(&world, number, "start", &added).map_err(|problem| error("start", problem))?;
        let (coordinates, tolerances) = (goal.at.len(), goal.within.len());
        if coordinates != tolerances {
            return Err(error("goal", AssignmentProblem::Tolerances { coordinates, tolerances }));
        }
        if let Some(wrong) = goal.within.iter().find(|t| t.is_nan() || **t < 0.0) {
            return Err(error("goal", AssignmentProblem::Tolerance(*wrong)));
        }
        let mut there = world.clone();
        there.robots[number].start.clone_from(&goal.at);
        check_place(&there, number, "goal", &added).map_err(|problem| error("goal", problem))?;
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
        let (limits, points, set_trailer) = (*limits, *points, *set_trailer);
        let assignment =
            Assignment { world, number, kind, goal, stay, limits, points, set_trailer, seeds, added, about };
        if assignment.is_at_goal(&assignment.world.robots[number].start) {
            return Err(error("goal", AssignmentProblem::AtStart));
        }
        Ok(assignment)
    }
}

/// Checks that the robot with this number has a valid start in the world, within its bounds, and touches no obstacle
/// there; errors call the start `what`. Returns the description of its kind, if it has one.
fn check_place(
    world: &World,
    number: usize,
    what: &'static str,
    added: &AddedKinds,
) -> Result<Option<&'static RobotKind>, AssignmentProblem> {
    let config = TourConfig { worlds: vec![world.clone()], ticks: 0, sensor: None };
    let run = Recorder::with_robots(config, Script::empty(), |app| added.add_to(app));
    let run = run.map_err(AssignmentProblem::Configuration)?;
    let Resident { name, kind, start, .. } = &world.robots[number];
    Resident::try_new(name.clone(), kind.clone(), start.clone(), None).map_err(AssignmentProblem::Place)?;
    world.check_position(kind, what, start)?;
    world.check_resident(&world.robots[number])?;
    let scene = Scene::of_world(world);
    let Some(robot) = run.view().into_iter().nth(number) else { return Ok(None) };
    match scene.witness(&robot.footprint).filter(|w| w.dist == 0.0) {
        Some(touched) => {
            Err(AssignmentProblem::Touches(scene.obstacle_name(touched.obstacle).unwrap_or("an obstacle").to_owned()))
        }
        None => Ok(robot.about),
    }
}

/// The chart difference of two configurations of this kind. A kind that nobody described is compared coordinate by
/// coordinate.
pub(super) fn difference(about: Option<&RobotKind>, from: &[f64], to: &[f64]) -> Option<Coordinates> {
    match about {
        Some(known) => (known.difference)(from, to),
        None => (from.len() == to.len()).then(|| from.iter().zip(to).map(|(a, b)| b - a).collect()),
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
    set_trailer: bool,
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

    /// Whether a submission may drop a trailer and take it again.
    pub fn may_set_trailer(&self) -> bool {
        self.set_trailer
    }

    /// Whether a configuration is at the goal, angles the short way round. One of another space (with a trailer, when
    /// the goal has none) is not.
    pub(super) fn is_at_goal(&self, q: &[f64]) -> bool {
        difference(self.about, &self.goal.at, q).is_some_and(|d| {
            d.len() == self.goal.within.len() && d.iter().zip(&self.goal.within).all(|(d, within)| d.abs() <= *within)
        })
    }

    /// The limits.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// The seeds.
    pub fn seeds(&self) -> &[Seed] {
        &self.seeds
    }

    /// Begins a run of the assignment, at tick 0. Robots that nobody drives stand, but for others than the graded one
    /// that follow a route of their world.
    pub(super) fn begin(&self, seed: Seed, script: &Script) -> Result<Recorder, RunError> {
        let config = TourConfig { worlds: vec![self.world.clone()], ticks: self.limits.ticks, sensor: None };
        Recorder::with_robots(config, (seed, script.clone()), |app| {
            self.added.add_to(app);
            app.insert_resource(self.standing());
        })
    }

    fn standing(&self) -> StandingRobots {
        let robots = self.world.robots.iter().zip(0_u32..);
        let stands = robots.filter(|(robot, id)| robot.route.is_none() || usize::try_from(*id) == Ok(self.number));
        StandingRobots(stands.map(|(_, id)| RobotId(id)).collect())
    }

    /// Simulates a log's run again and compares it, with the assignment's kinds of robots.
    pub(super) fn verify(&self, log: &Log) -> Result<Verification, RunError> {
        verify_with_robots(log, |app| self.added.add_to(app), |_| {})
    }
}
