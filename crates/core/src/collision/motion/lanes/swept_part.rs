//! `SweptPart`, a part of a linkage at the middles of eight intervals, and what it sweeps over in each.

use super::angles::sin_cos;
use crate::collision::LANES;
use crate::robots::TurningPart;

/// Eight numbers in single precision, one for each interval.
pub(crate) type Octet = [f32; LANES];

/// The middles of the intervals, in widths of the stretch from its own middle.
const MIDDLES: Octet = [-0.4375, -0.3125, -0.1875, -0.0625, 0.0625, 0.1875, 0.3125, 0.4375];

/// Half an interval, in widths of the stretch.
pub(crate) const HALF: f32 = 0.0625;

/// The origin of a part's frame at the middles of the intervals, metres from some point near it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameOrigin {
    at: [Octet; 2],
    /// How far it goes in half an interval along its tangent.
    step: [Octet; 2],
}

/// How a part turns over a stretch, and its core.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TurningCore {
    /// The heading in the middle of the stretch, and the turn over all of it, radians.
    heading: f32,
    turn: f32,
    /// The core's least and greatest x in the part's frame, then its least and greatest y, metres.
    x: [f32; 2],
    y: [f32; 2],
}

/// A part at the middles of the intervals, and what its core sweeps over if it goes from there along its tangent, by
/// half an interval to either side. All coordinates are in metres from some point near it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SweptPart {
    /// The number of corners of the core: 2 or 4.
    pub(crate) count: usize,
    pub(crate) corners: [[Octet; 2]; 4],
    /// How far each corner goes in half an interval along its tangent.
    pub(crate) steps: [[Octet; 2]; 4],
    /// The x axis of the part's frame.
    pub(crate) ahead: [Octet; 2],
    /// The least and the greatest height of the core along the frame's x axis, then along its y axis.
    pub(crate) still: [[Octet; 2]; 2],
    /// The same of what it sweeps over.
    pub(crate) swept: [[Octet; 2]; 2],
    /// The least x and y of all that it sweeps over, then the greatest.
    pub(crate) bounds: [f32; 4],
}

impl FrameOrigin {
    /// The origin of a frame that moves by `travel` over the stretch, from where it is in the middle.
    pub(crate) fn moving(travel: [f64; 2]) -> Self {
        let [x, y] = travel.map(|travel| travel as f32);
        let along = |travel: f32| MIDDLES.map(|middle| travel * middle);
        FrameOrigin { at: [along(x), along(y)], step: [[x * HALF; LANES], [y * HALF; LANES]] }
    }
}

impl TurningCore {
    /// A part over a stretch of this middle and width.
    pub(crate) fn new(part: &TurningPart, middle: f64, width: f64) -> Self {
        let (heading, turn) = ((part.heading + part.turn * middle) as f32, (part.turn * width) as f32);
        let (min, max) = (part.core.min, part.core.max);
        TurningCore { heading, turn, x: [min.x as f32, max.x as f32], y: [min.y as f32, max.y as f32] }
    }
}

impl SweptPart {
    /// Room for a part, to be filled in.
    pub(crate) const EMPTY: Self = {
        let nothing = [[0.0; LANES]; 2];
        SweptPart {
            count: 0,
            corners: [nothing; 4],
            steps: [nothing; 4],
            ahead: nothing,
            still: [nothing; 2],
            swept: [nothing; 2],
            bounds: [0.0; 4],
        }
    };
}

/// The lesser of two numbers, and the greater: as one instruction each.
#[inline(always)]
pub(crate) fn ordered(a: f32, b: f32) -> [f32; 2] {
    [if a < b { a } else { b }, if a > b { a } else { b }]
}

/// The least of eight numbers.
#[inline(always)]
pub(crate) fn least(of: Octet) -> f32 {
    let four: [f32; 4] = std::array::from_fn(|i| ordered(of[i], of[i + 4])[0]);
    let two: [f32; 2] = std::array::from_fn(|i| ordered(four[i], four[i + 2])[0]);
    ordered(two[0], two[1])[0]
}

