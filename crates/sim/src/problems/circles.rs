//! `CircleField`, a way among circles.

use super::error::{GeneratorError, within};
use super::generated::GeneratedProblem;
use super::site::{ProblemSite, angle, between, solid, tidy, walled};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab_core::num::{cos, greater, sin};
use motion_lab_core::random::Stream;
use motion_lab_core::worlds::World;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A square with circles here and there. A rover or a car goes from its left quarter to its right one; an arm, its base
/// in the middle, from anywhere to anywhere. Whether there is a path is not known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CircleField {
    /// The kind of robot: `rusty`, `hitch`, `reach` or `reach3`.
    pub robot: String,
    /// The number of circles. Without it what suits the robot: 30, for an arm 8.
    pub circles: Option<u32>,
    /// The least and the greatest radius, metres, to the millimetre. Without it what suits the robot: 0.2 to 0.8 m, for
    /// a car 0.5 to 1.5 m, for an arm 0.1 to 0.3 m.
    pub radius: Option<(f64, f64)>,
    /// The side of the square, metres. Without it what suits the robot: 10 m, for a car 40 m, for an arm 5 m.
    pub side: Option<f64>,
}

impl Default for CircleField {
    fn default() -> Self {
        CircleField { robot: RobotKind::RUSTY.name.into(), circles: None, radius: None, side: None }
    }
}

/// How far circles stay from an arm's base, metres: its links are 3 cm thick.
const TO_BASE: f64 = 0.2;

/// A field with nothing left out.
struct CircleSettings {
    kind: &'static RobotKind,
    circles: u32,
    radius: [f64; 2],
    side: f64,
}

impl CircleField {
    fn settings(&self) -> Result<CircleSettings, GeneratorError> {
        let kind = RobotKind::of(&self.robot).ok_or_else(|| GeneratorError::Robot {
            found: self.robot.clone(),
            expected: "rusty, hitch, reach and reach3",
        })?;
        let (circles, radius, side) = match kind.lengths {
            0 => (8, (0.1, 0.3), 5.0),
            _ if *kind == RobotKind::HITCH => (30, (0.5, 1.5), 40.0),
            _ => (30, (0.2, 0.8), 10.0),
        };
        let (circles, side) = (self.circles.unwrap_or(circles), self.side.unwrap_or(side));
        let (least, most) = self.radius.unwrap_or(radius);
        within("circles", f64::from(circles), [0.0, 10_000.0])?;
        within("side", side, [1.0, 1_000.0])?;
        within("radius", least, [0.001, side])?;
        within("radius", most, [least, side])?;
        Ok(CircleSettings { kind, circles, radius: [least, most], side })
    }

    pub(super) fn check(&self) -> Result<(), GeneratorError> {
        self.settings().map(|_| ())
    }

    pub(super) fn problem(&self, draws: &mut Stream, name: String) -> Result<GeneratedProblem, GeneratorError> {
        let CircleSettings { kind, circles, radius, side } = self.settings()?;
        let is_arm = kind.is_arm();
        let mut world = if is_arm {
            let half = 0.5 * side;
            World::empty(name, Aabb::new(Point2::new(-half, -half), Point2::new(half, half)))
        } else {
            walled(name, Point2::new(side, side))
        };
        for i in 0..circles {
            let radius = between(draws, radius);
            let at = if is_arm {
                // about the base, from where it stays free to the side
                let nearest = radius + TO_BASE;
                let (distance, turn) = (draws.uniform(nearest, greater(nearest, 0.5 * side)), draws.uniform(0.0, TAU));
                Point2::new(tidy(distance * cos(turn)), tidy(distance * sin(turn)))
            } else {
                Point2::new(between(draws, [0.0, side]), between(draws, [0.0, side]))
            };
            let pose = Pose2::new(at.x, at.y, 0.0);
            world.obstacles.push(solid(format!("circle {}", i + 1), pose, Shape::Disc { radius }));
        }
        let site = ProblemSite::new(kind, world);
        let place = |[from, to]: [f64; 2]| {
            move |draws: &mut Stream| match kind.lengths {
                0 => kind.coordinates.iter().map(|_| angle(draws)).collect(),
                _ => vec![between(draws, [from * side, to * side]), between(draws, [0.0, side]), angle(draws)],
            }
        };
        let start = site.free("start", draws, place([0.0, 0.25]))?;
        let goal = site.free("goal", draws, place([0.75, 1.0]))?;
        Ok(GeneratedProblem { task: site.task([start, goal])?, has_path: None })
    }
}
