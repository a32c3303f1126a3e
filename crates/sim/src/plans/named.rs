//! `PlannerName`, a planner by name.

use motion_lab_core::robots::AnyRobot;

use super::own::OwnPlanner;

/// A planner by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlannerName {
    /// Two trees that grow toward each other.
    RrtConnect,
    /// One tree that grows into the free space.
    Rrt,
    /// A tree that is wired anew as it grows.
    RrtStar,
    /// The same tree, which once there is a path grows only where a shorter one may lead.
    InformedRrtStar,
    /// A road map of samples.
    Prm,
    /// A* on a grid of configurations.
    AStar,
    /// Dijkstra's algorithm on the same grid.
    Dijkstra,
    /// The shortest way by the corners of the obstacles.
    VisibilityGraph,
    /// The shortest path, by tangents and arcs about the corners.
    TangentGraph,
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
    /// One that a program has of its own.
    Own(&'static OwnPlanner),
}

/// The robots that a planner plans for.
#[derive(Clone, Copy)]
enum Plans {
    /// All that can go along straight lines of their charts.
    Lines,
    Discs,
    /// All of whose space cells can be judged.
    Cells,
    Cars,
    /// Those that a planner of a program's own is made for.
    Own(&'static OwnPlanner),
}

/// A row of the table of planners.
struct About {
    id: &'static str,
    title: &'static str,
    plans: Plans,
    words: &'static str,
}

const fn row(id: &'static str, title: &'static str, plans: Plans, words: &'static str) -> About {
    About { id, title, plans, words }
}

impl PlannerName {
    /// Whether it joins samples that it draws.
    pub const fn draws_samples(self) -> bool {
        match self {
            PlannerName::RrtConnect
            | PlannerName::Rrt
            | PlannerName::RrtStar
            | PlannerName::InformedRrtStar
            | PlannerName::Prm => true,
            PlannerName::Own(own) => own.draws_samples,
            _ => false,
        }
    }

    /// Whether it goes on to shorten a path that it has.
    pub const fn improves(self) -> bool {
        matches!(self, PlannerName::RrtStar | PlannerName::InformedRrtStar | PlannerName::Prm)
    }

    /// The lab's planners, in the order of the lists. [`Planners`](super::Planners) has those of a program's own too.
    pub const ALL: [PlannerName; 15] = [
        PlannerName::RrtConnect,
        PlannerName::Rrt,
        PlannerName::RrtStar,
        PlannerName::InformedRrtStar,
        PlannerName::Prm,
        PlannerName::AStar,
        PlannerName::Dijkstra,
        PlannerName::VisibilityGraph,
        PlannerName::TangentGraph,
        PlannerName::PotentialField,
        PlannerName::Bug1,
        PlannerName::Bug1Sensor,
        PlannerName::Bug2,
        PlannerName::CellDecomposition,
        PlannerName::HybridAStar,
    ];

    const fn about(self) -> About {
        use Plans::{Cars, Cells, Discs, Lines};
        match self {
            PlannerName::RrtConnect => {
                row("rrt-connect", "RRT-Connect", Lines, "Two trees that grow toward each other")
            }
            PlannerName::Rrt => row("rrt", "RRT", Lines, "One tree that grows into the free space"),
            PlannerName::RrtStar => {
                row("rrt-star", "RRT*", Lines, "A tree that is wired anew as it grows: the first path that it has")
            }
            PlannerName::InformedRrtStar => row(
                "informed-rrt-star",
                "Informed RRT*",
                Lines,
                "RRT* that, once it has a path, draws samples only where a shorter one may lead",
            ),
            PlannerName::Prm => {
                row("prm", "PRM", Lines, "A road map of samples, grown until start and goal are joined")
            }
            PlannerName::AStar => row("a-star", "A*", Lines, "A* on a grid of configurations"),
            PlannerName::Dijkstra => row("dijkstra", "Dijkstra", Lines, "Dijkstra's algorithm on the same grid"),
            PlannerName::VisibilityGraph => row(
                "visibility-graph",
                "Visibility graph",
                Discs,
                "The shortest way by the corners of the obstacles, for a rover",
            ),
            PlannerName::TangentGraph => row(
                "tangent-graph",
                "Tangent graph",
                Discs,
                "The shortest path, by tangents and arcs about the corners of the obstacles, for a rover",
            ),
            PlannerName::PotentialField => row(
                "potential-field",
                "Potential field",
                Lines,
                "Downhill in a field that the goal attracts and obstacles repel; it may end in a local minimum",
            ),
            PlannerName::Bug1 => row(
                "bug1",
                "Bug1",
                Discs,
                "Bug1, for a rover: it goes round an obstacle once, and leaves where it was nearest to the goal",
            ),
            PlannerName::Bug1Sensor => row(
                "bug1-sensor",
                "Bug1 by its sensor",
                Discs,
                "Bug1, for a rover that sees walls by its range sensor alone: it may misjudge where to leave them",
            ),
            PlannerName::Bug2 => {
                row("bug2", "Bug2", Discs, "Bug2, for a rover: it follows the line to the goal, and boundaries between")
            }
            PlannerName::CellDecomposition => row(
                "cell-decomposition",
                "Cell decomposition",
                Cells,
                "Cells proven free or blocked: it may prove that there is no path; it gives none to a car",
            ),
            PlannerName::HybridAStar => {
                row("hybrid-a-star", "Hybrid A*", Cars, "A search over what a car can drive, with a trailer or without")
            }
            PlannerName::Own(own) => row(own.id, own.title, Plans::Own(own), own.words),
        }
    }

    /// The name by which the command line, studies and links name it.
    pub const fn id(self) -> &'static str {
        self.about().id
    }

    /// Its name in books.
    pub const fn title(self) -> &'static str {
        self.about().title
    }

    /// What it does, in a line.
    pub const fn words(self) -> &'static str {
        self.about().words
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
        match (self.about().plans, robot) {
            (Plans::Own(own), robot) if own.suits(robot) => Ok(()),
            (Plans::Own(_), _) => Err("it is not made for this robot"),
            (Plans::Cars, AnyRobot::Hitch(_)) => Ok(()),
            (Plans::Cars, _) => Err("it plans for a car only"),
            (Plans::Cells, _) => Ok(()),
            (_, AnyRobot::Hitch(_)) => Err("it plans straight lines, which no car can drive"),
            (Plans::Discs, AnyRobot::Reach(_) | AnyRobot::Reach3(_)) => Err("it plans for discs in the plane"),
            (Plans::Lines | Plans::Discs, _) => Ok(()),
        }
    }

    /// Whether it plans for no robot but a car.
    pub const fn plans_for_cars_alone(self) -> bool {
        match self.about().plans {
            Plans::Cars => true,
            Plans::Own(own) => own.car.is_some() && own.disc.is_none() && own.arm.is_none() && own.arm3.is_none(),
            Plans::Lines | Plans::Discs | Plans::Cells => false,
        }
    }

    /// The number of iterations that it does unless more are allowed: some seconds' work.
    pub const fn iterations(self) -> u64 {
        match self.about().plans {
            Plans::Cars => 20_000,
            Plans::Own(own) => own.iterations,
            Plans::Lines | Plans::Discs | Plans::Cells => 100_000,
        }
    }
}
