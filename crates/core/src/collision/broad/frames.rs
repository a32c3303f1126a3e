//! `Frames`, boxes turned with the pieces of a small scene: which of them a capsule may touch, all asked at once.

use super::linear::FEW;
use crate::collision::boundary::segments::LANES;
use crate::geometry::{Aabb, Placed, Point2, Vector2};
use crate::num::sqrt;

/// The roundings of a test in single precision, in parts of the largest coordinate: some twenty, each at most 2^-24 of
/// it.
const ROUNDING: f64 = 4e-6;

/// Eight vectors, by x and y.
type Eight = [[f32; LANES]; 2];

/// Eight turned boxes: their centres, and half of either side.
type TurnedBoxes = [Eight; 3];

/// Turned boxes around at most [`FEW`] pieces, in single precision, eight side by side.
#[derive(Clone, Debug)]
pub(crate) struct Frames {
    count: usize,
    boxes: Vec<TurnedBoxes>,
}

/// A line by its middle, its unit direction and half its length, metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CentredLine {
    pub(crate) middle: Point2,
    pub(crate) direction: Vector2,
    pub(crate) half: f64,
}

/// The line of a capsule as the test needs it.
#[derive(Clone, Copy)]
struct CapsuleLine {
    middle: [f32; 2],
    direction: [f32; 2],
    /// How far from the line, and along it from its middle, the capsule's own box reaches, metres.
    beside: f32,
    along: f32,
}

impl Frames {
    /// The boxes of the pieces; `None` where there are too many.
    pub(crate) fn new(pieces: &[Placed]) -> Option<Self> {
        if !Frames::fits(pieces.len()) {
            return None;
        }
        let boxes = vec![TurnedBoxes::default(); pieces.len().div_ceil(LANES)];
        let mut frames = Frames { count: pieces.len(), boxes };
        for (i, piece) in pieces.iter().enumerate() {
            let (centre, [side, other]) = turned_box(piece);
            for ([x, y], v) in frames.boxes[i / LANES].iter_mut().zip([centre.coords, side, other]) {
                (x[i % LANES], y[i % LANES]) = (v.x as f32, v.y as f32);
            }
        }
        Some(frames)
    }

    /// Whether a scene of this many pieces has them.
    pub(crate) fn fits(count: usize) -> bool {
        count <= FEW
    }

    /// The pieces that a disc of this radius may touch while its centre runs along the line, as bits by their numbers.
    /// A piece that is left out is farther than the radius by more than a millionth of `size`, which is at least the
    /// sum of two coordinates.
    pub(crate) fn near(&self, line: CentredLine, radius: f64, size: f64) -> u64 {
        let CentredLine { middle, direction, half } = line;
        let beside = radius + ROUNDING * size;
        let way = CapsuleLine {
            middle: [middle.x as f32, middle.y as f32],
            direction: [direction.x as f32, direction.y as f32],
            beside: beside as f32,
            along: (beside + half) as f32,
        };
        let all = if self.count < 64 { (1 << self.count) - 1 } else { u64::MAX };
        near_bits(&self.boxes, way) & all
    }
}

/// A box around a piece: its centre and two half sides.
fn turned_box(piece: &Placed) -> (Point2, [Vector2; 2]) {
    let (centre, [side, other]) = core_box(piece.core());
    let along = if side.norm_squared() > 0.0 { side / sqrt(side.norm_squared()) } else { Vector2::x() };
    let (across, radius) = (Vector2::new(-along.y, along.x), piece.radius());
    if radius == 0.0 {
        return (centre, [side, other]);
    }
    // a rectangle, also around a parallelogram, grown by the radius
    let reach = |axis: Vector2| side.dot(&axis).abs() + other.dot(&axis).abs() + radius;
    (centre, [along * reach(along), across * reach(across)])
}

/// A box around the core, a segment's without width.
fn core_box(core: &[Point2]) -> (Point2, [Vector2; 2]) {
    match core {
        [a, b] => (a + (b - a) * 0.5, [(b - a) * 0.5, Vector2::zeros()]),
        // a parallelogram as it is
        [a, b, c, d] if (a - b + (c - d)).norm() <= 1e-12 * ((b - a).norm() + (c - b).norm()) => {
            (a + (c - a) * 0.5, [(b - a) * 0.5, (c - b) * 0.5])
        }
        _ => {
            let Aabb { min, max } = Aabb::around(core).unwrap_or(Aabb { min: Point2::origin(), max: Point2::origin() });
            let half = (max - min) * 0.5;
            (min + half, [Vector2::new(half.x, 0.0), Vector2::new(0.0, half.y)])
        }
    }
}

