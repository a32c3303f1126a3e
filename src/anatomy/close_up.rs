//! The close-up of the nearest points.

use super::{Anatomy, Tab};
use crate::geometry::{Aabb, Point2, Vector2};
use crate::num::{greater, lesser};
use crate::picture::Picture;

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
