//! Helpers that several commands share.

pub(crate) mod choices;
pub(crate) mod console;
pub(crate) mod end;
pub(crate) mod gate;
pub(crate) mod input;
pub(crate) mod interrupt;
pub(crate) mod log_source;
pub(crate) mod output;
pub(crate) mod paper;
pub(crate) mod progress;
pub(crate) mod simulate;
pub(crate) mod summary;
pub(crate) mod target;
pub(crate) mod words;
pub(crate) mod world_source;
