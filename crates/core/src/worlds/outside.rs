//! `OutsideError`, what does not lie within its world, and which robots do not.

use super::{Resident, World};
use crate::configuration::{ArmSizes, CarSizes, RobotKind, Sizes};
use crate::geometry::{Aabb, Point2};
use crate::num::{greater, hypot, lesser};

/// Why something is not within its world's bounds, whose sides belong to it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutsideError {
    /// A position outside the bounds.
    #[error(
        "the {what} ({x}, {y}) lies outside the world, which reaches from ({}, {}) to ({}, {})",
        bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y
    )]
    Position {
        /// What is there: `start`, `goal`, `base`.
        what: &'static str,
        /// Where it is, metres.
        x: f64,
        /// Where it is, metres.
        y: f64,
        /// The world's bounds.
        bounds: Box<Aabb>,
    },
    /// A robot that fits nowhere into the bounds.
    #[error("{what} {size} m: the world is {width} m by {height} m, and lengths are in metres")]
    TooLarge {
        /// What is too large: `a diameter of`, `a link of`.
        what: &'static str,
        /// How large it is, metres.
        size: f64,
        /// The width of the world, metres.
        width: f64,
        /// The height of the world, metres.
        height: f64,
    },
}

impl OutsideError {
    /// Checks that a position, metres, lies within these bounds; the error calls it `what`.
    ///
    /// # Errors
    /// [`OutsideError::Position`] when it does not; a position that is not finite lies outside.
    pub fn check(what: &'static str, at: Point2, bounds: &Aabb) -> Result<(), Self> {
        if bounds.contains(at) {
            return Ok(());
        }
        Err(OutsideError::Position { what, x: at.x, y: at.y, bounds: Box::new(*bounds) })
    }
}

impl World {
    /// Checks that a configuration of one of its residents, which the error calls `what`, is within its bounds: the
    /// rover's centre, the middle of a car's rear axle. An arm's base is checked by [`check_resident`].
    ///
    /// [`check_resident`]: Self::check_resident
    ///
    /// # Errors
    /// [`OutsideError::Position`]. Kinds of a program's own are not checked.
    pub fn check_position(&self, kind: &str, what: &'static str, coordinates: &[f64]) -> Result<(), OutsideError> {
        match coordinates {
            [x, y, ..] if RobotKind::of(kind).is_some_and(|known| known.lengths == 2) => {
                OutsideError::check(what, Point2::new(*x, *y), &self.bounds)
            }
            _ => Ok(()),
        }
    }

    /// Checks that a robot is within its bounds: its start's position, an arm's base, and that no length of it is
    /// larger than they are. Robots may reach over the bounds, which are no obstacle.
    ///
    /// # Errors
    /// [`OutsideError`]. Kinds of a program's own are not checked.
    pub fn check_resident(&self, resident: &Resident) -> Result<(), OutsideError> {
        let Resident { kind, start, sizes, .. } = resident;
        self.check_position(kind, "start", start)?;
        let Some(sizes) = sizes.clone().or_else(|| Sizes::of_kind(kind)) else { return Ok(()) };
        if let Sizes::Arm(ArmSizes { base, .. }) = &sizes {
            OutsideError::check("base", *base, &self.bounds)?;
        }
        let (width, height) = (self.bounds.max.x - self.bounds.min.x, self.bounds.max.y - self.bounds.min.y);
        let has_trailer = start.len() > 3;
        for (what, size, most) in measures(&sizes, has_trailer, [width, height]) {
            if size > most {
                return Err(OutsideError::TooLarge { what, size, width, height });
            }
        }
        Ok(())
    }

    /// Checks that all its robots are within its bounds, as [`check_resident`](Self::check_resident).
    ///
    /// # Errors
    /// The number of the first robot that is not, and the reason.
    pub fn check_residents(&self) -> Result<(), (usize, OutsideError)> {
        let checked = |(i, resident)| self.check_resident(resident).map_err(|error| (i, error));
        self.robots.iter().enumerate().try_for_each(checked)
    }
}

/// Lengths of a robot, metres, each with the most that fits into a box with these sides.
fn measures(sizes: &Sizes, has_trailer: bool, [width, height]: [f64; 2]) -> Vec<(&'static str, f64, f64)> {
    let (side, diagonal) = (lesser(width, height), hypot(width, height));
    match sizes {
        Sizes::Disc(disc) => vec![("a diameter of", 2.0 * disc.radius, side)],
        Sizes::Arm(arm) => arm.lengths.iter().map(|length| ("a link of", *length, diagonal)).collect(),
        Sizes::Car(CarSizes { length, width, trailer, .. }) => {
            let hitch_len = if has_trailer { trailer.hitch_len } else { 0.0 };
            vec![
                ("a car of", greater(*length, *width), diagonal),
                ("a trailer whose axle is behind the hitch by", hitch_len, diagonal),
            ]
        }
    }
}
