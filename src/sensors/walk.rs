//! A scan of a large world: ring by ring outward, leaving out what only closed sectors could see.

use super::circle::raise_circle;
use super::kernel::{BATCH, Fan, Kernel, LANES, View, turns};
use crate::collision::{Cells, Item, SegmentSoup};
use crate::geometry::Segment;
use crate::num::{greater, lesser};

/// What a walk needs again and again.
#[derive(Clone, Debug, Default)]
pub(super) struct Walk {
    batch: Batch,
    /// In which scan each thing was last met.
    met: Vec<u32>,
    scan: u32,
    bearings: Bearings,
    groups: Groups,
}

/// The segments of the ring under way that are not raised yet, in structure-of-arrays order.
#[derive(Clone, Debug)]
struct Batch {
    arrays: Box<[[f64; BATCH]; 4]>,
    count: usize,
    /// The blocks that were open when the first of them was met: only what was closed by then they cannot raise.
    open: u64,
}

impl Default for Batch {
    fn default() -> Self {
        Batch { arrays: Box::new([[f64::NAN; BATCH]; 4]), count: 0, open: u64::MAX }
    }
}

impl Batch {
    /// Adds a segment if it is `new`, without a branch; whether it is full now.
    #[inline]
    fn push_if(&mut self, new: bool, segment: &Segment) -> bool {
        let i = self.count % BATCH;
        let [ax, ay, bx, by] = &mut *self.arrays;
        (ax[i], ay[i], bx[i], by[i]) = (segment.a.x, segment.a.y, segment.b.x, segment.b.y);
        self.count = i + usize::from(new);
        self.count == BATCH
    }

    /// Raises the rays that meet the first segments, whole eights of them, and keeps the rest for later: a ray is only taken for
    /// open a little longer then.
    fn raise_eights(&mut self, open: u64, view: &View, kernel: &Kernel, fan: &mut Fan) {
        let (whole, rest) = (self.count / LANES * LANES, self.count % LANES);
        if whole > 0 {
            self.raise(whole, view, kernel, fan);
            for array in &mut *self.arrays {
                array.copy_within(whole..whole + rest, 0);
            }
            // fewer than eight were left before this ring, so those left now are of this one
            (self.count, self.open) = (rest, open);
        }
    }

    /// Raises the rays that meet the segments, and forgets them.
    fn raise_all(&mut self, view: &View, kernel: &Kernel, fan: &mut Fan) {
        let places = self.count.next_multiple_of(LANES);
        for array in &mut *self.arrays {
            array[self.count..places].fill(f64::NAN);
        }
        self.raise(places, view, kernel, fan);
        self.count = 0;
    }

    fn raise(&self, places: usize, view: &View, kernel: &Kernel, fan: &mut Fan) {
        fan.open = self.open;
        let [ax, ay, bx, by] = &*self.arrays;
        (kernel.raise)([&ax[..places], &ay[..places], &bx[..places], &by[..places]], view, fan);
    }
}

/// For cells by how many columns and rows they are off: in which of 64 sectors of the world they may lie, wherever in its own
/// cell the sensor is.
#[derive(Clone, Debug, Default)]
struct Bearings(Vec<u64>);

/// Cells up to so many rings off have their sectors listed.
const LISTED: i64 = 40;

/// A ray is closed when it hits this much nearer than a ring begins: more than rounding can make of a hit.
const NEARER: f64 = 1e-6;

/// The sectors of the world between two bearings in turns from -1 on, the second less than a turn from the first.
fn sectors_between(begin: f64, end: f64) -> u64 {
    let (first, last) = ((64.0 * (begin + 1.0)) as u32, (64.0 * (end + 1.0)) as u32);
    let more = last.saturating_sub(first).min(63);
    (u64::MAX >> (63 - more)).rotate_left(first % 64)
}

impl Bearings {
    fn new() -> Self {
        let each = |j: i64| (-LISTED..=LISTED).map(move |i| Self::of(i as f64, j as f64));
        Bearings((-LISTED..=LISTED).flat_map(each).collect())
    }

