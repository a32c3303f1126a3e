//! The convex hull of a few points, by exact predicates.

use smallvec::SmallVec;

use super::{Point2, orientation};
use crate::short_list::ShortList;

/// A core's vertices; up to eight take no heap.
pub type Vertices = ShortList<Point2, 8>;

/// The convex hull of `points`: its corners counter-clockwise from the lowest leftmost, duplicates and points on an
/// edge left out. One point gives one, points on one line give the two outermost.
///
/// Every corner is one of the inputs, bit for bit, and every turn is decided exactly (Andrew's monotone chain, 1979),
/// so the hull holds every input with no rounding at all.
pub fn convex_hull(points: &[Point2]) -> Vertices {
    let mut sorted: SmallVec<[Point2; 16]> = SmallVec::from_slice(points);
    sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() <= 2 {
        return Vertices::from_slice(&sorted);
    }
    // With room for the start twice. The hull of two rectangles may have eight corners, and must not touch the heap.
    if sorted.len() < ROOM {
        let mut room = [Point2::origin(); ROOM];
        let count = chains(&sorted, &mut room);
        return Vertices::from_slice(&room[..count]);
    }
    let mut room = vec![Point2::origin(); sorted.len() + 1];
    let count = chains(&sorted, &mut room);
    Vertices::from_slice(&room[..count])
}

/// The size of the buffer on the stack, one more than the largest number of points that it serves.
const ROOM: usize = 17;

/// Writes the lower chain of sorted points and after it the upper one into `hull`, which has room for one point more
/// than there are. Returns the number of corners.
fn chains(sorted: &[Point2], hull: &mut [Point2]) -> usize {
    let mut count = 0;
    let mut go_on = |p: Point2, from: usize| {
        while count >= from + 2 && orientation(hull[count - 2], hull[count - 1], p) <= 0.0 {
            count -= 1;
        }
        hull[count] = p;
        count += 1;
        count
    };
    let mut lower = 0;
    for &p in sorted {
        lower = go_on(p, 0);
    }
    let mut all = lower;
    for &p in sorted.iter().rev().skip(1) {
        all = go_on(p, lower - 1);
    }
    all - 1 // without the start again
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Seed, Stream};

    #[test]
    fn hull_of_lattice_points_is_convex_and_holds_them_all() {
        let mut s = Stream::new(Seed(3), "hull");
        for _ in 0..2000 {
            let n = 1 + s.below(10) as usize;
            let points: Vec<Point2> = (0..n).map(|_| Point2::new(s.below(5) as f64, s.below(5) as f64)).collect();
            let hull = convex_hull(&points);
            let m = hull.len();
            assert!(m >= 1 && hull.iter().all(|h| points.contains(h)));
            if m >= 3 {
                for i in 0..m {
                    let (a, b) = (hull[i], hull[(i + 1) % m]);
                    assert!(orientation(a, b, hull[(i + 2) % m]) > 0.0, "a strict corner");
                    assert!(points.iter().all(|&p| orientation(a, b, p) >= 0.0), "{points:?} {hull:?}");
                }
            } else if m == 2 {
                assert!(points.iter().all(|&p| orientation(hull[0], hull[1], p) == 0.0));
                let longest = (hull[1] - hull[0]).norm();
                assert!(points.iter().all(|p| (p - hull[0]).norm() <= longest && (p - hull[1]).norm() <= longest));
            }
        }
    }
}
