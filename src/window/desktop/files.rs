//! Runs and worlds as files of the system: saved, opened, dropped on the window.

use std::fs;
use std::path::Path;
use std::sync::atomic::Ordering;

use bevy::ecs::world::World;

use super::persistence::autosave::note_in_file;
use crate::output::write_file;
use crate::window::error::SessionError;
use crate::window::run_files::{open_log, open_path_text, open_world_text, path_text, save};
use crate::window::ui::{Interface, Notice};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::plans::MAX_PATH_BYTES;
use motion_lab_sim::simulation::Transport;

/// File extension of the lab's worlds.
pub const WORLD: &str = "ron";

/// File extension of the lab's paths.
pub const PATH: &str = "json";

/// Largest size of a log that the window opens, bytes.
const MAX_BYTES: u64 = 1 << 30;

/// Largest size of a world file that the window opens, bytes.
const MAX_WORLD: u64 = 32 << 20;

/// Saves the run as far as it has come: its log, recorded from seed, configuration and script, whole or not at all.
/// Returns what came of it; nothing yet where it takes long and goes on in the background.
pub fn save_run(world: &mut World, path: &Path) -> Option<Notice> {
    let to = path.to_owned();
    let is_there = note_in_file(world, world.resource::<Transport>().frontier());
    let write = move |bytes: &[u8], words: String| {
        write_file(&to, bytes)?;
        is_there.store(true, Ordering::Release);
        Ok(Notice { text: format!("{}: {words}", name(&to)), is_error: false })
    };
    let refused = |error| Notice { text: format!("{}: not saved: {error}", path.display()), is_error: true };
    let said = save(world, Box::new(write)).unwrap_or_else(|error| Some(refused(error)));
    // what goes on in the background has begun without an error
    if said.as_ref().is_none_or(|notice| !notice.is_error) {
        note_recent(world, path);
    }
    said
}

/// Opens a run in place of the present one: simulates it again from its seed and script and compares every frame.
///
/// The run is shown paused, at its start or at the first tick that differs. Where the file can't be read, the present
/// run stays. Returns what came of it; nothing yet where it takes long and goes on in the background.
pub fn open_run(world: &mut World, path: &Path) -> Option<Notice> {
    let refused = |error| Notice { text: format!("{}: not opened: {error}", path.display()), is_error: true };
    open(world, path).unwrap_or_else(|error| Some(refused(error)))
}

/// Opens a world in the atlas, a path in the plan, any other file as a run, by the file's extension. Returns what came
/// of it; nothing yet where it takes long and goes on in the background.
pub fn open_any(world: &mut World, path: &Path) -> Option<Notice> {
    if path.extension().is_some_and(|e| e == WORLD) {
        Some(open_world(world, path))
    } else if path.extension().is_some_and(|e| e == PATH) {
        Some(open_path(world, path))
    } else {
        open_run(world, path)
    }
}

/// Opens a file of the list of recent files, and puts its widget in front. One that is no longer there is said so and
/// dropped from the list.
pub fn open_recent(world: &mut World, path: &Path) {
    let notice = if path.try_exists().is_ok_and(|is_there| !is_there) {
        world.resource_mut::<Interface>().0.recent.remove(path);
        let text = format!("{}: it is no longer there, and no longer among the recent files", path.display());
        Some(Notice { text, is_error: true })
    } else {
        let is_run = ![WORLD, PATH].iter().any(|other| path.extension().is_some_and(|e| e == *other));
        if is_run {
            world.resource_mut::<Interface>().0.widget = Widget::Dashboard;
        }
        open_any(world, path)
    };
    if let Some(notice) = notice {
        world.resource_mut::<Interface>().0.say(notice);
    }
}

/// Puts a file that was opened or saved first in the list of recent files.
fn note_recent(world: &mut World, path: &Path) {
    world.resource_mut::<Interface>().0.recent.put_first(path);
}

fn open(world: &mut World, path: &Path) -> Result<Option<Notice>, SessionError> {
    let length = fs::metadata(path)?.len();
    if length > MAX_BYTES {
        return Err(SessionError::TooLarge { found: length, most: MAX_BYTES });
    }
    let said = open_log(world, &name(path), &fs::read(path)?)?;
    // the file's input, as long as the reader adds none
    note_in_file(world, u64::MAX).store(true, Ordering::Release);
    note_recent(world, path);
    Ok(said)
}

/// Opens a world file in the atlas. Where it is refused, the present one stays.
pub fn open_world(world: &mut World, path: &Path) -> Notice {
    let refused = |error: String| Notice { text: format!("{}: not opened: {error}", path.display()), is_error: true };
    match fs::metadata(path) {
        Ok(about) if about.len() > MAX_WORLD => {
            return refused(format!("{} bytes: a world file has at most {MAX_WORLD}", about.len()));
        }
        Ok(_) => {}
        Err(error) => return refused(error.to_string()),
    }
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) => return refused(error.to_string()),
    };
    let notice = open_world_text(world, &name(path), &text);
    if !notice.is_error {
        world.resource_mut::<Interface>().0.atlas.stands_in(path);
        note_recent(world, path);
    }
    notice
}

/// Saves the atlas's world in canonical form, whole or not at all.
pub fn save_world(world: &mut World, path: &Path) -> Notice {
    let atlas = &mut world.resource_mut::<Interface>().into_inner().0.atlas;
    match write_file(path, atlas.text().as_bytes()) {
        Ok(()) => {
            atlas.mark_saved(path);
            note_recent(world, path);
            Notice { text: format!("{}: saved", name(path)), is_error: false }
        }
        Err(error) => Notice { text: format!("{}: not saved: {error}", path.display()), is_error: true },
    }
}

/// Saves the plan's path as JSON, whole or not at all; nothing without a path.
pub fn save_path(world: &mut World, path: &Path) -> Option<Notice> {
    let text = path_text(world)?;
    Some(match write_file(path, text.as_bytes()) {
        Ok(()) => {
            note_recent(world, path);
            Notice { text: format!("{}: saved", name(path)), is_error: false }
        }
        Err(error) => Notice { text: format!("{}: not saved: {error}", path.display()), is_error: true },
    })
}

/// Opens a path's file in the plan. Where it is refused, the present plan stays.
pub fn open_path(world: &mut World, path: &Path) -> Notice {
    let notice = read_path(world, path);
    if !notice.is_error {
        note_recent(world, path);
    }
    notice
}

fn read_path(world: &mut World, path: &Path) -> Notice {
    let refused = |error: String| Notice { text: format!("{}: not opened: {error}", path.display()), is_error: true };
    match fs::metadata(path) {
        Ok(about) if about.len() > MAX_PATH_BYTES as u64 => {
            refused(format!("{} bytes: a path's file has at most {MAX_PATH_BYTES}", about.len()))
        }
        Ok(_) => match fs::read_to_string(path) {
            Ok(text) => open_path_text(world, &name(path), &text),
            Err(error) => refused(error.to_string()),
        },
        Err(error) => refused(error.to_string()),
    }
}

/// A file's name without its folder.
pub fn name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
