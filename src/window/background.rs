//! Long work of the session, a piece in every frame: going to another tick, opening a run, saving one.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use bevy::platform::time::Instant;
use bevy::prelude::*;

use super::error::SessionError;
use super::explained::explained;
use crate::window::ui::{Interface, Notice, Working};
use motion_lab_sim::avoid::{Explaining, Explanation};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::recording::Recorder;
use motion_lab_sim::run::{Comparison, Difference, Log, LogWriter};
use motion_lab_sim::simulation::{Keyframes, LatestFrame, Playback, Transport, TransportCommand, seek};

/// Time that each frame gives to the work.
const BUDGET: Duration = Duration::from_millis(25);

/// Largest number of robot-steps that are done at once. More are done in the background.
const AT_ONCE: u64 = 20_000;

/// The work under way, if any.
#[derive(Resource, Default)]
pub struct Background(Option<BackgroundWork>);

/// A piece of work, and whether the run played when it began.
struct BackgroundWork {
    job: Job,
    playback: Playback,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Finish {
    Done,
    Stopped,
}

/// What is done piece by piece.
enum Job {
    /// Going to a tick.
    Seek { from: u64, to: u64 },
    /// Comparing the run under way with a recorded one.
    Check(Check),
    /// Recording a run again to save it.
    Save(Box<Save>),
    /// Explaining a contact.
    Explain(Box<Explain>),
}

/// The explanation of a contact of a robot, under way and then done.
struct Explain {
    robot: String,
    under_way: Explaining,
    explanation: Option<Explanation>,
}

/// A comparison of the run under way with a recorded one.
pub struct Check {
    name: String,
    comparison: Box<Comparison<Log>>,
    /// Words on the file's damage, if it is damaged.
    damage: Option<String>,
}

/// A run recorded again, and who takes its bytes.
pub struct Save {
    recorder: Recorder,
    /// In a mutex because a writer may be used by one thread at a time only.
    writer: Mutex<LogWriter<Vec<u8>>>,
    ticks: u64,
    done: Done,
}

/// What takes a log's bytes and words on them, and says what came of it.
pub type Done = Box<dyn FnOnce(&[u8], String) -> Result<Notice, SessionError> + Send + Sync>;

impl Check {
    /// A comparison with a recorded run, whose tick 0 is compared.
    pub fn begin(name: &str, comparison: Comparison<Log>, damage: Option<String>) -> Self {
        Check { name: name.to_owned(), comparison: Box::new(comparison), damage }
    }

    fn words(&self) -> String {
        let (identical, of) = (self.comparison.identical(), self.comparison.log().recipe.config.ticks);
        match self.comparison.difference() {
            Some(difference) => difference.to_string(),
            None => format!("bit-identical, {identical} of {of}"),
        }
    }

    /// Goes to the first tick that differs, or to the start, in the background if that takes long; says what came of
    /// it.
    fn ended(self, world: &mut World) -> Result<Notice, SessionError> {
        let differs = self.comparison.difference().map(Difference::first_tick);
        let to = differs.unwrap_or(0);
        if !seek_in_background(world, &TransportCommand::Seek(to)) {
            seek(world, to)?;
        }
        let mut text = format!("{}: {}", self.name, self.words());
        if let Some(damage) = &self.damage {
            text += &format!(" (its sealed beginning: {damage})");
        }
        Ok(Notice { text, is_error: differs.is_some() || self.damage.is_some() })
    }
}

impl Save {
    /// The recording of a run again, without frames, by a recorder at its start and a writer that has begun. `done`
    /// takes the log's bytes.
    pub fn begin(recorder: Recorder, writer: LogWriter<Vec<u8>>, ticks: u64, done: Done) -> Self {
        Save { recorder, writer: Mutex::new(writer), ticks, done }
    }

    fn tick(&mut self) -> Result<(), SessionError> {
        let writer = self.writer.get_mut().unwrap_or_else(PoisonError::into_inner);
        Ok(writer.tick(self.recorder.step())?)
    }

