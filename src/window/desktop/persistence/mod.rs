//! What is kept from one start of the program to the next: settings, recent files, the run under way.

pub mod autosave;
mod saved_run;
pub mod settings;
mod slot;
