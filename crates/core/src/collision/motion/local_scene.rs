//! `Vicinity`, the part of a scene that a motion can come near.

use smallvec::SmallVec;

use super::separation::SweptHull;
use crate::collision::Scene;
use crate::collision::narrow::core_lanes::LaneRoom;
use crate::collision::narrow::nearest::NearestSearch;
use crate::collision::narrow::pair::touches;
use crate::geometry::{Aabb, Placed, square};
use crate::num::lesser;

/// Largest number of pieces in a vicinity; with more it queries the scene.
const MAX_PIECES: usize = 64;

/// The pieces of a scene within a range of where a motion goes. For shapes along the motion it answers as the scene
/// does. It queries the scene only beyond the range, or where the pieces are too many to be worth collecting.
pub(crate) struct Vicinity<'a> {
    scene: &'a Scene,
    range: f64,
    pieces: Option<SmallVec<[(Aabb, u32); MAX_PIECES]>>,
}

impl<'a> Vicinity<'a> {
    pub(crate) fn all(scene: &'a Scene) -> Self {
        Vicinity { scene, range: 0.0, pieces: None }
    }

    /// The pieces whose boxes are within `range` metres of a box.
    pub(crate) fn new(scene: &'a Scene, within: &Aabb, range: f64) -> Self {
        let mut pieces = SmallVec::new();
        let mut fits = true;
        scene.index.each_near(within, range, |piece| {
            fits = pieces.len() < MAX_PIECES;
            if fits {
                pieces.push((scene.pieces[piece].padded_bounds(), piece as u32));
            }
            !fits
        });
        Vicinity { scene, range, pieces: fits.then_some(pieces) }
    }

    /// The distance beyond which it has to query the scene, metres; infinity where it queries the scene for everything.
    pub(crate) fn range(&self) -> f64 {
        if self.pieces.is_some() { self.range } else { f64::INFINITY }
    }

    /// The distance of a valid shape along the motion from the nearest piece, metres, if it is less than `within`.
    /// Stops once a distance of at most `enough` is found, and returns that one.
    pub(crate) fn distance(&self, shape: &Placed, enough: f64, within: f64) -> Option<f64> {
        let Some(pieces) = &self.pieces else { return self.in_scene(shape, enough, within) };
        let near = self.among(pieces, shape, enough, lesser(within, self.range));
        if near.is_some() || within <= self.range { near } else { self.in_scene(shape, enough, within) }
    }

    /// A conservative separation test of two places along the motion and all between them: true only if everything is
    /// farther off than `reach` metres. `false` is inconclusive.
    pub(crate) fn clears(&self, [from, to]: [&Placed; 2], reach: f64) -> bool {
        let Some(hull) = SweptHull::new(from, to) else { return false };
        match &self.pieces {
            // what is not among the pieces is farther off than the range
            Some(pieces) if reach < self.range => {
                let pieces = pieces.iter().map(|(extent, piece)| (extent, &self.scene.pieces[*piece as usize]));
                hull.clears_of(pieces, reach, self.scene.size)
            }
            _ => hull.clears(self.scene, reach),
        }
    }

    /// As [`distance`](Self::distance), among all pieces of the scene.
    fn in_scene(&self, shape: &Placed, enough: f64, within: f64) -> Option<f64> {
        let mut room = LaneRoom::EMPTY;
        let mut look = DistanceSearch::new(self.scene, shape, enough, within, &mut room);
        let from = look.extent();
        self.scene.index.nearest(&from, within, |piece| look.at(piece));
        look.found()
    }

    /// As [`distance`](Self::distance), among these pieces alone.
    fn among(&self, pieces: &[(Aabb, u32)], shape: &Placed, enough: f64, within: f64) -> Option<f64> {
        let mut room = LaneRoom::EMPTY;
        let mut look = DistanceSearch::new(self.scene, shape, enough, within, &mut room);
        let from = look.extent();
        let mut squares = [f64::INFINITY; MAX_PIECES];
        let (mut first, mut nearest) = (0, f64::INFINITY);
        for (i, ((extent, _), distance)) in pieces.iter().zip(&mut squares).enumerate() {
            *distance = from.squared_distance(extent);
            if *distance < nearest {
                (first, nearest) = (i, *distance);
            }
        }
        if nearest > square(within) || pieces.is_empty() {
            return None;
        }
        let mut least = square(look.at(pieces[first].1 as usize));
        for (i, ((_, piece), distance)) in pieces.iter().zip(&squares).enumerate() {
            if *distance <= least && i != first {
                least = square(look.at(*piece as usize));
            }
        }
        look.found()
    }

    /// Whether a valid shape along the motion touches a piece.
    pub(crate) fn touches(&self, shape: &Placed) -> bool {
        let from = shape.padded_bounds();
        let touched = |piece: usize| touches(shape, &self.scene.pieces[piece]);
        match &self.pieces {
            Some(pieces) => pieces.iter().any(|(e, piece)| from.squared_distance(e) == 0.0 && touched(*piece as usize)),
            None => {
                let mut found = false;
                self.scene.each_within(shape, 0.0, |piece| {
                    found = touched(piece);
                    found
                });
                found
            }
        }
    }
}

