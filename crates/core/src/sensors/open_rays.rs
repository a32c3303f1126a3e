//! `RayGroups`, which tracks the rays of a scan that may still hit something nearer.

use super::kernel::Kernel;
use super::rays::Fan;
use super::view::View;
use crate::collision::LANES;

/// The rays in up to 64 groups of whole blocks, and which groups are open. A group is open while one of its rays has no
/// hit in the cells visited so far.
#[derive(Clone, Debug)]
pub(super) struct RayGroups {
    blocks: usize,
    /// The open groups, a bit each.
    open: u64,
    /// The sectors of the world in which each group's rays lie.
    sectors: Vec<u64>,
    /// For each block, 1 if it was open when last checked, else 0. `any` is the same for each group.
    open_lanes: Vec<u8>,
    any: [u8; 64],
}

/// A turn in 32-bit fixed point, which wraps as bearings do.
const TURN: f64 = 4_294_967_296.0;

/// An upper bound on the errors of the bearings, in that fixed point: 1e-5 turns.
const BEARING_ERROR: u32 = 42_950;

/// A ray is closed when it hits nearer than the box's side by this fraction, which is more than the rounding of a hit.
const NEARER: f64 = 1e-6;

/// A group that spans more of a turn than this counts as lying in all sectors.
const NEARLY_ALL: f64 = 0.95;

impl Default for RayGroups {
    fn default() -> Self {
        RayGroups { blocks: 1, open: 0, sectors: Vec::new(), open_lanes: Vec::new(), any: [0; 64] }
    }
}

impl RayGroups {
    /// Begins a scan: opens all groups and finds the sectors of each.
    pub(super) fn begin(&mut self, fan: &Fan, view: &View) {
        self.blocks = fan.blocks.len().div_ceil(64).max(1);
        let count = fan.blocks.len().div_ceil(self.blocks);
        self.open = u64::MAX >> 64_usize.saturating_sub(count).min(63);
        let turn = (LANES * self.blocks) as f64 / view.rays;
        let all = turn > NEARLY_ALL;
        // a turn in 40 bits, so that the rounding of up to 64 groups does not add up to anything
        let fixed = |turns: f64| (turns * 256.0 * TURN) as u64;
        let (begin, step) = (fixed(view.heading), fixed(turn));
        self.open_lanes.resize(fan.blocks.len(), 1);
        self.sectors.clear();
        self.sectors.extend((0..count as u64).map(|g| {
            let begin = ((begin + step * g) >> 8) as u32;
            let end = begin.wrapping_add((step >> 8) as u32).wrapping_add(BEARING_ERROR);
            let first = begin.wrapping_sub(BEARING_ERROR) >> 26;
            let more = (end >> 26).wrapping_sub(first) & 63;
            if all { u64::MAX } else { (u64::MAX >> (63 - more)).rotate_left(first) }
        }));
    }

    /// Closes the groups all of whose rays hit within a box about the sensor, given the distances of its right, left,
    /// upper and lower side, metres. Returns the sectors of the world with open groups, a bit each.
    pub(super) fn close(&mut self, fan: &Fan, kernel: &Kernel, [right, left, upper, lower]: [f64; 4]) -> u64 {
        const NEAR: f64 = 1.0 + NEARER;
        (kernel.open)(fan, [NEAR / right, -NEAR / left, NEAR / upper, -NEAR / lower], &mut self.open_lanes);
        if self.blocks > 1 {
            for (g, blocks) in self.open_lanes.chunks(self.blocks).enumerate() {
                let any = blocks.iter().fold(0, |any, is_open| any | is_open);
                self.any[g % 64] = any;
            }
        } else {
            self.any[..self.open_lanes.len()].copy_from_slice(&self.open_lanes);
        }
        let (mut open, mut sectors) = (0, 0);
        for (g, (is_open, mine)) in self.any.iter().zip(&self.sectors).enumerate() {
            let is_open = u64::from(*is_open);
            open |= is_open << g;
            sectors |= is_open.wrapping_neg() & mine;
        }
        self.open = open;
        sectors
    }

    /// The blocks with open rays, a bit each; all bits are set if there are more than 64 blocks.
    pub(super) fn open_blocks(&self) -> u64 {
        if self.blocks == 1 { self.open } else { u64::MAX }
    }
}
