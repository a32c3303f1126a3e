//! `History`, the run's past ticks, for plots and for marks on a time line.

use bevy::prelude::*;

use super::{LatestFrame, ResidesIn, RobotOps, RobotView, Roster, Transport, WorldScene};
use crate::collision::Collision;
use crate::configuration::Coordinates;
use crate::geometry::Pose2;

/// Largest number of samples; beyond it every second one is dropped. Half an hour at 20 Hz is kept in full.
const MOST_SAMPLES: usize = 36_000;

/// Displacement in one tick from which on a robot counts as put there rather than driven, metres.
const LEAP: f64 = 0.5;

/// A robot after one tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trail {
    /// The coordinates of its configuration.
    pub coordinates: Coordinates,
    /// Its distance from the nearest obstacle of its world, metres; 0 in contact, infinity where there is none.
    pub clearance: f64,
    /// Signed distance driven since the start, metres, negative for backward; 0 for an arm.
    pub travelled: f64,
    /// Distance by its wheels' encoders, the mean of both, metres; `None` without encoders.
    pub encoders: Option<f64>,
    /// Number of changes between forward and backward since the start.
    pub reversals: u32,
    /// Contact episodes since the start.
    pub contacts: u32,
    /// Whether a person drove it.
    pub manual: bool,
    /// Direction of its last motion: 1 forward, -1 backward, 0 before the first.
    direction: i8,
}

/// All robots after one tick.
#[derive(Clone, Debug, PartialEq)]
struct Sample {
    tick: u64,
    robots: Vec<Trail>,
}

/// An event of a robot that is marked on a time line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Happening {
    /// A contact began.
    Contact,
    /// A person took it over from its tour.
    Takeover,
}

/// A tick to be marked on a time line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TickMark {
    /// The tick.
    pub tick: u64,
    /// The robot's id.
    pub robot: u32,
    /// The event.
    pub what: Happening,
}

/// The run's history, tick by tick. It is filled as the run goes on, and kept when the run is taken back, so that the
/// ticks ahead are known too. Continuing from an earlier tick forgets the later ones.
///
/// The history is no part of the run: without this resource the simulation does the same. Long runs are thinned. Memory
/// is bounded, except for the marks.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct History {
    samples: Vec<Sample>,
    latest: Option<Sample>,
    marks: Vec<TickMark>,
    /// Samples are kept at the ticks that are multiples of 2 to this power.
    thinned: u32,
}

impl History {
    /// The robot with this id after the last sampled tick up to `tick`.
    pub fn at(&self, tick: u64, robot: u32) -> Option<&Trail> {
        let latest = self.latest.as_ref().filter(|s| s.tick == tick);
        let before = || self.samples.get(self.samples.partition_point(|s| s.tick <= tick).checked_sub(1)?);
        latest.or_else(before)?.robots.get(robot as usize)
    }

    /// The ticks at which something happened, in order.
    pub fn marks(&self) -> &[TickMark] {
        &self.marks
    }

    /// The tick of the first known contact that begins after `tick`.
    pub fn next_contact(&self, tick: u64) -> Option<u64> {
        self.marks.iter().find(|m| m.tick > tick && m.what == Happening::Contact).map(|m| m.tick)
    }

    /// At most about `most` samples of one robot, evenly spread over the run: each sample's tick and its `value`.
    pub fn series(&self, robot: u32, most: usize, value: impl Fn(&Trail) -> Option<f64>) -> Vec<(u64, f64)> {
        let every = self.samples.len().div_ceil(most.max(1)).max(1);
        let pick = |s: &Sample| Some((s.tick, value(s.robots.get(robot as usize)?)?));
        self.samples.iter().step_by(every).filter_map(pick).collect()
    }

    /// The number of samples kept.
    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    /// Forgets everything after `tick`.
    pub(super) fn truncate_after(&mut self, tick: u64) {
        self.samples.retain(|s| s.tick <= tick);
        self.marks.retain(|m| m.tick <= tick);
        self.latest = self.latest.take().filter(|s| s.tick <= tick);
    }

