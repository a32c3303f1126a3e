//! Runs and worlds as bytes, saved and opened for the window and the web page alike.

use bevy::ecs::world::World;

use super::error::SessionError;
use super::session::Interface;
use crate::atlas::Editor;
use crate::random::Seed;
use crate::recording::{Run, RunError};
use crate::run::{Comparison, Log, LogError, ReadLog, Script};
use crate::simulation::{
    LatestFrame, PendingInput, Playback, RobotKinds, RunConfig, Transport, checkpoint, seek, start_run,
};
use crate::tour::TourConfig;
use crate::ui::{AtlasState, Notice, Widget};

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

/// Opens a log in place of the present run: simulates it again from its seed and script and compares every frame.
///
/// The run is shown paused, at its start or at the first tick that differs. Where the log can't be read, the present
/// run stays.
pub fn open_log(world: &mut World, name: &str, bytes: &[u8]) -> Result<Notice, SessionError> {
    let (log, damage) = match Log::read_mcap(bytes) {
        Ok(ReadLog { log, .. }) => (log, None),
        Err(LogError::Damaged(mut damaged)) => {
            // said before the recovered part is taken out: the message names it
            let message = damaged.to_string();
            match damaged.recovered.take() {
                Some(read) => (read.log, Some(message)),
                None => return Err(LogError::Damaged(damaged).into()),
            }
        }
        Err(error) => return Err(error.into()),
    };
    checkpoint(world);
    let speed = world.resource::<Transport>().speed;
    start_run(world, log.config.clone(), (log.seed, log.script.clone()))?;
    let mut comparison = Comparison::with(&log);
    comparison.frame(&world.resource::<LatestFrame>().0);
    for _ in &log.frames {
        // a seek, so that observers of contacts hear nothing of the comparison
        let next = world.resource::<Transport>().tick + 1;
        seek(world, next)?;
        comparison.frame(&world.resource::<LatestFrame>().0);
    }
    let divergence = comparison.divergence();
    let tick = divergence.map_or(0, |d| d.tick);
    seek(world, tick)?;
    let mut transport = world.resource_mut::<Transport>();
    (transport.playback, transport.speed) = (Playback::Paused, speed);
    let mut text = match divergence {
        None => format!("{name}: bit-identical, {} of {}", comparison.identical(), log.config.ticks),
        Some(divergence) => format!("{name}: {divergence}"),
    };
    if let Some(damage) = &damage {
        text += &format!(" (its sealed beginning: {damage})");
    }
    Ok(Notice { text, is_error: divergence.is_some() || damage.is_some() })
}

/// Opens a world file's text in the atlas. Where it is refused, the present one stays.
pub fn open_world_text(world: &mut World, name: &str, text: &str) -> Notice {
    match Editor::open(name, text) {
        Ok(editor) => {
            let ui = &mut world.resource_mut::<Interface>().into_inner().0;
            ui.atlas = AtlasState::edited(editor).like(&ui.atlas);
            ui.widget = Widget::Atlas;
            Notice { text: format!("{name}: opened"), is_error: false }
        }
        Err(error) => Notice { text: format!("{name}: not opened: {error}"), is_error: true },
    }
}
