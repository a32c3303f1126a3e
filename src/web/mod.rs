//! The lab in a web page: addresses that hold a run, and what the WebAssembly builds export.
//!
//! There are two builds. The light one, without the feature `web`, records, verifies and draws runs, and has lenses
//! that stand still; the page's overlay, the pages that hold one run, a book's figures, and `tests/all/determinism` use
//! it. The other is the lab itself.

// the light build only reads links
#[cfg_attr(not(feature = "web"), allow(dead_code))]
mod inputs;
#[cfg_attr(not(feature = "web"), allow(dead_code))]
mod link;
#[cfg(any(all(target_family = "wasm", feature = "web"), all(feature = "cli", test)))]
#[cfg_attr(test, allow(dead_code))]
mod message;
#[cfg(all(feature = "screen", any(target_family = "wasm", test)))]
mod mirror;
#[cfg(target_family = "wasm")]
mod query_value;
#[cfg(target_family = "wasm")]
mod runs;

#[cfg(all(target_family = "wasm", not(feature = "web")))]
mod lens;

#[cfg(all(target_family = "wasm", feature = "web"))]
mod page;

pub use link::{
    LINK_VERSION, LINK_VERSION_WITH_FILES, LINK_VERSION_WITH_INPUTS, Link, LinkError, MAX_LINK, MAX_LINK_TICK, ReadLink,
};
