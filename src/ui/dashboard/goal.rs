//! `ParkingGoal`, "one metre to the left": the trailer is to end a metre left of where it stood, facing the same way.

use crate::geometry::{Footprint, Point2, Pose2};
use crate::num::wrap;
use crate::picture::{Item, Role, footprint};

/// Largest distance of the trailer from its goal that counts as reached, metres.
pub const DISTANCE: f64 = 0.05;
/// Largest difference in heading that counts as reached, radians.
pub const ANGLE: f64 = 0.05;

/// The parking exercise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParkingGoal {
    /// The pose wanted of the trailer.
    pub trailer: Pose2,
    /// The number of the car's changes of direction when the goal was set.
    pub reversals: u32,
}

/// How far the trailer is from its goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Off {
    /// Distance, metres.
    pub distance: f64,
    /// Difference in heading, radians, at least 0.
    pub angle: f64,
}

impl Off {
    /// Whether the goal is reached.
    pub fn is_reached(&self) -> bool {
        self.distance <= DISTANCE && self.angle <= ANGLE
    }
}

/// The trailer of a car that pulls one: its second part.
pub fn trailer_of(car: &Footprint) -> Option<&Pose2> {
    car.parts().get(1).map(|part| part.pose())
}

impl ParkingGoal {
    /// A metre to the left of a trailer that stands at `trailer` now.
    pub fn left_of(trailer: &Pose2, reversals: u32) -> Self {
        let at = trailer.transform(Point2::new(0.0, 1.0));
        ParkingGoal { trailer: Pose2 { x: at.x, y: at.y, theta: trailer.theta }, reversals }
    }

    /// How far a trailer is from it.
    pub fn off(&self, trailer: &Pose2) -> Off {
        let distance = (trailer.position() - self.trailer.position()).norm();
        Off { distance, angle: wrap(trailer.theta - self.trailer.theta).abs() }
    }

    /// Where the trailer of `car` is to be, as an outline.
    pub fn items(&self, car: &Footprint) -> Vec<Item> {
        let Some(part) = car.parts().get(1) else { return vec![] };
        let placed = crate::geometry::Part::new(self.trailer, part.shape().clone());
        footprint("goal/trailer", "where the trailer is to be", &Footprint::new([placed]), Role::Goal, 0.0)
    }

    /// The state of the exercise in words. `reversals` is the car's count now.
    pub fn words(&self, car: &Footprint, reversals: u32) -> String {
        let Some(off) = trailer_of(car).map(|trailer| self.off(trailer)) else {
            return "goal: put the trailer back on".into();
        };
        let count = reversals.saturating_sub(self.reversals);
        let times = if count == 1 { "reversal" } else { "reversals" };
        if off.is_reached() {
            format!("Reached: one metre to the left, {count} {times}.")
        } else {
            format!("goal: off by {:.2} m, {:.2} rad; {count} {times}", off.distance, off.angle)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::configuration::HitchCfg;
    use crate::robots::{HITCH, Robot};

    fn towing(x: f64, y: f64, theta: f64) -> Footprint {
        HITCH.with_trailer().footprint(&HitchCfg { body: Pose2::new(x, y, theta), trailer: Some(theta) })
    }

    #[test]
    fn left_is_left_of_the_way_the_trailer_faces() {
        let goal = ParkingGoal::left_of(&Pose2::new(2.0, 3.0, FRAC_PI_2), 0);
        assert!((goal.trailer.x - 1.0).abs() < 1e-12 && (goal.trailer.y - 3.0).abs() < 1e-12);
        assert_eq!(goal.trailer.theta, FRAC_PI_2);
    }

    #[test]
    fn it_is_reached_within_five_centimetres_and_a_twentieth_of_a_radian() {
        let start = towing(5.0, 5.0, 0.0);
        let goal = ParkingGoal::left_of(trailer_of(&start).unwrap(), 2);
        assert_eq!(goal.words(&start, 2), "goal: off by 1.00 m, 0.00 rad; 0 reversals");
        assert_eq!(goal.words(&towing(5.0, 6.04, 0.0), 3), "Reached: one metre to the left, 1 reversal.");
        assert!(goal.words(&towing(5.0, 6.06, 0.0), 3).starts_with("goal: off"));
        // turned about the hitch, which is the trailer's own frame
        assert!(goal.words(&towing(5.0, 6.0, 0.049), 5).starts_with("Reached"));
        assert!(goal.words(&towing(5.0, 6.0, 0.051), 5).starts_with("goal: off"));
        let alone = HITCH.footprint(&HitchCfg { body: Pose2::new(5.0, 6.0, 0.0), trailer: None });
        assert_eq!(goal.words(&alone, 5), "goal: put the trailer back on");
        assert_eq!(goal.items(&start).len(), 1);
    }
}
