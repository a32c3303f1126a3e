//! `Witness`, a pair of points that attains a distance.

use crate::geometry::Point2;

/// The number of an obstacle in its scene, in file order. [`Scene::obstacle_name`](super::Scene::obstacle_name) gives
/// its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObstacleId(pub u32);

impl ObstacleId {
    /// Stands for no known obstacle: the footprint was not finite, so it has no witness.
    pub const UNKNOWN: ObstacleId = ObstacleId(u32::MAX);
}

/// What a motion hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitBy {
    /// An obstacle.
    Obstacle(ObstacleId),
    /// The robot's own limit, which no obstacle sets: the jackknife limit of a hitch.
    Limit,
}

impl HitBy {
    /// The obstacle; `None` for a limit.
    pub fn obstacle(self) -> Option<ObstacleId> {
        match self {
            HitBy::Obstacle(id) => Some(id),
            HitBy::Limit => None,
        }
    }
}

/// The nearest points of a footprint and the obstacles, and which part and obstacle they lie on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// The point a* of the footprint, metres.
    pub on_robot: Point2,
    /// The point b* of the obstacle, metres; on contact the same point as `on_robot`.
    pub on_obstacle: Point2,
    /// The distance between them, metres; 0 on contact.
    pub dist: f64,
    /// The number of the footprint's part.
    pub part: usize,
    /// The obstacle.
    pub obstacle: ObstacleId,
}

/// Where a footprint is deepest in an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// The number of the part.
    pub part: usize,
    /// The obstacle.
    pub obstacle: ObstacleId,
    /// A lower bound on how far the part must move to be free of the obstacle, metres, above 0.
    pub depth: f64,
}