    /// Seen from anywhere in its own cell, a cell lies in a box of twice its size.
    fn of(i: f64, j: f64) -> u64 {
        if i.abs() < 1.5 && j.abs() < 1.5 {
            return u64::MAX;
        }
        let middle = turns(i, j);
        let off = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            let d = turns(i + x, j + y) - middle;
            if d > 0.5 {
                d - 1.0
            } else if d < -0.5 {
                d + 1.0
            } else {
                d
            }
        });
        let (least, most) = (off.into_iter().fold(0.0, lesser), off.into_iter().fold(0.0, greater));
        sectors_between(middle + least - SLACK, middle + most + SLACK)
    }

    /// The sectors of a cell at most [`LISTED`] columns and rows off.
    #[inline]
    fn get(&self, i: i64, j: i64) -> u64 {
        self.0[((j + LISTED) * (2 * LISTED + 1) + i + LISTED) as usize]
    }
}

/// More than the errors of the bearings, in turns.
const SLACK: f64 = 1e-5;

/// The rays in up to 64 groups of whole blocks, and which of them are open.
#[derive(Clone, Debug, Default)]
struct Groups {
    /// How many blocks a group has.
    blocks: usize,
    open: u64,
    /// The sectors of the world in which each group's rays lie.
    sectors: Vec<u64>,
}

impl Groups {
    /// All are open.
    fn begin(&mut self, fan: &Fan, view: &View) {
        self.blocks = fan.blocks.len().div_ceil(64);
        let count = fan.blocks.len().div_ceil(self.blocks);
        let step = (LANES * self.blocks) as f64 / view.rays;
        self.open = u64::MAX >> (64 - count);
        self.sectors.clear();
        self.sectors.extend((0..count).map(|g| {
            let begin = view.heading + step * g as f64;
            sectors_between(begin - SLACK, begin + step + SLACK)
        }));
    }

    /// Closes the groups all of whose rays hit nearer than 1 / `inverse`; the sectors of the world with open ones.
    fn close(&mut self, fan: &Fan, inverse: f64) -> u64 {
        let (mut left, mut sectors) = (self.open, 0);
        while left != 0 {
            let group = left.trailing_zeros() as usize;
            left &= left - 1;
            let from = group * self.blocks;
            let mine = &fan.blocks[from..(from + self.blocks).min(fan.blocks.len())];
            if mine.iter().all(|b| b.inverse.iter().fold(true, |closed, i| closed & (*i >= inverse))) {
                self.open &= !(1 << group);
            } else {
                sectors |= self.sectors[group];
            }
        }
        sectors
    }
}

impl Walk {
    /// Raises the rays that meet anything of the soup under this grid.
    pub(super) fn raise(&mut self, soup: &SegmentSoup, cells: &Cells, view: &View, kernel: &Kernel, fan: &mut Fan) {
        let segments = soup.segments().len();
        let things = segments + soup.circles().len();
        if self.bearings.0.is_empty() {
            self.bearings = Bearings::new();
        }
        if self.met.len() < things || self.scan == u32::MAX {
            self.met = vec![0; things];
            self.scan = 0;
        }
        self.scan += 1;
        self.groups.begin(fan, view);
        let (mut open, mut blocks) = (u64::MAX, u64::MAX);
        let place = cells.place(view.origin);
        let (first, last) = cells.rings(&place);
        for ring in first..=last {
            let distance = cells.least_distance(&place, ring);
            if distance > view.reach {
                break;
            }
            if distance > 0.0 {
                open = self.groups.close(fan, (1.0 + NEARER) / distance);
                blocks = if self.groups.blocks == 1 { self.groups.open } else { u64::MAX };
                if open == 0 {
                    break;
                }
            }
            if self.batch.count == 0 {
                self.batch.open = blocks;
            }
            let (bearings, batch, met) = (&self.bearings, &mut self.batch, &mut self.met[..]);
            let wanted = |i: i64, j: i64| ring > LISTED || bearings.get(i, j) & open != 0;
            cells.each_in_ring(&place, ring, wanted, |items| {
                for &Item { number, segment } in items {
                    let Some(met) = met.get_mut(number as usize) else { continue };
                    let new = *met != self.scan;
                    *met = self.scan;
                    match (number as usize).checked_sub(segments) {
                        None => {
                            if batch.push_if(new, &segment) {
                                batch.raise_all(view, kernel, fan);
                                batch.open = blocks;
                            }
                        }
                        Some(circle) if new => raise_circle(&soup.circles()[circle], view, fan),
                        Some(_) => {}
                    }
                }
            });
            batch.raise_eights(blocks, view, kernel, fan);
        }
        // what is left may be nearer than where the walk ended
        self.batch.raise_all(view, kernel, fan);
    }
}
