//! The close-up of the nearest points.

use super::{Anatomy, Tab};
use motion_lab_core::geometry::{Aabb, Point2, Vector2};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::picture::Picture;

impl Anatomy {
    /// The surroundings of the witness, or of the point of contact, for an inset. They are a square about it, six
    /// distances wide, but at least a twelfth and at most a third of the world's shorter side. `None` in an empty scene
    /// and on the swept tab. The picture also holds items beyond its bounds; the viewer cuts them off.
    pub fn close_up(&self) -> Option<Picture> {
        if self.tab == Tab::Swept {
            return None;
        }
        let nearest = self.nearest().into_iter().next()?.witness;
        let middle = nearest.on_robot + (nearest.on_obstacle - nearest.on_robot) * 0.5;
        let Aabb { min, max } = self.world().bounds;
        let most = lesser(max.x - min.x, max.y - min.y) / 6.0;
        let half = greater(lesser(3.0 * nearest.dist, most), 0.25 * most);
        let reach = Vector2::new(half, half);
        let bounds = Aabb { min: Point2::from(middle.coords - reach), max: Point2::from(middle.coords + reach) };
        let overlay = self.overlay_in(bounds);
        let name = format!("{}, close up", overlay.name);
        Some(Picture { bounds, name, ..self.backdrop().with(overlay.items) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::WorldSource;
    use super::*;
    use motion_lab_core::configuration::{AnyConfiguration, T2};
    use motion_lab_core::picture::Drawing;
    use motion_lab_core::worlds::World;

    /// Side of the view, pixels, and the radius of a ring with its line.
    const SIDE: f64 = 208.0;
    const RING: f64 = 4.5;

    #[test]
    fn what_is_nearest_is_in_the_middle() {
        // the arm lies along the x axis: its second link is 0.1 m above the one box, its first 0.05 m below the other
        let world = "World(version: 1, name: \"bench\", bounds: (min: (-3, -3), max: (3, 3)), obstacles: [
            (name: \"far\", shape: Box(min: (1.4, -0.5), max: (1.6, -0.1))),
            (name: \"near\", shape: Box(min: (0.4, 0.05), max: (0.6, 0.5)))])";
        let world = World::parse("bench.ron", world).unwrap();
        let mut anatomy = Anatomy::default().with_tab(Tab::Distance).in_world(world, WorldSource::Unsaved);
        anatomy.set_q(AnyConfiguration::T2(T2::new(0.0, 0.0))).unwrap();
        let Aabb { min, max } = anatomy.close_up().unwrap().bounds;
        // six times 0.05 m is less than a twelfth of the world's 6 m
        assert!(min.x >= 0.4 - 0.25 - 1e-9 && max.x <= 0.6 + 0.25 + 1e-9, "{min} to {max}");
        assert!((0.5 * (min.y + max.y) - 0.025).abs() < 1e-9 && (max.y - min.y - 0.5).abs() < 1e-9, "{min} to {max}");
    }

    #[test]
    fn plates_keep_off_the_rings_and_off_what_is_measured() {
        for thick in [false, true] {
            let mut anatomy = Anatomy::default().with_tab(Tab::Witness);
            anatomy.set_thick_links(thick);
            let view = anatomy.close_up().unwrap();
            let scale = SIDE / (view.bounds.max.x - view.bounds.min.x);
            let pair = anatomy.nearest()[0].witness;
            let mut plates = 0;
            for item in view.items.iter().filter(|item| item.id.starts_with("witness/")) {
                let Drawing::Label { at, text, size_px, .. } = &item.drawing else { continue };
                plates += 1;
                let half = Vector2::new(0.3 * size_px * text.chars().count() as f64 + 3.0, 0.6 * size_px + 1.0);
                for k in 0..=10 {
                    let p = pair.on_robot + (pair.on_obstacle - pair.on_robot) * (f64::from(k) / 10.0);
                    let off = (p - at) * scale;
                    let room = if k % 10 == 0 { RING } else { 1.0 };
                    let is_clear = off.x.abs() > half.x + room || off.y.abs() > half.y + room;
                    // the names stand beside the ends, where the way between them may pass
                    assert!(is_clear || text.len() == 2 && k % 10 != 0, "{text} covers {k}/10 of it: {off}");
                }
            }
            // a way too short has no room for the names of its ends
            assert_eq!(plates, if thick { 1 } else { 3 });
        }
    }
}