    /// Records the robots as they are now.
    pub(super) fn note(&mut self, world: &World) {
        let tick = world.resource::<Transport>().tick;
        let known = self.samples.binary_search_by_key(&tick, |s| s.tick);
        if let Ok(i) = known {
            // a run that was taken back repeats the same ticks
            self.latest = self.samples.get(i).cloned();
            return;
        }
        let before = self.latest.take().filter(|s| s.tick + 1 == tick);
        let robots: Vec<Trail> = super::view(world)
            .iter()
            .enumerate()
            .map(|(i, robot)| {
                let last = before.as_ref().and_then(|s| s.robots.get(i));
                Trail::after(last, robot, clearance(world, i).unwrap_or(f64::INFINITY))
            })
            .collect();
        let last_mark = self.marks.last().map_or(0, |m| m.tick);
        if let Some(before) = before.as_ref().filter(|_| tick > last_mark) {
            self.mark(tick, &before.robots, &robots);
        }
        let sample = Sample { tick, robots };
        let is_next = self.samples.last().is_none_or(|s| s.tick < tick);
        if is_next && tick.is_multiple_of(1 << self.thinned) {
            self.samples.push(sample.clone());
        }
        if self.samples.len() > MOST_SAMPLES {
            self.thinned += 1;
            self.samples.retain(|s| s.tick.is_multiple_of(1 << self.thinned));
        }
        self.latest = Some(sample);
    }

    fn mark(&mut self, tick: u64, before: &[Trail], after: &[Trail]) {
        for ((a, b), robot) in before.iter().zip(after).zip(0..) {
            let happened =
                [(b.contacts > a.contacts, Happening::Contact), (b.manual && !a.manual, Happening::Takeover)];
            let new = happened.into_iter().filter(|(is, _)| *is);
            self.marks.extend(new.map(|(_, what)| TickMark { tick, robot, what }));
        }
    }
}

/// The clearance of the robot with this id from its world's obstacles, metres; `None` for an unknown robot.
fn clearance(world: &World, robot: usize) -> Option<f64> {
    let entity = *world.resource::<Roster>().robots().get(robot)?;
    let footprint = (world.get::<RobotOps>(entity)?.footprint)(world, entity)?;
    Some(world.get::<WorldScene>(world.get::<ResidesIn>(entity)?.0)?.0.distance(&footprint))
}

impl Trail {
    fn after(last: Option<&Trail>, robot: &RobotView, clearance: f64) -> Self {
        let pose = |q: &Coordinates| match (q.get(..3), robot.tip) {
            (Some(&[x, y, theta]), None) => Some(Pose2 { x, y, theta }),
            _ => None,
        };
        let (mut travelled, mut reversals, mut direction) =
            last.map_or((0.0, 0, 0), |t| (t.travelled, t.reversals, t.direction));
        let way = last.and_then(|t| Some(pose(&robot.coordinates)?.boxminus(&pose(&t.coordinates)?).dx));
        if let Some(way) = way.filter(|d| d.abs() < LEAP) {
            travelled += way;
            // a robot held at a wall does not move, so its control is no change of direction
            if way.abs() > 1e-6 {
                let now = if way > 0.0 { 1 } else { -1 };
                reversals += u32::from(direction == -now);
                direction = now;
            }
        }
        Trail {
            coordinates: robot.coordinates.clone(),
            clearance,
            travelled,
            encoders: robot.odometer,
            reversals,
            contacts: robot.contacts,
            manual: robot.manual,
            direction,
        }
    }
}

/// Adds the state just recorded to the history, if the app keeps one.
pub(super) fn note_where_kept(world: &mut World) {
    if world.contains_resource::<History>() && !world.resource::<LatestFrame>().0.robots.is_empty() {
        world.resource_scope(|world, mut history: Mut<History>| history.note(world));
    }
}

/// Keeps a [`History`] of every run in this app.
#[derive(Clone, Copy, Debug, Default)]
pub struct HistoryPlugin;

impl Plugin for HistoryPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<History>();
    }
}

#[cfg(test)]
mod tests {
    use super::super::command::obey;
    use super::*;
    use crate::run::{RobotInput, Script};
    use crate::simulation::{SimulationPlugin, TransportCommand, seek, start_run, step};
    use crate::tour::{BOOK_SEED, TourConfig};

    fn app(script: Script) -> App {
        let mut app = App::new();
        app.add_plugins((SimulationPlugin, HistoryPlugin));
        start_run(app.world_mut(), TourConfig::default(), (BOOK_SEED, script)).unwrap();
        app
    }

    fn event(tick: u64, robot: &str, input: RobotInput) -> crate::run::Event {
        crate::run::Event { tick, robot: robot.into(), input }
    }

