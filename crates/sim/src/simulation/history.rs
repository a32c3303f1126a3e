//! `History`, the run's past ticks, for plots and for marks on a time line.

use bevy::prelude::*;

use super::past::trail::Trail;
use super::roster::footprint_of;
use super::{LatestFrame, ResidesIn, RobotOps, Roster, Transport, WorldScene};
use motion_lab_core::collision::Collision;
use motion_lab_core::geometry::Point2;

/// Largest number of samples; beyond it every second one is dropped. Half an hour at 20 Hz is kept in full.
const MAX_SAMPLES: usize = 36_000;

/// Largest size of all samples together, bytes; beyond it they are thinned.
const BUDGET: usize = 96_000_000;

/// Largest number of marks; beyond it every second one is dropped.
const MAX_MARKS: usize = 1 << 19;

/// Largest number of robots that are measured after every tick. More are measured only where a sample is kept.
const MAX_MEASURED: usize = 100;

/// How far apart the first samples of more robots lie, ticks: a second.
const SECOND: u64 = 20;

/// All robots after one tick.
#[derive(Clone, Debug, PartialEq)]
struct Sample {
    tick: u64,
    robots: Vec<Trail>,
}

/// An event of a robot that is marked on a time line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Happening {
    /// A contact began.
    Contact,
    /// A person took it over from its tour.
    Takeover,
}

/// A tick to be marked on a time line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TickMark {
    /// The tick.
    pub tick: u64,
    /// The robot's id.
    pub robot: u32,
    /// The event.
    pub what: Happening,
    /// Where the robot was: the middle of the box around its footprint, metres.
    pub at: Point2,
}

/// The run's history, tick by tick. It is filled as the run goes on, and kept when the run is taken back, so that the
/// ticks ahead are known too. Continuing from an earlier tick forgets the later ones.
///
/// The history is no part of the run: without this resource the simulation does the same.
///
/// Memory is bounded. Of up to 31 robots or so every tick's sample is kept for half an hour; then, each time there are
/// more than 36,000 samples, every second one is dropped. Where the samples take more than 96 MB they are thinned to
/// every second tick, every fourth, one a second, one every five seconds, and from then on by halves. More than 100
/// robots begin with one a second; between samples their clearance and their encoders are those of the last one. Of
/// more than 2^19 marks every second one is dropped.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct History {
    samples: Vec<Sample>,
    latest: Option<Sample>,
    marks: Vec<TickMark>,
    /// Samples are kept at the multiples of this many ticks.
    every: u64,
    /// The size of the samples, bytes.
    bytes: usize,
    budget: usize,
}

impl Default for History {
    fn default() -> Self {
        History { samples: Vec::new(), latest: None, marks: Vec::new(), every: 1, bytes: 0, budget: BUDGET }
    }
}

