//! Long work of the session, a piece in every frame: going to another tick, opening a run, saving one.

use std::slice::from_ref;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use bevy::platform::time::Instant;
use bevy::prelude::*;

use super::error::SessionError;
use crate::window::ui::{Interface, Widget};
use crate::window::ui::{Notice, Working};
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{
    DifferingSecond, DigestComparison, DigestLog, DigestLogWriter, Divergence, Log, RunDigest, first_divergence,
};
use motion_lab_sim::simulation::{Keyframes, LatestFrame, Playback, Transport, TransportCommand, seek};

/// Time that each frame gives to the work.
const BUDGET: Duration = Duration::from_millis(25);

/// Largest number of robot-steps that are done at once. More are done aside.
const AT_ONCE: u64 = 20_000;

/// The work under way, if any.
#[derive(Resource, Default)]
pub struct Aside(Option<Work>);

/// A piece of work, and whether the run played when it began.
struct Work {
    what: What,
    playback: Playback,
}

enum What {
    /// Going to a tick.
    Seek { from: u64, to: u64 },
    /// Comparing the run under way with a recorded one.
    Check(Check),
    /// Recording a run again to save it.
    Save(Box<Save>),
}

/// A comparison of the run under way with a recorded one.
pub struct Check {
    name: String,
    recorded: Recorded,
    /// Words on the file's damage, if it is damaged.
    damage: Option<String>,
}

/// A recorded run, and the first place where the run under way differs from it.
pub enum Recorded {
    /// With all its frames.
    Frames(Box<Log>, Option<Divergence>),
    /// With a digest of each second.
    Digests(Box<DigestLog>, Box<RunDigest>, Option<DifferingSecond>),
}

/// A run recorded again, and who takes its bytes.
pub struct Save {
    recorder: Recorder,
    digest: RunDigest,
    /// In a mutex because a writer may be used by one thread at a time only.
    writer: Mutex<DigestLogWriter<Vec<u8>>>,
    ticks: u64,
    done: Done,
}

/// What takes a log's bytes and words on them, and says what came of it.
pub type Done = Box<dyn FnOnce(&[u8], String) -> Result<Notice, SessionError> + Send + Sync>;

impl Recorded {
    fn ticks(&self) -> u64 {
        match self {
            Recorded::Frames(log, _) => log.frames.len() as u64,
            Recorded::Digests(log, ..) => log.ticks,
        }
    }

    /// The first tick that differs, or may.
    fn differs_at(&self) -> Option<u64> {
        match self {
            Recorded::Frames(_, divergence) => divergence.as_ref().map(|d| d.tick),
            Recorded::Digests(_, _, difference) => difference.map(|d| d.first_tick),
        }
    }

    /// Compares the frame of the run under way.
    fn compare(&mut self, world: &World) {
        let frame = &world.resource::<LatestFrame>().0;
        match self {
            Recorded::Frames(log, divergence) => {
                let recorded = match frame.tick.checked_sub(1) {
                    None => Some(&log.initial),
                    Some(i) => log.frames.get(i as usize),
                };
                if let (None, Some(recorded)) = (&divergence, recorded) {
                    *divergence = first_divergence(from_ref(recorded), from_ref(frame)).map(|d| d.named(&log.config));
                }
            }
            Recorded::Digests(log, digest, difference) => {
                if frame.tick > 0 {
                    digest.tick(frame);
                }
                let mut comparison = DigestComparison::with(log);
                comparison.tick(frame.tick, digest);
                *difference = difference.or(comparison.difference().copied());
            }
        }
    }

    fn words(&self) -> String {
        let identical = self.differs_at().map_or(self.ticks(), |tick| tick.saturating_sub(1));
        match self {
            Recorded::Frames(_, Some(divergence)) => divergence.to_string(),
            Recorded::Digests(_, _, Some(difference)) => difference.to_string(),
            Recorded::Frames(log, None) => format!("bit-identical, {identical} of {}", log.config.ticks),
            Recorded::Digests(log, _, None) => format!("bit-identical, {identical} of {}", log.config.ticks),
        }
    }
}

impl Check {
    /// A comparison with a recorded run, whose first tick is the present one, 0.
    pub fn begin(world: &World, name: &str, mut recorded: Recorded, damage: Option<String>) -> Self {
        recorded.compare(world);
        Check { name: name.to_owned(), recorded, damage }
    }

