//! `LinkedPlan`, what an address says of a plan.

use super::error::LinkError;
use super::limits::MAX_PLANNER_SEED;
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::{PlannerName, Task};

/// What an address says of a plan: a robot of a built-in world, where it is to go, and by which planner.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkedPlan {
    /// The name by which the world is built in.
    pub world: &'static str,
    /// The robot's name in it.
    pub robot: String,
    /// The start's coordinates, metres and radians; where the robot stands when empty. A car with its trailer has four.
    pub from: Vec<f64>,
    /// The goal's; when empty, that with which the widget begins.
    pub to: Vec<f64>,
    /// The planner; the usual one of the robot when left out.
    pub planner: Option<PlannerName>,
    /// The seed of its samples; the book's when left out.
    pub seed: Option<Seed>,
    /// Whether the range sensor lies by which the robot walks, if its planner is such a one.
    pub lies: bool,
}

/// The robot of a plan in its world, and where it begins and ends.
pub struct PlannedRobot {
    /// The robot.
    pub robot: AnyRobot,
    /// Its world.
    pub world: World,
    /// Where it begins.
    pub start: AnyConfiguration,
    /// Where it ends, if that is said.
    pub goal: Option<AnyConfiguration>,
}

impl LinkedPlan {
    /// The plan of a robot in the built-in world of this name, from its usual start, by its usual planner.
    pub fn in_world(world: &'static str, robot: impl Into<String>) -> Self {
        let robot = robot.into();
        LinkedPlan { world, robot, from: Vec::new(), to: Vec::new(), planner: None, seed: None, lies: false }
    }

    /// The plan of a task in a built-in world, if an address can say it: of a resident with its own sizes.
    pub fn of(task: &Task, planner: PlannerName, seed: Seed) -> Option<Self> {
        let world = task.world.built_in_name()?;
        let [from, to] = [&task.start, &task.goal].map(|q| q.coordinates().to_vec());
        let (robot, lies) = (task.name.clone(), task.noise.is_some());
        let plan = LinkedPlan { world, robot, from, to, planner: Some(planner), seed: Some(seed), lies };
        (plan.planned().ok()?.robot == task.robot && seed.0 <= MAX_PLANNER_SEED).then_some(plan)
    }

    /// The robot in its world.
    ///
    /// # Errors
    /// [`LinkError::Plan`] for a robot that there is not, and [`LinkError::Place`] for an end that is no configuration
    /// of it.
    pub fn planned(&self) -> Result<PlannedRobot, LinkError> {
        let world = World::built_in(self.world).ok_or_else(|| LinkError::Plan(self.world.to_owned()))?;
        let resident = world.robots.iter().find(|resident| resident.name == self.robot);
        let (robot, stands) =
            resident.and_then(AnyRobot::of_resident).ok_or_else(|| LinkError::Plan(self.robot.clone()))?;
        // the number of coordinates tells whether a car pulls its trailer
        let at = |field, coordinates: &[f64]| {
            let (kind, count) = (robot.kind(), coordinates.len());
            let q = AnyRobot::of_kind(kind, coordinates).map(|(_, q)| q);
            q.ok_or(LinkError::Place { field, count, robot: self.robot.clone() })
        };
        let start = if self.from.is_empty() { stands } else { at("from", &self.from)? };
        let goal = if self.to.is_empty() { None } else { Some(at("to", &self.to)?) };
        let robot = robot.fitted(&start);
        if goal.is_some_and(|goal| robot.fitted(&goal) != robot) {
            return Err(LinkError::Place { field: "to", count: self.to.len(), robot: self.robot.clone() });
        }
        Ok(PlannedRobot { robot, world, start, goal })
    }
}
