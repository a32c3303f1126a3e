//! `ProblemPlace`, a robot in a world, where problems of one set begin and end.

use std::sync::Arc;

use motion_lab_core::collision::Scene;
use motion_lab_core::configuration::{AnyConfiguration, RobotKind, WrittenCoordinate};
use motion_lab_core::names::{hint, nearest};
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::World;
use motion_lab_sim::plans::Task;

/// A robot that stands alone in a world.
#[derive(Clone, Debug)]
pub(super) struct ProblemPlace {
    /// The robot's name: a resident's, or a kind's in the book.
    pub robot: String,
    pub kind: &'static RobotKind,
    model: AnyRobot,
    /// The coordinates behind the position, where a problem says none.
    headings: Vec<f64>,
    pub world: Arc<World>,
    scene: Arc<Scene>,
}

impl ProblemPlace {
    /// The robot that a name means in a world: the resident of this name, else one of the kind, by the kind's name in
    /// the book.
    pub fn of(robot: &str, world: &World) -> Result<Self, String> {
        let resident = world.robots.iter().find(|resident| resident.name == robot);
        let kind = resident.map_or(robot, |resident| &resident.kind);
        let sizes = resident.and_then(|resident| resident.sizes.as_ref());
        let known = RobotKind::of(kind).zip(AnyRobot::model(kind, sizes));
        let (kind, model) = known.ok_or_else(|| {
            let names: Vec<&str> = world.robots.iter().map(|resident| resident.name.as_str()).take(20).collect();
            let there = if names.is_empty() { "nobody".into() } else { names.join(", ") };
            let kinds = RobotKind::ALL.into_iter().map(|kind| kind.name);
            let meant = nearest(robot, names.iter().copied().chain(kinds));
            format!("there is no robot {robot:?}; in {} lives {there}{}", world.name, hint(meant))
        })?;
        let headings = resident.and_then(|resident| resident.start.get(2..)).unwrap_or(&[0.0]).to_vec();
        let world = World { robots: resident.cloned().into_iter().collect(), ..world.clone() };
        let scene = Arc::new(Scene::of_world(&world));
        let robot = resident.map_or(kind.title, |resident| &resident.name).to_owned();
        Ok(ProblemPlace { robot, kind, model, headings, world: Arc::new(world), scene })
    }

    /// The coordinates that a person wrote for this robot; a disc's heading may be left out.
    pub fn written(&self, written: &[WrittenCoordinate]) -> Result<Vec<f64>, String> {
        let mut values = WrittenCoordinate::values(written, self.kind.lengths).map_err(|error| error.to_string())?;
        if let Some(wrong) = values.iter().find(|x| !x.is_finite()) {
            return Err(format!("{wrong}: it must be finite"));
        }
        if *self.kind == RobotKind::RUSTY && values.len() == 2 {
            values.push(0.0);
        }
        self.configuration(&values).map(|_| values)
    }

    /// The coordinates of a position, with the headings that the robot has anyway.
    pub fn standing(&self, [x, y]: [f64; 2]) -> Vec<f64> {
        [x, y].into_iter().chain(self.headings.iter().copied()).collect()
    }

    fn configuration(&self, coordinates: &[f64]) -> Result<AnyConfiguration, String> {
        let none = || format!("{} coordinates: a {} has {}", coordinates.len(), self.kind.name, self.kind.start);
        AnyRobot::of_kind(self.kind.name, coordinates).map(|(_, q)| q).ok_or_else(none)
    }

    /// The task from one configuration to another.
    pub fn task(&self, ends: [&[f64]; 2]) -> Result<Task, String> {
        let [start, goal] = ends.map(|end| self.configuration(end));
        let (start, goal) = (start?, goal?);
        let (world, scene) = (Arc::clone(&self.world), Arc::clone(&self.scene));
        Ok(Task::in_scene(&self.robot, self.model.fitted(&start), (world, scene), [start, goal]))
    }
}
