//! The table's scans, ours and parry's, for a script that has the clock and times them in turn.
#![allow(missing_docs, dead_code, unused_imports, clippy::expect_used, clippy::disallowed_methods)]

#[path = "../table/contest.rs"]
mod contest;
#[path = "../table/rivals/mod.rs"]
mod rivals;
#[path = "../table/worlds.rs"]
mod worlds;

use contest::{Case, Ours, WORLDS, agree, task};
use motion_lab::sensors::Instructions;
use rivals::Contender;
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
    parry: Box<dyn Contender>,
}

#[wasm_bindgen]
impl Contest {
    /// Both scans in this world, after a check that they agree.
    #[wasm_bindgen(constructor)]
    pub fn new(number: usize) -> Contest {
        let case = WORLDS[number];
        let mut ours = Ours::new(&case, Instructions::best());
        let mut parry = rivals::contenders(&task(&case)).swap_remove(0);
        let answers: Vec<Vec<f64>> = (0..worlds::CASES).map(|i| parry.answers(i)).collect();
        agree(&mut ours, parry.name(), &answers);
        Contest { case, ours, parry }
    }

    pub fn work(&self) -> String {
        self.case.work()
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
        (from..from + calls).fold(0.0, |last, i| self.parry.work(i) + 0.0 * last)
    }
}
