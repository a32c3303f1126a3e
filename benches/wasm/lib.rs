//! The table's scans, ours and parry's, for a script that times them in turns: it has the clock.
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
    /// Both in this world, once they agree.
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

    /// Whether there is a mark to reach.
    pub fn marked(&self) -> bool {
        !self.case.must.is_empty()
    }

    pub fn digest(&mut self) -> String {
        format!("{:016x}", self.ours.digest())
    }

    /// So many scans of ours; one of the ranges, so that none is left out.
    pub fn ours(&mut self, from: usize, calls: usize) -> f64 {
        (from..from + calls).fold(0.0, |last, i| self.ours.scan(i)[0] + 0.0 * last)
    }

    /// So many scans of parry's.
    pub fn parry(&mut self, from: usize, calls: usize) -> f64 {
        (from..from + calls).fold(0.0, |last, i| self.parry.scan(i)[0] + 0.0 * last)
    }
}
