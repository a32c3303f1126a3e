//! `Task`, what is to be planned: a robot in a world, from a start to a goal.

use std::sync::Arc;

use motion_lab::collision::{Checker, Problem, Scene};
use motion_lab::configuration::{AnyConfiguration, Configuration, R2};
use motion_lab::geometry::Pose2;
use motion_lab::planning::hybrid::HybridAStar;
use motion_lab::planning::{
    Bug1, Bug2, CellDecomposition, GridSearch, NoPath, Planner, PotentialField, Prm, Rrt, RrtConnect, RrtStar,
    VisibilityGraph,
};
use motion_lab::random::Seed;
use motion_lab::robots::{AnyRobot, ChartLine, Hitch, HitchArc, Reach, Rusty, RustyDisc};
use motion_lab::worlds::World;

use super::attempt::{Attempt, Planned, Trial};
use super::named::PlannerName;
use crate::cli::Failure;
use crate::cli::commands::query::Chosen;

/// What is to be planned.
pub struct Task {
    /// The robot's name, as it was given.
    pub name: String,
    /// The robot, a car with its trailer if it starts with one.
    pub robot: AnyRobot,
    /// The world.
    pub world: World,
    /// Its scene.
    pub scene: Arc<Scene>,
    /// Where the path begins.
    pub start: AnyConfiguration,
    /// Where it ends.
    pub goal: AnyConfiguration,
    /// How much larger a rover is planned, metres.
    pub tube: f64,
}

impl Task {
    /// The task of these arguments.
    pub fn find(name: &str, world: Option<&str>, from: Option<&[f64]>, to: &[f64], tube: f64) -> Result<Self, Failure> {
        let (chosen, world) = Chosen::in_world(name, world)?;
        let see = "`motion-lab plan --help` says which numbers a robot has.";
        let at = |option: &str, numbers: Option<&[f64]>| {
            chosen.at(numbers, &world).map_err(|reason| Failure::usage(format!("{option}: {reason}"), see))
        };
        let (robot, start) = at("--from", from)?;
        let (other, goal) = at("--to", Some(to))?;
        if other != robot {
            let reason = "one of --from and --to has a trailer's heading, the other has none";
            return Err(Failure::usage(reason, "Give both four numbers, or both three."));
        }
        let scene = Arc::new(Scene::of_world(&world));
        Ok(Task { name: name.to_owned(), robot, world, scene, start, goal, tube })
    }

    /// The planner of this name with the problem, ready to begin; or why there is no problem.
    pub fn attempt(&self, name: PlannerName, seed: Seed) -> Result<Result<Box<dyn Attempt>, NoPath>, Failure> {
        match (self.robot, self.start, self.goal) {
            (AnyRobot::Reach(arm), AnyConfiguration::T2(start), AnyConfiguration::T2(goal)) => {
                self.by_lines::<Reach<2>>(arm, [start, goal], name, seed)
            }
            (AnyRobot::Reach3(arm), AnyConfiguration::T3(start), AnyConfiguration::T3(goal)) => {
                self.by_lines::<Reach<3>>(arm, [start, goal], name, seed)
            }
            (AnyRobot::Rusty(rover), AnyConfiguration::Pose(start), AnyConfiguration::Pose(goal)) => {
                let disc = RustyDisc::try_new(rover.body_radius + self.tube).map_err(Failure::internal)?;
                self.by_lines(disc, [start, goal].map(|q| R2::new(q.x, q.y)), name, seed)
            }
            (AnyRobot::Hitch(car), AnyConfiguration::Hitch(start), AnyConfiguration::Hitch(goal)) => {
                if name != PlannerName::HybridAStar {
                    let reason = format!("{} plans straight lines, which no car can drive", name.name());
                    return Err(Failure::usage(reason, "Use --planner hybrid-a-star."));
                }
                let car = if start.trailer.is_some() { car.with_trailer() } else { car.without_trailer() };
                let problem = Problem::try_new(Checker::new(Arc::clone(&self.scene), car), start, goal, seed);
                Ok(problem.map_err(NoPath::from).map(|problem| {
                    let planner = HybridAStar::new(problem);
                    Box::new(Trial::<Hitch, HitchArc>::new(Box::new(planner))) as Box<dyn Attempt>
                }))
            }
            _ => Err(Failure::internal(anyhow::anyhow!("a configuration of another robot"))),
        }
    }

    /// The robot as it is planned for: a rover is larger by the tube.
    pub fn planned(&self) -> AnyRobot {
        match self.robot {
            AnyRobot::Rusty(rover) => AnyRobot::Rusty(Rusty { body_radius: rover.body_radius + self.tube, ..rover }),
            robot => robot,
        }
    }

    /// The planner by cells, which plans for a robot of any kind.
    fn by_cells(&self, seed: Seed) -> Result<Box<dyn Attempt>, NoPath> {
        let robot = self.planned();
        // a rover's heading does not matter
        let [start, goal] = [self.start, self.goal].map(|q| match q {
            AnyConfiguration::Pose(pose) => AnyConfiguration::Pose(Pose2::new(pose.x, pose.y, 0.0)),
            q => q,
        });
        let problem = Problem::try_new(Checker::new(Arc::clone(&self.scene), robot), start, goal, seed)?;
        Ok(Box::new(Trial::new(Box::new(CellDecomposition::new(problem)))))
    }

    /// A planner whose edges are the chart's straight lines.
    fn by_lines<R>(
        &self,
        robot: R,
        [start, goal]: [R::Configuration; 2],
        name: PlannerName,
        seed: Seed,
    ) -> Result<Result<Box<dyn Attempt>, NoPath>, Failure>
    where
        R: Planned<Configuration: motion_lab::configuration::Chart>,
        motion_lab::planning::LinePath<R>: motion_lab::simulation::PlayablePath,
    {
        let problem = match Problem::try_new(Checker::new(Arc::clone(&self.scene), robot), start, goal, seed) {
            Ok(problem) => problem,
            Err(reason) => return Ok(Err(reason.into())),
        };
        let planner: Box<dyn Planner<R, ChartLine<R>>> = match name {
            PlannerName::RrtConnect => Box::new(RrtConnect::new(problem)),
            PlannerName::Rrt => Box::new(Rrt::new(problem)),
            PlannerName::RrtStar => Box::new(RrtStar::new(problem)),
            PlannerName::Prm => Box::new(Prm::new(problem)),
            PlannerName::AStar => Box::new(GridSearch::a_star(problem)),
            PlannerName::Dijkstra => Box::new(GridSearch::dijkstra(problem)),
            PlannerName::VisibilityGraph => Box::new(VisibilityGraph::new(problem)),
            PlannerName::PotentialField => Box::new(PotentialField::new(problem)),
            PlannerName::Bug1 => match Bug1::try_new(&problem) {
                Ok(bug) => Box::new(bug),
                Err(reason) => return Ok(Err(reason)),
            },
            PlannerName::Bug2 => match Bug2::try_new(&problem) {
                Ok(bug) => Box::new(bug),
                Err(reason) => return Ok(Err(reason)),
            },
            PlannerName::CellDecomposition => return Ok(self.by_cells(seed)),
            PlannerName::HybridAStar => {
                let reason = "hybrid-a-star plans for a car only";
                return Err(Failure::usage(reason, "Use --planner rrt-connect."));
            }
        };
        Ok(Ok(Box::new(Trial::new(planner))))
    }

    /// A configuration's coordinates.
    pub fn coordinates(q: &AnyConfiguration) -> Vec<f64> {
        q.coordinates().to_vec()
    }
}
