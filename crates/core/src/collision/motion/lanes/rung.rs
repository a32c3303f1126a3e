//! The rung of eight intervals: whether a motion is surely free, or surely not.
//!
//! A motion in which every part turns at a constant rate, a [`Linkage`], is cut into eight equal intervals, which are
//! examined side by side in single precision. In the middle of an interval stand the part's core and the tangents of
//! its corners' paths. A point of the core strays from its tangent by at most `A d^2 / 2` within half an interval `d`,
//! where A bounds its acceleration: so all that the part touches in the interval lies within that of the hull of the
//! core moved along the tangents, by half an interval to either side. A line that separates this hull from a piece by
//! more than that, the radii and the margin for rounding proves the interval clear of the piece. Where no line
//! separates the core in the middle of an interval from a piece, and even less so by the margin, the two touch there.
//! Where neither is so, the open intervals are cut again.
//!
//! The margin keeps the answers those of the ladder. With u = 2^-24 the unit of rounding and S the size of all
//! coordinates from the point that they count from, the tangents' lengths included: an angle of at most 16 radians is
//! off by at most 48 u, its sine and cosine by 52 u, a corner and its tangent's end by less than 70 u S, a height along
//! an axis by less than 80 u S, so a gap by less than the margin of 128 u S. A motion called free keeps clear of
//! everything by what is left of it, 48 u S, and by `2^-20 A`. Then every step of the march of `2^-10` or less proves
//! something, so the march comes through well within its budget. A motion called not free touches something at one of
//! its places, deeper than all rounding of the places in double precision; no proof calls that free. Only additions,
//! multiplications and comparisons are done, each rounded once on every machine.

use smallvec::SmallVec;

use super::angles::MAX_ANGLE;
use super::gaps::{LaneAnswer, LocalPiece, Reaches, judge};
use super::outlines::{MAX_SIZE, PieceOutlines};
use super::swept_part::{FrameOrigin, HALF, SweptPart, TurningCore, sweep};
use crate::collision::{LANES, Scene};
use crate::geometry::{Aabb, Point2, Vector2};
use crate::num::{greater, sqrt};
use crate::robots::{Linkage, TurningPart};

/// The margin for rounding, in parts of the coordinates: 128 units of 2^-24.
const ROUNDING: f64 = 1.0 / 131_072.0;

/// The clearance that the march certainly gets by with, in parts of a part's acceleration: 2^-20.
const MARCHED: f64 = 1.0 / 1_048_576.0;

/// What double precision may round by, in parts of the coordinates in the world, and more.
const DOUBLE_ROUNDING: f64 = 1e-10;

/// Largest number of stretches that are examined; with more the ladder is the faster.
const MAX_STRETCHES: usize = 16;

/// Largest number of open intervals that are examined again as one stretch.
const LONGEST_RUN: u32 = 2;

/// A stretch of a motion's parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    from: f64,
    width: f64,
}

/// Whether a motion is surely free in a scene, or surely not; `None` where it is neither. It says nothing that the
/// march would not say with its usual budget.
pub(crate) fn decide(scene: &Scene, linkage: &Linkage) -> Option<bool> {
    let motion = LinkageAmong { scene, outlines: scene.outlines.as_ref()?, linkage };
    let mut stretches: SmallVec<[Stretch; 2 * MAX_STRETCHES]> = SmallVec::new();
    stretches.push(Stretch { from: 0.0, width: 1.0 });
    let mut room = SweptPart::EMPTY;
    for examined in 0..MAX_STRETCHES {
        let Some(stretch) = stretches.get(examined).copied() else { return Some(true) };
        match motion.at(stretch, &mut room)? {
            LaneAnswer::Contact => return Some(false),
            LaneAnswer::Open(open) => stretches.extend(runs(stretch, open)),
        }
    }
    (stretches.len() <= MAX_STRETCHES).then_some(true)
}

/// The stretches that are made of open intervals, given as bits, that follow one another.
fn runs(of: Stretch, mut open: u32) -> impl Iterator<Item = Stretch> {
    let interval = of.width / LANES as f64;
    std::iter::from_fn(move || {
        (open != 0).then(|| {
            let first = open.trailing_zeros();
            let count = (open >> first).trailing_ones().min(LONGEST_RUN);
            open &= !(((1 << count) - 1) << first);
            Stretch { from: of.from + f64::from(first) * interval, width: f64::from(count) * interval }
        })
    })
}

/// A motion and the scene that it is in.
struct LinkageAmong<'a> {
    scene: &'a Scene,
    outlines: &'a PieceOutlines,
    linkage: &'a Linkage,
}

