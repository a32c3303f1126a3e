//! Fills polygons with hatches and dots, in pixels. Their lattice is fixed to the screen, so that the hatches of two
//! pieces of one obstacle meet.

use super::ScreenPoint;
use crate::num::{greater, lesser};

/// The gap between two lines of a hatch along the axes, pixels.
const HATCH_STEP: f64 = 7.0;

/// The largest gap between two pieces of a line that are one, pixels.
const JOINT: f64 = 0.01;

/// The gap between two dots, pixels.
const DOT_STEP: f64 = 6.0;

/// Largest span of lattice numbers in one polygon. A polygon larger than that on the screen gets no lines or dots.
const MAX_LATTICE: i64 = 2000;

/// The least and greatest value of `f` over the polygon's corners.
fn range(polygon: &[ScreenPoint], f: impl Fn(&ScreenPoint) -> f64) -> (f64, f64) {
    polygon.iter().fold((f64::INFINITY, -f64::INFINITY), |(lo, hi), p| (lesser(lo, f(p)), greater(hi, f(p))))
}

/// The numbers k with `lo <= k * step <= hi`; none when there are too many or a bound is not finite.
fn lattice(lo: f64, hi: f64, step: f64) -> std::ops::Range<i64> {
    let (first, last) = ((lo / step).ceil() as i64, (hi / step).floor() as i64);
    let fits = lo.is_finite() && hi.is_finite() && last.saturating_sub(first) <= MAX_LATTICE;
    if fits { first..last.saturating_add(1) } else { 0..0 }
}

/// The two parameters between which the line from `a` along `d` lies inside the convex polygon; `None` if it misses it.
///
/// Cyrus and Beck's clipping (1978), for either orientation of the polygon.
fn clip(polygon: &[ScreenPoint], a: ScreenPoint, d: ScreenPoint) -> Option<(f64, f64)> {
    let n = polygon.len();
    let area: f64 = (0..n)
        .map(|i| {
            let (p, q) = (polygon[i], polygon[(i + 1) % n]);
            p[0] * q[1] - p[1] * q[0]
        })
        .sum();
    let side = if area >= 0.0 { 1.0 } else { -1.0 };
    let (mut from, mut to) = (-f64::INFINITY, f64::INFINITY);
    for i in 0..n {
        let (p, q) = (polygon[i], polygon[(i + 1) % n]);
        let normal = [side * (p[1] - q[1]), side * (q[0] - p[0])]; // points inside
        let inside = normal[0] * (a[0] - p[0]) + normal[1] * (a[1] - p[1]);
        let rate = normal[0] * d[0] + normal[1] * d[1];
        if rate > 0.0 {
            from = greater(from, -inside / rate);
        } else if rate < 0.0 {
            to = lesser(to, -inside / rate);
        } else if inside < 0.0 {
            return None;
        }
    }
    (from < to && from.is_finite() && to.is_finite()).then_some((from, to))
}

/// The hatch of convex polygons: lines that rise to the right. Where polygons meet, the pieces of a line are one: of a
/// strip thinner than a line no piece would be painted.
pub(super) fn hatch(polygons: &[Vec<ScreenPoint>]) -> Vec<Vec<ScreenPoint>> {
    let mut pieces: Vec<(i64, f64, f64)> = polygons.iter().flat_map(|polygon| pieces_in(polygon)).collect();
    pieces.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut lines: Vec<(i64, f64, f64)> = Vec::new();
    for (k, from, to) in pieces {
        match lines.last_mut().filter(|(number, _, end)| *number == k && from <= *end + JOINT) {
            Some((.., end)) => *end = greater(*end, to),
            None => lines.push((k, from, to)),
        }
    }
    let point = |k: i64, y: f64| [k as f64 * HATCH_STEP - y, y];
    lines.into_iter().map(|(k, from, to)| vec![point(k, from), point(k, to)]).collect()
}

