//! Reeds and Shepp's curves: the shortest way of a car that goes ahead and back.
//!
//! J. A. Reeds and L. A. Shepp, Optimal paths for a car that goes both forwards and backwards (1990). A shortest curve
//! is one of 48 words, all of which come from the eight below by driving them in the opposite gear, in a mirror, or
//! from their end. C is an arc, S a line, | a change of gear; equal angles bear the same name.

use std::f64::consts::{FRAC_PI_2, PI};

use super::curve::{Curve, CurvePiece, CurvePieces, Turn, arc_cosine, goal_in_units, keep_shorter, root};
use crate::geometry::Pose2;
use crate::num::{atan2, hypot, sin_cos, wrap};

/// A turn this little in the wrong gear is none: what rounding makes of 0.
const NO_TURN: f64 = 1e-10;

/// The shortest curve from `from` to `to` of a car that goes ahead and back and turns with at least this radius,
/// metres; of equally long ones always the same.
///
/// `None` when a number is not finite or the radius not above 0. The same pose twice gives a curve without pieces.
///
/// ```
/// use motion_lab_core::planning::curves::reeds_shepp;
/// use motion_lab_core::prelude::*;
/// // turning on the spot by half a turn: three arcs of a third of that, with two changes of gear
/// let curve = reeds_shepp(&Pose2::IDENTITY, &Pose2::new(0.0, 0.0, std::f64::consts::PI), 1.0).unwrap();
/// assert!((curve.length() - std::f64::consts::PI).abs() < 1e-9);
/// assert_eq!(curve.reversals(), 2);
/// ```
pub fn reeds_shepp(from: &Pose2, to: &Pose2, radius: f64) -> Option<Curve> {
    let goal = goal_in_units(from, to, radius)?;
    let (sin, cos) = sin_cos(goal.theta);
    let mut best = None;
    for word in WORDS {
        for view in WordSymmetry::ALL {
            let (x, y, phi) = if view.from_end {
                (goal.x * cos + goal.y * sin, goal.x * sin - goal.y * cos, goal.theta)
            } else {
                (goal.x, goal.y, goal.theta)
            };
            let (x, phi) = if view.other_gear { (-x, -phi) } else { (x, phi) };
            let (y, phi) = if view.mirrored { (-y, -phi) } else { (y, phi) };
            if let Some(pieces) = word(&UnitGoal::new(x, y, phi)) {
                keep_shorter(&mut best, view.seen(&pieces), &goal);
            }
        }
    }
    best.map(|pieces| Curve::of_units(radius, &pieces))
}

/// A way to look at the same problem in which its curves have other words.
#[derive(Clone, Copy)]
struct WordSymmetry {
    other_gear: bool,
    mirrored: bool,
    /// Driven from the end.
    from_end: bool,
}

impl WordSymmetry {
    const ALL: [WordSymmetry; 8] = [
        WordSymmetry { other_gear: false, mirrored: false, from_end: false },
        WordSymmetry { other_gear: true, mirrored: false, from_end: false },
        WordSymmetry { other_gear: false, mirrored: true, from_end: false },
        WordSymmetry { other_gear: true, mirrored: true, from_end: false },
        WordSymmetry { other_gear: false, mirrored: false, from_end: true },
        WordSymmetry { other_gear: true, mirrored: false, from_end: true },
        WordSymmetry { other_gear: false, mirrored: true, from_end: true },
        WordSymmetry { other_gear: true, mirrored: true, from_end: true },
    ];

    /// The pieces found in this view, as the start sees them.
    fn seen(self, pieces: &CurvePieces) -> CurvePieces {
        let seen = |p: &CurvePiece| CurvePiece {
            turn: if self.mirrored { p.turn.mirrored() } else { p.turn },
            length: if self.other_gear { -p.length } else { p.length },
        };
        if self.from_end { pieces.iter().rev().map(seen).collect() } else { pieces.iter().map(seen).collect() }
    }
}

/// A goal in the start's frame, with the sine and the cosine of its heading. Lengths are in units of the radius, the
/// heading `phi` in radians.
struct UnitGoal {
    x: f64,
    y: f64,
    phi: f64,
    sin: f64,
    cos: f64,
}

impl UnitGoal {
    fn new(x: f64, y: f64, phi: f64) -> Self {
        let (sin, cos) = sin_cos(phi);
        UnitGoal { x, y, phi, sin, cos }
    }

    /// From the centre of the left circle at the start to that at the end.
    fn left_to_left(&self) -> (f64, f64) {
        (self.x - self.sin, self.y - 1.0 + self.cos)
    }

    /// From the centre of the left circle at the start to that of the right circle at the end.
    fn left_to_right(&self) -> (f64, f64) {
        (self.x + self.sin, self.y - 1.0 - self.cos)
    }
}

/// The pieces of a word to a goal, in units of the radius.
type Word = fn(&UnitGoal) -> Option<CurvePieces>;

const WORDS: [Word; 8] = [
    line_between_left_circles,
    line_across,
    three_arcs,
    four_arcs_gear_in_the_middle,
    four_arcs_gear_at_both_ends,
    arcs_line_left,
    arcs_line_right,
    two_arcs_line_two_arcs,
];

const L: Turn = Turn::Left;
const R: Turn = Turn::Right;
const S: Turn = Turn::Straight;

fn pieces<const N: usize>(turns: [Turn; N], lengths: [f64; N]) -> Option<CurvePieces> {
    Some(turns.into_iter().zip(lengths).map(|(turn, length)| CurvePiece { turn, length }).collect())
}

