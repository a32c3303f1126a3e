//! `Curve`, a chain of arcs of one radius and straight lines.

use crate::collision::Checker;
use crate::configuration::HitchCfg;
use crate::geometry::{Pose2, Tangent2};
use crate::num::{acos, atan2, greater, hypot, sqrt};
use crate::planning::{CertifiedPath, PathError};
use crate::robots::{CarCmd, ConfigurationError, Drivable, Hitch, HitchArc, Motion};
use crate::short_list::ShortList;

/// Which way the wheels are turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// As far to the left as they go.
    Left,
    /// Not at all.
    Straight,
    /// As far to the right as they go.
    Right,
}

impl Turn {
    /// The curvature in units of the tightest turn's: 1 to the left, -1 to the right.
    pub const fn sign(self) -> f64 {
        match self {
            Turn::Left => 1.0,
            Turn::Straight => 0.0,
            Turn::Right => -1.0,
        }
    }

    /// The turn in a mirror along the x axis.
    #[must_use]
    pub(super) const fn mirrored(self) -> Self {
        match self {
            Turn::Left => Turn::Right,
            Turn::Straight => Turn::Straight,
            Turn::Right => Turn::Left,
        }
    }
}

/// A piece of a curve: an arc of the curve's radius, or a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePiece {
    /// Which way the wheels are turned.
    pub turn: Turn,
    /// The signed length, metres: negative where the car goes back.
    pub length: f64,
}

/// The pieces of a curve in units of its radius.
pub(super) type CurvePieces = ShortList<CurvePiece, 5>;

/// A curve that a car can drive: arcs of one radius and straight lines, ahead and back.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    radius: f64,
    pieces: CurvePieces,
}

/// The length below which a piece is left out, in units of the radius.
const NOTHING: f64 = 1e-12;

/// How far from its goal a candidate may end, in units of the radius and for each unit of the goal's distance.
const MISSES: f64 = 1e-9;

impl Curve {
    /// The curve of these pieces in units of the radius.
    pub(super) fn of_units(radius: f64, units: &CurvePieces) -> Self {
        let is_some = |piece: &&CurvePiece| piece.length.abs() > NOTHING;
        let pieces = units.iter().filter(is_some).map(|p| CurvePiece { length: p.length * radius, ..*p }).collect();
        Curve { radius, pieces }
    }

    /// The radius of its arcs, metres.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Its pieces in order, none of them without length.
    pub fn pieces(&self) -> &[CurvePiece] {
        &self.pieces
    }

    /// How far the car drives along it, ahead and back, metres.
    pub fn length(&self) -> f64 {
        length(&self.pieces)
    }

    /// How often the car changes between going ahead and going back.
    pub fn reversals(&self) -> usize {
        self.pieces.windows(2).filter(|pair| (pair[0].length > 0.0) != (pair[1].length > 0.0)).count()
    }

    /// What a car drives along it from `from`, at its greatest speed: a motion for each piece. The arcs are the car's
    /// own tightest where the radius is [`Hitch::tightest`]; a trailer is pulled or pushed along as it will.
    ///
    /// # Errors
    /// [`ConfigurationError`] when `from` is not a configuration of this car, or a piece takes more than an hour.
    pub fn drives(&self, car: &Hitch, from: &HitchCfg) -> Result<Vec<HitchArc>, ConfigurationError> {
        let mut at = *from;
        let drive = |piece: &CurvePiece| {
            let phi = piece.turn.sign() * atan2(car.wheelbase, self.radius);
            let control = CarCmd { v: car.max_speed.copysign(piece.length), phi };
            let arc = car.drive(&at, &control, piece.length.abs() / car.max_speed)?;
            at = arc.at(1.0);
            Ok(arc)
        };
        self.pieces.iter().map(drive).collect()
    }

    /// The path along it from `from`, with its certificates.
    ///
    /// # Errors
    /// [`PathError`]: a curve without pieces, a configuration that is not the car's, a piece that is not proven free.
    pub fn certified(&self, checker: &Checker<Hitch>, from: &HitchCfg) -> Result<CertifiedPath<HitchArc>, PathError> {
        let refused = |source| PathError::Configuration { corner: 0, source };
        CertifiedPath::try_new(checker, self.drives(checker.robot(), from).map_err(refused)?)
    }

    /// Where a car ends that drives it from `from`.
    pub fn end(&self, from: &Pose2) -> Pose2 {
        self.at(from, f64::INFINITY)
    }

    /// Where a car is that has driven `driven` metres along it from `from`, ahead and back; its end beyond its length.
    pub fn at(&self, from: &Pose2, driven: f64) -> Pose2 {
        let mut left = driven;
        let mut at = *from;
        for piece in &self.pieces[..] {
            let whole = piece.length.abs();
            let length = if left < whole { piece.length.signum() * left } else { piece.length };
            at = at.boxplus(&Tangent2::new(length, 0.0, piece.turn.sign() * length / self.radius));
            left -= whole;
            if left <= 0.0 {
                break;
            }
        }
        at
    }
}

/// How far rounding may take a number beyond the end of its range: two circles that touch may seem to overlap.
const TOUCHES: f64 = 1e-12;

/// The square root, of 0 where rounding made it less; `None` of a number that is less.
pub(super) fn root(square: f64) -> Option<f64> {
    if square < -TOUCHES { None } else { Some(sqrt(greater(square, 0.0))) }
}

/// The arc cosine, where rounding took the cosine beyond 1 or -1 that of the end; `None` farther beyond.
pub(super) fn arc_cosine(cosine: f64) -> Option<f64> {
    if cosine.abs() > 1.0 + TOUCHES { None } else { Some(acos(cosine.clamp(-1.0, 1.0))) }
}

/// The length of pieces, in their own unit.
pub(super) fn length(pieces: &[CurvePiece]) -> f64 {
    // the sum of no floats is -0.0
    pieces.iter().fold(0.0, |sum, piece| sum + piece.length.abs())
}

/// The goal as the start sees it, in units of the radius. `None` when a number is not finite or the radius not above 0.
pub(super) fn goal_in_units(from: &Pose2, to: &Pose2, radius: f64) -> Option<Pose2> {
    let seen = from.inverse().compose(to);
    let goal = Pose2 { x: seen.x / radius, y: seen.y / radius, theta: seen.theta };
    (radius > 0.0 && radius.is_finite() && goal.is_finite()).then_some(goal)
}

/// The shorter of the best pieces so far and a candidate, if the candidate ends at the goal. The closed forms divide by
/// numbers that may be nearly 0; a candidate that misses for that reason is passed over.
pub(super) fn keep_shorter(best: &mut Option<CurvePieces>, candidate: CurvePieces, goal: &Pose2) {
    if best.as_ref().is_some_and(|best| length(best) <= length(&candidate)) {
        return;
    }
    let curve = Curve::of_units(1.0, &candidate);
    let missed = goal.boxminus(&curve.end(&Pose2::IDENTITY));
    let most = MISSES * (1.0 + hypot(goal.x, goal.y));
    if hypot(missed.dx, missed.dy) <= most && missed.dtheta.abs() <= most {
        *best = Some(candidate);
    }
}