/// A search for the distance alone, which stops once a distance of at most `enough` is found.
struct DistanceSearch<'a> {
    search: NearestSearch<'a>,
    room: &'a mut LaneRoom,
    within: f64,
    enough: f64,
    /// The distance found that is at most `enough`, metres.
    near: Option<f64>,
}

impl<'a> DistanceSearch<'a> {
    fn new(scene: &'a Scene, shape: &'a Placed, enough: f64, within: f64, room: &'a mut LaneRoom) -> Self {
        DistanceSearch { search: scene.search(shape, within), room, within, enough, near: None }
    }

    fn extent(&self) -> Aabb {
        self.search.extent()
    }

    /// Measures a piece and returns the least distance so far. Returns 0 once that is at most `enough`, so that hardly
    /// any other piece is measured.
    fn at(&mut self, piece: usize) -> f64 {
        if self.near.is_some() {
            return 0.0;
        }
        let least = self.search.look_for_distance(piece, self.room);
        if least <= self.enough && least < self.within {
            self.near = Some(least);
            return 0.0;
        }
        least
    }

    fn found(self) -> Option<f64> {
        self.near.or_else(|| self.search.found().map(|(_, n)| n.dist))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Collision;
    use crate::geometry::{Footprint, Point2, Segment};
    use crate::random::{Seed, Stream};

    #[test]
    fn a_vicinity_answers_as_the_scene_does() {
        let scene = Scene::apartment();
        let mut draws = Stream::new(Seed(2), "vicinity");
        let (mut beyond, mut kept, mut missed) = (0, [0; 2], 0);
        for _ in 0..300 {
            let mut at = |reach: f64| Point2::new(draws.uniform(3.0, 3.0 + reach), draws.uniform(2.0, 2.0 + reach));
            let way = Aabb { min: Point2::new(3.0, 2.0), max: Point2::new(5.0, 4.0) };
            let vicinity = Vicinity::new(&scene, &way, 0.25);
            assert!(vicinity.pieces.is_some());
            let hull = Placed::new([at(2.0), at(2.0)], 0.05);
            let distance = scene.distance(&Footprint::of_hull(hull.clone()));
            for within in [0.1, 0.25, 0.5, f64::INFINITY] {
                let expected = (distance < within).then_some(distance);
                for vicinity in [&vicinity, &Vicinity::all(&scene)] {
                    assert_eq!(vicinity.distance(&hull, 0.0, within), expected, "{distance} within {within}");
                    let near = vicinity.distance(&hull, 0.2, within);
                    assert!(near == expected || near.is_some_and(|n| n <= 0.2 && distance <= n), "{near:?} {distance}");
                }
            }
            // between two places; what lies beyond the range counts too
            let to = Placed::new([at(2.0), at(2.0)], 0.05);
            let swept = scene.distance_of_hull(hull.hull_with(&to));
            for reach in [0.05, 0.2, 0.4, 0.8] {
                let clears = vicinity.clears([&hull, &to], reach);
                assert!(!clears || swept > reach, "{swept} is not farther than {reach}");
                kept[usize::from(reach > 0.25)] += usize::from(clears);
                missed += usize::from(!clears && swept > 1.1 * reach + 0.01);
            }
            assert_eq!(vicinity.touches(&hull), distance == 0.0);
            assert_eq!(Vicinity::all(&scene).touches(&hull), distance == 0.0);
            beyond += usize::from(distance > 0.25);
        }
        assert!(beyond > 10 && beyond < 290, "{beyond} beyond the range");
        assert!(kept[0] > 30 && kept[1] > 0 && missed < 10, "{kept:?} kept, {missed} missed");
        let wall = |k: u32| Segment::new(Point2::new(f64::from(k), 0.0), Point2::new(f64::from(k), 1.0));
        let walls: Vec<Segment> = (0..=MAX_PIECES as u32).map(wall).collect();
        let all = Aabb { min: Point2::origin(), max: Point2::new(99.0, 1.0) };
        assert!(Vicinity::new(&Scene::of_walls(&walls), &all, 1.0).pieces.is_none(), "too much to be worth it");
        assert!(Vicinity::new(&Scene::of_walls(&walls[1..]), &all, 1.0).pieces.is_some());
    }

    #[test]
    fn what_lies_beyond_the_range_is_parted_in_the_scene() {
        let wall = Scene::of_walls(&[Segment::new(Point2::new(5.5, 2.0), Point2::new(5.5, 4.0))]);
        let way = Aabb { min: Point2::new(3.0, 2.0), max: Point2::new(5.0, 4.0) };
        let vicinity = Vicinity::new(&wall, &way, 0.25);
        assert!(vicinity.pieces.as_ref().is_some_and(|pieces| pieces.is_empty()));
        let [near, far] = [5.0, 3.0].map(|x| Placed::new([Point2::new(x, 2.5), Point2::new(x, 3.5)], 0.0));
        // the wall is half a metre off
        let clears = [0.2, 0.4, 0.6].map(|reach| vicinity.clears([&far, &near], reach));
        assert_eq!(clears, [true, true, false]);
        assert!(!vicinity.clears([&far, &near], f64::NAN));
    }
}
