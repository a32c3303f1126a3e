//! Runs and worlds as bytes, saved and opened for the window and the web page alike.

use bevy::ecs::world::World;

use super::session::Interface;
use crate::atlas::Editor;
use crate::recording::Run;
use crate::run::{Log, LogError, ReadLog, Script, first_divergence};
use crate::simulation::{
    LatestFrame, PendingInput, Playback, RunConfig, Transport, TransportCommand, obey, seek, start_run, step,
};
use crate::tour::TourConfig;
use crate::ui::{AtlasState, Notice, number_of};

/// The run's configuration and script up to `ticks`.
pub fn shown_run(world: &World, ticks: u64) -> (TourConfig, Script) {
    let config = TourConfig { ticks, ..TourConfig::clone(&world.resource::<RunConfig>().0) };
    let mut script: Script = world.resource::<PendingInput>().script().clone();
    script.events.retain(|e| e.tick <= ticks);
    (config, script)
}

/// The run up to `ticks`, recorded.
pub fn log_up_to(world: &World, ticks: u64) -> Result<Log, String> {
    let (config, script) = shown_run(world, ticks);
    Run::record(config, (world.resource::<Transport>().seed, script)).map_err(|e| e.to_string())
}

/// The run as far as it has come, recorded from seed, configuration and script, and its log's bytes.
pub fn recorded(world: &World) -> Result<(Log, Vec<u8>), String> {
    let Transport { frontier, .. } = *world.resource::<Transport>();
    if frontier == 0 {
        return Err("nothing has been run yet; press Play first".into());
    }
    let log = log_up_to(world, frontier)?;
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes).map_err(|e| e.to_string())?;
    Ok((log, bytes))
}

/// Opens a log in place of the present run: simulates it again from its seed and script and compares every frame.
///
/// The run is shown paused, at its start or at the first tick that differs. Where the log can't be read, the present
/// run stays.
pub fn open_log(world: &mut World, name: &str, bytes: &[u8]) -> Result<Notice, String> {
    let (log, damage) = match Log::read_mcap(bytes) {
        Ok(ReadLog { log, .. }) => (log, None),
        Err(LogError::Damaged(damaged)) => {
            let message = damaged.to_string();
            let read = damaged.recovered.ok_or_else(|| message.clone())?;
            (read.log, Some(message))
        }
        Err(error) => return Err(error.to_string()),
    };
    obey(world, TransportCommand::Checkpoint)?;
    let speed = world.resource::<Transport>().speed;
    let ticks = log.frames.len() as u64;
    start_run(world, log.config.clone(), (log.seed, log.script.clone())).map_err(|e| e.to_string())?;
    let here = |world: &World, frame| {
        first_divergence(std::slice::from_ref(frame), std::slice::from_ref(&world.resource::<LatestFrame>().0))
    };
    let mut divergence = here(world, &log.initial);
    for frame in &log.frames {
        step(world);
        divergence = divergence.or_else(|| here(world, frame));
    }
    let tick = divergence.as_ref().map_or(0, |d| d.tick);
    seek(world, tick).map_err(|e| e.to_string())?;
    let mut transport = world.resource_mut::<Transport>();
    (transport.playback, transport.speed) = (Playback::Paused, speed);
    let mut text = match &divergence {
        None => format!("{name}: bit-identical, {ticks} of {}", log.config.ticks),
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
            ui.atlas = AtlasState::edited(editor).in_mode(ui.atlas.mode);
            ui.widget = number_of("atlas").unwrap_or(0);
            Notice { text: format!("{name}: opened"), is_error: false }
        }
        Err(error) => Notice { text: format!("{name}: not opened: {error}"), is_error: true },
    }
}
