//! `Members`, what a crowd knows of its robots for the whole run.

use motion_lab_core::configuration::{AnyConfiguration, Configuration as _, HitchCfg};
use motion_lab_core::geometry::{Footprint, Part, Point2, Vector2};
use motion_lab_core::num::{greater, sin_cos};
use motion_lab_core::robots::{AnyRobot, Robot};

/// Sizes and shapes of a crowd's robots, by their places. What every frame reads of each is apart from the rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Members {
    circles: Vec<Option<MemberCircle>>,
    robots: Vec<Option<(AnyRobot, AnyConfiguration)>>,
}

/// A circle about a robot's reference point that holds it at every configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemberCircle {
    /// An arm's base; `None` for a robot whose first two coordinates are its place.
    base: Option<Point2>,
    /// Its radius, metres.
    pub radius: f64,
    /// The robot's greatest extent along an axis while it is straight, metres.
    pub size: f64,
    /// The middle of the straight robot from the reference point, in the robot's frame, metres.
    middle: Vector2,
}

impl Members {
    /// Adds a robot, with a configuration of its space; `None` for one of a kind that is not the lab's.
    pub fn push(&mut self, robot: Option<(AnyRobot, AnyConfiguration)>) {
        self.circles.push(robot.and_then(|(robot, like)| MemberCircle::of(&robot, &like)));
        self.robots.push(robot);
    }

    /// The circle of the robot at a place.
    pub fn circle(&self, place: usize) -> Option<&MemberCircle> {
        self.circles.get(place)?.as_ref()
    }

    /// The configuration with these coordinates of the robot at a place.
    pub fn configuration(&self, place: usize, coordinates: &[f64]) -> Option<AnyConfiguration> {
        self.robots.get(place)?.as_ref()?.1.with_coordinates(coordinates)
    }

    /// The footprint of the robot at a place in this configuration, and the heading that the footprint does not show.
    pub fn footprint(&self, place: usize, q: &AnyConfiguration) -> Option<(Footprint, Option<f64>)> {
        let (robot, _) = self.robots.get(place)?.as_ref()?;
        Some((robot.fitted(q).footprint(q), robot.heading(q)))
    }
}

impl MemberCircle {
    /// The circle of a robot. A car's holds its trailer too, whether it has one now or not.
    fn of(robot: &AnyRobot, like: &AnyConfiguration) -> Option<MemberCircle> {
        let straight = like.with_coordinates(&vec![0.0; like.coordinates().len()])?;
        let base = robot.annulus().map(|(base, _)| base);
        let about = base.unwrap_or(Point2::origin());
        let footprint = robot.fitted(&straight).footprint(&straight);
        let bounds = footprint.bounds()?;
        let towing = match (robot, &straight) {
            (AnyRobot::Hitch(car), AnyConfiguration::Hitch(q)) => {
                let q = HitchCfg { trailer: Some(0.0), ..*q };
                Some(car.with_trailer().footprint(&q))
            }
            _ => None,
        };
        let parts = towing.iter().chain([&footprint]).flat_map(|footprint| footprint.parts());
        let reach = |part: &Part| {
            let core = part.placed().core().iter();
            core.fold(0.0, |far, p| greater(far, (p - about).norm())) + part.placed().radius()
        };
        let radius = parts.map(reach).fold(0.0, greater);
        let (w, h) = (bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
        let middle = if base.is_some() { Vector2::zeros() } else { bounds.centre() - about };
        Some(MemberCircle { base, radius, size: greater(w, h), middle })
    }

    /// The reference point of the robot at these coordinates.
    pub fn centre(&self, coordinates: &[f64]) -> Option<Point2> {
        match (self.base, coordinates) {
            (Some(base), _) => Some(base),
            (None, [x, y, ..]) => Some(Point2::new(*x, *y)),
            _ => None,
        }
    }

    /// The vector from the reference point to the middle of the straight robot at these coordinates.
    pub fn middle(&self, coordinates: &[f64]) -> Vector2 {
        match coordinates {
            [_, _, theta, ..] if self.middle != Vector2::zeros() => {
                let ((s, c), m) = (sin_cos(*theta), self.middle);
                Vector2::new(c * m.x - s * m.y, s * m.x + c * m.y)
            }
            _ => Vector2::zeros(),
        }
    }
}
