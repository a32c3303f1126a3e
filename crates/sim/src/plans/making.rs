//! How the planner of a task is made, whatever its robot.

use motion_lab_core::collision::Problem;
use motion_lab_core::configuration::Chart;
use motion_lab_core::planning::hybrid::HybridAStar;
use motion_lab_core::planning::{
    Bug1, Bug2, GridSearch, NoPath, PotentialField, Prm, Rrt, RrtConnect, RrtStar, TangentGraph, VisibilityGraph,
};
use motion_lab_core::robots::{Hitch, HitchArc, Reach, Robot, RustyDisc};

use super::named::PlannerName;
use super::own::{LinePlanner, MadePlanner, OwnPlanner, PlannerMaker};

/// No planner of straight lines plans for a car.
pub(super) const LINES: NoPath = NoPath::Unsuited("it plans straight lines, which no car can drive");

/// Makes planners for robots that go along straight lines of their charts.
pub(super) trait Making {
    /// The planner of a problem.
    fn make<R: HasMaker<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R>;

    /// The planner of a car's problem.
    fn make_for_car(&self, problem: Problem<Hitch>) -> MadePlanner<Hitch, HitchArc>;
}

impl Making for PlannerName {
    fn make<R: HasMaker<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
        Ok(match self {
            PlannerName::RrtConnect => Box::new(RrtConnect::new(problem)),
            PlannerName::Rrt => Box::new(Rrt::new(problem)),
            PlannerName::RrtStar => Box::new(RrtStar::new(problem)),
            PlannerName::InformedRrtStar => Box::new(RrtStar::informed(problem)),
            PlannerName::Prm => Box::new(Prm::new(problem)),
            PlannerName::AStar => Box::new(GridSearch::a_star(problem)),
            PlannerName::Dijkstra => Box::new(GridSearch::dijkstra(problem)),
            PlannerName::VisibilityGraph => Box::new(VisibilityGraph::new(problem)),
            PlannerName::TangentGraph => Box::new(TangentGraph::new(problem)),
            PlannerName::PotentialField => Box::new(PotentialField::new(problem)),
            PlannerName::Bug1 => Box::new(Bug1::try_new(&problem)?),
            PlannerName::Bug2 => Box::new(Bug2::try_new(&problem)?),
            PlannerName::CellDecomposition => {
                return Err(NoPath::Unsuited("it judges the cells of a robot of any kind"));
            }
            PlannerName::Bug1Sensor => return Err(NoPath::Unsuited("it walks by the range sensor of a rover")),
            PlannerName::HybridAStar => return Err(NoPath::Unsuited("it plans for a car only")),
            PlannerName::Own(own) => {
                let maker = R::maker(own).ok_or(NoPath::Unsuited("it is not made for this robot"))?;
                return maker(problem);
            }
        })
    }

    fn make_for_car(&self, problem: Problem<Hitch>) -> MadePlanner<Hitch, HitchArc> {
        match self {
            PlannerName::HybridAStar => Ok(Box::new(HybridAStar::new(problem))),
            PlannerName::Own(OwnPlanner { car: Some(make), .. }) => make(problem),
            _ => Err(LINES),
        }
    }
}

/// A planner that a program makes as it goes.
pub(super) struct ByLines<'a, P>(pub &'a P);

impl<P: LinePlanner> Making for ByLines<'_, P> {
    fn make<R: HasMaker<Configuration: Chart>>(&self, problem: Problem<R>) -> MadePlanner<R> {
        self.0.for_problem(problem)
    }

    fn make_for_car(&self, _: Problem<Hitch>) -> MadePlanner<Hitch, HitchArc> {
        Err(LINES)
    }
}

/// A robot that an [`OwnPlanner`] may be made for.
pub(super) trait HasMaker: Robot {
    /// The maker of its planners, if there is one.
    fn maker(own: &OwnPlanner) -> Option<PlannerMaker<Self>>;
}

impl HasMaker for RustyDisc {
    fn maker(own: &OwnPlanner) -> Option<PlannerMaker<Self>> {
        own.disc
    }
}

impl HasMaker for Reach<2> {
    fn maker(own: &OwnPlanner) -> Option<PlannerMaker<Self>> {
        own.arm
    }
}

impl HasMaker for Reach<3> {
    fn maker(own: &OwnPlanner) -> Option<PlannerMaker<Self>> {
        own.arm3
    }
}