    #[test]
    fn it_counts_what_the_robots_themselves_count_and_survives_being_taken_back() {
        let mut app = app(Script::empty());
        let world = app.world_mut();
        (0..400).for_each(|_| step(world));
        let contacts: Vec<u32> = super::super::view(world).iter().map(|r| r.contacts).collect();
        let history = world.resource::<History>().clone();
        for (id, count) in (0_u32..).zip(&contacts) {
            let marked = history.marks().iter().filter(|m| m.robot == id && m.what == Happening::Contact).count();
            assert_eq!(marked, *count as usize, "robot {id}");
            assert_eq!(history.at(400, id).unwrap().contacts, *count);
        }
        assert!(contacts.iter().any(|c| *c > 0), "or nothing is tested");
        seek(world, 130).unwrap();
        assert_eq!(world.resource::<History>().samples(), 401, "what lies ahead is kept");
        seek(world, 400).unwrap();
        assert_eq!(*world.resource::<History>(), history);
        // continuing from a tick keeps the marks of that tick
        let ticks: Vec<u64> = history.marks().iter().map(|m| m.tick).collect();
        for tick in ticks.iter().rev().copied() {
            seek(world, tick).unwrap();
            obey(world, TransportCommand::ContinueFromHere).unwrap();
            let kept: Vec<u64> = world.resource::<History>().marks().iter().map(|m| m.tick).collect();
            assert_eq!(kept, ticks.iter().copied().filter(|t| *t <= tick).collect::<Vec<_>>());
        }
    }

    #[test]
    fn reversals_are_changes_of_the_way_that_was_gone() {
        let drive = |tick, v| event(tick, "Hitch", RobotInput::Drive(v, 0));
        // forward, stand, forward again (none), backward (1), forward (2)
        let events = vec![drive(1, 64), drive(11, 0), drive(16, 64), drive(21, -64), drive(31, 64)];
        let mut app = app(Script { events, ..Script::empty() });
        (0..40).for_each(|_| step(app.world_mut()));
        let history = app.world().resource::<History>();
        let at = |tick| history.at(tick, 2).unwrap();
        assert_eq!([10, 20, 25, 40].map(|t| at(t).reversals), [0, 0, 1, 2]);
        assert!(at(20).travelled > 0.1 && (at(40).travelled - at(20).travelled).abs() < 0.05, "there and back");
        assert_eq!(
            history.marks().iter().find(|m| m.robot == 2).map(|m| (m.tick, m.what)),
            Some((1, Happening::Takeover))
        );
    }

    #[test]
    fn encoders_turn_on_at_a_wall_while_the_way_does_not() {
        // Rusty drives straight ahead from its start until something holds it
        let mut app = app(Script { events: vec![event(1, "Rusty", RobotInput::Drive(128, 0))], ..Script::empty() });
        (0..600).for_each(|_| step(app.world_mut()));
        let history = app.world().resource::<History>();
        let (early, late) = (history.at(500, 0).unwrap(), history.at(600, 0).unwrap());
        assert!((late.travelled - early.travelled).abs() < 1e-3, "held");
        let turned = late.encoders.unwrap() - early.encoders.unwrap();
        assert!((turned - 3.0).abs() < 0.05, "5 s at 0.6 m/s roll 3 m, not {turned}");
        assert!(late.clearance > 0.0 && late.clearance < 1e-3);
    }

    #[test]
    fn continuing_forgets_what_came_after() {
        let mut app = app(Script::empty());
        let world = app.world_mut();
        (0..300).for_each(|_| step(world));
        obey(world, TransportCommand::Seek(100)).unwrap();
        obey(world, TransportCommand::ContinueFromHere).unwrap();
        let history = world.resource::<History>();
        assert_eq!(history.samples(), 101);
        assert!(history.marks().iter().all(|m| m.tick <= 100));
    }

    #[test]
    fn a_long_run_is_thinned_and_goes_on_counting() {
        let mut app = app(Script::empty());
        let world = app.world_mut();
        let trail = Trail { contacts: 0, ..Trail::default() };
        let sample = |tick| Sample { tick, robots: vec![trail.clone(); 3] };
        world.resource_mut::<History>().samples = (0..MOST_SAMPLES as u64).map(sample).collect();
        world.resource_mut::<History>().latest = Some(sample(MOST_SAMPLES as u64 - 1));
        world.resource_mut::<Transport>().tick = MOST_SAMPLES as u64 - 1;
        (0..2).for_each(|_| step(world));
        let history = world.resource::<History>();
        assert_eq!(history.samples(), MOST_SAMPLES / 2 + 1);
        assert!(history.samples.iter().all(|s| s.tick % 2 == 0));
        assert!(history.series(0, 100, |t| Some(t.travelled)).len() <= 101);
    }
}
