//! `View`, where a scan's rays begin and how far they reach.

use crate::geometry::Point2;

/// The sensor's position, heading, reach and number of rays in a scan.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) origin: Point2,
    /// A little more than the sensor's range, metres, and its square: what lies farther off is left out.
    pub(super) reach: f64,
    pub(super) reach_squared: f64,
    /// The bearing of ray 0, in turns, in [0, 1].
    pub(super) heading: f64,
    /// The number of rays in a full turn, not always whole.
    pub(super) rays: f64,
    /// The number of blocks of a fan of less than a full turn; `None` for a full turn.
    pub(super) fan_blocks: Option<usize>,
    /// Always 0, which the compiler does not know: see [`raised`](super::rays::raised).
    pub(super) nothing: f64,
}
