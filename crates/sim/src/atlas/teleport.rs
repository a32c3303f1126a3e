//! Teleports: whether a robot can be put somewhere, and the nearest free configuration if not.

use std::fmt;

use crate::run::check_target;
use motion_lab_core::collision::{Checker, Collision, ObstacleId, Scene};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::cspace::{NearestFree, Slice, nearest_free};
use motion_lab_core::geometry::{Aabb, Footprint, Part, Pose2, Shape};
use motion_lab_core::robots::{AnyRobot, ConfigurationError, Robot};
use motion_lab_core::worlds::{Obstacle, ObstacleKind, OutsideError, World};

/// The check whether a robot can be put somewhere.
#[derive(Clone, Copy, Debug)]
pub struct Teleport;

/// Why a teleport is refused.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum TeleportRefusal {
    /// It would overlap or touch something.
    Overlap {
        /// The names of everything it would overlap or touch, in file order, other robots last.
        names: Vec<String>,
        /// The nearest free configuration with the same headings (for an arm of three joints, the same first joint), if
        /// one was found. [`NearestFree`] holds its distance.
        nearest: Option<NearestFree>,
    },
    /// An arm's tip cannot reach the point.
    OutOfReach {
        /// The least distance of the tip from the base, metres.
        least: f64,
        /// The greatest distance of the tip from the base, metres.
        most: f64,
        /// The point's distance from the base, metres.
        wanted: f64,
    },
    /// The target lies outside the world.
    Outside(OutsideError),
    /// The target is no configuration of this robot.
    Configuration(ConfigurationError),
}

