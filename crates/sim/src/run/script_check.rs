//! Checks scripts: each event and change by itself, and all of them against a run's robots and worlds.

use std::collections::{BTreeMap, BTreeSet};

use super::script_error::{
    MAX_CHANGED_SHAPES, MAX_CHANNEL, MAX_COORDINATES, MAX_EVENTS, ScriptError, ScriptProblem, UnfitInput,
};
use super::{Event, Quantized, RobotInput, Script, WorldChange, WorldEvent};
use crate::tour::{MAX_TICKS, TourConfig};
use motion_lab_core::configuration::{Kinds, RobotKind};
use motion_lab_core::geometry::{Aabb, MAX_COORDINATE, Point2};
use motion_lab_core::worlds::{MAX_ITEMS, Obstacle, OutsideError, World, check_name};

impl Script {
    /// Checks a script made by a program: whether [`parse`](Self::parse) could have returned it.
    ///
    /// # Errors
    /// [`ScriptError`] without file and line.
    pub fn check(&self) -> Result<(), ScriptError> {
        if self.version != Script::version_of(&self.changes) {
            return Err(ScriptProblem::Version(u64::from(self.version)).anywhere());
        }
        let count = self.events.len().saturating_add(self.changes.len());
        if count > MAX_EVENTS {
            return Err(ScriptProblem::TooMany(count).anywhere());
        }
        let mut before = 0;
        for (i, event) in self.events.iter().enumerate() {
            event.check(before).map_err(|problem| problem.at("events", i))?;
            before = event.tick;
        }
        before = 0;
        for (i, change) in self.changes.iter().enumerate() {
            change.check(before).map_err(|problem| problem.at("changes", i))?;
            before = change.tick;
        }
        Ok(())
    }

    /// Checks that a run of this configuration could apply every event: [`check`](Self::check),
    /// [`check_robots`](Self::check_robots) and [`check_worlds`](Self::check_worlds), and that robots get only inputs
    /// that their kinds [take](RobotKind::takes), with as many coordinates as a configuration has, and teleports only
    /// to places within their world's bounds.
    ///
    /// A run starts without this check, so that logs recorded before it still replay; there such an input is refused
    /// and counted. What depends on where robots are, such as a teleport onto an obstacle, shows only in the run.
    ///
    /// # Errors
    /// [`ScriptError`] without file and line, for the first of these that fails; [`located`](ScriptError::located) adds
    /// them. [`ScriptProblem::NotTaken`] names tick, robot, kind, input, and what the kind takes;
    /// [`ScriptProblem::Outside`] tick, robot, and the place.
    ///
    /// ```
    /// use motion_lab_core::configuration::{RobotKind, T2};
    /// use motion_lab_sim::run::Script;
    /// use motion_lab_sim::tour::TourConfig;
    ///
    /// let config = TourConfig::default();
    /// assert_eq!(Script::of_moves("Reach", [T2::new(0.5, 0.0)]).unwrap().check_for(&config), Ok(()));
    /// let script = Script::of_moves("Hitch", [T2::new(0.5, 0.0)]).unwrap();
    /// assert_eq!(
    ///     script.check_for(&config).unwrap_err().to_string(),
    ///     "events[0]: tick 1: robot \"Hitch\" is a hitch and takes no MoveTo: \
    ///      it takes Drive, Teleport, SetTrailer and Release"
    /// );
    /// ```
    pub fn check_for(&self, config: &TourConfig) -> Result<(), ScriptError> {
        self.check_for_kinds(config, &Kinds::default())
    }

