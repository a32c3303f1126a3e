//! A scan of a large world: visits the grid's cells ring by ring outward, and skips those that only closed sectors see.

use super::cast_segments::RayMemory;
use super::kernel::{Kernel, raise};
use super::open_rays::RayGroups;
use super::rays::Fan;
use super::sectors;
use super::view::View;
use super::wedges::{BATCH, Batch};
use crate::collision::{Cells, GridCell, LANES, SegmentSoup};

/// The boundary that a scan is cast at, and the grid over it.
#[derive(Clone, Copy)]
pub(super) struct Boundary<'a> {
    pub(super) soup: &'a SegmentSoup,
    pub(super) cells: &'a Cells,
}

/// The working memory of a walk through the grid, kept from scan to scan.
#[derive(Clone, Debug)]
pub(super) struct Walk {
    groups: RayGroups,
    /// The number of the scan in which each segment or disc was last met.
    met: Vec<u32>,
    scan: u32,
    /// The cells of the current ring that have to be visited.
    cells: Vec<usize>,
    pending: PendingSegments,
}

/// The segments met, by their numbers in the grid, in the order they were met.
#[derive(Clone, Debug)]
struct PendingSegments {
    numbers: Vec<u32>,
    /// The place in `numbers` of the first segment that is not raised yet.
    from: usize,
    count: usize,
    /// The blocks that were open when the first of those was met. The pending segments can raise no ray of the others.
    open: u64,
    arrays: Box<[Batch; 4]>,
}

impl Default for Walk {
    fn default() -> Self {
        let arrays = Box::new([[f64::NAN; BATCH]; 4]);
        let pending = PendingSegments { numbers: Vec::new(), from: 0, count: 0, open: u64::MAX, arrays };
        Walk { groups: RayGroups::default(), met: Vec::new(), scan: 0, cells: Vec::new(), pending }
    }
}

impl PendingSegments {
    /// Raises the rays that meet the pending segments. If more are to come, fewer than eight are kept for later. That
    /// is safe: a ray only counts as open a little longer then.
    fn raise(&mut self, more: bool, cells: &Cells, view: &View, kernel: &Kernel, fan: &mut Fan, desk: &mut RayMemory) {
        let PendingSegments { numbers, from, count, open, arrays } = self;
        let kept = if more { (*count - *from) % LANES } else { 0 };
        let [ax, ay, bx, by] = &mut **arrays;
        fan.open = *open;
        for numbers in numbers[*from..*count - kept].chunks(BATCH) {
            let places = numbers.len().next_multiple_of(LANES).min(BATCH);
            for (k, &number) in numbers.iter().enumerate() {
                let s = cells.segment(number);
                (ax[k], ay[k], bx[k], by[k]) = (s.a.x, s.a.y, s.b.x, s.b.y);
            }
            ax[numbers.len()..places].fill(f64::NAN);
            raise([&ax[..places], &ay[..places], &bx[..places], &by[..places]], view, kernel, fan, desk);
        }
        *from = *count - kept;
    }
}

impl Walk {
    /// Begins a scan, with room for this many segments and discs.
    fn prepare(&mut self, things: usize) {
        if self.met.len() < things || self.scan == u32::MAX {
            self.met = vec![0; things];
            self.pending.numbers = vec![0; things + 1];
            self.scan = 0;
        }
        self.scan += 1;
        (self.pending.from, self.pending.count) = (0, 0);
    }

    /// Lists the cells of a ring that open sectors see and that are no farther than the root of `reach`, in cells.
    /// Rings beyond the precomputed ones are listed in full.
    fn take_cells(&mut self, cells: &Cells, place: &GridCell, ring: i64, open: u64, reach: f64) {
        if ring > sectors::LISTED {
            self.cells.clear();
            cells.each_in_ring(place, ring, |cell| self.cells.push(cell));
            return;
        }
        let [right, left, upper, lower] = cells.sides(place, 1);
        let listed = sectors::ring(ring, left > right, lower > upper);
        let mut count = 0;
        self.cells.resize(listed.len() + 1, 0);
        for cell in listed {
            let (column, row) = (place.column + cell.i, place.row + cell.j);
            let wanted = (cell.sectors & open != 0) & (cell.near <= reach) & cells.holds(column, row);
            if let Some(place) = self.cells.get_mut(count) {
                *place = cells.number(column, row);
            }
            count += usize::from(wanted);
        }
        self.cells.truncate(count);
    }

    /// Collects the segments of the listed cells that were not met before, and raises the rays that meet new discs.
    fn meet(&mut self, boundary: Boundary, view: &View, kernel: &Kernel, fan: &mut Fan) {
        let Boundary { soup, cells } = boundary;
        let segments = soup.segments().len();
        // local values, which the compiler can keep in registers
        let (met, numbers, scan) = (&mut self.met[..], &mut self.pending.numbers[..], self.scan);
        let mut count = self.pending.count;
        for &cell in &self.cells {
            for &number in cells.things(cell) {
                let Some(met) = met.get_mut(number as usize) else { continue };
                let new = *met != scan;
                *met = scan;
                if let Some(circle) = (number as usize).checked_sub(segments) {
                    if new {
                        (kernel.circle)(&soup.circles()[circle], view, fan);
                    }
                } else if let Some(place) = numbers.get_mut(count) {
                    *place = number;
                    count += usize::from(new);
                }
            }
        }
        self.pending.count = count;
    }

    /// Raises the rays that meet anything of the boundary.
    pub(super) fn raise(
        &mut self,
        boundary: Boundary,
        view: &View,
        kernel: &Kernel,
        fan: &mut Fan,
        desk: &mut RayMemory,
    ) {
        let Boundary { soup, cells } = boundary;
        self.prepare(soup.segments().len() + soup.circles().len());
        self.groups.begin(fan, view);
        let mut open = u64::MAX;
        let place = cells.place(view.origin);
        let (first, last) = cells.rings(&place);
        let reach = cells.in_cells(view.reach);
        let mut ring = first;
        loop {
            let distance = cells.least_distance(&place, ring);
            // rays are hardly ever closed before the third ring, so the first two are visited without this test
            if ring > first + 1 {
                open = self.groups.close(fan, kernel, cells.sides(&place, ring));
            }
            // whether the rings that are left may still change a ray
            let more = ring <= last && distance <= view.reach && open != 0;
            if more {
                if self.pending.from == self.pending.count {
                    self.pending.open = self.groups.open_blocks();
                }
                self.take_cells(cells, &place, ring, open, reach * reach);
                self.meet(boundary, view, kernel, fan);
            }
            if !more || self.pending.count - self.pending.from >= LANES {
                self.pending.raise(more, cells, view, kernel, fan, desk);
                // fewer than eight were left before this ring, so those left now are of this one
                self.pending.open = self.groups.open_blocks();
            }
            if !more {
                break;
            }
            ring += 1;
        }
    }
}
