//! A close view of the nearest points.

use super::{Anatomy, Tab};
use crate::geometry::{Point2, Vector2};
use crate::num::{greater, lesser};
use crate::picture::Picture;
use crate::worlds::Bounds;

impl Anatomy {
    /// What is near the witness, or the point of contact, for an inset: a square about it, six distances wide but never more
    /// than a third of the world. `None` in an empty scene, and on the swept tab. What lies beyond its bounds is on it too,
    /// to be cut off by whoever shows it.
    pub fn close_up(&self) -> Option<Picture> {
        if self.tab == Tab::Swept {
            return None;
        }
        let nearest = self.nearest().into_iter().next()?.witness;
        let middle = nearest.on_robot + (nearest.on_obstacle - nearest.on_robot) * 0.5;
        let Bounds { min, max } = self.world().bounds;
        let most = lesser(max.x - min.x, max.y - min.y) / 6.0;
        let half = greater(lesser(3.0 * nearest.dist, most), 0.25 * most);
        let reach = Vector2::new(half, half);
        let bounds = Bounds { min: Point2::from(middle.coords - reach), max: Point2::from(middle.coords + reach) };
        let overlay = self.overlay_in(bounds);
        let name = format!("{}, close up", overlay.name);
        Some(Picture { bounds, name, ..self.backdrop().with(overlay.items) })
    }
}
