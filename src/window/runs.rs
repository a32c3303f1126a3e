//! Runs and worlds as bytes, saved and opened for the window and the web page alike.

use bevy::ecs::world::World;

use super::aside::{self, Check, Done, Recorded, Save};
use super::error::SessionError;
use crate::window::ui::Interface;
use crate::window::ui::{AtlasState, Notice, Widget};
use motion_lab_core::random::Seed;
use motion_lab_sim::atlas::Editor;
use motion_lab_sim::recording::{Recorder, Run, RunError};
use motion_lab_sim::run::{DigestLog, DigestLogWriter, Log, LogError, MOST_ROBOTS_IN_FULL, ReadLog, RunDigest, Script};
use motion_lab_sim::simulation::{
    LatestFrame, PendingInput, Playback, RobotKinds, RunConfig, Transport, checkpoint, start_run,
};
use motion_lab_sim::tour::TourConfig;

/// All that determines a run.
pub struct ShownRun {
    /// The seed.
    pub seed: Seed,
    /// The configuration.
    pub config: TourConfig,
    /// The script.
    pub script: Script,
    /// The kinds of robots that the program registered.
    pub kinds: RobotKinds,
}

impl ShownRun {
    /// The run, recorded.
    pub fn record(self) -> Result<Log, RunError> {
        Run::record_with_robots(self.config, (self.seed, self.script), |app| self.kinds.add_to(app))
    }
}

/// The present run up to `ticks`.
pub fn shown_run(world: &World, ticks: u64) -> ShownRun {
    let config = TourConfig { ticks, ..TourConfig::clone(&world.resource::<RunConfig>().0) };
    let mut script: Script = world.resource::<PendingInput>().script().clone();
    script.truncate_after(ticks);
    let kinds = world.resource::<RobotKinds>().clone();
    ShownRun { seed: world.resource::<Transport>().seed, config, script, kinds }
}

/// The run up to `ticks`, recorded.
pub fn log_up_to(world: &World, ticks: u64) -> Result<Log, SessionError> {
    shown_run(world, ticks).record().map_err(SessionError::from)
}

/// The run as far as it has come, recorded from seed, configuration and script, and its log's bytes.
pub fn recorded(world: &World) -> Result<(Log, Vec<u8>), SessionError> {
    let Transport { frontier, .. } = *world.resource::<Transport>();
    if frontier == 0 {
        return Err(SessionError::NotRun);
    }
    let log = log_up_to(world, frontier)?;
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes)?;
    Ok((log, bytes))
}

/// Saves the run as far as it has come, as a log whose bytes `done` takes: with its frames up to 100 robots, with a
/// digest of each second above. Returns what came of it; nothing yet where it takes long and goes on aside.
pub fn save(world: &mut World, done: Done) -> Result<Option<Notice>, SessionError> {
    aside::stop(world);
    let Transport { frontier, .. } = *world.resource::<Transport>();
    if world.resource::<LatestFrame>().0.robots.len() > MOST_ROBOTS_IN_FULL && frontier > 0 {
        let ShownRun { seed, config, script, kinds } = shown_run(world, frontier);
        let recorder = Recorder::with_robots(config.clone(), (seed, script.clone()), |app| kinds.add_to(app))?;
        let digest = RunDigest::new(seed, &config, &script, recorder.frame());
        let writer = DigestLogWriter::new(Vec::new(), seed, &config, &script, &digest)?;
        return aside::save(world, Save::begin(recorder, digest, writer, config.ticks, done));
    }
    let (log, bytes) = recorded(world)?;
    done(&bytes, format!("saved, {} ticks, digest {}", log.frames.len(), log.digest())).map(Some)
}

/// Opens a log in place of the present run: simulates it again from its seed and script and compares every frame, or
/// the digest of every second.
///
/// The run is shown paused, at its start or at the first tick that differs. Where the log can't be read, the present
/// run stays. Returns what came of it; nothing yet where it takes long and goes on aside.
pub fn open_log(world: &mut World, name: &str, bytes: &[u8]) -> Result<Option<Notice>, SessionError> {
    let (log, damage) = read_log(bytes)?;
    aside::stop(world);
    checkpoint(world);
    let speed = world.resource::<Transport>().speed;
    let (seed, config, script) = match &log {
        EitherLog::Frames(log) => (log.seed, &log.config, &log.script),
        EitherLog::Digests(log) => (log.seed, &log.config, &log.script),
    };
    start_run(world, config.clone(), (seed, script.clone()))?;
    world.resource_mut::<Interface>().0.played = false;
    let mut transport = world.resource_mut::<Transport>();
    (transport.playback, transport.speed) = (Playback::Paused, speed);
    let recorded = match log {
        EitherLog::Frames(log) => Recorded::Frames(log, None),
        EitherLog::Digests(log) => {
            let digest = RunDigest::new(seed, &log.config, &log.script, &world.resource::<LatestFrame>().0);
            Recorded::Digests(log, Box::new(digest), None)
        }
    };
    let check = Check::begin(world, name, recorded, damage);
    aside::check(world, check)
}

/// A log of either kind.
enum EitherLog {
    Frames(Box<Log>),
    Digests(Box<DigestLog>),
}

/// The log in these bytes, or its sealed beginning and words on the damage.
fn read_log(bytes: &[u8]) -> Result<(EitherLog, Option<String>), LogError> {
    let frames = |log| EitherLog::Frames(Box::new(log));
    let digests = |log| EitherLog::Digests(Box::new(log));
    let error = match Log::read_mcap(bytes) {
        Ok(ReadLog { log, .. }) => return Ok((frames(log), None)),
        Err(LogError::NoFrames) => match DigestLog::read_mcap(bytes) {
            Ok(read) => return Ok((digests(read.log), None)),
            Err(error) => error,
        },
        Err(error) => error,
    };
    // said before the recovered part is taken out: the message names it
    let message = Some(error.to_string());
    match error {
        LogError::Damaged(mut damaged) => match damaged.recovered.take() {
            Some(read) => Ok((frames(read.log), message)),
            None => Err(LogError::Damaged(damaged)),
        },
        LogError::DamagedDigests(mut damaged) => match damaged.recovered.take() {
            Some(read) => Ok((digests(read.log), message)),
            None => Err(LogError::DamagedDigests(damaged)),
        },
        error => Err(error),
    }
}

/// The text of the plan's path as a file; `None` without a path of the planner's own.
pub fn path_text(world: &World) -> Option<String> {
    world.resource::<Interface>().0.plan.file()?.to_json().ok()
}

/// Opens the text of a path's file in the plan. Where it is refused, the present plan stays.
pub fn open_path_text(world: &mut World, name: &str, text: &str) -> Notice {
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    let atlas = ui.atlas.world().clone();
    match ui.plan.read(name, text, &atlas) {
        Ok(()) => {
            ui.widget = Widget::Plan;
            Notice { text: format!("{name}: opened"), is_error: false }
        }
        Err(error) => Notice { text: format!("{name}: not opened: {error}"), is_error: true },
    }
}

/// Opens a world file's text in the atlas. Where it is refused, the present one stays.
pub fn open_world_text(world: &mut World, name: &str, text: &str) -> Notice {
    match Editor::open(name, text) {
        Ok(editor) => {
            let ui = &mut world.resource_mut::<Interface>().into_inner().0;
            ui.open_world(AtlasState::edited(editor));
            ui.widget = Widget::Atlas;
            Notice { text: format!("{name}: opened"), is_error: false }
        }
        Err(error) => Notice { text: format!("{name}: not opened: {error}"), is_error: true },
    }
}