impl LinkageAmong<'_> {
    /// What is known of a stretch; `None` where the motion's numbers are too large for single precision, or none.
    /// `room` is for one part after the other.
    fn at(&self, Stretch { from, width }: Stretch, room: &mut SweptPart) -> Option<LaneAnswer> {
        let Linkage { origin, travel, parts } = self.linkage;
        let middle = from + 0.5 * width;
        let half = f64::from(HALF) * width;
        let point = origin + travel * middle;
        let mut frame = FrameOrigin::moving([travel.x * width, travel.y * width]);
        let (mut reach, mut acceleration, mut open) = ((travel.x.abs() + travel.y.abs()) * width, 0.0, 0);
        for (k, part) in parts.iter().enumerate() {
            let [far_x, far_y] = farthest(part.core);
            let size = 2.0 * (reach + far_x + far_y) + part.radius;
            if !fits(part, point, size) {
                return None;
            }
            let fastest = acceleration + sqrt(far_x * far_x + far_y * far_y) * part.turn * part.turn;
            let hinge = parts.get(k + 1).map_or(0.0, |next| next.hinge);
            sweep(room, &mut frame, TurningCore::new(part, middle, width), hinge as f32);
            let (sagitta, least) = (0.5 * fastest * half * half, MARCHED * fastest);
            let seen = SweptAmong { part: room, point, size, radius: part.radius, sagitta, least };
            match seen.pieces(self.scene, self.outlines) {
                LaneAnswer::Contact => return Some(LaneAnswer::Contact),
                LaneAnswer::Open(also) => open |= also,
            }
            reach += hinge.abs();
            acceleration += hinge.abs() * part.turn * part.turn;
        }
        Some(LaneAnswer::Open(open))
    }
}

/// How far a core reaches from its frame's origin along the axes, metres.
fn farthest(core: Aabb) -> [f64; 2] {
    let Aabb { min, max } = core;
    [greater(min.x.abs(), max.x.abs()), greater(min.y.abs(), max.y.abs())]
}

/// Whether a part of this size, with its coordinates from `point`, can be examined in single precision. False where a
/// number is NaN.
fn fits(part: &TurningPart, point: Point2, size: f64) -> bool {
    let TurningPart { heading, turn, core: Aabb { min, max }, radius, .. } = part;
    heading.abs() + turn.abs() <= MAX_ANGLE
        && size <= MAX_SIZE
        && *radius >= 0.0
        && point.x.abs() + point.y.abs() <= MAX_SIZE
        && (min.x + min.y + max.x + max.y).is_finite()
}

/// A swept part, and what it takes to judge it among pieces.
struct SweptAmong<'a> {
    part: &'a SweptPart,
    /// What its coordinates count from.
    point: Point2,
    /// An upper bound on its coordinates and their changes, metres.
    size: f64,
    radius: f64,
    sagitta: f64,
    /// The clearance that the march needs, metres.
    least: f64,
}

impl SweptAmong<'_> {
    /// What is known of the part and the pieces of a scene.
    fn pieces(&self, scene: &Scene, outlines: &PieceOutlines) -> LaneAnswer {
        let SweptAmong { part, point, size, sagitta, .. } = *self;
        let least = self.least + DOUBLE_ROUNDING * (scene.size + point.x.abs() + point.y.abs());
        let [x0, y0, x1, y1] = part.bounds.map(f64::from);
        let around = Aabb { min: point + Vector2::new(x0, y0), max: point + Vector2::new(x1, y1) };
        let range = self.radius + sagitta + least + ROUNDING * size;
        let mut answer = LaneAnswer::Open(0);
        scene.index.each_near(&around, range, |piece| {
            let outline = outlines.outline(piece);
            let centre = outline.centre - point;
            let coordinates = size + centre.x.abs() + centre.y.abs() + f64::from(outline.size + outline.radius);
            let (radius, margin) = (self.radius + f64::from(outline.radius), ROUNDING * coordinates + least);
            let clear = (radius + sagitta + margin) as f32;
            let reaches = Reaches { clear, radius: radius as f32, margin: margin as f32 };
            let local = LocalPiece { outline, centre: [centre.x as f32, centre.y as f32] };
            match (judge(part, local, reaches), &mut answer) {
                (LaneAnswer::Open(also), LaneAnswer::Open(open)) => *open |= also,
                _ => answer = LaneAnswer::Contact,
            }
            answer == LaneAnswer::Contact
        });
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_intervals_that_follow_one_another_are_examined_in_pairs() {
        let stretch = |from: f64, width: f64| Stretch { from, width };
        let of = |open: u32| runs(stretch(0.5, 0.25), open).collect::<Vec<_>>();
        let interval = 0.25 / 8.0;
        assert_eq!(of(0), []);
        assert_eq!(of(0b1000_0000), [stretch(0.5 + 7.0 * interval, interval)]);
        let (single, pair) = (stretch(0.5, interval), stretch(0.5 + 2.0 * interval, 2.0 * interval));
        assert_eq!(of(0b0001_1101), [single, pair, stretch(0.5 + 4.0 * interval, interval)]);
        assert_eq!(of(0b1111_1111).len(), 4);
    }
}