/// Fills in the part with this origin and core, and moves the origin to what sits on the part's x axis at `next`
/// metres.
#[cfg_attr(
    not(baseline),
    multiversion::multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))
)]
pub(crate) fn sweep(part: &mut SweptPart, origin: &mut FrameOrigin, core: TurningCore, next: f32) {
    if core.y[0] == core.y[1] { turn::<2>(part, origin, core, next) } else { turn::<4>(part, origin, core, next) }
}

/// [`sweep`] of a part with as many corners.
#[inline(always)]
fn turn<const COUNT: usize>(part: &mut SweptPart, origin: &mut FrameOrigin, core: TurningCore, next: f32) {
    let (FrameOrigin { at, step }, [x0, x1], [y0, y1]) = (*origin, core.x, core.y);
    let half_turn = core.turn * HALF;
    part.count = COUNT;
    let corners = [[x0, y0], [x1, y1], [x1, y0], [x0, y1]];
    // the upper sides of the box with the other sign
    let mut sides = [[0.0; LANES]; 4];
    for i in 0..LANES {
        let (sin, cos) = sin_cos(core.heading + core.turn * MIDDLES[i]);
        (part.ahead[0][i], part.ahead[1][i]) = (cos, sin);
        // the origin and its step, along the frame's axes
        let (along, across) = (at[0][i] * cos + at[1][i] * sin, at[1][i] * cos - at[0][i] * sin);
        let (step_along, step_across) = (step[0][i] * cos + step[1][i] * sin, step[1][i] * cos - step[0][i] * sin);
        let (mut lo_x, mut hi_x, mut lo_y, mut hi_y) = (f32::INFINITY, -f32::INFINITY, f32::INFINITY, -f32::INFINITY);
        let mut box_sides = [f32::INFINITY; 4];
        for (c, [x, y]) in corners.into_iter().enumerate().take(COUNT) {
            let (turned_x, turned_y) = (cos * x - sin * y, sin * x + cos * y);
            (part.corners[c][0][i], part.corners[c][1][i]) = (at[0][i] + turned_x, at[1][i] + turned_y);
            part.steps[c][0][i] = step[0][i] - half_turn * turned_y;
            part.steps[c][1][i] = step[1][i] + half_turn * turned_x;
            let (x_step, y_step) = (part.steps[c][0][i].abs(), part.steps[c][1][i].abs());
            let (at_x, at_y) = (part.corners[c][0][i], part.corners[c][1][i]);
            for (side, of) in box_sides.iter_mut().zip([at_x - x_step, at_y - y_step, -at_x - x_step, -at_y - y_step]) {
                *side = ordered(*side, of)[0];
            }
            let (reach_x, reach_y) = ((step_along - half_turn * y).abs(), (step_across + half_turn * x).abs());
            (lo_x, hi_x) = (ordered(lo_x, x - reach_x)[0], ordered(hi_x, x + reach_x)[1]);
            (lo_y, hi_y) = (ordered(lo_y, y - reach_y)[0], ordered(hi_y, y + reach_y)[1]);
        }
        let (next_x, next_y) = (next * cos, next * sin);
        (origin.at[0][i], origin.at[1][i]) = (at[0][i] + next_x, at[1][i] + next_y);
        (origin.step[0][i], origin.step[1][i]) = (step[0][i] - half_turn * next_y, step[1][i] + half_turn * next_x);
        for (side, of) in sides.iter_mut().zip(box_sides) {
            side[i] = of;
        }
        (part.still[0][0][i], part.still[0][1][i]) = (along + x0, along + x1);
        (part.still[1][0][i], part.still[1][1][i]) = (across + y0, across + y1);
        (part.swept[0][0][i], part.swept[0][1][i]) = (along + lo_x, along + hi_x);
        (part.swept[1][0][i], part.swept[1][1][i]) = (across + lo_y, across + hi_y);
    }
    let [x0, y0, x1, y1] = sides.map(least);
    part.bounds = [x0, y0, -x1, -y1];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::{HitchCfg, Tn};
    use crate::geometry::{Point2, Pose2, Vector2};
    use crate::num::{greater, lesser, sin_cos};
    use crate::random::{Seed, Stream};
    use crate::robots::{ChartLine, HITCH, Motion, Reach, Robot};

    /// Compares the parts of an edge with its footprints, over a random stretch: the corners in the middle of each
    /// interval, to less than half the rung's margin; then that the core stays within the sagitta of what is swept
    /// over, along a random axis, along the part's own and in the box.
    fn compare<R: Robot>(draws: &mut Stream, edge: &ChartLine<R>) {
        let linkage = edge.linkage().unwrap();
        let width = [1.0, 0.25, 1.0 / 64.0][draws.below(3) as usize];
        let middle = draws.uniform(0.5 * width, 1.0 - 0.5 * width);
        let point = linkage.origin + linkage.travel * middle;
        let mut frame = FrameOrigin::moving([linkage.travel.x * width, linkage.travel.y * width]);
        let mut part = SweptPart::EMPTY;
        for (k, turning) in linkage.parts.iter().enumerate() {
            let hinge = linkage.parts.get(k + 1).map_or(0.0, |next| next.hinge);
            sweep(&mut part, &mut frame, TurningCore::new(turning, middle, width), hinge as f32);
            let size = 2.0 * (linkage.travel.norm() * width + 6.0);
            let (rounding, half) = (size / f64::from(1 << 18), f64::from(HALF) * width);
            let sagitta = 0.5 * edge.rates(k).acceleration * half * half;
            let (sin, cos) = sin_cos(draws.uniform(-3.0, 3.0));
            for i in 0..LANES {
                let s = middle + width * f64::from(MIDDLES[i]);
                let octet = |of: &[Octet; 2]| Vector2::new(f64::from(of[0][i]), f64::from(of[1][i]));
                let core = |s: f64| edge.footprint_at(s).parts()[k].placed().core().to_vec();
                let corners = part.corners.iter().take(part.count).map(octet);
                assert_eq!(core(s).len(), part.count);
                for corner in corners.clone() {
                    let off = core(s).iter().map(|p: &Point2| (p - point - corner).norm()).fold(f64::INFINITY, lesser);
                    assert!(off < rounding, "{off} of {rounding}");
                }
                let ahead = octet(&part.ahead);
                let across = Vector2::new(-ahead.y, ahead.x);
                let reach = |axis: Vector2| {
                    let swept = corners.clone().zip(part.steps.iter().map(octet));
                    let of = |(p, step): (Vector2, Vector2)| p.dot(&axis) + step.dot(&axis).abs();
                    swept.map(of).fold(f64::NEG_INFINITY, greater)
                };
                let [x, y] = [0, 1].map(|axis: usize| part.swept[axis].map(|side| f64::from(side[i])));
                let sides = part.bounds.map(f64::from);
                let random = Vector2::new(cos, sin);
                let bounds = [
                    (random, reach(random)),
                    (ahead, x[1]),
                    (-ahead, -x[0]),
                    (across, y[1]),
                    (-across, -y[0]),
                    (Vector2::x(), sides[2]),
                    (-Vector2::x(), -sides[0]),
                    (Vector2::y(), sides[3]),
                    (-Vector2::y(), -sides[1]),
                ];
                for beyond in [-1.0, -0.6, 0.0, 0.3, 1.0] {
                    for p in core(s + beyond * half) {
                        for (axis, bound) in bounds {
                            let height = (p - point).dot(&axis);
                            assert!(height <= bound + sagitta + rounding, "{height} beyond {bound} along {axis:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn parts_are_where_the_footprints_are_and_stay_by_their_tangents() {
        let mut draws = Stream::new(Seed(41), "swept parts");
        let arm = Reach { base: Point2::new(5.0, -3.0), lengths: [1.0, 0.7, 0.6], link_radius: 0.03 };
        let car = HITCH.with_trailer();
        for _ in 0..300 {
            let mut u = |size: f64| draws.uniform(-size, size);
            let [a, b] = [0, 1].map(|_| Tn([u(3.1), u(3.1), u(3.1)]));
            let mut place = || {
                let body = Pose2::new(40.0 + u(2.0), u(2.0), u(3.1));
                HitchCfg { body, trailer: Some(u(3.1)) }
            };
            let (from, to) = (place(), place());
            compare(&mut draws, &arm.edge(&a, &b).unwrap());
            compare(&mut draws, &car.edge(&from, &to).unwrap());
        }
    }

    #[test]
    fn the_least_of_eight_is_found_in_every_place() {
        for i in 0..LANES {
            let mut of = [3.0; LANES];
            of[i] = -2.0;
            assert_eq!(least(of), -2.0, "{i}");
        }
    }
}