/// The numbers of the lines of a hatch that cross a convex polygon, and between which heights.
fn pieces_in(polygon: &[ScreenPoint]) -> impl Iterator<Item = (i64, f64, f64)> {
    let (lo, hi) = range(polygon, |p| p[0] + p[1]);
    lattice(lo, hi, HATCH_STEP).filter_map(|k| {
        let (from, to) = clip(polygon, [k as f64 * HATCH_STEP, 0.0], [-1.0, 1.0])?;
        Some((k, from, to))
    })
}

/// The centres of the dots in a convex polygon, every other row moved by half a step.
pub(super) fn dots(polygon: &[ScreenPoint]) -> Vec<ScreenPoint> {
    let (lo, hi) = range(polygon, |p| p[1]);
    let mut out = Vec::new();
    for row in lattice(lo, hi, DOT_STEP) {
        let y = row as f64 * DOT_STEP;
        let shift = if row % 2 == 0 { 0.0 } else { 0.5 * DOT_STEP };
        if let Some((from, to)) = clip(polygon, [shift, y], [1.0, 0.0]) {
            out.extend(lattice(from, to, DOT_STEP).map(|k| [k as f64 * DOT_STEP + shift, y]));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [ScreenPoint; 4] = [[0.0, 0.0], [21.0, 0.0], [21.0, 21.0], [0.0, 21.0]];

    #[test]
    fn hatch_lines_span_the_polygon_on_the_lattice_either_way_round() {
        let mut turned = SQUARE;
        turned.reverse();
        for polygon in [SQUARE, turned] {
            let lines = hatch(&[polygon.to_vec()]);
            // x + y = 7, 14, .. 35; at 0 and 42 the line meets a corner only
            assert_eq!(lines.len(), 5);
            for line in lines {
                let sum = line[0][0] + line[0][1];
                assert_eq!(sum, line[1][0] + line[1][1]);
                assert_eq!(sum % HATCH_STEP, 0.0);
                for p in &line {
                    assert!(p.iter().all(|v| (0.0..=21.0).contains(v)), "{line:?}");
                    assert!(p.contains(&0.0) || p.contains(&21.0), "it ends on the boundary");
                }
            }
        }
    }

    #[test]
    fn a_line_goes_on_through_pieces_that_meet_and_ends_at_a_gap() {
        // the square in strips of half a pixel, without those from 10 to 11
        let strip = |k: i32| {
            let (low, high) = (0.5 * f64::from(k), 0.5 * f64::from(k + 1));
            vec![[0.0, low], [21.0, low], [21.0, high], [0.0, high]]
        };
        let mut strips: Vec<Vec<ScreenPoint>> = (0..42).rev().map(strip).collect();
        let whole = |lines: Vec<Vec<ScreenPoint>>| -> Vec<f64> {
            lines.iter().flatten().flatten().map(|v| (1e6 * v).round()).collect()
        };
        assert_eq!(whole(hatch(&strips)), whole(hatch(&[SQUARE.to_vec()])));
        strips.retain(|strip| !(10.0..11.0).contains(&strip[0][1]));
        // the lines x + y = 7 and 35 lie beside the gap, those of 14, 21 and 28 are cut by it
        assert_eq!(hatch(&strips).len(), 5 + 3);
    }

    #[test]
    fn dots_lie_inside_and_huge_or_broken_polygons_give_none() {
        let inside = dots(&[[-1.0, -1.0], [20.0, -1.0], [20.0, 20.0], [-1.0, 20.0]]);
        assert_eq!(inside.len(), 4 + 3 + 4 + 3, "rows at 0, 6, 12, 18 from 0 or 3");
        let huge = SQUARE.map(|p| [p[0] * 1e9, p[1] * 1e9]);
        assert!(hatch(&[huge.to_vec()]).is_empty() && dots(&huge).is_empty());
        assert!(hatch(&[vec![[f64::NAN; 2]; 3]]).is_empty());
        assert!(hatch(&[vec![]]).is_empty() && hatch(&[]).is_empty());
    }
}