    fn ended(self) -> Result<Notice, SessionError> {
        let writer = self.writer.into_inner().unwrap_or_else(PoisonError::into_inner);
        let digest = writer.digest();
        let bytes = writer.finish()?;
        (self.done)(&bytes, format!("saved without its frames, {} ticks, digest {digest}", self.ticks))
    }
}

impl Job {
    /// Does a tick of the work. Returns whether there is more.
    fn step(&mut self, world: &mut World) -> Result<bool, SessionError> {
        let tick = world.resource::<Transport>().tick();
        match self {
            Job::Seek { to, .. } => {
                if tick != *to {
                    seek(world, next_on_the_way(world, *to))?;
                }
                Ok(world.resource::<Transport>().tick() != *to)
            }
            Job::Check(check) => {
                let ticks = check.comparison.log().ticks();
                if tick < ticks {
                    // a seek, so that observers of contacts hear nothing of the comparison
                    seek(world, tick + 1)?;
                    check.comparison.tick(world.resource::<LatestFrame>().frame());
                }
                Ok(tick + 1 < ticks && check.comparison.difference().is_none())
            }
            Job::Save(save) => {
                if save.recorder.frame().tick < save.ticks {
                    save.tick()?;
                }
                Ok(save.recorder.frame().tick < save.ticks)
            }
            Job::Explain(explain) => {
                explain.explanation = explain.under_way.step()?;
                Ok(explain.explanation.is_none())
            }
        }
    }

    /// How far the work is, in words.
    fn words(&self, world: &World) -> String {
        let tick = world.resource::<Transport>().tick();
        match self {
            Job::Seek { from, to } => {
                format!("going to tick {to}: {} of {}", tick.abs_diff(*from.min(&tick)), to.abs_diff(*from.min(to)))
            }
            Job::Check(check) => {
                format!("{}: comparing tick {tick} of {}", check.name, check.comparison.log().ticks())
            }
            Job::Save(save) => format!("saving: tick {} of {}", save.recorder.frame().tick, save.ticks),
            Job::Explain(explain) => {
                format!("looking for a way out of {}: {} ticks", explain.robot, explain.under_way.ticks())
            }
        }
    }