/// Bit `i` is set unless box `i` lies beside the way's own box, or before or behind it.
#[cfg_attr(
    not(baseline),
    multiversion::multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))
)]
fn near_bits(boxes: &[TurnedBoxes], way: CapsuleLine) -> u64 {
    let CapsuleLine { middle: [x, y], direction: [dx, dy], beside, along } = way;
    let mut bits = 0;
    for (block, [[cx, cy], [ax, ay], [bx, by]]) in boxes.iter().enumerate() {
        let mut near = 0_u32;
        for i in 0..LANES {
            let (wx, wy) = (cx[i] - x, cy[i] - y);
            let across = (dx * wy - dy * wx).abs() - (dx * ay[i] - dy * ax[i]).abs() - (dx * by[i] - dy * bx[i]).abs();
            let ahead = (dx * wx + dy * wy).abs() - (dx * ax[i] + dy * ay[i]).abs() - (dx * bx[i] + dy * by[i]).abs();
            near |= u32::from(!((across > beside) | (ahead > along))) << i;
        }
        bits |= u64::from(near) << (block * LANES);
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::narrow::distance::nearest;
    use crate::geometry::{Pose2, Shape};
    use crate::random::{Seed, Stream};

    /// A wall, a box, a triangle, a disc, a rounded wall or a rounded box.
    fn piece(kind: u64, at: Pose2, draws: &mut Stream) -> Placed {
        let mut side = || draws.uniform(0.05, 1.0);
        let p = |x: f64, y: f64| at.transform(Point2::new(x, y));
        match kind {
            0 => Placed::new([p(0.0, 0.0), p(2.0 * side(), 0.0)], 0.0),
            1 => Shape::try_rectangle(Point2::new(-side(), -side()), Point2::new(side(), side())).unwrap().place(&at),
            2 => Placed::new([p(0.0, 0.0), p(side(), 0.0), p(0.0, side())], 0.0),
            3 => Placed::new([p(0.0, 0.0)], side()),
            4 => Placed::new([p(0.0, 0.0), p(2.0 * side(), 0.0)], 0.3 * side()),
            _ => Placed::new([p(0.0, 0.0), p(side(), 0.0), p(0.7, 0.5), p(0.0, 0.5)], 0.3 * side()),
        }
    }

    #[test]
    fn what_a_capsule_touches_is_near_and_little_else() {
        let mut draws = Stream::new(Seed(24), "frames");
        for (count, kinds, offset) in [(1, 1, 0.0), (40, 1, 0.0), (40, 6, 0.0), (64, 6, 90_000.0), (63, 2, -4e5)] {
            let (mut near, mut touched) = (0, 0);
            let pieces: Vec<Placed> = (0..count)
                .map(|_| {
                    let mut at = || offset + draws.uniform(0.0, 12.0);
                    let at = Pose2::new(at(), at(), draws.uniform(-3.0, 3.0));
                    piece(draws.below(kinds), at, &mut draws)
                })
                .collect();
            let frames = Frames::new(&pieces).unwrap();
            for _ in 0..400 {
                let mut at = || Point2::new(offset + draws.uniform(0.0, 12.0), offset + draws.uniform(0.0, 12.0));
                let (a, b, radius) = (at(), at(), draws.uniform(0.01, 0.3));
                let length = (b - a).norm();
                let line = CentredLine { middle: a + (b - a) * 0.5, direction: (b - a) / length, half: 0.5 * length };
                let bits = frames.near(line, radius, 2.0 * (offset.abs() + 15.0));
                assert!(count == 64 || bits >> count == 0, "{bits:x} of {count}");
                let capsule = Placed::new([a, b], radius);
                for (i, piece) in pieces.iter().enumerate() {
                    let touches = nearest(&capsule, piece).dist == 0.0;
                    assert!(!touches || bits >> i & 1 == 1, "piece {i} of {count}: {a:?} {b:?} {radius}");
                    touched += u32::from(touches);
                }
                near += bits.count_ones();
            }
            // single precision loses metres 400 km from the origin
            assert!(f64::from(near) < 1.35 * f64::from(touched) + 100.0 || offset != 0.0, "{near} for {touched}");
        }
    }

    #[test]
    fn a_large_scene_has_none_and_an_empty_one_is_near_nothing() {
        let disc = Placed::new([Point2::origin()], 0.1);
        assert!(Frames::new(&vec![disc.clone(); FEW + 1]).is_none());
        assert_eq!(Frames::new(&vec![disc; FEW]).unwrap().near(line(), 0.1, 2.0), u64::MAX);
        assert_eq!(Frames::new(&[]).unwrap().near(line(), 0.1, 2.0), 0);
    }

    fn line() -> CentredLine {
        CentredLine { middle: Point2::origin(), direction: Vector2::x(), half: 1.0 }
    }
}