impl fmt::Display for TeleportRefusal {
    /// In words: `would overlap the post`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TeleportRefusal::Overlap { names, .. } => match &names[..] {
                [] => write!(f, "would overlap something"),
                [one] => write!(f, "would overlap {one}"),
                [head @ .., last] => write!(f, "would overlap {} and {last}", head.join(", ")),
            },
            TeleportRefusal::OutOfReach { least, most, wanted } => {
                write!(f, "out of reach: {wanted:.2} m from the base, and the tip gets from {least:.2} to {most:.2} m")
            }
            TeleportRefusal::Outside(error) => write!(f, "{error}"),
            TeleportRefusal::Configuration(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for TeleportRefusal {}

impl Teleport {
    /// Checks whether the checker's robot can be put at `to`. It asks the query that decides teleports in a run, so a
    /// run accepts what is accepted here. Touching is refused, and so is a place outside the bounds.
    ///
    /// # Errors
    /// [`TeleportRefusal`] with the names of everything it would overlap or touch, and the nearest free configuration.
    pub fn ask(checker: &Checker<AnyRobot>, to: &AnyConfiguration) -> Result<(), TeleportRefusal> {
        Self::ask_only(checker, to).map_err(|refusal| match refusal {
            TeleportRefusal::Overlap { names, .. } => {
                let slice = Slice::through(checker, to);
                TeleportRefusal::Overlap { names, nearest: slice.ok().and_then(|slice| nearest_free(&slice, to)) }
            }
            refusal => refusal,
        })
    }

    /// As [`ask`](Self::ask), without the search for the nearest free configuration: for use during a drag.
    ///
    /// # Errors
    /// [`TeleportRefusal`], whose `nearest` is `None`.
    pub fn ask_only(checker: &Checker<AnyRobot>, to: &AnyConfiguration) -> Result<(), TeleportRefusal> {
        check_there(checker.robot(), to, &checker.scene().bounds())?;
        let footprint = checker.robot().footprint(to);
        if !checker.scene().intersects(&footprint) {
            return Ok(());
        }
        let names = names(checker.scene(), checker.scene().touched(&footprint));
        Err(TeleportRefusal::Overlap { names, nearest: None })
    }
}

/// Checks what needs no obstacles: that `to` is one of the robot's configurations, and lies within these bounds.
pub(super) fn check_there(robot: &AnyRobot, to: &AnyConfiguration, bounds: &Aabb) -> Result<(), TeleportRefusal> {
    robot.check(to).map_err(TeleportRefusal::Configuration)?;
    robot.position(to).map_or(Ok(()), |at| check_target(at, bounds)).map_err(TeleportRefusal::Outside)
}

/// The names of these obstacles, in their order. A robot of several parts is named once.
pub(super) fn names(scene: &Scene, touched: Vec<ObstacleId>) -> Vec<String> {
    let mut names: Vec<String> =
        touched.into_iter().filter_map(|id| scene.obstacle_name(id)).map(str::to_owned).collect();
    names.dedup();
    names
}

/// The scene of a world with robots standing in it: after the world's obstacles and closed doors each part of each
/// robot, in their order, is an obstacle under the robot's name.
pub(super) fn crowd<'a>(world: &World, standing: impl Iterator<Item = (&'a str, Footprint)>) -> Scene {
    let parts = standing.flat_map(|(name, footprint)| {
        let part = |part: &Part| {
            let placed = part.placed();
            let shape = Shape::Hull { vertices: placed.core().into(), radius: placed.radius() };
            Obstacle::new(name, ObstacleKind::Solid, vec![(Pose2::IDENTITY, shape)])
        };
        footprint.parts().iter().map(part).collect::<Vec<_>>()
    });
    let added: Vec<Obstacle> = world.closed_doors().chain(parts).collect();
    Scene::of_obstacles(world.bounds, world.obstacles.iter().chain(&added))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atlas::Atlas;
    use motion_lab_core::worlds::Resident;

    #[test]
    fn a_refusal_names_everything_and_offers_the_nearest_free_place() {
        let mut atlas = Atlas::new(World::lot());
        let car = atlas.robots()[0].q;
        let in_the_corner = car.with(0, 0.5).with(1, 0.5);
        let refusal = atlas.teleport(0, in_the_corner).unwrap().unwrap_err();
        assert_eq!(refusal.to_string(), "would overlap the south curb and the west curb");
        let on_the_pillar = car.with(0, 5.5).with(1, 5.0).with(2, 1.2);
        let refusal = atlas.teleport(0, on_the_pillar).unwrap().unwrap_err();
        assert_eq!(refusal.to_string(), "would overlap the west pillar");
        assert_eq!(atlas.robots()[0].q, car, "it stays where it is");
        let TeleportRefusal::Overlap { nearest: Some(offer), .. } = refusal else { panic!("{refusal:?}") };
        assert!(offer.distance > 0.1 && offer.distance - offer.proven < 2e-3, "{offer:?}");
        assert_eq!(atlas.teleport(0, offer.q), Some(Ok(())));
        assert_eq!(atlas.robots()[0].q, offer.q);
    }

    #[test]
    fn other_robots_are_in_the_way_under_their_names() {
        let mut world = World::workbench();
        world.robots.push(Resident::new("Rover", "rusty", [2.0, 2.0, 0.0]));
        let mut atlas = Atlas::new(world);
        let rover = atlas.robots()[1].q;
        // at the elbow it would overlap both links: one robot
        let on_the_elbow = rover.with(0, 0.7).with(1, 0.7);
        assert_eq!(atlas.teleport(1, on_the_elbow).unwrap().unwrap_err().to_string(), "would overlap Reach");
        let on_the_arm = rover.with(0, 0.0).with(1, 1.4);
        let refusal = atlas.teleport(1, on_the_arm).unwrap().unwrap_err();
        assert_eq!(refusal.to_string(), "would overlap Reach");
        let at_block_and_arm = rover.with(0, 0.45).with(1, 0.97);
        let refusal = atlas.teleport(1, at_block_and_arm).unwrap().unwrap_err();
        assert_eq!(refusal.to_string(), "would overlap the block and Reach");
        assert_eq!(atlas.teleport(7, rover), None);
        let wrong = atlas.robots()[0].q;
        assert!(matches!(atlas.teleport(1, wrong), Some(Err(TeleportRefusal::Configuration(_)))));
    }

    #[test]
    fn a_place_outside_the_world_is_refused_by_name_and_there_is_no_offer() {
        let mut atlas = Atlas::new(World::lot());
        let car = atlas.robots()[0].q;
        let refusal = atlas.teleport(0, car.with(0, 90.0).with(1, 5.0)).unwrap().unwrap_err();
        let bounds = atlas.world().bounds;
        let sides = format!("from ({}, {}) to ({}, {})", bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y);
        assert_eq!(refusal.to_string(), format!("the target (90, 5) lies outside the world, which reaches {sides}"));
        assert_eq!(atlas.robots()[0].q, car, "it stays where it is");
    }

    #[test]
    fn touching_is_refused() {
        let mut world = World::lot();
        world.robots = vec![Resident::new("Rover", "rusty", [2.0, 2.0, 0.0])];
        world.robots[0].kind = "rusty".into();
        let mut atlas = Atlas::new(world);
        let q = atlas.robots()[0].q;
        let touching = q.with(0, 0.11); // a body radius from the west curb, exactly
        assert!(atlas.teleport(0, touching).unwrap().is_err());
        assert_eq!(atlas.teleport(0, q.with(0, 0.11 + 1e-9)), Some(Ok(())));
    }
}
