//! `ParkingLot`, a car to be parked between others.

use std::f64::consts::FRAC_PI_2;

use super::error::{GeneratorError, within};
use super::generated::GeneratedProblem;
use super::site::{ProblemSite, between, cut, solid, tidy, walled};
use motion_lab_core::configuration::{CarSizes, RobotKind};
use motion_lab_core::geometry::{Point2, Pose2, Shape};
use motion_lab_core::num::wrap;
use motion_lab_core::random::Stream;
use serde::{Deserialize, Serialize};

/// A lot of 16 x 10 m with five bays on its north side, one of them empty. Hitch starts in the aisle, about along it
/// and either way, and is to stand backed into the empty bay; with a trailer, with the trailer in it. Whether there is
/// a path is not known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ParkingLot {
    /// Whether the car pulls its trailer, straight behind it at both ends.
    pub trailer: bool,
    /// The width of a bay, metres.
    pub bay: f64,
    /// How many of the other four bays hold a car.
    pub parked: u32,
}

impl Default for ParkingLot {
    fn default() -> Self {
        ParkingLot { trailer: false, bay: 2.8, parked: 3 }
    }
}

/// The lot, metres.
const LOT: Point2 = Point2::new(16.0, 10.0);
/// The number of bays.
const BAYS: u64 = 5;
/// Where the rear axle of a car stands that is backed in, and where with its trailer, metres.
const PARKED: f64 = 8.875;
const WITH_TRAILER: f64 = 7.0;
/// How far a parked car stands from the middle of its bay, at most, metres.
const ASTRAY: f64 = 0.1;

impl ParkingLot {
    pub(super) fn check(&self) -> Result<(), GeneratorError> {
        within("bay", self.bay, [2.0, 3.2])?;
        within("parked", f64::from(self.parked), [0.0, 4.0])
    }

    pub(super) fn problem(&self, draws: &mut Stream, name: String) -> Result<GeneratedProblem, GeneratorError> {
        let ParkingLot { trailer, bay, parked } = *self;
        let middle = |number: u64| tidy(0.5 * LOT.x + (number as f64 - 0.5 * (BAYS - 1) as f64) * bay);
        let empty = draws.below(BAYS);
        let mut others: Vec<u64> = (0..BAYS).filter(|number| *number != empty).collect();
        let mut world = walled(name, LOT);
        for number in 1..=parked {
            let at = others.remove(draws.below(others.len() as u64) as usize);
            let x = tidy(middle(at) + between(draws, [-ASTRAY, ASTRAY]));
            let CarSizes { length, width, rear_overhang, .. } = CarSizes::HITCH;
            let min = Point2::new(tidy(x - 0.5 * width), tidy(PARKED + rear_overhang - length));
            let max = Point2::new(tidy(x + 0.5 * width), tidy(PARKED + rear_overhang));
            world.obstacles.push(solid(format!("parked car {number}"), Pose2::IDENTITY, Shape::Rectangle { min, max }));
        }
        let site = ProblemSite::new(&RobotKind::HITCH, world);
        let with = |[x, y, theta]: [f64; 3]| if trailer { vec![x, y, theta, theta] } else { vec![x, y, theta] };
        let goal = [middle(empty), if trailer { WITH_TRAILER } else { PARKED }, -FRAC_PI_2];
        let goal = site.free("goal", draws, |_| with(goal))?;
        let start = site.free("start", draws, |draws| {
            let (x, y) = (between(draws, [4.0, 12.0]), between(draws, [1.75, 3.25]));
            let turned = if draws.below(2) == 0 { 0.0 } else { std::f64::consts::PI };
            with([x, y, cut(wrap(turned + draws.uniform(-0.25, 0.25)))])
        })?;
        Ok(GeneratedProblem { task: site.task([start, goal])?, has_path: None })
    }
}
