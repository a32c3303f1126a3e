//! Dubins's curves: the shortest way of a car that only goes ahead.
//!
//! L. E. Dubins, On curves of minimal length with a constraint on average curvature, and with prescribed initial and
//! terminal positions and tangents (1957). The closed forms are those of A. M. Shkel and V. Lumelsky, Classification of
//! the Dubins set (2001), in the frame of the start.

use std::f64::consts::TAU;

use super::curve::{Curve, CurvePiece, CurvePieces, Turn, arc_cosine, goal_in_units, keep_shorter, root};
use crate::geometry::Pose2;
use crate::num::{atan2, hypot, sin_cos, wrap};

/// An angle this near a whole turn is none: what rounding makes of 0.
const WHOLE_TURN: f64 = 1e-10;

/// The shortest curve from `from` to `to` of a car that goes ahead and turns with at least this radius, metres; of two
/// equally long ones that of the first word in the order LSL, RSR, LSR, RSL, RLR, LRL.
///
/// `None` when a number is not finite or the radius not above 0. The same pose twice gives a curve without pieces.
///
/// ```
/// use motion_lab_core::planning::curves::dubins;
/// use motion_lab_core::prelude::*;
/// // three quarters of a circle to the left end beside the start, across it
/// let curve = dubins(&Pose2::IDENTITY, &Pose2::new(-2.0, 2.0, -std::f64::consts::FRAC_PI_2), 2.0).unwrap();
/// assert!((curve.length() - 3.0 * std::f64::consts::PI).abs() < 1e-9);
/// ```
pub fn dubins(from: &Pose2, to: &Pose2, radius: f64) -> Option<Curve> {
    let goal = goal_in_units(from, to, radius)?;
    let mut best = None;
    // in a mirror every word to the left is one to the right
    for (word, mirrored) in [(lsl as Word, false), (lsl, true), (lsr, false), (lsr, true), (lrl, true), (lrl, false)] {
        let seen = if mirrored { Pose2 { x: goal.x, y: -goal.y, theta: wrap(-goal.theta) } } else { goal };
        if let Some(pieces) = word(&seen) {
            let turn = |turn: Turn| if mirrored { turn.mirrored() } else { turn };
            let pieces = pieces.into_iter().map(|p| CurvePiece { turn: turn(p.turn), ..p }).collect();
            keep_shorter(&mut best, pieces, &goal);
        }
    }
    best.map(|pieces| Curve::of_units(radius, &pieces))
}

/// The closed form of one word, such as [`lsl`]: the pieces that lead from the start to a goal. The goal is in the
/// start's frame; lengths are in units of the radius. `None` where no curve of this word reaches the goal.
type Word = fn(&Pose2) -> Option<CurvePieces>;

/// An angle as a turn that is driven ahead, in `[0, 2 pi)`.
fn ahead(angle: f64) -> f64 {
    let turn = wrap(angle);
    let turn = if turn < 0.0 { turn + TAU } else { turn };
    if turn > TAU - WHOLE_TURN { 0.0 } else { turn }
}

fn pieces(turns: [Turn; 3], lengths: [f64; 3]) -> CurvePieces {
    turns.into_iter().zip(lengths).map(|(turn, length)| CurvePiece { turn, length }).collect()
}

/// Left, straight, left: the line joins the two circles' centres, in parallel.
fn lsl(goal: &Pose2) -> Option<CurvePieces> {
    let (sin, cos) = sin_cos(goal.theta);
    let (x, y) = (goal.x - sin, goal.y - 1.0 + cos);
    let t = ahead(atan2(y, x));
    Some(pieces([Turn::Left, Turn::Straight, Turn::Left], [t, hypot(x, y), ahead(goal.theta - t)]))
}

/// Left, straight, right: the line crosses between the two circles.
fn lsr(goal: &Pose2) -> Option<CurvePieces> {
    let (sin, cos) = sin_cos(goal.theta);
    let (x, y) = (goal.x + sin, goal.y - 1.0 - cos);
    let straight = root(x * x + y * y - 4.0)?;
    let t = ahead(atan2(y, x) + atan2(2.0, straight));
    Some(pieces([Turn::Left, Turn::Straight, Turn::Right], [t, straight, ahead(t - goal.theta)]))
}

/// Left, right, left: the middle circle touches both others, and more than half of it is driven.
fn lrl(goal: &Pose2) -> Option<CurvePieces> {
    let (sin, cos) = sin_cos(goal.theta);
    let (x, y) = (goal.x - sin, goal.y - 1.0 + cos);
    let u = TAU - arc_cosine(1.0 - (x * x + y * y) / 8.0)?;
    let t = ahead(atan2(y, x) + 0.5 * u);
    Some(pieces([Turn::Left, Turn::Right, Turn::Left], [t, u, ahead(goal.theta - t + u)]))
}
