//! `ParkingExercise`, "one metre to the left": the trailer is to end a metre left of where it stood, facing the same
//! way.

use crate::window::ui::CockpitRobot;
use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::{Footprint, Part, Point2, Pose2};
use motion_lab_core::num::{cos, wrap};
use motion_lab_core::picture::{Dash, Drawing, Item, Line, Role, footprint};
use motion_lab_sim::run::DT;
use motion_lab_sim::simulation::History;

/// Largest distance of the trailer from its goal that counts as reached, metres.
pub const DISTANCE: f64 = 0.05;
/// Largest difference in heading that counts as reached, radians.
pub const ANGLE: f64 = 0.05;

/// The parking exercise.
#[derive(Clone, Debug, PartialEq)]
pub struct ParkingExercise {
    /// The pose wanted of the trailer.
    pub trailer: Pose2,
    /// The trailer's pose when the goal was set, and the coordinates of the car's configuration.
    pub from: Pose2,
    /// The coordinates of the car's configuration then.
    pub start: Coordinates,
    /// The number of the car's changes of direction then.
    pub reversals: u32,
    /// The tick from which on the exercise counts, once it is known.
    pub tick: Option<u64>,
    /// Whether the car is put back to the start by the tick that comes next, which does not count.
    pub is_put: bool,
    /// Whether the car was put somewhere since, which no wheel does: the goal is not reached so.
    pub was_lifted: bool,
    /// What it took, once the goal has been reached.
    pub score: Option<GoalScore>,
}

/// What it took to reach the goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoalScore {
    /// Simulated time, seconds.
    pub seconds: f64,
    /// Changes of direction.
    pub reversals: u32,
    /// Distance driven, forward and backward, metres.
    pub metres: f64,
}