    /// Goes to the first tick that differs, or to the start, aside if that takes long; says what came of it.
    fn ended(self, world: &mut World) -> Result<Notice, SessionError> {
        let differs = self.recorded.differs_at();
        let to = differs.unwrap_or(0);
        if !seek_aside(world, &TransportCommand::Seek(to)) {
            seek(world, to)?;
        }
        let mut text = format!("{}: {}", self.name, self.recorded.words());
        if let Some(damage) = &self.damage {
            text += &format!(" (its sealed beginning: {damage})");
        }
        Ok(Notice { text, is_error: differs.is_some() || self.damage.is_some() })
    }
}

impl Save {
    /// The recording of a run again, without frames, by a recorder at its start and a writer that has begun with the
    /// run's digest. `done` takes the log's bytes.
    pub fn begin(
        recorder: Recorder,
        digest: RunDigest,
        writer: DigestLogWriter<Vec<u8>>,
        ticks: u64,
        done: Done,
    ) -> Self {
        Save { recorder, digest, writer: Mutex::new(writer), ticks, done }
    }

    fn tick(&mut self) -> Result<(), SessionError> {
        let frame = self.recorder.step();
        self.digest.tick(frame);
        let writer = self.writer.get_mut().unwrap_or_else(PoisonError::into_inner);
        Ok(writer.tick(frame, &self.digest)?)
    }

    fn ended(self) -> Result<Notice, SessionError> {
        let digest = self.digest.digest();
        let writer = self.writer.into_inner().unwrap_or_else(PoisonError::into_inner);
        let bytes = writer.finish(digest)?;
        (self.done)(&bytes, format!("saved without its frames, {} ticks, digest {digest}", self.ticks))
    }
}

impl What {
    /// Does a tick of the work. Returns whether there is more.
    fn go_on(&mut self, world: &mut World) -> Result<bool, SessionError> {
        let tick = world.resource::<Transport>().tick;
        match self {
            What::Seek { to, .. } => {
                if tick != *to {
                    seek(world, next_on_the_way(world, *to))?;
                }
                Ok(world.resource::<Transport>().tick != *to)
            }
            What::Check(check) => {
                if tick < check.recorded.ticks() {
                    // a seek, so that observers of contacts hear nothing of the comparison
                    seek(world, tick + 1)?;
                    check.recorded.compare(world);
                }
                Ok(tick + 1 < check.recorded.ticks() && check.recorded.differs_at().is_none())
            }
            What::Save(save) => {
                if save.recorder.frame().tick < save.ticks {
                    save.tick()?;
                }
                Ok(save.recorder.frame().tick < save.ticks)
            }
        }
    }

    /// How far the work is, in words.
    fn words(&self, world: &World) -> String {
        let tick = world.resource::<Transport>().tick;
        match self {
            What::Seek { from, to } => {
                format!("going to tick {to}: {} of {}", tick.abs_diff(*from.min(&tick)), to.abs_diff(*from.min(to)))
            }
            What::Check(check) => format!("{}: comparing tick {tick} of {}", check.name, check.recorded.ticks()),
            What::Save(save) => format!("saving: tick {} of {}", save.recorder.frame().tick, save.ticks),
        }
    }

    /// Ends the work, which is done or was stopped. Returns what to say.
    fn end(self, world: &mut World, was_stopped: bool) -> Result<Option<Notice>, SessionError> {
        let plain = |text: String| Some(Notice { text, is_error: false });
        let tick = world.resource::<Transport>().tick;
        Ok(match self {
            What::Seek { to, .. } if was_stopped => plain(format!("stopped at tick {tick} on the way to {to}")),
            What::Seek { .. } => None,
            What::Check(check) if was_stopped => {
                plain(format!("{}: stopped at tick {tick}: bit-identical so far", check.name))
            }
            What::Check(check) => Some(check.ended(world)?),
            What::Save(_) if was_stopped => plain("not saved: stopped".into()),
            What::Save(save) => Some(save.ended()?),
        })
    }
}

/// The next tick on the way to `to` that costs at most one tick of simulation: a keyframe's, or the one that follows.
fn next_on_the_way(world: &World, to: u64) -> u64 {
    let now = world.resource::<Transport>().tick;
    let begins = way_begins(world, to);
    if begins == now { now + 1 } else { begins }
}

/// The tick from which on the way to `to` is simulated: the present one, or the last keyframe's where that is nearer or
/// `to` lies behind.
fn way_begins(world: &World, to: u64) -> u64 {
    let now = world.resource::<Transport>().tick;
    let keyframe = world.resource::<Keyframes>().before(to).map_or(0, |frame| frame.tick);
    if to < now || keyframe > now { keyframe } else { now }
}

/// Whether this number of ticks of the run under way takes so long that it is done aside.
pub fn is_long(world: &World, ticks: u64) -> bool {
    ticks.saturating_mul(world.resource::<LatestFrame>().0.robots.len() as u64) > AT_ONCE
}

