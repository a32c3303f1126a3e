//! Worlds, scripts and kinds as files.

pub mod files;
pub mod import;
pub mod kinds;
pub mod outside;
pub mod scripts;
pub mod sizes;
pub mod world;
