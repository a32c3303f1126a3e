//! The commands: a file or a folder each.

pub(crate) mod bare;
pub(crate) mod capture;
pub(crate) mod completions;
pub(crate) mod describe;
pub(crate) mod diff;
pub(crate) mod export;
pub(crate) mod grade;
pub(crate) mod info;
pub(crate) mod link;
#[cfg(feature = "window")]
pub(crate) mod open;
pub(crate) mod plan;
pub(crate) mod plot;
pub(crate) mod problems;
pub(crate) mod query;
pub(crate) mod record;
pub(crate) mod replay;
pub(crate) mod script;
pub(crate) mod shrink;
pub(crate) mod stats;
pub(crate) mod sweep;
#[cfg(feature = "headless")]
pub(crate) mod tour;
pub(crate) mod verify;
pub(crate) mod why;
pub(crate) mod world;