impl Sample {
    fn bytes(&self) -> usize {
        // lists grow by doubling
        2 * size_of::<Sample>() + self.robots.iter().map(Trail::bytes).sum::<usize>()
    }
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
        let after = self.marks.partition_point(|m| m.tick <= tick);
        self.marks.get(after..)?.iter().find(|m| m.what == Happening::Contact).map(|m| m.tick)
    }

    /// At most about `most` samples of one robot, evenly spread over the run: each sample's tick and its `value`.
    pub fn series(&self, robot: u32, most: usize, value: impl Fn(&Trail) -> Option<f64>) -> Vec<(u64, f64)> {
        let every = self.samples.len().div_ceil(most.max(1)).max(1);
        let pick = |s: &Sample| Some((s.tick, value(s.robots.get(robot as usize)?)?));
        self.samples.iter().step_by(every).filter_map(pick).collect()
    }

    /// The samples of one robot in a span of ticks, oldest first.
    pub fn span(&self, robot: u32, ticks: std::ops::RangeInclusive<u64>) -> impl Iterator<Item = &Trail> {
        let first = self.samples.partition_point(|s| s.tick < *ticks.start());
        let in_span = self.samples[first..].iter().take_while(move |s| s.tick <= *ticks.end());
        in_span.filter_map(move |s| s.robots.get(robot as usize))
    }

    /// The number of samples kept.
    pub fn samples(&self) -> usize {
        self.samples.len()
    }

    /// The memory that samples and marks take, bytes: an estimate from the lengths of the lists, rather too high.
    pub fn bytes(&self) -> usize {
        let latest = self.latest.as_ref().map_or(0, Sample::bytes);
        self.bytes + latest + 2 * size_of_val(&self.marks[..])
    }

    /// Forgets everything after `tick`.
    pub(super) fn truncate_after(&mut self, tick: u64) {
        self.retain(|s| s <= tick);
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
        let states = &world.resource::<LatestFrame>().frame().robots;
        let are_many = states.len() > MAX_MEASURED;
        if are_many && self.samples.is_empty() && self.every < SECOND {
            self.every = SECOND;
        }
        let is_kept = self.samples.last().is_none_or(|s| s.tick < tick) && tick.is_multiple_of(self.every);
        let before = self.latest.take().filter(|s| s.tick + 1 == tick);
        let follows = before.is_some();
        let is_marked = follows && self.marks.last().is_none_or(|m| m.tick < tick);
        let new = || Sample { tick, robots: vec![Trail::default(); states.len()] };
        let mut sample = Sample { tick, ..before.unwrap_or_else(new) };
        for ((trail, state), robot) in sample.robots.iter_mut().zip(states).zip(0..) {
            let (contacts, manual) = (trail.contacts, trail.manual);
            trail.follow(state);
            if is_marked {
                let happened =
                    [(trail.contacts > contacts, Happening::Contact), (trail.manual && !manual, Happening::Takeover)];
                let new = happened.into_iter().filter(|(is, _)| *is);
                self.marks.extend(new.map(|(_, what)| TickMark { tick, robot, what, at: middle(world, robot) }));
            }
            if !are_many || is_kept || !follows {
                measure(world, robot as usize, trail);
            }
        }
        self.thin_marks();
        if is_kept {
            self.bytes += sample.bytes();
            self.samples.push(sample.clone());
            self.thin();
        }
        self.latest = Some(sample);
    }

    /// Drops samples until the others are few and small enough.
    fn thin(&mut self) {
        while self.samples.len() > 1 && (self.samples.len() > MAX_SAMPLES || self.bytes > self.budget) {
            let is_by_size = self.samples.len() <= MAX_SAMPLES;
            // every keyframe's tick must have its sample, for the trails to go on from there: up to five seconds the
            // distance divides that of the first keyframes, and beyond it the larger keyframes are thinned before
            let times = if is_by_size && self.every < 5 * SECOND && self.every >= 4 { 5 } else { 2 };
            let every = self.every * times;
            self.every = every;
            self.retain(|tick| tick.is_multiple_of(every));
        }
    }

    /// Keeps the samples of the ticks that `keep` says.
    fn retain(&mut self, keep: impl Fn(u64) -> bool) {
        self.samples.retain(|s| keep(s.tick));
        self.bytes = self.samples.iter().map(Sample::bytes).sum();
    }

    /// Drops every second mark when there are too many, and never the last.
    fn thin_marks(&mut self) {
        if self.marks.len() > MAX_MARKS {
            let mut stays = self.marks.len().is_multiple_of(2);
            self.marks.retain(|_| {
                stays = !stays;
                stays
            });
        }
    }
}

/// The middle of the box around the robot with this id; the origin for one without a footprint.
fn middle(world: &World, robot: u32) -> Point2 {
    footprint_of(world, robot).and_then(|f| f.bounds()).map_or(Point2::origin(), |b| b.centre())
}

/// Reads the gauges of the robot with this id. An unknown robot has none.
fn measure(world: &World, robot: usize, trail: &mut Trail) {
    let entity = world.resource::<Roster>().robots().get(robot).copied();
    let gauges = entity.and_then(|e| (world.get::<RobotOps>(e)?.gauges)(world, e));
    let (Some(entity), Some(gauges)) = (entity, gauges) else { return };
    let scene = world.get::<ResidesIn>(entity).and_then(|on| world.get::<WorldScene>(on.0));
    trail.read(&gauges, scene.map_or(f64::INFINITY, |scene| scene.0.distance(&gauges.footprint)));
}

/// Adds the state just recorded to the history, if the app keeps one.
pub(super) fn note_if_history(world: &mut World) {
    if world.contains_resource::<History>() && !world.resource::<LatestFrame>().frame().robots.is_empty() {
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
mod tests;
