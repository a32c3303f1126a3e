//! `PlannerName`, a planner by name.

use motion_lab_core::robots::AnyRobot;

/// A planner by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlannerName {
    /// Two trees that grow toward each other.
    RrtConnect,
    /// One tree that grows into the free space.
    Rrt,
    /// A tree that is wired anew as it grows.
    RrtStar,
    /// A road map of samples.
    Prm,
    /// A* on a grid of configurations.
    AStar,
    /// Dijkstra's algorithm on the same grid.
    Dijkstra,
    /// The shortest way by the corners of the obstacles.
    VisibilityGraph,
    /// Downhill in a field that the goal attracts and obstacles repel.
    PotentialField,
    /// Bug1.
    Bug1,
    /// Bug1 by a range sensor.
    Bug1Sensor,
    /// Bug2.
    Bug2,
    /// Cells of the configuration space proven free or blocked.
    CellDecomposition,
    /// A search over what a car can drive.
    HybridAStar,
}

impl PlannerName {
    /// All planners, in the order of the lists.
    pub const ALL: [PlannerName; 13] = [
        PlannerName::RrtConnect,
        PlannerName::Rrt,
        PlannerName::RrtStar,
        PlannerName::Prm,
        PlannerName::AStar,
        PlannerName::Dijkstra,
        PlannerName::VisibilityGraph,
        PlannerName::PotentialField,
        PlannerName::Bug1,
        PlannerName::Bug1Sensor,
        PlannerName::Bug2,
        PlannerName::CellDecomposition,
        PlannerName::HybridAStar,
    ];

    /// The name by which the command line, plans of sweeps and links name it.
    pub const fn id(self) -> &'static str {
        match self {
            PlannerName::RrtConnect => "rrt-connect",
            PlannerName::Rrt => "rrt",
            PlannerName::RrtStar => "rrt-star",
            PlannerName::Prm => "prm",
            PlannerName::AStar => "a-star",
            PlannerName::Dijkstra => "dijkstra",
            PlannerName::VisibilityGraph => "visibility-graph",
            PlannerName::PotentialField => "potential-field",
            PlannerName::Bug1 => "bug1",
            PlannerName::Bug1Sensor => "bug1-sensor",
            PlannerName::Bug2 => "bug2",
            PlannerName::CellDecomposition => "cell-decomposition",
            PlannerName::HybridAStar => "hybrid-a-star",
        }
    }

    /// Its name in books.
    pub const fn title(self) -> &'static str {
        match self {
            PlannerName::RrtConnect => "RRT-Connect",
            PlannerName::Rrt => "RRT",
            PlannerName::RrtStar => "RRT*",
            PlannerName::Prm => "PRM",
            PlannerName::AStar => "A*",
            PlannerName::Dijkstra => "Dijkstra",
            PlannerName::VisibilityGraph => "Visibility graph",
            PlannerName::PotentialField => "Potential field",
            PlannerName::Bug1 => "Bug1",
            PlannerName::Bug1Sensor => "Bug1 by its sensor",
            PlannerName::Bug2 => "Bug2",
            PlannerName::CellDecomposition => "Cell decomposition",
            PlannerName::HybridAStar => "Hybrid A*",
        }
    }

    /// What it does, in a line.
    pub const fn words(self) -> &'static str {
        match self {
            PlannerName::RrtConnect => "Two trees that grow toward each other",
            PlannerName::Rrt => "One tree that grows into the free space",
            PlannerName::RrtStar => "A tree that is wired anew as it grows: the first path that it has",
            PlannerName::Prm => "A road map of samples, grown until start and goal are joined",
            PlannerName::AStar => "A* on a grid of configurations",
            PlannerName::Dijkstra => "Dijkstra's algorithm on the same grid",
            PlannerName::VisibilityGraph => "The shortest way by the corners of the obstacles, for a rover",
            PlannerName::PotentialField => {
                "Downhill in a field that the goal attracts and obstacles repel; it may end in a local minimum"
            }
            PlannerName::Bug1 => {
                "Bug1, for a rover: it goes round an obstacle once, and leaves where it was nearest to the goal"
            }
            PlannerName::Bug1Sensor => {
                "Bug1, for a rover that sees walls by its range sensor alone: it may misjudge where to leave them"
            }
            PlannerName::Bug2 => "Bug2, for a rover: it follows the line to the goal, and boundaries between",
            PlannerName::CellDecomposition => {
                "Cells proven free or blocked, for a rover and an arm of two links; it may prove that there is no path"
            }
            PlannerName::HybridAStar => "A search over what a car can drive, with a trailer or without",
        }
    }

    /// The planner with this [`id`](Self::id).
    pub fn of(id: &str) -> Option<PlannerName> {
        PlannerName::ALL.into_iter().find(|name| name.id() == id)
    }

    /// The planner that suits a robot.
    pub fn default_for(robot: &AnyRobot) -> Self {
        match robot {
            AnyRobot::Hitch(_) => PlannerName::HybridAStar,
            _ => PlannerName::RrtConnect,
        }
    }

    /// Whether it can plan for this robot, or why not.
    ///
    /// # Errors
    /// The reason in words.
    pub const fn suits(self, robot: &AnyRobot) -> Result<(), &'static str> {
        use PlannerName::{Bug1, Bug1Sensor, Bug2, CellDecomposition, HybridAStar, VisibilityGraph};
        match (self, robot) {
            (HybridAStar, AnyRobot::Hitch(_)) => Ok(()),
            (HybridAStar, _) => Err("it plans for a car only"),
            (_, AnyRobot::Hitch(_)) => Err("it plans straight lines, which no car can drive"),
            (Bug1 | Bug1Sensor | Bug2 | VisibilityGraph, AnyRobot::Reach(_) | AnyRobot::Reach3(_)) => {
                Err("it plans for discs in the plane")
            }
            (CellDecomposition, AnyRobot::Reach3(_)) => Err("its cells are those of a plane or a torus"),
            _ => Ok(()),
        }
    }

    /// The number of iterations that it does unless more are allowed: some seconds' work.
    pub const fn iterations(self) -> u64 {
        if matches!(self, PlannerName::HybridAStar) { 20_000 } else { 100_000 }
    }
}
