//! `OccupiedAreas`, the room that labels on a world have taken.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::geometry::{Aabb, Footprint, Point2, Pose2, Shape};
use motion_lab_core::worlds::{Obstacle, ObstacleKind};

/// Labels and leaders. Each scene has at least twice as many as the next one, so that adding one costs little.
#[derive(Default)]
pub(super) struct OccupiedAreas(Vec<(Vec<Shape>, Scene)>);

impl OccupiedAreas {
    /// Adds a label's shapes. Scenes are merged like binary digits (Bentley and Saxe, 1980), so n labels build in
    /// O(n log n).
    pub(super) fn add(&mut self, mut shapes: Vec<Shape>) {
        while let Some((last, _)) = self.0.pop_if(|(last, _)| last.len() < 2 * shapes.len()) {
            shapes.extend(last);
        }
        let bounds = Aabb::new(Point2::origin(), Point2::origin());
        let pieces = shapes.iter().map(|shape| (Pose2::IDENTITY, shape.clone())).collect();
        let scene = Scene::of_obstacles(bounds, [&Obstacle::new("labels", ObstacleKind::Solid, pieces)]);
        self.0.push((shapes, scene));
    }

    /// Whether the footprint overlaps or touches one of them.
    pub(super) fn intersects(&self, footprint: &Footprint) -> bool {
        self.0.iter().any(|(_, scene)| scene.intersects(footprint))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_added_is_in_the_way_and_few_scenes_hold_it() {
        let mut taken = OccupiedAreas::default();
        let at = |k: u32| f64::from(k) * 2.0;
        for k in 0..300 {
            let corner = |x: f64| Point2::new(at(k) + x, x);
            taken.add(vec![Shape::Rectangle { min: corner(0.0), max: corner(1.0) }]);
            assert!(taken.0.len() <= 9, "{} scenes", taken.0.len());
            assert!(taken.0.windows(2).all(|w| w[0].0.len() >= 2 * w[1].0.len()));
            for other in [0, k / 2, k] {
                assert!(taken.intersects(&Footprint::disc(Point2::new(at(other) + 0.5, 0.5), 0.1)), "{other} of {k}");
            }
            assert!(!taken.intersects(&Footprint::disc(Point2::new(at(k + 1) + 0.5, 0.5), 0.1)));
        }
    }
}
