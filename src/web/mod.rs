//! The lab in a web page: addresses that hold a run, and what the WebAssembly builds export.
//!
//! There are two builds. The light one, without the feature `web`, records, verifies and draws runs; the page's
//! overlay, the pages that hold one run, and the identity tests use it. The other is the lab itself.

#[cfg(target_family = "wasm")]
mod identity;
// the light build only reads links
#[cfg_attr(not(feature = "web"), allow(dead_code))]
mod inputs;
#[cfg_attr(not(feature = "web"), allow(dead_code))]
mod link;
#[cfg(all(feature = "screen", any(target_family = "wasm", test)))]
mod mirror;
#[cfg(target_family = "wasm")]
mod runs;

#[cfg(all(target_family = "wasm", feature = "web"))]
mod canvas;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod controls;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod downloads;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod error;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod inbox;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod lab;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod listener;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod message;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod report;
#[cfg(all(target_family = "wasm", feature = "web"))]
mod run_link;

pub use link::{LINK_VERSION, LINK_VERSION_WITH_INPUTS, Link, LinkError, MAX_LINK, MAX_LINK_TICK};
