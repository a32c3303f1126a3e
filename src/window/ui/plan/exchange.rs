//! What leaves a plan and comes into it: commands, figures, paths that are played, files.

use std::sync::Arc;

use super::panel::goal_for;
use super::racer::PlanStage;
use super::state::PlanState;
use motion_lab_core::collision::Scene;
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::planning::Effort;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::capture::{self, Captured, PlanOutcome, PlanSheet};
use motion_lab_sim::lens::SpaceCells;
use motion_lab_sim::plans::{Drawn, PathFile, PathFileError, Task};
use motion_lab_sim::simulation::{PlayError, PlayedPath};

impl PlanState {
    /// The command line that plans this; `None` in a world that no command knows by name, for a file's path, and for a
    /// sensor that lies: the command's is exact.
    pub fn command(&self) -> Option<String> {
        if matches!(self.stage(), PlanStage::Read(..)) || self.is_by_sensor() && self.sensor_lies() {
            return None;
        }
        let (Task { name, start, goal, .. }, world) = (&self.task, self.known_as?);
        let numbers = |q: &AnyConfiguration| q.coordinates().iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let (planner, seed) = (self.planner().id(), self.seed);
        let ends = format!("--from {} --to {}", numbers(start), numbers(goal));
        Some(format!("motion-lab plan --planner {planner} --robot {name} --world {world} {ends} --seed {seed}"))
    }

    /// The planner's path, played in its world by its robot alone; `None` without a path of the planner's own.
    pub fn played(&self) -> Option<(World, Result<PlayedPath, PlayError>)> {
        let work = self.racer().work.as_ref().filter(|_| *self.stage() == PlanStage::Solved)?;
        let (world, played) = work.with(|attempt| self.task.played(attempt, self.seed));
        Some((world, played?))
    }

    /// The path as a file, with what the planner has grown; `None` without a path of the planner's own.
    pub fn file(&self) -> Option<PathFile> {
        let work = self.racer().work.as_ref().filter(|_| *self.stage() == PlanStage::Solved)?;
        Some(work.with(|attempt| PathFile::new(self.planner().id(), self.seed.0, &self.task, attempt, true)))
    }

    /// Shows a plan from a file: in `world` if it has the name that the file names, else in the built-in world of that
    /// name, else in the present one.
    ///
    /// # Errors
    /// [`PathFileError`]: the present plan stays.
    pub fn read(&mut self, name: &str, text: &str, world: &World) -> Result<(), PathFileError> {
        let file = PathFile::read(text)?;
        let (kind, [start, goal]) = file.robot()?;
        let [of, robot_name] = file.names();
        let built_in = || World::built_in_names().into_iter().filter_map(World::built_in).find(|w| w.name == of);
        let world =
            if world.name == of { world.clone() } else { built_in().unwrap_or_else(|| World::clone(&self.task.world)) };
        let resident = world.robots.iter().find(|r| r.name == robot_name).and_then(AnyRobot::of_resident);
        let resident = resident.map(|(robot, _)| robot).filter(|robot| robot.like(&start).is_some());
        let robot = resident.unwrap_or(kind);
        // a name that no robot has is the file's word only: what is copied as a command repeats the task's
        let robot_name = if resident.is_some() { robot_name } else { robot.title() }.to_owned();
        let task = Task::new(robot_name, robot, world, [start, goal]);
        let judged = file.judged(&task)?;
        let rejected = judged.as_ref().and_then(|judged| judged.hit.clone());
        let drawn = Drawn { rejected, ..file.drawn(&robot)? };
        self.take(task);
        let planner = self.planner();
        self.race(&[planner], planner);
        for racer in &mut self.racers {
            (racer.work, racer.stage) = (None, PlanStage::Read(name.to_owned(), judged.clone()));
        }
        self.draw(drawn);
        Ok(())
    }

    /// Whether there is nothing to lose: no planner has begun, no goal was moved, and no file is shown.
    pub fn is_idle(&self) -> bool {
        let is_read = matches!(self.stage(), PlanStage::Read(..));
        !self.playing && !self.is_moved && !is_read && self.effort() == Effort::default()
    }

    /// Shows the plan of a robot of this name in a world, from `start` to `goal`, or to a goal to begin with.
    pub fn show(
        &mut self,
        (name, robot): (&str, AnyRobot),
        world: Arc<World>,
        start: AnyConfiguration,
        goal: Option<AnyConfiguration>,
    ) {
        let goal = goal.unwrap_or_else(|| goal_for(&robot, &world, start));
        let scene = Arc::new(Scene::of_world(&world));
        self.take(Task::in_scene(name, robot, (world, scene), [start, goal]));
    }

    /// The widget as a figure.
    pub fn captured(&self) -> Captured {
        capture::plan(&PlanSheet {
            task: &self.task,
            planner: self.planner(),
            seed: self.seed,
            drawn: &self.drawn,
            effort: self.effort(),
            found: match (self.stage(), self.lengths()) {
                (PlanStage::Read(file, judged), _) => PlanOutcome::File(file, judged.as_ref()),
                (_, Some(lengths)) => PlanOutcome::Path(lengths),
                (PlanStage::Ended(_), None) => PlanOutcome::None,
                _ => PlanOutcome::Growing,
            },
            cells: self.cells.as_ref().map(SpaceCells::map),
        })
    }
}
