//! `Vicinity`, the part of a scene that a motion can come near.

use smallvec::SmallVec;

use super::answers::touches;
use super::extent::{Extent, square};
use super::narrow::Nearest;
use super::{Collision, Scene, Witness};
use crate::geometry::{Footprint, Placed};

/// At most so many pieces are taken out of a scene.
const MOST: usize = 32;

/// The pieces of a scene within a range of where a motion goes. Asked about places of that motion it answers as the scene does; only what
/// is farther off than the range it has to ask the scene about.
pub(super) struct Vicinity<'a> {
    scene: &'a Scene,
    range: f64,
    pieces: SmallVec<[(Extent, u32); MOST]>,
}

impl<'a> Vicinity<'a> {
    /// What is within `range` metres of a box; `None` where that is too much to be worth it.
    pub(super) fn new(scene: &'a Scene, within: &Extent, range: f64) -> Option<Self> {
        let mut pieces = SmallVec::new();
        let mut fits = true;
        scene.index.each_near(within, range, |piece| {
            fits = pieces.len() < MOST;
            if fits {
                pieces.push((Extent::of(&scene.pieces[piece]), piece as u32));
            }
            !fits
        });
        fits.then_some(Vicinity { scene, range, pieces })
    }

    fn nearest(&self, shape: &Placed, within: f64) -> Option<(usize, Nearest)> {
        let mut search = self.scene.search(shape, within);
        let from = search.extent();
        let mut squares = [f64::INFINITY; MOST];
        let (mut first, mut nearest) = (0, f64::INFINITY);
        for (i, ((extent, _), distance)) in self.pieces.iter().zip(&mut squares).enumerate() {
            *distance = from.squared_distance(extent);
            if *distance < nearest {
                (first, nearest) = (i, *distance);
            }
        }
        if nearest > square(within) || self.pieces.is_empty() {
            return None;
        }
        let mut least = square(search.look(self.pieces[first].1 as usize));
        for (i, ((_, piece), distance)) in self.pieces.iter().zip(&squares).enumerate() {
            if *distance <= least && i != first {
                least = square(search.look(*piece as usize));
            }
        }
        search.found()
    }
}

impl Collision for Vicinity<'_> {
    fn intersects(&self, footprint: &Footprint) -> bool {
        !footprint.is_valid()
            || footprint.parts().iter().any(|part| {
                self.pieces.iter().any(|(_, piece)| touches(part.placed(), &self.scene.pieces[*piece as usize]))
            })
    }

    fn distance(&self, footprint: &Footprint) -> f64 {
        if !footprint.is_valid() {
            return 0.0;
        }
        let parts = footprint.parts().iter();
        let least =
            parts.fold(self.range, |least, part| self.nearest(part.placed(), least).map_or(least, |(_, n)| n.dist));
        if least < self.range { least } else { self.scene.distance(footprint) }
    }

    fn distance_of_hull(&self, hull: Placed) -> f64 {
        if !hull.is_valid() {
            return 0.0;
        }
        self.nearest(&hull, self.range).map_or_else(|| self.scene.distance_of_hull(hull), |(_, n)| n.dist)
    }

    fn witness(&self, footprint: &Footprint) -> Option<Witness> {
        self.scene.witness(footprint)
    }

    fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
        self.scene.swept(a, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point2, Segment};
    use crate::random::{Seed, Stream};

    #[test]
    fn a_vicinity_answers_as_the_scene_does() {
        let scene = Scene::apartment();
        let mut draws = Stream::new(Seed(2), "vicinity");
        let mut beyond = 0;
        for _ in 0..300 {
            let mut at = |reach: f64| Point2::new(draws.uniform(3.0, 3.0 + reach), draws.uniform(2.0, 2.0 + reach));
            let within = Extent { min: Point2::new(3.0, 2.0), max: Point2::new(5.0, 4.0) };
            let vicinity = Vicinity::new(&scene, &within, 0.25).unwrap();
            let hull = Placed::new(smallvec::smallvec![at(2.0), at(2.0)], 0.05);
            let footprint = Footprint::of_hull(hull.clone());
            let distance = scene.distance(&footprint);
            assert_eq!(vicinity.distance(&footprint), distance);
            assert_eq!(vicinity.distance_of_hull(hull), distance);
            assert_eq!(vicinity.intersects(&footprint), distance == 0.0);
            beyond += usize::from(distance > 0.25);
        }
        assert!(beyond > 10 && beyond < 290, "{beyond} beyond the range");
        let wall = |k: u32| Segment::new(Point2::new(f64::from(k), 0.0), Point2::new(f64::from(k), 1.0));
        let walls: Vec<Segment> = (0..=MOST as u32).map(wall).collect();
        let all = Extent { min: Point2::origin(), max: Point2::new(99.0, 1.0) };
        assert!(Vicinity::new(&Scene::of_walls(&walls), &all, 1.0).is_none(), "too much to be worth it");
        assert!(Vicinity::new(&Scene::of_walls(&walls[1..]), &all, 1.0).is_some());
    }
}
