//! `PlannerName`, a planner by name.

use clap::ValueEnum;
use motion_lab::robots::AnyRobot;

/// A planner by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PlannerName {
    /// Two trees that grow toward each other.
    RrtConnect,
    /// One tree that grows into the free space.
    Rrt,
    /// A tree that is wired anew as it grows: the first path that it has.
    RrtStar,
    /// A road map of samples, grown until start and goal are joined.
    Prm,
    /// A* on a grid of configurations.
    AStar,
    /// Dijkstra's algorithm on the same grid.
    Dijkstra,
    /// The shortest way by the corners of the obstacles, for a rover.
    VisibilityGraph,
    /// Downhill in a field that the goal attracts and obstacles repel; it may end in a local minimum.
    PotentialField,
    /// Bug1, for a rover: it goes round an obstacle once, and leaves where it was nearest to the goal.
    Bug1,
    /// Bug2, for a rover: it follows the line to the goal, and boundaries between.
    Bug2,
    /// Cells of the configuration space proven free or blocked, for a rover and an arm of two links; it may prove that
    /// there is no path.
    CellDecomposition,
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