/// Goes to another tick aside if that takes long. Returns whether it does; if not, the command is left to the run.
pub fn seek_aside(world: &mut World, command: &TransportCommand) -> bool {
    let Transport { tick: now, playback, .. } = *world.resource::<Transport>();
    // a run that stands only for a seek goes on playing after the seek that takes its place
    let under_way = world.resource::<Aside>().0.as_ref();
    let held = under_way.filter(|work| matches!(work.what, What::Seek { .. })).map(|work| work.playback);
    let (to, playback) = match command {
        TransportCommand::Seek(to) => (*to, held.unwrap_or(playback)),
        TransportCommand::StepBack => (now.saturating_sub(1), Playback::Paused),
        _ => return false,
    };
    let from = way_begins(world, to);
    if !is_long(world, to - from) {
        return false;
    }
    // a handle that is held asks for its tick in every frame; other work than a seek gives way aloud
    match &world.resource::<Aside>().0 {
        Some(Work { what: What::Seek { to: same, .. }, playback: kept }) if *same == to && *kept == playback => {}
        Some(Work { what: What::Seek { .. }, .. }) => begin(world, What::Seek { from, to }, playback),
        _ => {
            stop(world);
            begin(world, What::Seek { from, to }, playback);
        }
    }
    true
}

/// Compares the run under way with a recorded one: at once, or aside if that takes long. Returns what came of it, or
/// nothing yet.
pub fn check(world: &mut World, check: Check) -> Result<Option<Notice>, SessionError> {
    let ticks = check.recorded.ticks();
    work(world, What::Check(check), ticks, Playback::Paused)
}

/// Records a run again to save it: at once, or aside if that takes long. Returns what came of it, or nothing yet.
pub fn save(world: &mut World, save: Save) -> Result<Option<Notice>, SessionError> {
    let (ticks, playback) = (save.ticks, world.resource::<Transport>().playback);
    work(world, What::Save(Box::new(save)), ticks, playback)
}

fn work(world: &mut World, mut what: What, ticks: u64, playback: Playback) -> Result<Option<Notice>, SessionError> {
    if is_long(world, ticks) {
        begin(world, what, playback);
        return Ok(None);
    }
    while what.go_on(world)? {}
    what.end(world, false)
}

/// Begins some work, while there is none under way. The run stands while it goes on, and then has this playback.
fn begin(world: &mut World, what: What, playback: Playback) {
    world.resource_mut::<Transport>().playback = Playback::Paused;
    world.resource_mut::<Interface>().0.working = Some(Working { text: what.words(world), stop: false });
    world.resource_mut::<Aside>().0 = Some(Work { what, playback });
}

impl Aside {
    /// Whether there is work under way.
    pub fn is_under_way(&self) -> bool {
        self.0.is_some()
    }
}

/// Ends the work under way where it stands. A run that stood only for it plays again.
pub fn stop(world: &mut World) {
    if let Some(work) = world.resource_mut::<Aside>().0.take() {
        let ended = work.what.end(world, true);
        settle(world, ended, work.playback);
    }
}

/// Goes on with the work for a part of a frame.
pub fn go_on(world: &mut World) {
    let Some(mut work) = world.resource_mut::<Aside>().0.take() else { return };
    // a run that somebody let play goes its own way
    let was_stopped = world.resource::<Interface>().0.working.as_ref().is_some_and(|w| w.stop)
        || world.resource::<Transport>().playback == Playback::Playing;
    let start = Instant::now();
    let mut is_done = false;
    while !was_stopped && !is_done && start.elapsed() < BUDGET {
        match work.what.go_on(world) {
            Ok(more) => is_done = !more,
            Err(error) => return settle(world, Err(error), Playback::Paused),
        }
    }
    if is_done || was_stopped {
        let playback = if was_stopped { Playback::Paused } else { work.playback };
        let ended = work.what.end(world, was_stopped);
        settle(world, ended, playback);
    } else {
        let text = work.what.words(world);
        world.resource_mut::<Interface>().0.working = Some(Working { text, stop: false });
        world.resource_mut::<Aside>().0 = Some(work);
    }
}

/// Takes the words on the work away, says what came of it and lets the run play as before.
fn settle(world: &mut World, ended: Result<Option<Notice>, SessionError>, playback: Playback) {
    let failed = |error: SessionError| Some(Notice { text: error.to_string(), is_error: true });
    let notice = ended.unwrap_or_else(failed);
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    ui.working = None;
    if let Some(notice) = notice {
        // the work is the run's, whatever is in front meanwhile
        ui.say_in(Widget::Dashboard, notice);
    }
    world.resource_mut::<Transport>().playback = playback;
}
