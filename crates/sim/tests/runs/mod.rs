//! Runs: what they record, keep and tell.

mod allocation;
mod caches;
pub mod controls;
pub mod crowds;
mod digest_logs;
mod inputs;
mod keyframes;
mod lengths;
mod live;
mod many_worlds;
mod paranoid;
mod replicas;
mod send_sync;
mod sizes;
mod stats;
mod tick_tangents;
mod warehouse;
