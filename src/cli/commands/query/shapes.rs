//! `ObstacleShapes`, the shapes of a world's obstacles as JSON, for programs that check a proof.

use motion_lab_core::collision::{ObstacleId, Scene};
use motion_lab_core::geometry::Placed;
use motion_lab_sim::export::JsonNumber;
use serde::Serialize;

use super::answer::{name, point};

/// The shapes of a world's obstacles.
#[derive(Debug, Serialize)]
pub struct ObstacleShapes {
    name: String,
    /// The least and the greatest corner of the world, where a proof is about paths within it.
    #[serde(skip_serializing_if = "Option::is_none")]
    bounds: Option<[[JsonNumber; 2]; 2]>,
    obstacles: Vec<ShapeEntry>,
}

/// A placed shape: all points within the radius of the convex hull of the core's points, in world coordinates. A disc
/// has one core point, a segment or a capsule two.
#[derive(Debug, Serialize)]
struct ShapeEntry {
    /// The number of its obstacle in the world, from 0, where a proof names obstacles by it.
    #[serde(skip_serializing_if = "Option::is_none")]
    obstacle: Option<u32>,
    /// The name of its obstacle, which may have other pieces.
    name: String,
    core: Vec<[JsonNumber; 2]>,
    radius: JsonNumber,
}

impl ObstacleShapes {
    /// All shapes of a world of this name.
    pub fn all(world: &str, scene: &Scene) -> ObstacleShapes {
        let entry = |(id, piece)| ShapeEntry::new(scene, id, piece);
        ObstacleShapes { name: world.to_owned(), bounds: None, obstacles: scene.pieces().map(entry).collect() }
    }

    /// The world's bounds, and the shapes of these obstacles of it with their numbers.
    pub fn numbered(world: &str, scene: &Scene, is_named: impl Fn(ObstacleId) -> bool) -> ObstacleShapes {
        let bounds = scene.bounds();
        let pieces = scene.pieces().filter(|(id, _)| is_named(*id));
        let entry =
            |(id, piece): (ObstacleId, _)| ShapeEntry { obstacle: Some(id.0), ..ShapeEntry::new(scene, id, piece) };
        ObstacleShapes {
            name: world.to_owned(),
            bounds: Some([point(bounds.min), point(bounds.max)]),
            obstacles: pieces.map(entry).collect(),
        }
    }
}

impl ShapeEntry {
    fn new(scene: &Scene, id: ObstacleId, piece: &Placed) -> Self {
        ShapeEntry {
            obstacle: None,
            name: name(scene, id).unwrap_or_default(),
            core: piece.core().iter().copied().map(point).collect(),
            radius: JsonNumber(piece.radius()),
        }
    }
}
