//! `PlannerName`, a planner by name.

use clap::ValueEnum;
use motion_lab::robots::AnyRobot;

/// A planner by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PlannerName {
    /// Two trees that grow toward each other.
    RrtConnect,
    /// A search over what a car can drive, with a trailer or without.
    HybridAStar,
}

impl PlannerName {
    /// The planner that suits a robot.
    pub fn default_for(robot: &AnyRobot) -> Self {
        match robot {
            AnyRobot::Hitch(_) => PlannerName::HybridAStar,
            _ => PlannerName::RrtConnect,
        }
    }

    /// The number of iterations that it does unless more are allowed: some seconds' work.
    pub fn iterations(self) -> u64 {
        if self == PlannerName::HybridAStar { 20_000 } else { 100_000 }
    }

    /// Its name.
    pub fn name(self) -> String {
        self.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned())
    }
}
