//! `PlannerName`, a planner by name.

use clap::ValueEnum;
use motion_lab::robots::AnyRobot;

/// A planner by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PlannerName {
    /// Two trees that grow toward each other.
    RrtConnect,
    /// A tree from the start.
    Rrt,
    /// A tree from the start whose branches become shorter.
    RrtStar,
    /// A roadmap of samples.
    Prm,
    /// The shortest way on a grid, the goal's side first.
    AStar,
    /// The shortest way on a grid.
    Dijkstra,
    /// The corners of the obstacles that see one another; a rover's.
    VisibilityGraph,
    /// Downhill to the goal, away from obstacles; it may be stuck.
    PotentialField,
    /// All around an obstacle, then on from where the goal was nearest; a rover's.
    Bug1,
    /// Around an obstacle until the line to the goal is met again; a rover's.
    Bug2,
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
