//! The four questions put to a scene.

use super::clear_way::Way;
use super::closed::verdict;
use super::narrow::{self, Nearest, nearest, nearest_within};
use super::swept::{self, SWEEP};
use super::{Collision, ObstacleId, Scene, Witness};
use crate::geometry::{Footprint, Placed};

impl Collision for Scene {
    fn intersects(&self, footprint: &Footprint) -> bool {
        if !footprint.is_valid() {
            return true;
        }
        footprint.parts().iter().any(|part| {
            let mut hit = false;
            self.each_within(part.placed(), 0.0, |piece| {
                hit = touches(part.placed(), &self.pieces[piece]);
                hit
            });
            hit
        })
    }

    fn distance(&self, footprint: &Footprint) -> f64 {
        if !footprint.is_valid() {
            return 0.0;
        }
        let mut least = f64::INFINITY;
        for part in footprint.parts() {
            least = self.nearest_piece(part.placed(), least).map_or(least, |(_, n)| n.dist);
            if least == 0.0 {
                break;
            }
        }
        least
    }

    fn distance_of_hull(&self, hull: Placed) -> f64 {
        if !hull.is_valid() {
            return 0.0;
        }
        self.nearest_piece(&hull, f64::INFINITY).map_or(f64::INFINITY, |(_, n)| n.dist)
    }

    fn clears(&self, from: &Placed, to: &Placed, reach: f64) -> bool {
        Way::new(from, to).is_some_and(|way| way.clears(self, reach))
    }

    fn witness(&self, footprint: &Footprint) -> Option<Witness> {
        if !footprint.is_valid() {
            return None;
        }
        let mut best: Option<Witness> = None;
        for (part, shape) in footprint.parts().iter().map(|p| p.placed()).enumerate() {
            let within = best.map_or(f64::INFINITY, |w| w.dist);
            if let Some((piece, n)) = self.nearest_piece(shape, within) {
                let obstacle = ObstacleId(self.owners[piece]);
                best = Some(Witness { on_robot: n.on_a, on_obstacle: n.on_b, dist: n.dist, part, obstacle });
            }
        }
        best
    }

    fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
        swept::hits(self, a, b, |motion| verdict(self, motion, SWEEP.budget, None))
    }
}

/// The nearest points of a part and a piece; contact when the piece is not a valid shape.
pub(super) fn pair(part: &Placed, piece: &Placed) -> Nearest {
    if piece.is_valid() { nearest(part, piece) } else { contact_at(part) }
}

/// As [`pair`]; `None` only where the distance is greater than `limit`.
pub(super) fn pair_within(part: &Placed, piece: &Placed, limit: f64) -> Option<Nearest> {
    if piece.is_valid() { nearest_within(part, piece, limit) } else { Some(contact_at(part)) }
}

fn contact_at(part: &Placed) -> Nearest {
    let point = part.core()[0];
    Nearest { dist: 0.0, on_a: point, on_b: point }
}

/// Whether two shapes touch; true when either is not valid.
pub(crate) fn touch(a: &Placed, b: &Placed) -> bool {
    !a.is_valid() || touches(a, b)
}

/// Whether a valid part touches a piece; true when the piece is not a valid shape.
pub(super) fn touches(part: &Placed, piece: &Placed) -> bool {
    !piece.is_valid() || narrow::touch(part, piece)
}