    /// [`check_for`](Self::check_for) with kinds of robots that a program added. Inputs to a robot of a kind without a
    /// description are not checked.
    ///
    /// # Errors
    /// As [`check_for`](Self::check_for).
    pub fn check_for_kinds(&self, config: &TourConfig, kinds: &Kinds) -> Result<(), ScriptError> {
        self.check()?;
        let robots = config.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| (r, &w.bounds)));
        let known: BTreeMap<&str, (&str, &Aabb)> =
            robots.map(|(r, bounds)| (r.name.as_str(), (r.kind.as_str(), bounds))).collect();
        for (i, event) in self.events.iter().enumerate() {
            let Some((kind, bounds)) = known.get(event.robot.as_str()) else {
                return Err(ScriptProblem::Robot(event.robot.clone()).at("events", i));
            };
            if let Some(about) = kinds.of(kind) {
                event.check_kind(kind, about).map_err(|problem| problem.at("events", i))?;
                event.check_within(about, bounds).map_err(|problem| problem.at("events", i))?;
            }
        }
        self.check_worlds(&config.worlds)
    }

    /// Checks that every event's robot is among `names`.
    ///
    /// # Errors
    /// [`ScriptError`] without file and line, naming the first event of an unknown robot.
    pub fn check_robots(&self, names: &[&str]) -> Result<(), ScriptError> {
        let names: BTreeSet<&str> = names.iter().copied().collect();
        match self.events.iter().position(|e| !names.contains(e.robot.as_str())) {
            Some(i) => Err(ScriptProblem::Robot(self.events[i].robot.clone()).at("events", i)),
            None => Ok(()),
        }
    }

    /// Checks that the changes fit the worlds of a run: that each names a world, and in it a door, an obstacle that the
    /// world or an earlier change has, or a new obstacle's name that nothing has; that no world gets more than
    /// [`MAX_ITEMS`] shapes; and that at most [`MAX_CHANGED_SHAPES`] are placed for the changes: all of a world at a
    /// tick's first change of it, those of what is changed at each further one.
    ///
    /// # Errors
    /// [`ScriptError`] without file and line, naming the first change that does not fit.
    pub fn check_worlds(&self, worlds: &[World]) -> Result<(), ScriptError> {
        let mut changed = ChangedWorlds::default();
        let mut changes = self.changes.iter().enumerate();
        changes.try_for_each(|(i, event)| changed.take(worlds, event).map_err(|problem| problem.at("changes", i)))
    }
}

/// The worlds of a run as the changes of its script leave them, one change after the other: their names, and how many
/// shapes they have. What a change takes does not grow with the number of those before it.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChangedWorlds {
    worlds: BTreeMap<String, KnownNames>,
    /// The shapes that are placed for the changes.
    made: u64,
}

impl ChangedWorlds {
    /// Takes the script's next change. `worlds` are those of the run, the same each time.
    ///
    /// # Errors
    /// As [`check`](Self::check), and nothing is taken.
    pub fn take(&mut self, worlds: &[World], event: &WorldEvent) -> Result<(), ScriptProblem> {
        let (shapes, made) = self.after(worlds, event)?;
        self.made = made;
        if let Some(names) = self.worlds.get_mut(&event.world) {
            names.shapes = shapes;
            if let WorldChange::Add { name, .. } = &event.change {
                names.things.insert(name.clone(), NamedThing::Obstacle { shapes: 1 });
            }
        }
        Ok(())
    }

    /// Checks the change that the script would have next.
    ///
    /// # Errors
    /// [`ScriptProblem`], as those of [`Script::check_worlds`].
    pub fn check(&mut self, worlds: &[World], event: &WorldEvent) -> Result<(), ScriptProblem> {
        self.after(worlds, event).map(|_| ())
    }

