//! `NarrowPassage`, gaps of a stated width.

use super::error::{GeneratorError, within};
use super::generated::GeneratedProblem;
use super::site::{ProblemSite, angle, between, solid, tidy, walled};
use motion_lab_core::configuration::{CarSizes, DiscSizes, RobotKind};
use motion_lab_core::geometry::{Point2, Pose2, Shape};
use motion_lab_core::random::Stream;
use serde::{Deserialize, Serialize};

/// Rooms one after the other, with walls between them that have a gap each, of one width, anywhere; from the first room
/// to the last.
///
/// A robot wider than the gap does not get through. A rover gets through any that is wider; with a
/// [tube](crate::plans::Task::tube) it is planned larger than it is. Whether a car gets through is not known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NarrowPassage {
    /// The kind of robot: `rusty`, or `hitch`, without its trailer.
    pub robot: String,
    /// The width of the gaps, metres.
    pub width: f64,
    /// The number of walls.
    pub walls: u32,
    /// How thick they are, metres.
    pub thickness: f64,
}

impl Default for NarrowPassage {
    fn default() -> Self {
        NarrowPassage { robot: RobotKind::RUSTY.name.into(), width: 0.3, walls: 1, thickness: 0.2 }
    }
}

/// What goes through a passage, in metres.
struct Passenger {
    kind: &'static RobotKind,
    width: f64,
    /// The sides of a room in which it turns.
    room: [f64; 2],
}

const ROVER: Passenger = Passenger { kind: &RobotKind::RUSTY, width: 2.0 * DiscSizes::RUSTY.radius, room: [3.0, 5.0] };
const CAR: Passenger = Passenger { kind: &RobotKind::HITCH, width: CarSizes::HITCH.width, room: [14.0, 16.0] };

/// By how much a gap may be wider or narrower than it is said to be, metres.
const ROUNDING: f64 = 1e-9;

impl NarrowPassage {
    fn passenger(&self) -> Result<Passenger, GeneratorError> {
        let known = [ROVER, CAR].into_iter().find(|known| known.kind.name == self.robot);
        known.ok_or_else(|| GeneratorError::Robot { found: self.robot.clone(), expected: "rusty and hitch" })
    }

    pub(super) fn check(&self) -> Result<(), GeneratorError> {
        let Passenger { room: [_, height], .. } = self.passenger()?;
        within("width", self.width, [0.001, 0.5 * height])?;
        within("walls", f64::from(self.walls), [1.0, 100.0])?;
        within("thickness", self.thickness, [0.01, 10.0])
    }

    pub(super) fn problem(&self, draws: &mut Stream, name: String) -> Result<GeneratedProblem, GeneratorError> {
        let NarrowPassage { width, walls, thickness, .. } = *self;
        let Passenger { kind, width: robot_width, room: [length, height] } = self.passenger()?;
        let pitch = length + thickness;
        let mut world = walled(name, Point2::new(tidy(pitch * f64::from(walls) + length), height));
        for number in 1..=walls {
            let right = tidy(pitch * f64::from(number));
            let left = tidy(right - thickness);
            let low = between(draws, [0.1 * height, 0.9 * height - width]);
            for (part, from, to) in [("lower", 0.0, low), ("upper", low + width, height)] {
                let shape = Shape::Rectangle { min: Point2::new(left, from), max: Point2::new(right, to) };
                world.obstacles.push(solid(format!("{part} wall {number}"), Pose2::IDENTITY, shape));
            }
        }
        let site = ProblemSite::new(kind, world);
        let place = |left: f64| {
            move |draws: &mut Stream| {
                vec![between(draws, [left, left + length]), between(draws, [0.0, height]), angle(draws)]
            }
        };
        let start = site.free("start", draws, place(0.0))?;
        let goal = site.free("goal", draws, place(pitch * f64::from(walls)))?;
        // the sides of a gap are rounded, so that a width next to the robot's tells nothing
        let is_plain = (width - robot_width).abs() > ROUNDING;
        let is_wider = width > robot_width;
        // a disc turns as it likes
        let is_known = is_plain && (!is_wider || *kind == RobotKind::RUSTY);
        let has_path = is_known.then_some(is_wider);
        Ok(GeneratedProblem { task: site.task([start, goal])?, has_path })
    }
}
