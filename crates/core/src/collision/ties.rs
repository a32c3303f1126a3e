//! Tied witnesses: all that is nearest, not only the first.

use super::narrow::pair::pair;
use super::{Collision, ObstacleId, Scene, Witness};
use crate::geometry::Footprint;
use crate::num::{greater, ulp};

impl Scene {
    /// The nearest points of every part and obstacle whose distance exceeds the footprint's by at most `slack` metres:
    /// where more than one comes back, the footprint stands between obstacles, and the clearance has no gradient.
    ///
    /// One witness for each such part and obstacle, by part and then in file order; a corner that two obstacles share
    /// counts for both. On contact those that touch, and those within `slack`. Empty in an empty scene and for a
    /// footprint that is not finite. A slack that is negative or NaN counts as 0.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// let walls = [-1.0, 1.0].map(|y| Segment::new(Point2::new(-5.0, y), Point2::new(5.0, y)));
    /// let between = Footprint::disc(Point2::origin(), 0.1);
    /// assert_eq!(Scene::of_walls(&walls).witnesses(&between, 1e-9).len(), 2);
    /// ```
    pub fn witnesses(&self, footprint: &Footprint, slack: f64) -> Vec<Witness> {
        let Some(first) = self.witness(footprint) else { return Vec::new() };
        let reach = first.dist + greater(slack, 0.0);
        let mut ties: Vec<Witness> = Vec::new();
        for (part, shape) in footprint.parts().iter().map(|part| part.placed()).enumerate() {
            // of an obstacle's pieces at the same distance the first found counts
            let whole = self.whole();
            whole.index.each_near(&shape.padded_bounds(), reach + ulp(reach), |number| {
                let piece = whole.piece(number);
                let (near, obstacle) = (pair(shape, &self.pieces[piece]), ObstacleId(self.owners[piece]));
                let found = Witness { on_robot: near.on_a, on_obstacle: near.on_b, dist: near.dist, part, obstacle };
                match ties.iter_mut().find(|tie| tie.part == part && tie.obstacle == obstacle) {
                    Some(known) if known.dist <= near.dist => {}
                    Some(known) => *known = found,
                    None if near.dist <= reach => ties.push(found),
                    None => {}
                }
                false
            });
        }
        ties.sort_by_key(|tie| (tie.part, tie.obstacle));
        ties
    }
}
