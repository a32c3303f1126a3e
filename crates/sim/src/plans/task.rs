//! `Task`, what is to be planned: a robot in a world, from a start to a goal.

use std::sync::Arc;

use crate::simulation::{PlayError, PlayStage, PlayablePath, PlayedPath};
use motion_lab_core::collision::{Checker, Collision as _, Problem, ProblemError, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Chart, Configuration, R2, Tn};
use motion_lab_core::geometry::Pose2;
use motion_lab_core::num::greater;
use motion_lab_core::planning::hybrid::{HybridSettings, NearGoal};
use motion_lab_core::planning::{
    CellDecomposition, CertifiedPath, LinePath, MARGIN, NoPath, Planner, cell_length_bound, length_bound,
};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::robots::{AnyRobot, Hitch, HitchArc, Reach, Robot, Rusty, RustyDisc};
use motion_lab_core::sensors::BeamModel;
use motion_lab_core::worlds::{Resident, World};

use super::attempt::{LegMotion, PlanAttempt, ShortenedPath, Trial};
use super::bug1_sensor::Bug1Sensor;
use super::checker_name::CheckerName;
use super::making::{ByLines, HasMaker, LINES, Making};
use super::named::PlannerName;
use super::own::LinePlanner;

/// How much larger a rover is planned unless somebody says otherwise, metres.
pub const TUBE: f64 = 0.02;

/// Largest clearance that a path may be asked to keep, metres.
pub const MAX_CLEARANCE: f64 = 100.0;

/// Start and goal are not the robot's.
const MISMATCH: NoPath = NoPath::Unsuited("start and goal are no configurations of this robot");

/// The least tube in which a path is played, metres: no follower stays on a line without any width.
const MIN_TUBE: f64 = 1e-3;

/// What is to be planned.
#[derive(Clone, Debug)]
pub struct Task {
    /// The robot's name: that of a resident of the world, or of a kind.
    pub name: String,
    /// The robot, a car with its trailer if it starts with one.
    pub robot: AnyRobot,
    /// The world.
    pub world: Arc<World>,
    /// Its scene.
    pub scene: Arc<Scene>,
    /// Where the path begins.
    pub start: AnyConfiguration,
    /// Where it ends.
    pub goal: AnyConfiguration,
    /// How much larger a rover is planned, metres, so that its script may stray from the path by as much.
    pub tube: f64,
    /// The clearance that the path is to keep beside the tube, metres; with 0 it only touches nothing. A path that
    /// keeps it is proven: [`CheckerName::EXACT`] alone plans so, and no robot that walks by its sensor does. `None`
    /// for what is [usual](Self::usual_clearance).
    pub clearance: Option<f64>,
    /// The noise of the range sensor by which the robot walks, if its planner is such a one; `None` for an exact
    /// sensor.
    pub noise: Option<BeamModel>,
    /// Who answers the planner's questions. Only with [`CheckerName::EXACT`] is a path proven, and can be played.
    pub checker: CheckerName,
}

impl Task {
    /// The task of a robot in a world, from `start` to `goal`, both of its own configurations.
    pub fn new(name: impl Into<String>, robot: AnyRobot, world: World, ends: [AnyConfiguration; 2]) -> Self {
        let scene = Arc::new(Scene::of_world(&world));
        Self::in_scene(name, robot, (Arc::new(world), scene), ends)
    }

    /// The task of a robot in a world and its scene, which other tasks may share.
    pub fn in_scene(
        name: impl Into<String>,
        robot: AnyRobot,
        (world, scene): (Arc<World>, Arc<Scene>),
        [start, goal]: [AnyConfiguration; 2],
    ) -> Self {
        Task {
            name: name.into(),
            robot,
            world,
            scene,
            start,
            goal,
            tube: TUBE,
            clearance: None,
            noise: None,
            checker: CheckerName::EXACT,
        }
    }

    /// The chapter's question: the arm of the Workbench round the post.
    pub fn round_the_post() -> Self {
        let ends = [[2.0, 0.0], [3.1, 0.0]].map(|q| AnyConfiguration::T2(Tn(q)));
        Self::new("Reach", AnyRobot::Reach(Reach::workbench()), World::workbench(), ends)
    }

    /// The world with the robot that plays alone in it, and that robot's name: the resident of the task's name, else
    /// the first of its kind and of the kind's own sizes, else a new one at the start.
    pub fn alone(&self) -> (World, String) {
        let (robots, kind) = (&self.world.robots, self.robot.kind());
        let of_kind = || robots.iter().find(|r| r.kind == kind && r.sizes.is_none());
        let named = robots.iter().find(|r| r.name == self.name).or_else(of_kind);
        let new = || Resident::new(self.robot.title(), kind, self.start.coordinates().to_vec());
        let resident = named.cloned().unwrap_or_else(new);
        let name = resident.name.clone();
        (World { robots: vec![resident], ..World::clone(&self.world) }, name)
    }

    /// The world with the robot [alone](Self::alone) in it, where the path begins.
    pub fn world_at_start(&self) -> World {
        let (mut world, _) = self.alone();
        world.robots.iter_mut().for_each(|resident| resident.start = self.start.coordinates().to_vec());
        world
    }

