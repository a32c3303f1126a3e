//! `SightCells`, which remembers what can be seen from each square of a small scene.
//!
//! A square's segments are listed when scans have begun there a few times, and only once. The list changes no bit of a
//! scan (`occluder.rs`), so nothing depends on who scanned before, nor on the order of threads.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

use super::occluder::{ALL_PARTS, MARGIN, Occluder, Viewpoints};
use super::segments::{LANES, SegmentArrays};
use crate::geometry::{Aabb, MAX_COORDINATE, Point2, Segment};

/// Largest number of segments of a scene whose squares are remembered.
const MAX_SEGMENTS: usize = 128;

/// The side of a square, metres. It is larger where the scene would have more than [`MAX_SQUARES`].
const SIDE: f64 = 0.25;

/// Largest number of squares of a scene. With 32 bytes each they take half a mebibyte.
const MAX_SQUARES: f64 = 16_384.0;

/// Largest number of numbers in all lists of a scene, of 8 bytes each: 8 MiB. The squares of the Apartment take a fifth
/// of that.
const MAX_LISTED: usize = 1 << 20;

/// The number of scans of a scene before it has squares, so that one scan costs no more than it did.
const SCANS: u32 = 16;

/// The number of the scan beginning in a square that lists its segments. To list them takes as long as seven scans in
/// the Apartment, and saves a third of each from then on. So a robot that drives through at 0.2 m/s, 20 scans a second,
/// pays for a list only where it comes back: at 12 the tour, which never does, took 2 % more instructions.
const VISITS: u32 = 32;

/// The squares over the boundary of a small scene.
#[derive(Debug)]
pub(crate) struct SightCells {
    bounds: Aabb,
    side: f64,
    columns: usize,
    rows: usize,
    margin: f64,
    scans: AtomicU32,
    squares: OnceLock<Box<[Square]>>,
    /// About how many numbers the lists hold.
    listed: AtomicUsize,
}

#[derive(Debug, Default)]
struct Square {
    visits: AtomicU32,
    seen: OnceLock<SeenSegments>,
}

/// The segments that may be seen from a square, from near to far, padded to a multiple of eight with NaN.
///
/// For each eight the least distance from the square to the first of them, then the arrays of the ends' coordinates.
#[derive(Debug)]
struct SeenSegments(Box<[f64]>);

impl SeenSegments {
    fn new(seen: &[SightedSegment], view: &Viewpoints) -> Self {
        let groups = seen.len().div_ceil(LANES);
        let mut numbers = vec![f64::NAN; groups * (1 + 4 * LANES)].into_boxed_slice();
        let (near, arrays) = numbers.split_at_mut(groups);
        for (near, group) in near.iter_mut().zip(seen.chunks(LANES)) {
            *near = view.least_distance(group[0].distance);
        }
        for (i, SightedSegment { segment: Segment { a, b }, .. }) in seen.iter().enumerate() {
            for (array, number) in arrays.chunks_exact_mut(groups * LANES).zip([a.x, a.y, b.x, b.y]) {
                array[i] = number;
            }
        }
        SeenSegments(numbers)
    }

    /// The arrays of those that may be within reach.
    fn within(&self, reach: f64) -> [&[f64]; 4] {
        let groups = self.0.len() / (1 + 4 * LANES);
        let (near, arrays) = self.0.split_at(groups);
        let count = LANES * near.iter().take_while(|near| **near <= reach).count();
        let (a, b) = arrays.split_at(2 * LANES * groups);
        let ((ax, ay), (bx, by)) = (a.split_at(LANES * groups), b.split_at(LANES * groups));
        [&ax[..count], &ay[..count], &bx[..count], &by[..count]]
    }
}

