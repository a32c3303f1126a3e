//! `Parting`, a separating line between two cores. It gives a lower bound on their distance, and shows which vertices
//! and edges are too far apart to matter.

use super::convex::{Closest, NearestPoints, between_vertices, cores_distance, edges};
use crate::geometry::{Point2, Segment, Vector2};
use crate::num::{greater, lesser, sqrt};

/// A separating line through a side of one of two cores: all of the first core lies behind it, all of the second ahead.
#[derive(Clone, Copy)]
pub(crate) struct Parting {
    at: Point2,
    /// The unit normal, which points ahead.
    normal: Vector2,
    /// The distance of the two cores along the normal, metres; rounded.
    pub(crate) gap: f64,
}

/// A separating line that rounding leaves no doubt about.
#[derive(Clone, Copy)]
pub(crate) struct SureParting {
    pub(crate) line: Parting,
    /// What a height above the line may be off by, metres.
    pub(crate) slack: f64,
}

impl Parting {
    /// The separating line with the widest gap among those through the sides of `a`, or else among those through the
    /// sides of `b`; `None` where no side separates the cores.
    pub(crate) fn of(a: &[Point2], b: &[Point2]) -> Option<Self> {
        let mut best = None;
        Self::beside(a, b, &mut best);
        // the second core's sides are tried only where no side of the first separates: else their gap is rarely wider
        if best.is_none() {
            Self::beside(b, a, &mut best);
            best = best.map(|p| Parting { normal: -p.normal, ..p });
        }
        best
    }

    /// Puts into `best` the line with the widest gap ahead of a side of `a`; for a segment, ahead of an end too.
    fn beside(a: &[Point2], b: &[Point2], best: &mut Option<Parting>) {
        let mut offer = |at: Point2, ahead: Vector2| {
            let all_ahead = b.iter().try_fold(f64::INFINITY, |least, q| {
                let along = (q - at).dot(&ahead);
                (along > 0.0).then(|| lesser(along, least))
            });
            if let Some(nearest) = all_ahead {
                let inverse = 1.0 / sqrt(ahead.norm_squared());
                let gap = nearest * inverse;
                if best.is_none_or(|best| gap > best.gap) {
                    *best = Some(Parting { at, normal: ahead * inverse, gap });
                }
            }
        };
        if let [p, q] = a {
            let u = q - p;
            let right = Vector2::new(u.y, -u.x);
            for (at, ahead) in [(*p, right), (*p, -right), (*q, u), (*p, -u)] {
                offer(at, ahead);
            }
        } else if a.len() > 2 {
            for Segment { a: p, b: q } in edges(a) {
                let u = q - p;
                offer(p, Vector2::new(u.y, -u.x));
            }
        }
    }

    /// How far ahead of the line a point lies, metres; rounded.
    fn height(&self, p: Point2) -> f64 {
        (p - self.at).dot(&self.normal)
    }
}

/// Largest number of vertices with cached heights.
const HEIGHTS: usize = 16;

/// As [`cores_distance`], for cores that a line certainly separates. Vertices and edges that their heights above it
/// prove too far apart are passed over. The result has the same bits, because none of those can be nearest.
pub(crate) fn parted_distance(a: &[Point2], b: &[Point2], limit: f64, parting: &SureParting) -> Option<NearestPoints> {
    let (line, slack) = (&parting.line, parting.slack);
    if a.len() > HEIGHTS || b.len() > HEIGHTS {
        return cores_distance(a, b, limit);
    }
    let (mut below, mut above) = ([0.0; HEIGHTS], [0.0; HEIGHTS]);
    let (mut highest, mut lowest) = (f64::NEG_INFINITY, f64::INFINITY);
    for (p, height) in a.iter().zip(&mut below) {
        *height = line.height(*p);
        highest = greater(*height, highest);
    }
    for (q, height) in b.iter().zip(&mut above) {
        *height = line.height(*q);
        lowest = lesser(*height, lowest);
    }
    let between = between_vertices(a, b);
    let (enough, mut closest) = (lesser(sqrt(between), limit), Closest::new(limit, between));
    let far = |apart: f64, least: f64| apart > lesser(least, enough) * (1.0 + 1e-9) + slack;
    for (&p, below) in a.iter().zip(&below) {
        if far(lowest - below, closest.least) {
            continue;
        }
        for ((edge, h0), h1) in edges(b).zip(&above).zip(above[1..b.len()].iter().chain(&above[..1])) {
            if !far(lesser(*h0, *h1) - below, closest.least) {
                closest.look(p, edge, |p, foot| (p, foot));
            }
        }
    }
    if a.len() > 1 {
        for (&q, above) in b.iter().zip(&above) {
            if far(above - highest, closest.least) {
                continue;
            }
            for ((edge, h0), h1) in edges(a).zip(&below).zip(below[1..a.len()].iter().chain(&below[..1])) {
                if !far(above - greater(*h0, *h1), closest.least) {
                    closest.look(q, edge, |q, foot| (foot, q));
                }
            }
        }
    }
    closest.found()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::narrow::convex::{cores_contact, plainly_overlap};
    use crate::geometry::convex_hull;
    use crate::random::{Seed, Stream};

    #[test]
    fn a_line_that_parts_two_cores_changes_no_bit_of_their_distance() {
        let mut draws = Stream::new(Seed(6), "parting");
        let (mut parted, mut overlapping) = (0, 0);
        for i in 0..6000 {
            // every other round on a lattice, where vertices, edges and whole sides are equally near
            let mut core = |at: f64| {
                let count = [2, 3, 4, 8][draws.below(4) as usize];
                let mut x = || if i % 2 == 0 { draws.below(5) as f64 } else { draws.uniform(0.0, 4.0) };
                let points: Vec<Point2> = (0..count).map(|_| Point2::new(at + x(), x())).collect();
                convex_hull(&points)
            };
            let (a, b) = (core(0.0), core([0.0, 3.0, 4.5][i % 3]));
            let contact = cores_contact(&a, &b).is_some();
            assert!(contact || !plainly_overlap(&a, &b), "{a:?} {b:?}");
            overlapping += usize::from(plainly_overlap(&a, &b));
            let Some(line) = Parting::of(&a, &b).filter(|line| line.gap > 1e-9) else { continue };
            assert!(!contact, "{a:?} {b:?}");
            parted += 1;
            let exact = cores_distance(&a, &b, f64::INFINITY);
            let distance = exact.unwrap().dist;
            assert!(line.gap <= distance * (1.0 + 1e-12), "{a:?} {b:?}");
            for limit in [f64::INFINITY, 1.5 * distance, 0.5 * distance] {
                let across = parted_distance(&a, &b, limit, &SureParting { line, slack: 1e-12 });
                assert_eq!(across, cores_distance(&a, &b, limit), "{a:?} {b:?} within {limit}");
            }
        }
        assert!(parted > 1000 && overlapping > 300, "{parted} parted, {overlapping} overlapping of 6000");
    }
}