fn is_ahead(length: f64) -> bool {
    length >= -NO_TURN
}

fn is_back(length: f64) -> bool {
    length <= NO_TURN
}

/// L+ S+ L+, formula 8.1.
fn line_between_left_circles(goal: &UnitGoal) -> Option<CurvePieces> {
    let (x, y) = goal.left_to_left();
    let t = atan2(y, x);
    let v = wrap(goal.phi - t);
    if is_ahead(t) && is_ahead(v) { pieces([L, S, L], [t, hypot(x, y), v]) } else { None }
}

/// L+ S+ R+, formula 8.2.
fn line_across(goal: &UnitGoal) -> Option<CurvePieces> {
    let (x, y) = goal.left_to_right();
    let u = root(x * x + y * y - 4.0)?;
    let t = wrap(atan2(y, x) + atan2(2.0, u));
    let v = wrap(t - goal.phi);
    if is_ahead(t) && is_ahead(v) { pieces([L, S, R], [t, u, v]) } else { None }
}

/// The angle that the middle arc of three turns through, and the heading after the first, of left circles so far apart.
fn middle_arc((x, y): (f64, f64)) -> Option<(f64, f64)> {
    let quarter = 0.25 * hypot(x, y);
    let u = 2.0 * atan2(quarter, root((1.0 - quarter) * (1.0 + quarter))?);
    Some((u, atan2(y, x)))
}

/// L+ | R- | L+, formula 8.3, and L+ | R- L-, formula 8.4: the last arc may have either gear.
fn three_arcs(goal: &UnitGoal) -> Option<CurvePieces> {
    let (u, bearing) = middle_arc(goal.left_to_left())?;
    let t = wrap(bearing - 0.5 * u + PI);
    let v = wrap(goal.phi - t - u);
    if is_ahead(t) { pieces([L, R, L], [t, -u, v]) } else { None }
}

/// The first and the last arc of four between which the car turns by u to the right and by v to the left.
fn outer_arcs(u: f64, v: f64, (x, y): (f64, f64), phi: f64) -> (f64, f64) {
    let ((sin_u, cos_u), (sin_d, cos_d)) = (sin_cos(u), sin_cos(u - v));
    let (a, b) = (sin_u - sin_d, cos_u - cos_d - 1.0);
    let heading = atan2(y * a - x * b, x * a + y * b);
    let turned = 2.0 * (cos_d - sin_cos(v).1 - cos_u) + 3.0 < 0.0;
    let t = wrap(if turned { heading + PI } else { heading });
    (t, wrap(t - u + v - phi))
}

/// L+ R(u)+ | L(u)- R-, formula 8.7.
fn four_arcs_gear_in_the_middle(goal: &UnitGoal) -> Option<CurvePieces> {
    let (x, y) = goal.left_to_right();
    let u = arc_cosine(0.25 * (2.0 + hypot(x, y)))?;
    let (t, v) = outer_arcs(u, -u, (x, y), goal.phi);
    if is_ahead(t) && is_back(v) { pieces([L, R, L, R], [t, u, -u, v]) } else { None }
}

/// L+ | R(u)- L(u)- | R+, formula 8.8.
fn four_arcs_gear_at_both_ends(goal: &UnitGoal) -> Option<CurvePieces> {
    let (x, y) = goal.left_to_right();
    let u = -arc_cosine((20.0 - x * x - y * y) / 16.0)?;
    if u < -FRAC_PI_2 - NO_TURN {
        return None;
    }
    let (t, v) = outer_arcs(u, u, (x, y), goal.phi);
    if is_ahead(t) && is_ahead(v) { pieces([L, R, L, R], [t, u, u, v]) } else { None }
}

/// L+ | R(pi/2)- S- L-, formula 8.9.
fn arcs_line_left(goal: &UnitGoal) -> Option<CurvePieces> {
    let (x, y) = goal.left_to_left();
    let far = root(x * x + y * y - 4.0)?;
    let u = 2.0 - far;
    let t = wrap(atan2(y, x) + atan2(far, -2.0));
    let v = wrap(goal.phi - FRAC_PI_2 - t);
    if is_ahead(t) && is_back(u) && is_back(v) { pieces([L, R, S, L], [t, -FRAC_PI_2, u, v]) } else { None }
}

/// L+ | R(pi/2)- S- R-, formula 8.10.
fn arcs_line_right(goal: &UnitGoal) -> Option<CurvePieces> {
    let (x, y) = goal.left_to_right();
    let u = 2.0 - hypot(x, y);
    let t = atan2(x, -y);
    let v = wrap(t + FRAC_PI_2 - goal.phi);
    if is_ahead(t) && is_back(u) && is_back(v) { pieces([L, R, S, R], [t, -FRAC_PI_2, u, v]) } else { None }
}

/// L+ | R(pi/2)- S- L(pi/2)- | R+, formula 8.11.
fn two_arcs_line_two_arcs(goal: &UnitGoal) -> Option<CurvePieces> {
    let (x, y) = goal.left_to_right();
    let u = 4.0 - root(x * x + y * y - 4.0)?;
    let t = wrap(atan2((4.0 - u) * x - 2.0 * y, -2.0 * x + (u - 4.0) * y));
    let v = wrap(t - goal.phi);
    let lengths = [t, -FRAC_PI_2, u, -FRAC_PI_2, v];
    if is_ahead(t) && is_back(u) && is_ahead(v) { pieces([L, R, S, L, R], lengths) } else { None }
}
