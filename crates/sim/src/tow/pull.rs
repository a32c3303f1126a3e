//! `Pull`, a tow as its robot sees it.

use motion_lab_core::geometry::{Point2, Vector2};
use motion_lab_core::num::{hypot, lesser};

/// Part of a way that the first command for it may go, so that commands held for long do not pass the end.
const PART: f64 = 0.8;

/// A tow as its robot sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pull {
    /// How far ahead of the robot's reference point it is gripped, metres.
    pub(super) grip: f64,
    /// Where the grip is pulled to, in the robot's frame, metres.
    pub(super) aim: Point2,
    /// How long the command will be held, seconds, above 0.
    pub(super) held: f64,
}

impl Pull {
    /// From the grip to the aim.
    pub(super) fn way(&self) -> Vector2 {
        self.aim - Point2::new(self.grip, 0.0)
    }

    /// Whether the grip is within `radius` metres of the aim.
    pub(super) fn is_within(&self, radius: f64) -> bool {
        hypot(self.way().x, self.way().y) <= radius
    }

    /// The rate at which to take away `off`, proportional to it by `gain` per second.
    pub(super) fn rate(&self, off: f64, gain: f64) -> f64 {
        off * lesser(gain, PART / self.held)
    }
}
