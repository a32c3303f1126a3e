//! `ProblemSite`, a world in which a problem is made: where the robot is free, and the task from there.

use std::sync::Arc;

use super::error::GeneratorError;
use crate::plans::Task;
use motion_lab_core::collision::{Collision as _, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Configuration as _, RobotKind, Sizes};
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Shape};
use motion_lab_core::random::Stream;
use motion_lab_core::robots::{AnyRobot, Robot as _};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, Resident, World};

/// The clearance of every start and goal, metres: more than a path's usual tube and margin.
pub(super) const END_CLEARANCE: f64 = 0.05;

/// Largest number of places that are drawn for an end.
const MAX_DRAWS: usize = 1_000;

/// A world without robots, and the kind of robot that is to live there.
pub(super) struct ProblemSite {
    kind: &'static RobotKind,
    sizes: Option<Sizes>,
    world: World,
    scene: Arc<Scene>,
}

impl ProblemSite {
    pub fn new(kind: &'static RobotKind, world: World) -> Self {
        Self::with_sizes(kind, None, world)
    }

    /// The site for a robot of these sizes; of its kind's own without any.
    pub fn with_sizes(kind: &'static RobotKind, sizes: Option<Sizes>, world: World) -> Self {
        let world = World { robots: Vec::new(), ..world };
        ProblemSite { kind, sizes, scene: Arc::new(Scene::of_world(&world)), world }
    }

    /// The robot with the configuration of these coordinates, if there is one.
    fn at(&self, coordinates: &[f64]) -> Option<(AnyRobot, AnyConfiguration)> {
        let (_, q) = AnyRobot::of_kind(self.kind.name, coordinates)?;
        Some((AnyRobot::model(self.kind.name, self.sizes.as_ref())?.fitted(&q), q))
    }

    /// The first of the configurations drawn that has room about it.
    pub fn free(
        &self,
        end: &'static str,
        draws: &mut Stream,
        mut draw: impl FnMut(&mut Stream) -> Vec<f64>,
    ) -> Result<AnyConfiguration, GeneratorError> {
        let drawn = (0..MAX_DRAWS).find_map(|_| self.has_room(&draw(draws)));
        drawn.ok_or(GeneratorError::Crowded { end, tries: MAX_DRAWS })
    }

    /// The configuration with these coordinates, if it has room about it.
    fn has_room(&self, coordinates: &[f64]) -> Option<AnyConfiguration> {
        let (robot, q) = self.at(coordinates)?;
        let is_within =
            |p: &AnyConfiguration| self.world.check_position(self.kind.name, "end", &p.coordinates()).is_ok();
        let footprint = robot.footprint(&q);
        // contact is decided sooner than a distance
        let is_free = is_within(&q) && !self.scene.intersects(&footprint);
        (is_free && self.scene.distance(&footprint) > END_CLEARANCE).then_some(q)
    }

    /// The task of the robot, which lives at the start and is alone in the world.
    pub fn task(self, ends: [AnyConfiguration; 2]) -> Result<Task, GeneratorError> {
        let none = || GeneratorError::Robot { found: self.kind.name.to_owned(), expected: "robots of the lab" };
        let (robot, _) = self.at(&ends[0].coordinates()).ok_or_else(none)?;
        let ProblemSite { kind, sizes, mut world, scene } = self;
        let resident = Resident::new(kind.title, kind.name, ends[0].coordinates().to_vec());
        world.robots.push(Resident { sizes, ..resident });
        Ok(Task::in_scene(kind.title, robot, (Arc::new(world), scene), ends))
    }
}

/// A number to the thousandth, whose text is short: millimetres, or milliradians.
pub(super) fn tidy(x: f64) -> f64 {
    (x * 1e3).round() / 1e3 + 0.0
}

/// A number of this range, to the thousandth.
pub(super) fn between(draws: &mut Stream, [low, high]: [f64; 2]) -> f64 {
    tidy(draws.uniform(low, high))
}

/// An angle, cut to the thousandth and not rounded, so that it stays in range.
pub(super) fn cut(theta: f64) -> f64 {
    (theta * 1e3).trunc() / 1e3 + 0.0
}

/// Any angle, cut.
pub(super) fn angle(draws: &mut Stream) -> f64 {
    cut(draws.uniform(-std::f64::consts::PI, std::f64::consts::PI))
}

/// A world with an outer wall, from the origin to this corner.
pub(super) fn walled(name: String, to: Point2) -> World {
    let bounds = Aabb::new(Point2::origin(), to);
    let corners = [bounds.min, Point2::new(to.x, 0.0), to, Point2::new(0.0, to.y)];
    let side = |i: usize| (Pose2::IDENTITY, Shape::Segment { a: corners[i], b: corners[(i + 1) % 4] });
    let wall = Obstacle::new("the outer wall", ObstacleKind::Wall, (0..4).map(side).collect());
    World { obstacles: vec![wall], ..World::empty(name, bounds) }
}

/// A solid obstacle of one shape.
pub(super) fn solid(name: String, pose: Pose2, shape: Shape) -> Obstacle {
    Obstacle::new(name, ObstacleKind::Solid, vec![(pose, shape)])
}
