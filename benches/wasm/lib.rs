//! The table's scans, ours and parry's, for a script that has the clock and times them in turn.
#![allow(missing_docs, dead_code, clippy::expect_used, clippy::disallowed_methods)]

#[path = "../table/contest.rs"]
mod contest;
#[path = "../table/peer.rs"]
mod peer;
#[path = "../table/worlds.rs"]
mod worlds;

use contest::{Case, Ours, Parry, WORLDS, agree};
use motion_lab::sensors::Instructions;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
pub fn worlds() -> usize {
    WORLDS.len()
}

/// Both scans of one world.
#[wasm_bindgen]
pub struct Contest {
    case: Case,
    ours: Ours,
    parry: Parry,
}

#[wasm_bindgen]
impl Contest {
    /// Both scans in this world, after a check that they agree.
    #[wasm_bindgen(constructor)]
    pub fn new(number: usize) -> Contest {
        let case = WORLDS[number];
        let (mut ours, mut parry) = (Ours::new(&case, Instructions::best()), Parry::new(&case));
        agree(&mut ours, &mut parry);
        Contest { case, ours, parry }
    }

    pub fn work(&self) -> String {
        self.case.work()
    }

    /// Whether the world has a ratio to reach.
    pub fn marked(&self) -> bool {
        !self.case.must.is_empty()
    }

    pub fn digest(&mut self) -> String {
        format!("{:016x}", self.ours.digest())
    }

    /// Does this number of our scans. Returns a range, so that no scan is optimised away.
    pub fn ours(&mut self, from: usize, calls: usize) -> f64 {
        (from..from + calls).fold(0.0, |last, i| self.ours.scan(i)[0] + 0.0 * last)
    }

    /// Does this number of parry's scans.
    pub fn parry(&mut self, from: usize, calls: usize) -> f64 {
        (from..from + calls).fold(0.0, |last, i| self.parry.scan(i)[0] + 0.0 * last)
    }
}
