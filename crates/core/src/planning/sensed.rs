//! `Sensed`, what the robot of a planner sees where it is, and `LeavePoint`, where it left a boundary.

use std::fmt;

use crate::geometry::Point2;

/// What the robot of a planner sees where it is, and where it has left boundaries, to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensed {
    /// The place of the robot and of its range sensor.
    pub at: Point2,
    /// The ranges that the sensor reads there, metres, from the x axis on.
    pub ranges: Vec<f64>,
    /// Where it has left boundaries, in order.
    pub leave_points: Vec<LeavePoint>,
}

/// The end of a round about an obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoundEnd {
    /// It left for the goal.
    Free,
    /// It saw the goal behind the obstacle, at the place that seemed nearest to the goal.
    Behind,
    /// It never came back to the place that seemed nearest to the goal.
    NotFound,
    /// It never came back to where it had met the obstacle.
    NotClosed,
}

/// Where a robot left the boundary of an obstacle after a round about it, and where it should have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeavePoint {
    /// Where it left, or where it gave up.
    pub at: Point2,
    /// The place of the same round, by exact nearest points, where the boundary comes nearest to the goal; `None` where
    /// that round never closes.
    pub nearest: Option<Point2>,
    /// The excess of the leave point's distance from the goal over that place's, metres.
    pub excess: f64,
    /// How the round ended.
    pub leaving: RoundEnd,
}

impl LeavePoint {
    /// Largest excess of a leave point that is not misjudged, metres.
    pub const TOLERANCE: f64 = 0.1;

    /// Whether the robot misjudged it, given that the goal can be reached.
    pub fn is_misjudged(&self) -> bool {
        self.leaving != RoundEnd::Free || self.is_too_far()
    }

    /// Whether it lies farther from the goal than the nearest place of the round, by more than the tolerance.
    pub fn is_too_far(&self) -> bool {
        // what is no number is misjudged too
        !self.excess.le(&Self::TOLERANCE)
    }
}

impl fmt::Display for LeavePoint {
    /// The leave point in words: `left where the boundary comes nearest`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let excess = self.excess;
        match self.leaving {
            RoundEnd::Free if self.is_too_far() => {
                write!(f, "left {excess:.2} m farther from the goal than the boundary comes: misjudged")
            }
            RoundEnd::Free => f.write_str("left where the boundary comes nearest"),
            RoundEnd::Behind if self.is_too_far() => write!(
                f,
                "saw the goal behind the obstacle, {excess:.2} m farther from it than the boundary comes: misjudged"
            ),
            RoundEnd::Behind => f.write_str("saw the goal behind the obstacle where the boundary comes nearest"),
            RoundEnd::NotFound => f.write_str("never came back to where the boundary had seemed nearest"),
            RoundEnd::NotClosed => f.write_str("never closed its round"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_beyond_the_tolerance_is_misjudged_and_said_in_metres() {
        let of = |excess: f64, leaving: RoundEnd| LeavePoint { at: Point2::origin(), nearest: None, excess, leaving };
        let words = |excess, leaving| of(excess, leaving).to_string();
        assert_eq!(words(0.1, RoundEnd::Free), "left where the boundary comes nearest");
        assert_eq!(words(-0.3, RoundEnd::Free), "left where the boundary comes nearest");
        assert_eq!(
            words(0.432, RoundEnd::Free),
            "left 0.43 m farther from the goal than the boundary comes: misjudged"
        );
        assert!(words(0.432, RoundEnd::Behind).ends_with("0.43 m farther from it than the boundary comes: misjudged"));
        let misjudged = |excess, leaving| of(excess, leaving).is_misjudged();
        assert!(
            !misjudged(0.1, RoundEnd::Free) && misjudged(0.101, RoundEnd::Free) && misjudged(f64::NAN, RoundEnd::Free)
        );
        for leaving in [RoundEnd::Behind, RoundEnd::NotFound, RoundEnd::NotClosed] {
            assert!(misjudged(0.0, leaving), "{leaving:?}");
        }
    }
}
