//! Runs for comparing platforms, as the WebAssembly builds export them.

use wasm_bindgen::prelude::*;

use motion_lab_core::random::Seed;
use motion_lab_core::worlds::World;

/// The names of the worlds that [`identity_line`] knows.
#[wasm_bindgen]
pub fn identity_worlds() -> Vec<String> {
    World::built_in_names().map(String::from).to_vec()
}

/// The line of [`recording::identity_line`](motion_lab_sim::recording::identity_line) for a built-in world; where there
/// is none, the reason.
#[wasm_bindgen]
pub fn identity_line(seed: u64, world: &str) -> String {
    let Some(world) = World::built_in(world) else {
        return format!("no world is named {world}");
    };
    motion_lab_sim::recording::identity_line(&world, Seed(seed)).unwrap_or_else(|error| error.to_string())
}