    /// The path of an attempt at this task, played by the robot alone in the world, which is returned too; no path
    /// without one of the attempt's.
    pub fn played(&self, attempt: &dyn PlanAttempt, seed: Seed) -> (World, Option<Result<PlayedPath, PlayError>>) {
        let (world, robot) = self.alone();
        let stage = PlayStage { tube: greater(self.tube, MIN_TUBE), ..PlayStage::new(&world, &robot, seed) };
        let played = attempt.play(&stage);
        (world, played)
    }

    /// The planner of this name with the problem, ready to begin.
    ///
    /// # Errors
    /// [`NoPath`]: there is no problem, or the planner does not suit the robot.
    pub fn attempt(&self, name: PlannerName, seed: Seed) -> Result<Box<dyn PlanAttempt>, NoPath> {
        name.suits(&self.robot).map_err(NoPath::Unsuited)?;
        let task = self.with_clearance(name.draws_samples());
        match name {
            PlannerName::Bug1Sensor => task.by_sensor(seed),
            PlannerName::CellDecomposition => task.by_cells(seed),
            _ => task.made_by(&name, seed),
        }
    }

    /// A planner that a program makes as it goes, with the problem, ready to begin. Where nobody says a clearance, its
    /// path keeps [what is usual](Self::usual_clearance) for one that draws samples, or for one that does not.
    ///
    /// # Errors
    /// [`NoPath`]: there is no problem, or the planner does not suit the robot, as no such planner suits a car.
    pub fn attempt_by_lines<P: LinePlanner>(
        &self,
        planner: &P,
        draws_samples: bool,
        seed: Seed,
    ) -> Result<Box<dyn PlanAttempt>, NoPath> {
        if let AnyRobot::Hitch(_) = self.robot {
            return Err(LINES);
        }
        self.with_clearance(draws_samples).made_by(&ByLines(planner), seed)
    }

    /// The planner of the problem of this task's robot.
    fn made_by(&self, making: &impl Making, seed: Seed) -> Result<Box<dyn PlanAttempt>, NoPath> {
        match (self.robot, self.start, self.goal) {
            (AnyRobot::Reach(arm), AnyConfiguration::T2(start), AnyConfiguration::T2(goal)) => {
                self.by_lines::<Reach<2>>(arm, [start, goal], making, seed)
            }
            (AnyRobot::Reach3(arm), AnyConfiguration::T3(start), AnyConfiguration::T3(goal)) => {
                self.by_lines::<Reach<3>>(arm, [start, goal], making, seed)
            }
            (AnyRobot::Rusty(_), ..) => {
                let (disc, ends) = self.disc()?;
                self.by_lines(disc, ends, making, seed)
            }
            (AnyRobot::Hitch(car), AnyConfiguration::Hitch(start), AnyConfiguration::Hitch(goal)) => {
                let car = if start.trailer.is_some() { car.with_trailer() } else { car.without_trailer() };
                let problem = self.problem(car, [start, goal], seed)?;
                Ok(self.trial::<Hitch, HitchArc>(car, making.make_for_car(problem)?))
            }
            _ => Err(MISMATCH),
        }
    }

    /// A length that no path undercuts, metres, of an arm radians: of a rover that is larger by the tube, and of any
    /// robot that keeps the clearance which is said, and whose position stays within the world's bounds. A rover's is
    /// [exact](length_bound()), another's comes from [cells](cell_length_bound). Infinity where there is no such path;
    /// `None` where start or goal are no ends of one.
    pub fn length_bound(&self) -> Option<f64> {
        let task = Task { checker: CheckerName::EXACT, ..self.clone() };
        if let Ok((disc, ends)) = self.disc() {
            return length_bound(&task.problem(disc, ends, Seed(0)).ok()?);
        }
        let reach = match self.goal {
            // as near as hybrid A* takes for the goal
            AnyConfiguration::Hitch(goal) => {
                let NearGoal { near, aligned, .. } = HybridSettings::default().around(goal);
                &[near, near, aligned][..]
            }
            _ => &[],
        };
        cell_length_bound(&task.problem(self.robot, [self.start, self.goal], Seed(0)).ok()?, reach)
    }

    /// The disc that a rover is planned as, larger by the tube, and where its path begins and ends.
    fn disc(&self) -> Result<(RustyDisc, [R2; 2]), NoPath> {
        match (self.robot, self.start, self.goal) {
            (AnyRobot::Rusty(rover), AnyConfiguration::Pose(start), AnyConfiguration::Pose(goal)) => {
                let too_large = |_| NoPath::Unsuited("the rover with its tube is too large");
                let disc = RustyDisc::try_new(rover.body_radius + self.tube).map_err(too_large)?;
                Ok((disc, [start, goal].map(|q| R2::new(q.x, q.y))))
            }
            _ => Err(MISMATCH),
        }
    }

    /// The task with the clearance that is usual where nobody says another.
    fn with_clearance(&self, draws_samples: bool) -> Self {
        let clearance = self.clearance.unwrap_or_else(|| self.usual_clearance(draws_samples));
        Task { clearance: Some(clearance), ..self.clone() }
    }