    /// Ends the job. Returns what to say.
    fn finish(self, world: &mut World, finish: Finish) -> Result<Option<Notice>, SessionError> {
        let plain = |text: String| Some(Notice { text, is_error: false });
        let tick = world.resource::<Transport>().tick();
        let was_stopped = finish == Finish::Stopped;
        Ok(match self {
            Job::Seek { to, .. } if was_stopped => plain(format!("stopped at tick {tick} on the way to {to}")),
            Job::Seek { .. } => None,
            Job::Check(check) if was_stopped => {
                plain(format!("{}: stopped at tick {tick}: bit-identical so far", check.name))
            }
            Job::Check(check) => Some(check.ended(world)?),
            Job::Save(_) if was_stopped => plain("not saved: stopped".into()),
            Job::Save(save) => Some(save.ended()?),
            Job::Explain(explain) => match explain.explanation {
                Some(explanation) if !was_stopped => {
                    explained(world, &explanation);
                    None
                }
                _ => plain(format!("stopped looking for a way out of {}", explain.robot)),
            },
        })
    }
}

/// The next tick on the way to `to` that costs at most one tick of simulation: a keyframe's, or the one that follows.
fn next_on_the_way(world: &World, to: u64) -> u64 {
    let now = world.resource::<Transport>().tick();
    let begins = way_begins(world, to);
    if begins == now { now + 1 } else { begins }
}

/// The tick from which on the way to `to` is simulated: the present one, or the last keyframe's where that is nearer or
/// `to` lies behind.
fn way_begins(world: &World, to: u64) -> u64 {
    let now = world.resource::<Transport>().tick();
    let keyframe = world.resource::<Keyframes>().before(to).map_or(0, |frame| frame.tick);
    if to < now || keyframe > now { keyframe } else { now }
}

/// Whether this number of ticks of the run under way takes so long that it is done in the background.
pub fn is_long(world: &World, ticks: u64) -> bool {
    ticks.saturating_mul(world.resource::<LatestFrame>().frame().robots.len() as u64) > AT_ONCE
}

/// Goes to another tick in the background if that takes long. Returns whether it does; if not, the command is left to
/// the run.
pub fn seek_in_background(world: &mut World, command: &TransportCommand) -> bool {
    let transport = world.resource::<Transport>();
    let (now, playback) = (transport.tick(), transport.playback);
    // a run that stands only for a seek goes on playing after the seek that takes its place
    let under_way = world.resource::<Background>().0.as_ref();
    let held = under_way.filter(|work| matches!(work.job, Job::Seek { .. })).map(|work| work.playback);
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
    match &world.resource::<Background>().0 {
        Some(BackgroundWork { job: Job::Seek { to: same, .. }, playback: then })
            if *same == to && *then == playback => {}
        Some(BackgroundWork { job: Job::Seek { .. }, .. }) => begin(world, Job::Seek { from, to }, playback),
        _ => {
            stop(world);
            begin(world, Job::Seek { from, to }, playback);
        }
    }
    true
}

/// Compares the run under way with a recorded one: at once, or in the background if that takes long. Returns what came
/// of it, or nothing yet.
pub fn check(world: &mut World, check: Check) -> Result<Option<Notice>, SessionError> {
    let ticks = check.comparison.log().ticks();
    run_or_defer(world, Job::Check(check), ticks, Playback::Paused)
}

/// Records a run again to save it: at once, or in the background if that takes long. Returns what came of it, or
/// nothing yet.
pub fn save(world: &mut World, save: Save) -> Result<Option<Notice>, SessionError> {
    let (ticks, playback) = (save.ticks, world.resource::<Transport>().playback);
    run_or_defer(world, Job::Save(Box::new(save)), ticks, playback)
}

/// Explains a contact of a robot, in the frames to come. The run then plays or stands as before.
pub fn explain(world: &mut World, under_way: Explaining, robot: &str) {
    let playback = world.resource::<Transport>().playback;
    let explain = Explain { robot: robot.to_owned(), under_way, explanation: None };
    begin(world, Job::Explain(Box::new(explain)), playback);
}

/// Does a job of this number of ticks at once, or defers it to the frames to come if that takes long.
fn run_or_defer(
    world: &mut World,
    mut job: Job,
    ticks: u64,
    playback: Playback,
) -> Result<Option<Notice>, SessionError> {
    if is_long(world, ticks) {
        begin(world, job, playback);
        return Ok(None);
    }
    while job.step(world)? {}
    job.finish(world, Finish::Done)
}

/// Begins a job, while there is none under way. The run stands while it goes on, and then has this playback.
fn begin(world: &mut World, job: Job, playback: Playback) {
    world.resource_mut::<Transport>().playback = Playback::Paused;
    world.resource_mut::<Interface>().0.working = Some(Working { text: job.words(world), stop: false });
    world.resource_mut::<Background>().0 = Some(BackgroundWork { job, playback });
}

impl Background {
    /// Whether there is work under way.
    pub fn is_under_way(&self) -> bool {
        self.0.is_some()
    }
}

/// Ends the work under way where it stands. A run that stood only for it plays again.
pub fn stop(world: &mut World) {
    if let Some(work) = world.resource_mut::<Background>().0.take() {
        let ended = work.job.finish(world, Finish::Stopped);
        settle(world, ended, work.playback);
    }
}

/// Goes on with the job for a part of a frame.
pub fn go_on(world: &mut World) {
    let Some(mut work) = world.resource_mut::<Background>().0.take() else { return };
    // a run that somebody let play goes its own way
    let was_stopped = world.resource::<Interface>().0.working.as_ref().is_some_and(|w| w.stop)
        || world.resource::<Transport>().playback == Playback::Playing;
    let start = Instant::now();
    let mut is_done = false;
    while !was_stopped && !is_done && start.elapsed() < BUDGET {
        match work.job.step(world) {
            Ok(more) => is_done = !more,
            Err(error) => return settle(world, Err(error), Playback::Paused),
        }
    }
    if is_done || was_stopped {
        let (playback, finish) =
            if was_stopped { (Playback::Paused, Finish::Stopped) } else { (work.playback, Finish::Done) };
        let ended = work.job.finish(world, finish);
        settle(world, ended, playback);
    } else {
        let text = work.job.words(world);
        world.resource_mut::<Interface>().0.working = Some(Working { text, stop: false });
        world.resource_mut::<Background>().0 = Some(work);
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