    /// The shapes of the change's world, and those of all, after the change.
    fn after(&mut self, worlds: &[World], event: &WorldEvent) -> Result<(ChangedShapes, u64), ScriptProblem> {
        let WorldEvent { tick, world, change } = event;
        let name = change.name();
        if !self.worlds.contains_key(world) {
            self.worlds.insert(world.clone(), KnownNames::of_world(worlds, world)?);
        }
        let Some(names) = self.worlds.get(world) else { return Err(ScriptProblem::World(world.clone())) };
        let own = match (change, names.things.get(name)) {
            (WorldChange::Close(_) | WorldChange::Open(_), Some(NamedThing::Door))
            | (WorldChange::Add { .. }, None) => 1,
            (WorldChange::Remove(_) | WorldChange::Move { .. }, Some(NamedThing::Obstacle { shapes })) => *shapes,
            _ => {
                let (world, name) = (world.clone(), name.to_owned());
                return Err(match change {
                    WorldChange::Close(_) | WorldChange::Open(_) => ScriptProblem::Door { world, name },
                    WorldChange::Add { .. } => ScriptProblem::Taken { world, name },
                    WorldChange::Remove(_) | WorldChange::Move { .. } => ScriptProblem::Obstacle { world, name },
                });
            }
        };
        let is_add = matches!(change, WorldChange::Add { .. });
        let mut shapes = names.shapes;
        let made = self.made + shapes.changed(*tick, own, is_add);
        if is_add && shapes.count > MAX_ITEMS as u64 {
            return Err(ScriptProblem::Shapes(world.clone()));
        }
        if made > MAX_CHANGED_SHAPES { Err(ScriptProblem::ChangedShapes) } else { Ok((shapes, made)) }
    }
}

/// What a name of a world stands for, as far as changes ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NamedThing {
    Door,
    Obstacle {
        shapes: u64,
    },
    /// What no change can change.
    Other,
}

/// The names of a world, and its shapes.
#[derive(Clone, Debug)]
struct KnownNames {
    things: BTreeMap<String, NamedThing>,
    shapes: ChangedShapes,
}

/// The shapes of a world, and the tick that has changed it last.
#[derive(Clone, Copy, Debug)]
struct ChangedShapes {
    count: u64,
    tick: u64,
}

impl ChangedShapes {
    /// Takes a change of something of `own` shapes. Returns how many are placed for it: the first change of a tick has
    /// a scene made, and each further one is held against the robots.
    fn changed(&mut self, tick: u64, own: u64, is_add: bool) -> u64 {
        self.count += u64::from(is_add);
        let is_first = self.tick != tick;
        self.tick = tick;
        if is_first { self.count } else { own }
    }
}

impl KnownNames {
    fn of_world(worlds: &[World], name: &str) -> Result<Self, ScriptProblem> {
        let mut named = worlds.iter().filter(|w| w.name == name);
        let world = named.next().ok_or_else(|| ScriptProblem::World(name.to_owned()))?;
        if named.next().is_some() {
            return Err(ScriptProblem::SameWorld(name.to_owned()));
        }
        let others = world.places.iter().map(|p| &p.name).chain(world.marks.iter().map(|m| &m.name));
        let others = others.chain(world.robots.iter().map(|r| &r.name)).map(|name| (name, NamedThing::Other));
        let doors = world.doors.iter().map(|d| (&d.name, NamedThing::Door));
        let shapes = |obstacle: &Obstacle| NamedThing::Obstacle { shapes: obstacle.pieces.len() as u64 };
        let obstacles = world.obstacles.iter().map(|o| (&o.name, shapes(o)));
        let things = others.chain(doors).chain(obstacles).map(|(name, thing)| (name.clone(), thing)).collect();
        let pieces: usize = world.obstacles.iter().map(|o| o.pieces.len()).sum();
        let shapes = ChangedShapes { count: (pieces + world.doors.len()) as u64, tick: 0 };
        Ok(KnownNames { things, shapes })
    }
}

impl Event {
    pub(super) fn check(&self, before: u64) -> Result<(), ScriptProblem> {
        let Event { tick, input, .. } = self;
        check_tick(*tick, before)?;
        match input {
            RobotInput::Drive(a, b) => match [a, b].into_iter().find(|c| c.unsigned_abs() > MAX_CHANNEL.unsigned_abs())
            {
                Some(channel) => Err(ScriptProblem::Channel(*channel)),
                None => Ok(()),
            },
            RobotInput::MoveTo(q) | RobotInput::Teleport(q) => {
                if q.is_empty() || q.len() > MAX_COORDINATES {
                    return Err(ScriptProblem::Coordinates(q.len()));
                }
                check_coordinates(q.iter().copied())
            }
            RobotInput::SetTrailer(_) | RobotInput::Release => Ok(()),
        }
    }
}