    /// The clearance that a path keeps where nobody says another, metres: [`MARGIN`] by planners that
    /// [draw samples](PlannerName::draws_samples), if start and goal have more, and 0 by the others, which keep what
    /// they keep or say that there is no path at all.
    pub fn usual_clearance(&self, draws_samples: bool) -> f64 {
        let has_more = |q: &AnyConfiguration| self.scene.distance(&self.planned().footprint(q)) > MARGIN;
        let keeps = draws_samples && self.checker.proves() && has_more(&self.start) && has_more(&self.goal);
        if keeps { MARGIN } else { 0.0 }
    }

    /// The clearance that is said, metres.
    fn said_clearance(&self) -> f64 {
        self.clearance.unwrap_or(0.0)
    }

    /// The robot as it is planned for: a rover is larger by the tube.
    pub fn planned(&self) -> AnyRobot {
        match self.robot {
            AnyRobot::Rusty(rover) => AnyRobot::Rusty(Rusty { body_radius: rover.body_radius + self.tube, ..rover }),
            robot => robot,
        }
    }

    /// The planner by cells, which plans for a robot of any kind.
    fn by_cells(&self, seed: Seed) -> Result<Box<dyn PlanAttempt>, NoPath> {
        // a rover's heading does not matter
        let [start, goal] = [self.start, self.goal].map(|q| match q {
            AnyConfiguration::Pose(pose) => AnyConfiguration::Pose(Pose2::new(pose.x, pose.y, 0.0)),
            q => q,
        });
        let problem = self.problem(self.planned(), [start, goal], seed)?;
        Ok(self.trial(self.planned(), Box::new(CellDecomposition::new(problem))))
    }

    /// The planner whose rover walks by its range sensor.
    fn by_sensor(&self, seed: Seed) -> Result<Box<dyn PlanAttempt>, NoPath> {
        if self.said_clearance() > 0.0 {
            return Err(NoPath::Unsuited("it walks by what its sensor sees, and keeps no clearance of yours"));
        }
        let (disc, [start, goal]) = self.disc()?;
        let problem = Problem::try_new(self.checker.checker(&self.scene, disc), start, goal, seed)?;
        let noise = self.noise.map(|model| (model, Stream::new(seed, "bug1/beam")));
        Ok(Box::new(Trial::new(Box::new(Bug1Sensor::new(problem, noise)))))
    }

    /// A planner whose edges are the chart's straight lines.
    fn by_lines<R>(
        &self,
        robot: R,
        ends: [R::Configuration; 2],
        making: &impl Making,
        seed: Seed,
    ) -> Result<Box<dyn PlanAttempt>, NoPath>
    where
        R: HasMaker<Configuration: Chart + Into<AnyConfiguration>>,
        LinePath<R>: PlayablePath,
    {
        let planner = making.make(self.problem(robot.clone(), ends, seed)?)?;
        Ok(self.trial(robot, planner))
    }

    /// The scene in which a planner plans: the world's, with obstacles larger by the clearance that is to be kept.
    pub fn planned_scene(&self) -> Arc<Scene> {
        if self.said_clearance() > 0.0 {
            Arc::new(self.scene.grown(self.said_clearance()))
        } else {
            Arc::clone(&self.scene)
        }
    }

    /// The problem of a robot in the scene in which it is planned.
    fn problem<R: Robot>(
        &self,
        robot: R,
        [start, goal]: [R::Configuration; 2],
        seed: Seed,
    ) -> Result<Problem<R>, ProblemError> {
        let own = Problem::try_new(self.checker.checker(&self.scene, robot.clone()), start, goal, seed)?;
        if self.said_clearance() <= 0.0 {
            return Ok(own);
        }
        for (end, q) in [("start", &start), ("goal", &goal)] {
            let nearest =
                own.checker().witness(q).ok().flatten().filter(|witness| witness.dist <= self.said_clearance());
            if let Some(witness) = nearest {
                let obstacle = self.scene.obstacle_name(witness.obstacle).unwrap_or("an obstacle").to_owned();
                return Err(ProblemError::Clearance {
                    end,
                    obstacle,
                    clearance: witness.dist,
                    kept: self.said_clearance(),
                });
            }
        }
        Problem::try_new(self.checker.checker(&self.planned_scene(), robot), start, goal, seed)
    }

    /// A planner of this task at work, of this robot.
    fn trial<R, M>(&self, robot: R, planner: Box<dyn Planner<R, M> + Send>) -> Box<dyn PlanAttempt>
    where
        R: Robot<Configuration: Into<AnyConfiguration>> + Send + 'static,
        M: LegMotion<Configuration = R::Configuration>,
        CertifiedPath<M>: PlayablePath + ShortenedPath<R>,
    {
        let trial = Trial::new(planner);
        if self.said_clearance() > 0.0 {
            return Box::new(trial.keeping(Checker::new(Arc::clone(&self.scene), robot), self.said_clearance()));
        }
        Box::new(trial)
    }
}

#[cfg(test)]
mod tests;
