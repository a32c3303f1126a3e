//! `Surroundings`, a scene and other robots' footprints in it.

use super::motion::conservative_advancement::march;
use super::motion::separation::SweptHull;
use super::motion::swept::{self, SWEEP};
use super::narrow::distance::{nearest, touch};
use super::{Collision, ObstacleId, Scene, Witness};
use crate::geometry::{Footprint, Part, Placed, largest_coordinate};

/// A scene together with further placed shapes: what one robot among several may not touch. Obstacle ids from the
/// scene's [`obstacle_count`](Scene::obstacle_count) on number the further shapes.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The other robots' parts.
    pub others: &'a [Placed],
}

impl Surroundings<'_> {
    /// The nearest of the further shapes: the witness, the lowest part and then the first shape on ties.
    fn nearest_other(&self, footprint: &Footprint) -> Option<Witness> {
        let mut best: Option<Witness> = None;
        for (part, shape) in footprint.parts().iter().enumerate() {
            for (i, other) in self.others.iter().enumerate() {
                let found = nearest(shape.placed(), other);
                if best.is_none_or(|w| found.dist < w.dist) {
                    let obstacle = ObstacleId((self.scene.obstacle_count() + i) as u32);
                    let (on_robot, on_obstacle) = (found.on_a, found.on_b);
                    best = Some(Witness { on_robot, on_obstacle, dist: found.dist, part, obstacle });
                }
            }
        }
        best
    }

    /// Whether the footprint and all further shapes are valid; if not, the answer is contact.
    fn decidable(&self, footprint: &Footprint) -> bool {
        footprint.is_valid() && self.others.iter().all(Placed::is_valid)
    }
}

impl Collision for Surroundings<'_> {
    fn intersects(&self, footprint: &Footprint) -> bool {
        let met = |part: &Part| self.others.iter().any(|other| touch(part.placed(), other));
        !self.decidable(footprint) || self.scene.intersects(footprint) || footprint.parts().iter().any(met)
    }

    fn distance(&self, footprint: &Footprint) -> f64 {
        if !self.decidable(footprint) {
            return 0.0;
        }
        let other = self.nearest_other(footprint).map_or(f64::INFINITY, |w| w.dist);
        crate::num::lesser(self.scene.distance(footprint), other)
    }

    fn distance_of_hull(&self, hull: Placed) -> f64 {
        self.distance_of_hull_within(hull, f64::INFINITY)
    }

    fn distance_of_hull_within(&self, hull: Placed, within: f64) -> f64 {
        if !hull.is_valid() || !self.others.iter().all(Placed::is_valid) {
            return 0.0;
        }
        let others = self.others.iter().map(|other| nearest(&hull, other).dist);
        let other = others.fold(within, |least, dist| crate::num::lesser(dist, least));
        crate::num::lesser(self.scene.distance_of_hull_within(hull, other), other)
    }

    fn clears(&self, from: &Placed, to: &Placed, reach: f64) -> bool {
        let passes =
            |way: &SweptHull, other| Placed::is_valid(other) && way.passes(other, reach, largest_coordinate([other]));
        SweptHull::new(from, to)
            .is_some_and(|way| way.clears(self.scene, reach) && self.others.iter().all(|other| passes(&way, other)))
    }

    fn witness(&self, footprint: &Footprint) -> Option<Witness> {
        if !self.decidable(footprint) {
            return None;
        }
        let (fixed, other) = (self.scene.witness(footprint), self.nearest_other(footprint));
        match (fixed, other) {
            (Some(f), Some(o)) => Some(if (o.dist, o.part) < (f.dist, f.part) { o } else { f }),
            (f, o) => f.or(o),
        }
    }

    fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
        swept::hits(self, a, b, |motion| march(self, motion, SWEEP, None))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Counted;
    use crate::geometry::Point2;
    use crate::random::{Seed, Stream};

    #[test]
    fn a_distance_within_a_limit_is_the_distance_or_no_less_than_the_limit() {
        let mut draws = Stream::new(Seed(8), "within");
        let scene = Scene::apartment();
        let (mut near, mut far) = (0, 0);
        for _ in 0..400 {
            let mut at = || Point2::new(draws.uniform(0.0, 12.0), draws.uniform(0.0, 8.0));
            let (hull, others) = (Placed::new([at(), at()], 0.05), [Placed::new([at()], 0.2)]);
            let surroundings = Surroundings { scene: &scene, others: &others };
            let counted = Counted::new(surroundings);
            for checker in [&scene as &dyn Collision, counted.inner(), &counted, &&counted] {
                let distance = checker.distance_of_hull(hull.clone());
                assert_eq!(distance, checker.distance(&Footprint::of_hull(hull.clone())));
                for within in [0.05, 0.5, distance, f64::INFINITY] {
                    let found = checker.distance_of_hull_within(hull.clone(), within);
                    let is_near = distance < within;
                    assert!(if is_near { found == distance } else { within <= found && found <= distance });
                    (near, far) = (near + u32::from(is_near), far + u32::from(!is_near));
                }
                assert_eq!(checker.distance_of_hull_within(Placed::new([], 0.1), 0.5), 0.0, "not valid");
            }
            assert_eq!(counted.counts().distance_of_hull, 2 * 6);
        }
        assert!(near > 1000 && far > 1000, "{near} {far}");
    }
}
