//! The first contact and the clearance of simple motions among all pieces of a scene, by the closed forms of one pair.

use super::time_of_impact;
use crate::collision::Scene;
use crate::geometry::{Aabb, CircularArc, Footprint, Placed};
use crate::num::lesser;

/// The time of impact of a footprint that moves from `start` to `end` without turning, as a fraction of the motion;
/// rounded. `None` where it touches nothing.
pub(crate) fn translation_meets(scene: &Scene, start: &Footprint, end: &Footprint) -> Option<f64> {
    let mut first: Option<f64> = None;
    for (a, b) in start.parts().iter().zip(end.parts()) {
        let (a, b) = (a.placed(), b.placed());
        let v = b.core()[0] - a.core()[0];
        scene.index.each_near(&a.padded_bounds().merged(&b.padded_bounds()), 0.0, |piece| {
            if let Some(s) = time_of_impact::translation_meets(a, v, &scene.pieces[piece]) {
                first = Some(first.map_or(s, |f| lesser(s, f)));
            }
            false
        });
    }
    first
}

/// The time of impact of a disc of this radius whose centre runs along the arc, as the arc's parameter; rounded. `None`
/// where it touches nothing.
pub(crate) fn arc_meets(scene: &Scene, arc: &CircularArc, radius: f64) -> Option<f64> {
    let mut first: Option<f64> = None;
    scene.index.each_near(&arc_box(arc, radius), 0.0, |piece| {
        let piece = &scene.pieces[piece];
        if let Some(s) = time_of_impact::arc_meets(arc, piece.core(), radius + piece.radius()) {
            first = Some(first.map_or(s, |f| lesser(s, f)));
        }
        false
    });
    first
}

/// The least clearance of a disc of this radius whose centre runs along the arc as far as `until`, metres; rounded. It
/// is not positive in contact, and infinity in an empty scene.
pub(crate) fn arc_clearance(scene: &Scene, arc: &CircularArc, until: f64, radius: f64) -> f64 {
    let mut least = f64::INFINITY;
    scene.index.nearest(&arc_box(arc, 0.0), least, |piece| {
        let piece = &scene.pieces[piece];
        least = lesser(time_of_impact::arc_distance(arc, until, piece.core()) - piece.radius(), least);
        least
    });
    least - radius
}

/// A box around all that a disc of this radius touches along the arc: no point of the arc is farther than half the
/// arc's length from one of its ends.
fn arc_box(arc: &CircularArc, radius: f64) -> Aabb {
    let grown = radius + lesser(0.5 * arc.length(), 2.0 * arc.radius);
    let ends = [arc.at(0.0), arc.at(1.0)].map(|p| Placed::new([p], grown));
    ends[0].padded_bounds().merged(&ends[1].padded_bounds())
}