impl SightCells {
    /// The squares over the box around these segments. `None` where there is nothing to gain, and where there are too
    /// many segments, or coordinates that are not finite or too large.
    pub(crate) fn new(segments: &SegmentArrays) -> Option<Self> {
        if segments.len() <= LANES || segments.len() > MAX_SEGMENTS {
            return None;
        }
        let ends = || (0..segments.len()).map(|i| segments.segment(i)).flat_map(|s| [s.a, s.b]);
        // NaN is not at most anything
        let is_small = |end: Point2| end.x.abs() <= MAX_COORDINATE && end.y.abs() <= MAX_COORDINATE;
        if !ends().all(is_small) {
            return None;
        }
        let bounds = ends().map(|end| Aabb::new(end, end)).reduce(|a, b| a.merged(&b))?;
        let (width, height) = (bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let mut side = SIDE;
        let along = |extent: f64, side: f64| (extent / side).floor() + 1.0;
        while along(width, side) * along(height, side) > MAX_SQUARES {
            side *= 1.25;
        }
        Some(SightCells {
            bounds,
            side,
            columns: along(width, side) as usize,
            rows: along(height, side) as usize,
            margin: MARGIN * (width + height + side),
            scans: AtomicU32::new(0),
            squares: OnceLock::new(),
            listed: AtomicUsize::new(0),
        })
    }

    /// The arrays of the segments that a scan from a point may meet within its reach, metres. `None` where they are not
    /// listed: outside the squares, and where few scans have begun. `segments` are those that the squares were made
    /// for.
    pub(crate) fn seen_from(&self, origin: Point2, reach: f64, segments: &SegmentArrays) -> Option<[&[f64]; 4]> {
        let Some(squares) = self.squares.get() else {
            if self.scans.fetch_add(1, Ordering::Relaxed) + 1 == SCANS {
                // set by this thread only, whose scan is that number
                _ = self.squares.set((0..self.columns * self.rows).map(|_| Square::default()).collect());
            }
            return None;
        };
        let number = self.number(origin)?;
        let square = squares.get(number)?;
        if let Some(seen) = square.seen.get() {
            return Some(seen.within(reach));
        }
        // no thread waits for another: the one that counts this very visit makes the list
        let is_due = square.visits.fetch_add(1, Ordering::Relaxed) + 1 == VISITS;
        if !is_due || self.listed.load(Ordering::Relaxed) >= MAX_LISTED {
            return None;
        }
        let seen = self.list(number, segments);
        self.listed.fetch_add(seen.0.len(), Ordering::Relaxed);
        Some(square.seen.get_or_init(|| seen).within(reach))
    }

    /// The number of the square that holds a point. Rounding may take a neighbour's: the squares overlap.
    fn number(&self, p: Point2) -> Option<usize> {
        let column = (p.x - self.bounds.min.x) / self.side;
        let row = (p.y - self.bounds.min.y) / self.side;
        let holds = column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        holds.then(|| row as u32 as usize * self.columns + column as u32 as usize)
    }

    /// The segments that may be seen from a square.
    fn list(&self, number: usize, segments: &SegmentArrays) -> SeenSegments {
        let centre = |least: f64, place: usize| least + (place as f64 + 0.5) * self.side;
        let (x, y) = (self.bounds.min.x, self.bounds.min.y);
        let centre = Point2::new(centre(x, number % self.columns), centre(y, number / self.columns));
        let view = Viewpoints::new(centre, 0.5 * self.side, self.margin);
        let distance = |i: usize| view.distance(&segments.segment(i));
        let mut order: Vec<(u64, usize)> = (0..segments.len()).map(|i| (distance(i).to_bits(), i)).collect();
        // the bits of numbers that are not negative are in the numbers' order
        order.sort_unstable_by_key(|(distance, _)| *distance);
        let sighted = |(distance, i)| SightedSegment::new(segments.segment(i), f64::from_bits(distance), &view);
        let mut sighted: Vec<SightedSegment> = order.into_iter().map(sighted).collect();
        drop_hidden(&mut sighted, &view);
        SeenSegments::new(&sighted, &view)
    }
}

/// A segment and which of its parts are hidden from a square.
#[derive(Clone, Copy, Debug)]
struct SightedSegment {
    segment: Segment,
    /// Its distance from the square's centre.
    distance: f64,
    /// A bit for each part that may still be seen.
    seen: u32,
    /// Whether it is kept anyway.
    is_kept: bool,
}

impl SightedSegment {
    fn new(segment: Segment, distance: f64, view: &Viewpoints) -> Self {
        SightedSegment { segment, distance, seen: ALL_PARTS, is_kept: !view.may_lose(&segment, distance) }
    }
}

/// Takes away what other segments hide from all of a square, of segments from near to far. What a hidden segment hides
/// is about what those hide that hide it, so it is not tried itself.
fn drop_hidden(segments: &mut Vec<SightedSegment>, view: &Viewpoints) {
    let mut next = 0;
    while next < segments.len() {
        let (near, far) = segments.split_at_mut(next + 1);
        if let Some(occluder) = near.last().and_then(|s| Occluder::new(&s.segment, view)) {
            let mut any = false;
            for s in far.iter_mut().filter(|s| !s.is_kept) {
                s.seen &= !occluder.shaded(&s.segment);
                any |= s.seen == 0;
            }
            if any {
                segments.retain(|s| s.seen != 0);
            }
        }
        next += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arrays(ends: &[[f64; 4]]) -> SegmentArrays {
        let mut arrays = SegmentArrays::default();
        ends.iter()
            .for_each(|[ax, ay, bx, by]| arrays.push(Segment::new(Point2::new(*ax, *ay), Point2::new(*bx, *by))));
        arrays
    }

    /// Ten walls side by side, each a metre behind the one before and twice as long.
    fn rows() -> Vec<[f64; 4]> {
        (0..10).map(f64::from).map(|k| [-0.2 * k - 1.0, k, 0.2 * k + 1.0, k]).collect()
    }

    #[test]
    fn few_walls_many_and_far_ones_have_no_squares() {
        assert!(SightCells::new(&arrays(&rows())).is_some());
        assert!(SightCells::new(&arrays(&rows()[..8])).is_none());
        assert!(SightCells::new(&arrays(&rows().repeat(13))).is_none());
        for odd in [f64::NAN, f64::INFINITY, 1.1e4, -1e300] {
            let mut walls = rows();
            walls[3][2] = odd;
            assert!(SightCells::new(&arrays(&walls)).is_none(), "{odd}");
        }
    }

    #[test]
    fn the_squares_are_few_however_large_the_scene() {
        for (width, height) in
            [(0.0, 0.0), (1e-3, 2.0), (12.0, 8.0), (100.0, 100.0), (2e4, 0.0), (2e4, 2e4), (1.0, 2e4)]
        {
            let corner = Point2::new(-0.5 * width, -0.5 * height);
            let wall = |k: u32| {
                let share = f64::from(k) / 9.0;
                [corner.x, corner.y, corner.x + share * width, corner.y + share * height]
            };
            let sight = SightCells::new(&arrays(&(0..10).map(wall).collect::<Vec<_>>())).unwrap();
            assert!((sight.columns * sight.rows) as f64 <= MAX_SQUARES);
            let last = Point2::new(0.5 * width, 0.5 * height);
            assert_eq!((sight.number(corner), sight.number(last)), (Some(0), Some(sight.columns * sight.rows - 1)));
            for outside in [(f64::NAN, 0.0), (0.0, f64::INFINITY), (-0.6 * width - 0.01, 0.0), (0.0, height + 1e3)] {
                assert_eq!(sight.number(Point2::new(outside.0, outside.1)), None, "{outside:?}");
            }
        }
    }

    #[test]
    fn walls_are_listed_at_a_late_visit_and_only_there() {
        let segments = arrays(&rows());
        let sight = SightCells::new(&segments).unwrap();
        let (p, q) = (Point2::new(0.1, 0.1), Point2::new(0.1, 8.4));
        for _ in 0..SCANS + VISITS - 1 {
            assert!(sight.seen_from(p, 99.0, &segments).is_none());
        }
        let [ax, ay, _, _] = sight.seen_from(p, 99.0, &segments).unwrap();
        // the wall the square lies on, and the next, which hides those behind
        assert_eq!((ax.len(), &ay[..2]), (8, &[0.0, 1.0][..]));
        assert!(ax[2..].iter().all(|x| x.is_nan()));
        assert!(sight.seen_from(q, 99.0, &segments).is_none());
        assert_eq!(sight.seen_from(p, -1.0, &segments).unwrap()[0].len(), 0);
    }

    #[test]
    fn a_wall_that_is_behind_another_by_less_than_the_margin_is_listed() {
        let mut walls = rows();
        walls[2] = [-0.5, 1.0, 0.5, 1.0];
        for (behind, count) in [(-0.9, 3), (0.9, 3), (1.1, 2)] {
            let height = 9.0 + 5.6 + SIDE;
            (walls[2][1], walls[2][3]) = (1.0 + behind * MARGIN * height, 1.0 + behind * MARGIN * height);
            let segments = arrays(&walls);
            let sight = SightCells::new(&segments).unwrap();
            assert_eq!(sight.margin, MARGIN * height);
            let p = Point2::new(0.1, 0.6);
            (0..SCANS + VISITS).for_each(|_| _ = sight.seen_from(p, 99.0, &segments));
            let [ax, ..] = sight.seen_from(p, 99.0, &segments).unwrap();
            assert_eq!(ax.iter().filter(|x| !x.is_nan()).count(), count, "{behind}");
        }
    }

    #[test]
    fn lists_that_take_too_much_memory_are_not_made() {
        let segments = arrays(&rows());
        let sight = SightCells::new(&segments).unwrap();
        sight.listed.store(MAX_LISTED, Ordering::Relaxed);
        assert!((0..100).all(|_| sight.seen_from(Point2::new(0.1, 0.1), 99.0, &segments).is_none()));
    }
}
