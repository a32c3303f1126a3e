//! What is kept from one start of the program to the next: settings, recent files, the run under way.

pub mod autosave;
mod saved_run;
pub mod settings;
mod slot;

use std::path::PathBuf;

use bevy::platform::dirs::preferences_dir;

/// The name of the folder that the system keeps all of it in.
const PROGRAM: &str = "motion-lab";

/// The folder of the runs under way; `None` where the system has no place for settings.
fn folder_of_runs() -> Option<PathBuf> {
    Some(preferences_dir()?.join(PROGRAM).join("runs"))
}
