//! `WorldChange`, an input of a run that changes a world's obstacles.

use serde::{Deserialize, Serialize};

use super::Quantized;
use motion_lab_core::geometry::{Point2, Pose2, Shape, ShapeError, convex_hull};
use motion_lab_core::num::wrap;
use motion_lab_core::worlds::{Obstacle, ObstacleKind};

/// One change of one world's obstacles.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorldEvent {
    /// The tick before whose step the change applies, from 1; before the inputs to robots of the same tick.
    pub tick: u64,
    /// The name of the world.
    pub world: String,
    /// The change.
    pub change: WorldChange,
}

/// A change of a world's obstacles.
///
/// What would put an obstacle where a robot stands, touching included, is refused, and changes nothing. So is a change
/// of an obstacle that is not there. What is so already stays so.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum WorldChange {
    /// Close the door of this name.
    Close(String),
    /// Open the door of this name.
    Open(String),
    /// Take the obstacle of this name away.
    Remove(String),
    /// Put the obstacle of this name somewhere; one that was taken away comes back there.
    Move {
        /// The obstacle's name.
        name: String,
        /// The rigid motion from where it was at first to its new place: x, y, metres, and theta, radians. It turns
        /// about the world's origin, then shifts. `(0, 0, 0)` is where it was at first.
        to: (Quantized, Quantized, Quantized),
    },
    /// Put a new obstacle there: all points within a radius of the convex hull of some points.
    Add {
        /// The name: one that nothing else in the world has.
        name: String,
        /// The points, metres: one for a disc, two for a capsule or a segment.
        points: Vec<(Quantized, Quantized)>,
        /// The radius, metres.
        radius: Quantized,
    },
}

impl WorldChange {
    /// The name of the obstacle or the door.
    pub fn name(&self) -> &str {
        match self {
            WorldChange::Close(name) | WorldChange::Open(name) | WorldChange::Remove(name) => name,
            WorldChange::Move { name, .. } | WorldChange::Add { name, .. } => name,
        }
    }

    /// The obstacle that is added; `None` for another change.
    ///
    /// # Errors
    /// [`ShapeError`] for points and a radius that make no shape.
    pub fn added(&self) -> Option<Result<Obstacle, ShapeError>> {
        let WorldChange::Add { name, points, radius } = self else { return None };
        let piece = piece(points, radius.value());
        Some(piece.map(|piece| Obstacle::new(name, ObstacleKind::Solid, vec![piece])))
    }

    /// The rigid motion of a `Move`, its angle wrapped; `None` for another change.
    pub fn pose(&self) -> Option<Pose2> {
        let WorldChange::Move { to: (x, y, theta), .. } = self else { return None };
        Some(Pose2::new(x.value(), y.value(), wrap(theta.value())))
    }
}

/// All points within a radius of the convex hull of some points, with the pose of its frame.
fn piece(points: &[(Quantized, Quantized)], radius: f64) -> Result<(Pose2, Shape), ShapeError> {
    let points: Vec<Point2> = points.iter().map(|(x, y)| Point2::new(x.value(), y.value())).collect();
    match convex_hull(&points)[..] {
        [centre] => Ok((Pose2::new(centre.x, centre.y, 0.0), Shape::try_disc(radius)?)),
        _ => Ok((Pose2::IDENTITY, Shape::try_rounded(&points, radius)?)),
    }
}
