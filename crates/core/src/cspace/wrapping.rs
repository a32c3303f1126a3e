//! Cuts lines on a torus where they leave the square at one edge and come back at the opposite one.

use std::f64::consts::PI;

/// A step along one coordinate that counts as none, radians: rounding.
const STILL: f64 = 1e-12;

/// Cuts the chart line from `from` by `step` into pieces within the square from -pi to pi. `from` lies in the square.
///
/// A piece ends on the edge where the line leaves, and the next begins on the edge opposite. A line along an edge stays
/// at the edge where it begins.
pub fn wrapped_pieces(from: [f64; 2], step: [f64; 2]) -> Vec<[[f64; 2]; 2]> {
    let mut cuts = vec![0.0, 1.0];
    for i in 0..2 {
        if step[i] == 0.0 || !step[i].is_finite() {
            continue;
        }
        // where a coordinate passes an odd multiple of pi
        let (lo, hi) =
            (crate::num::lesser(from[i], from[i] + step[i]), crate::num::greater(from[i], from[i] + step[i]));
        let (first, last) = (((lo / PI - 1.0) / 2.0).ceil() as i32, ((hi / PI - 1.0) / 2.0).floor() as i32);
        for k in first..=last {
            let s = ((f64::from(2 * k + 1)) * PI - from[i]) / step[i];
            if s > 0.0 && s < 1.0 {
                cuts.push(s);
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    let at = |s: f64| [from[0] + s * step[0], from[1] + s * step[1]];
    cuts.windows(2)
        .filter(|w| w[1] > w[0])
        .map(|w| {
            let middle = at(0.5 * (w[0] + w[1]));
            // the whole turns that bring the piece's middle into the square
            let turns = |i: usize| if step[i].abs() > STILL { ((middle[i] / PI + 1.0) / 2.0).floor() } else { 0.0 };
            let back = [0, 1].map(|i| turns(i) * 2.0 * PI);
            [w[0], w[1]].map(|s| {
                let p = at(s);
                [(p[0] - back[0]).clamp(-PI, PI), (p[1] - back[1]).clamp(-PI, PI)]
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::wrap;
    use crate::random::{Seed, Stream};

    #[test]
    fn a_line_over_an_edge_comes_back_opposite() {
        let pieces = wrapped_pieces([3.0, 0.0], [0.4, 0.2]);
        assert_eq!(pieces.len(), 2);
        assert_eq!((pieces[0][0], pieces[0][1][0]), ([3.0, 0.0], PI));
        assert_eq!(pieces[1][0][0], -PI);
        assert!((pieces[0][1][1] - pieces[1][0][1]).abs() < 1e-12, "at one height");
        assert!((pieces[1][1][0] - wrap(3.4)).abs() < 1e-12);
        assert_eq!(wrapped_pieces([1.0, 1.0], [0.5, -0.5]).len(), 1);
        assert_eq!(wrapped_pieces([3.0, 3.0], [0.4, 0.3]).len(), 3, "over a corner's two edges");
    }

    #[test]
    fn a_line_along_an_edge_stays_where_its_ends_are_drawn() {
        for edge in [PI, -PI] {
            assert_eq!(wrapped_pieces([0.5, edge], [1.0, 0.0]), [[[0.5, edge], [1.5, edge]]]);
            assert_eq!(wrapped_pieces([edge, 0.5], [0.0, -1.0]), [[[edge, 0.5], [edge, -0.5]]]);
        }
        let [[from, to]] = wrapped_pieces([0.5, PI], [1.0, 1e-15])[..] else { panic!("one piece") };
        assert_eq!((from, to), ([0.5, PI], [1.5, PI]), "rounding is no step over the edge");
    }

    #[test]
    fn the_pieces_are_the_line() {
        let mut s = Stream::new(Seed(2), "wrapping");
        for _ in 0..500 {
            let from = [s.uniform(-PI, PI), s.uniform(-PI, PI)];
            let step = [s.uniform(-PI, PI), s.uniform(-PI, PI)];
            let pieces = wrapped_pieces(from, step);
            let length = |[a, b]: [[f64; 2]; 2]| crate::num::hypot(b[0] - a[0], b[1] - a[1]);
            let total: f64 = pieces.iter().map(|p| length(*p)).sum();
            assert!((total - crate::num::hypot(step[0], step[1])).abs() < 1e-9);
            for w in pieces.windows(2) {
                for (end, start) in w[0][1].iter().zip(w[1][0]) {
                    assert!(wrap(end - start).abs() < 1e-9, "each begins where the last ended, on the torus");
                }
            }
        }
    }
}
