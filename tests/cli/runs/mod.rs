//! Recording, replaying, comparing and measuring runs.

pub mod columns;
pub mod diff;
pub mod digests;
pub mod driving;
pub mod link;
#[cfg(target_os = "linux")]
pub mod progress;
pub mod record;
pub mod replay;
mod saved_pages;
pub mod sealed_digests;
pub mod shrink;
pub mod stats;
pub mod verify;
mod why;
