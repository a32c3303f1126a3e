//! `Collision` for a `Scene`: the four queries.

use super::motion::decide::verdict;
use super::motion::separation::SweptHull;
use super::motion::swept::{self, SWEEP};
use super::narrow::pair::touches;
use super::{Collision, ObstacleId, Scene, Witness};
use crate::geometry::{Footprint, Placed};

impl Collision for Scene {
    fn intersects(&self, footprint: &Footprint) -> bool {
        if !footprint.is_valid() {
            return true;
        }
        footprint.parts().iter().any(|part| {
            let mut hit = false;
            self.index.each_near(&part.placed().padded_bounds_of_valid(), 0.0, |piece| {
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
        self.distance_of_hull_within(hull, f64::INFINITY)
    }

    fn distance_of_hull_within(&self, hull: Placed, within: f64) -> f64 {
        if !hull.is_valid() {
            return 0.0;
        }
        self.nearest_piece(&hull, within).map_or(within, |(_, n)| n.dist)
    }

    fn clears(&self, from: &Placed, to: &Placed, reach: f64) -> bool {
        SweptHull::new(from, to).is_some_and(|way| way.clears(self, reach))
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