/// How far a car comes to the side that drives ahead in two arcs of this angle, radians, one to either side, and goes
/// straight back, metres. The arcs have this radius, metres.
pub fn sideways(radius: f64, angle: f64) -> f64 {
    2.0 * radius * (1.0 - cos(angle))
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

impl ParkingExercise {
    /// A metre to the left of where a car's trailer stands now. `start` is the car's configuration, `reversals` the
    /// count of its changes of direction. `None` for a car without a trailer.
    pub fn left_of(car: &Footprint, start: &Coordinates, reversals: u32) -> Option<Self> {
        let from = *trailer_of(car)?;
        let at = from.transform(Point2::new(0.0, 1.0));
        let trailer = Pose2 { x: at.x, y: at.y, theta: from.theta };
        Some(ParkingExercise {
            trailer,
            from,
            start: start.clone(),
            reversals,
            tick: None,
            is_put: false,
            was_lifted: false,
            score: None,
        })
    }

    /// The same exercise from its start, for a car that is put back there.
    pub fn again(&self) -> Self {
        ParkingExercise { tick: None, is_put: true, was_lifted: false, score: None, ..self.clone() }
    }

    /// Keeps the score: it counts from the first tick after the goal was set, and is taken when the goal is reached.
    pub fn watch(&mut self, car: &CockpitRobot, tick: u64, history: &History) {
        let from = *self.tick.get_or_insert(tick + u64::from(self.is_put));
        self.was_lifted = car.put_since_goal;
        if self.was_lifted {
            self.score = None;
        } else if tick <= from {
            // before its first tick nothing is reached, also where the run was taken back
            (self.score, self.reversals) = (None, car.reversals);
        } else if self.score.is_none() && trailer_of(&car.footprint).is_some_and(|at| self.off(at).is_reached()) {
            let travelled: Vec<f64> = history.span(car.id, from..=tick).map(|trail| trail.travelled).collect();
            self.score = Some(GoalScore {
                seconds: (tick - from) as f64 * DT,
                reversals: car.reversals.saturating_sub(self.reversals),
                metres: travelled.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum(),
            });
        }
    }

    /// How far a trailer is from it.
    pub fn off(&self, trailer: &Pose2) -> Off {
        let distance = (trailer.position() - self.trailer.position()).norm();
        Off { distance, angle: wrap(trailer.theta - self.trailer.theta).abs() }
    }

    /// Where the trailer of `car` was and where it is to be, as outlines with their headings, and how exactly: a disc
    /// that its hitch is to be in, and the headings between which it is to lie.
    pub fn items(&self, car: &Footprint) -> Vec<Item> {
        let Some(part) = car.parts().get(1) else { return vec![] };
        let mut items = Vec::new();
        for (id, name, pose, role) in [
            ("start", "where the trailer was", self.from, Role::Muted),
            ("goal", "where the trailer is to be", self.trailer, Role::Goal),
        ] {
            let placed = Footprint::new([Part::new(pose, part.shape().clone())]);
            items.extend(footprint(&format!("{id}/trailer"), name, &placed, role, 0.0));
            let arrow = [(-0.95, 0.2), (-0.55, 0.0), (-0.95, -0.2)].map(|(x, y)| pose.transform(Point2::new(x, y)));
            let arrow = Drawing::Polyline(arrow.to_vec());
            items.push(Item::new(format!("{id}/heading"), name, role, arrow).stroked(Line::solid(2.0)));
        }
        let centre = self.trailer.position();
        let disc = Drawing::Disc { centre, radius: DISTANCE };
        items.push(Item::new("goal/distance", "within 5 cm", Role::Goal, disc).stroked(Line::solid(1.5)));
        let end =
            |off: f64| Pose2 { theta: self.trailer.theta + off, ..self.trailer }.transform(Point2::new(-3.2, 0.0));
        let wedge = Drawing::Polyline(vec![end(-ANGLE), centre, end(ANGLE)]);
        let thin = Line::solid(1.0).dashed(Dash::Dashed);
        items.push(Item::new("goal/angle", "within 0.05 rad", Role::Goal, wedge).stroked(thin));
        items
    }

    /// The state of the exercise in words. `reversals` is the car's count now.
    pub fn words(&self, car: &Footprint, reversals: u32) -> String {
        if self.was_lifted {
            return "goal: the car was put, and not driven, since; \"again\" begins anew".into();
        }
        if let Some(GoalScore { seconds, reversals, metres }) = self.score {
            let times = if reversals == 1 { "reversal" } else { "reversals" };
            return format!(
                "Reached: one metre to the left in {seconds:.1} s, {reversals} {times}, {metres:.1} m driven."
            );
        }
        let Some(off) = trailer_of(car).map(|trailer| self.off(trailer)) else {
            return "goal: put the trailer back on".into();
        };
        let count = reversals.saturating_sub(self.reversals);
        let times = if count == 1 { "reversal" } else { "reversals" };
        format!("goal: off by {:.2} m, {:.2} rad; {count} {times}", off.distance, off.angle)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use motion_lab_core::configuration::HitchCfg;
    use motion_lab_core::robots::{HITCH, Robot};

    fn towing(x: f64, y: f64, theta: f64) -> Footprint {
        HITCH.with_trailer().footprint(&HitchCfg { body: Pose2::new(x, y, theta), trailer: Some(theta) })
    }

    /// The exercise of a car that stands there.
    fn goal(x: f64, y: f64, theta: f64) -> ParkingExercise {
        ParkingExercise::left_of(&towing(x, y, theta), &Coordinates::from_slice(&[x, y, theta, theta]), 2).unwrap()
    }

    #[test]
    fn left_is_left_of_the_way_the_trailer_faces() {
        let goal = goal(2.0, 3.0, FRAC_PI_2);
        assert!((goal.trailer.x - 1.0).abs() < 1e-12 && (goal.trailer.y - 3.0).abs() < 1e-12);
        assert_eq!((goal.trailer.theta, goal.from.theta), (FRAC_PI_2, FRAC_PI_2));
    }

    #[test]
    fn it_is_reached_within_five_centimetres_and_a_twentieth_of_a_radian() {
        let (start, goal) = (towing(5.0, 5.0, 0.0), goal(5.0, 5.0, 0.0));
        assert_eq!(goal.words(&start, 2), "goal: off by 1.00 m, 0.00 rad; 0 reversals");
        let reached = |car: &Footprint| goal.off(trailer_of(car).unwrap()).is_reached();
        assert!(reached(&towing(5.0, 6.04, 0.0)) && !reached(&towing(5.0, 6.06, 0.0)));
        // turned about the hitch, which is the trailer's own frame
        assert!(reached(&towing(5.0, 6.0, 0.049)) && !reached(&towing(5.0, 6.0, 0.051)));
        let alone = HITCH.footprint(&HitchCfg { body: Pose2::new(5.0, 6.0, 0.0), trailer: None });
        assert_eq!(goal.words(&alone, 5), "goal: put the trailer back on");
        let scored =
            ParkingExercise { score: Some(GoalScore { seconds: 12.34, reversals: 1, metres: 9.87 }), ..goal.clone() };
        let words = "Reached: one metre to the left in 12.3 s, 1 reversal, 9.9 m driven.";
        assert_eq!((scored.words(&alone, 5).as_str(), scored.again().score), (words, None));
        let items = goal.items(&start);
        assert!(items.iter().all(|item| (item.role == Role::Goal) == item.id.starts_with("goal/")), "the goal is red");
        let ids: Vec<&str> = items.iter().map(|item| item.id.as_str()).collect();
        assert!(["start/trailer/0", "goal/trailer/0", "goal/distance", "goal/angle"].iter().all(|id| ids.contains(id)));
    }

    #[test]
    fn two_arcs_and_straight_back_take_the_car_to_the_side() {
        use motion_lab_core::robots::CarCmd;
        let (mut q, radius) = (HitchCfg { body: Pose2::IDENTITY, trailer: None }, HITCH.tightest());
        let mut drive = |v: f64, phi: f64, far: f64| {
            for _ in 0..1000 {
                q = HITCH.step(&q, &CarCmd { v, phi }, far / 1000.0).unwrap();
            }
            q.body
        };
        drive(1.0, 0.6, 0.5 * radius);
        let turned = drive(1.0, -0.6, 0.5 * radius);
        let end = drive(-1.0, 0.0, turned.x);
        assert!(
            end.x.abs() < 1e-9 && end.theta.abs() < 1e-9 && (end.y - sideways(radius, 0.5)).abs() < 1e-9,
            "{end:?}"
        );
        assert!((end.y - 0.8946).abs() < 1e-3, "{end:?}");
    }
}
