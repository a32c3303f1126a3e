//! Runs as files: saved, opened, dropped on the window.

use std::fs;
use std::path::Path;

use bevy::ecs::world::World;

use super::session::Interface;
use crate::atlas::Editor;
use crate::output::write_file;
use crate::random::Seed;
use crate::recording::Run;
use crate::run::{Log, LogError, ReadLog, Script, first_divergence};
use crate::simulation::{
    LatestFrame, PendingInput, Playback, RunConfig, Transport, TransportCommand, obey, seek, start_run, step,
};
use crate::tour::TourConfig;
use crate::ui::{AtlasState, Notice};

/// The greatest size of a log that the window opens, bytes.
const MOST_BYTES: u64 = 1 << 30;

/// The greatest size of a world file that the window opens, bytes.
const MOST_WORLD: u64 = 16 << 20;

/// The atlas's number on the rail.
const ATLAS: usize = 3;

/// Saves the run as far as it has come: its log, recorded from seed, configuration and script, whole or not at all.
pub fn save_run(world: &World, path: &Path) -> Notice {
    match save(world, path) {
        Ok(text) => Notice { text, is_error: false },
        Err(error) => Notice { text: format!("{}: not saved: {error}", path.display()), is_error: true },
    }
}

/// What determines the run as far as it has come: its configuration with so many ticks, its seed and its script.
pub fn so_far(world: &World) -> (TourConfig, (Seed, Script)) {
    let Transport { seed, frontier, .. } = *world.resource::<Transport>();
    let config = TourConfig { ticks: frontier, ..TourConfig::clone(&world.resource::<RunConfig>().0) };
    let mut script = world.resource::<PendingInput>().script().clone();
    script.events.retain(|e| e.tick <= frontier);
    (config, (seed, script))
}

fn save(world: &World, path: &Path) -> Result<String, String> {
    let (config, input) = so_far(world);
    let frontier = config.ticks;
    if frontier == 0 {
        return Err("nothing has been run yet; press Play first".into());
    }
    let log = Run::record(config, input).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes).map_err(|e| e.to_string())?;
    write_file(path, &bytes).map_err(|e| e.to_string())?;
    Ok(format!("{}: saved, {frontier} ticks, digest {}", name(path), log.digest()))
}

/// Opens a run in place of the present one: simulates it again from its seed and script, compares every frame, and shows it
/// from its start, or at the first tick that differs. Paused. Where the file can't be read, the present run stays.
pub fn open_run(world: &mut World, path: &Path) -> Notice {
    match open(world, path) {
        Ok(notice) => notice,
        Err(error) => Notice { text: format!("{}: not opened: {error}", path.display()), is_error: true },
    }
}

fn open(world: &mut World, path: &Path) -> Result<Notice, String> {
    let length = fs::metadata(path).map_err(|e| e.to_string())?.len();
    if length > MOST_BYTES {
        return Err(format!("{length} bytes: the window opens at most {MOST_BYTES}"));
    }
    let bytes = fs::read(path).map_err(|e| e.to_string())?;
    let (log, damage) = match Log::read_mcap(&bytes) {
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
        None => format!("{}: bit-identical, {ticks} of {}", name(path), log.config.ticks),
        Some(divergence) => format!("{}: {divergence}", name(path)),
    };
    if let Some(damage) = &damage {
        text += &format!(" (its sealed beginning: {damage})");
    }
    Ok(Notice { text, is_error: divergence.is_some() || damage.is_some() })
}

/// Opens a world file in the atlas. Where it is refused, the present one stays.
pub fn open_world(world: &mut World, path: &Path) -> Notice {
    let refused = |error: String| Notice { text: format!("{}: not opened: {error}", path.display()), is_error: true };
    match fs::metadata(path) {
        Ok(about) if about.len() > MOST_WORLD => {
            return refused(format!("{} bytes: a world file has at most {MOST_WORLD}", about.len()));
        }
        Ok(_) => {}
        Err(error) => return refused(error.to_string()),
    }
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) => return refused(error.to_string()),
    };
    match Editor::open(&name(path), &text) {
        Ok(editor) => {
            let ui = &mut world.resource_mut::<Interface>().into_inner().0;
            ui.atlas = AtlasState::edited(editor).of_file(path).in_mode(ui.atlas.mode);
            ui.widget = ATLAS;
            Notice { text: format!("{}: opened", name(path)), is_error: false }
        }
        Err(error) => refused(error.to_string()),
    }
}

/// Saves the atlas's world in canonical form, whole or not at all.
pub fn save_world(world: &mut World, path: &Path) -> Notice {
    let atlas = &mut world.resource_mut::<Interface>().into_inner().0.atlas;
    match write_file(path, atlas.text().as_bytes()) {
        Ok(()) => {
            atlas.mark_saved(path);
            Notice { text: format!("{}: saved", name(path)), is_error: false }
        }
        Err(error) => Notice { text: format!("{}: not saved: {error}", path.display()), is_error: true },
    }
}

/// A file's name without its folder.
pub fn name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