impl Event {
    /// Checks whether robots of a kind with this name and description could ever apply the input.
    fn check_kind(&self, kind: &str, about: &'static RobotKind) -> Result<(), ScriptProblem> {
        let (input, coordinates) = match &self.input {
            RobotInput::MoveTo(q) | RobotInput::Teleport(q) => (self.input.kind(), Some(q.len())),
            _ => (self.input.kind(), None),
        };
        let unfit = || {
            let (tick, robot, kind, coordinates) =
                (self.tick, self.robot.clone(), kind.to_owned(), coordinates.unwrap_or(0));
            Box::new(UnfitInput { tick, robot, kind, input, coordinates, about })
        };
        if !about.takes.contains(&input) {
            return Err(ScriptProblem::NotTaken(unfit()));
        }
        match coordinates {
            Some(count) if about.space(count).is_none() => Err(ScriptProblem::NoConfiguration(unfit())),
            _ => Ok(()),
        }
    }

    /// Checks that a teleport leads within these bounds, those of the robot's world.
    fn check_within(&self, about: &RobotKind, bounds: &Aabb) -> Result<(), ScriptProblem> {
        match &self.input {
            RobotInput::Teleport(to) if RobotKind::of(about.name).is_some_and(RobotKind::has_place) => {
                let [x, y, ..] = to[..] else { return Ok(()) };
                check_target(Point2::new(x.value(), y.value()), bounds).map_err(|reason| {
                    let (tick, robot, reason) = (self.tick, self.robot.clone(), reason.to_string());
                    ScriptProblem::Outside { tick, robot, reason }
                })
            }
            _ => Ok(()),
        }
    }
}

/// Checks that the place where an input puts a robot lies within the world's bounds. One on a side of theirs does, even
/// where a script's units round it outward.
///
/// # Errors
/// [`OutsideError::Position`] of a `target`.
pub fn check_target(at: Point2, bounds: &Aabb) -> Result<(), OutsideError> {
    let down = |p: Point2| p.map(|x| (x * Quantized::UNITS).floor() / Quantized::UNITS);
    let up = |p: Point2| p.map(|x| (x * Quantized::UNITS).ceil() / Quantized::UNITS);
    if Aabb::new(down(bounds.min), up(bounds.max)).contains(at) {
        return Ok(());
    }
    OutsideError::check("target", at, bounds)
}

impl WorldEvent {
    /// Checks the change by itself, after one at the tick `before`.
    pub(crate) fn check(&self, before: u64) -> Result<(), ScriptProblem> {
        check_tick(self.tick, before)?;
        match &self.change {
            WorldChange::Close(_) | WorldChange::Open(_) | WorldChange::Remove(_) => Ok(()),
            WorldChange::Move { to: (x, y, theta), .. } => check_coordinates([*x, *y, *theta]),
            WorldChange::Add { name, points, radius } => {
                if check_name(name).is_err() {
                    return Err(ScriptProblem::Name(name.clone()));
                }
                if points.is_empty() || points.len() > MAX_COORDINATES {
                    return Err(ScriptProblem::Coordinates(points.len()));
                }
                check_coordinates(points.iter().flat_map(|(x, y)| [*x, *y]).chain([*radius]))?;
                let shape = self.change.added().transpose();
                shape.map(|_| ()).map_err(|error| ScriptProblem::Shape(error.to_string()))
            }
        }
    }
}

fn check_tick(tick: u64, before: u64) -> Result<(), ScriptProblem> {
    if !(1..=MAX_TICKS).contains(&tick) {
        return Err(ScriptProblem::Tick(tick));
    }
    if tick < before { Err(ScriptProblem::Order { tick, before }) } else { Ok(()) }
}

fn check_coordinates(coordinates: impl IntoIterator<Item = Quantized>) -> Result<(), ScriptProblem> {
    let most = (MAX_COORDINATE * Quantized::UNITS) as u64;
    match coordinates.into_iter().find(|c| c.0.unsigned_abs() > most) {
        Some(coordinate) => Err(ScriptProblem::Coordinate(coordinate.0)),
        None => Ok(()),
    }
}
