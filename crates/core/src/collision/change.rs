//! `Scene`, changed: obstacles put in and taken out one after another.

use std::iter::repeat_n;
use std::sync::Arc;

use super::boundary::scene_boundary::SceneBoundary;
use super::broad::frames::Frames;
use super::broad::index::Index;
use super::layers::{WholeIndex, WholeView};
use super::scene::{GONE, SceneObstacle};
use super::{ObstacleId, Scene};
use crate::geometry::{Aabb, Placed, largest_coordinate};
use crate::num::greater;
use crate::worlds::Obstacle;

impl Scene {
    /// Puts an obstacle into the scene, before the one with this id or, where there is none, behind all others. The ids
    /// from there on are one higher then.
    ///
    /// Every answer is that of a scene made of the same obstacles in the same order, to the last bit. An obstacle of a
    /// large scene takes the time of a logarithm of their number, in the mean of many; a small scene is made anew.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// use motion_lab_core::collision::ObstacleId;
    /// let mut scene = Scene::apartment();
    /// let obstacles = World::apartment().obstacles;
    /// scene.remove_obstacle(ObstacleId(0));
    /// assert_eq!(scene.obstacle_name(ObstacleId(0)), Some(obstacles[1].name.as_str()));
    /// scene.insert_obstacle(ObstacleId(0), &obstacles[0]);
    /// assert_eq!(scene.obstacle_name(ObstacleId(0)), Some(obstacles[0].name.as_str()));
    /// ```
    pub fn insert_obstacle(&mut self, before: ObstacleId, obstacle: &Obstacle) {
        let (first, placed) = (self.pieces.len(), obstacle.placed().collect());
        self.list(before.0 as usize, obstacle.name.as_str().into(), placed);
        if !self.adds_layer(first) {
            *self = self.made_of(Placed::clone);
        }
    }

    /// Takes an obstacle out of the scene. The ids after it are one lower then. Without such an obstacle nothing
    /// happens.
    ///
    /// What it takes, and what answers are then, is as with [`insert_obstacle`](Self::insert_obstacle).
    pub fn remove_obstacle(&mut self, id: ObstacleId) {
        let number = id.0 as usize;
        if number >= self.obstacles.len() {
            return;
        }
        let obstacle = self.obstacles.remove(number);
        for later in &self.obstacles[number..] {
            self.owners[later.pieces()].iter_mut().for_each(|owner| *owner -= 1);
        }
        self.owners[obstacle.pieces()].fill(GONE);
        if !self.drops(&obstacle) {
            *self = self.made_of(Placed::clone);
        }
    }

    /// Adds an obstacle to the lists, with its pieces behind all others.
    pub(super) fn list(&mut self, number: usize, name: Arc<str>, placed: Vec<Placed>) {
        let number = number.min(self.obstacles.len());
        let (first, count) = (self.pieces.len() as u32, placed.len() as u32);
        for later in &self.obstacles[number..] {
            self.owners[later.pieces()].iter_mut().for_each(|owner| *owner += 1);
        }
        self.obstacles.insert(number, SceneObstacle { name, first, count });
        self.owners.extend(repeat_n(number as u32, placed.len()));
        self.pieces.extend(placed);
    }

    /// Makes a layer of the pieces from a number on, which are listed already. False where the scene has to be made
    /// anew: where that takes no longer, where it would have other parts, and where the layer would take in everything.
    fn adds_layer(&mut self, first: usize) -> bool {
        if first == self.pieces.len() {
            return true;
        }
        let size = largest_coordinate(&self.pieces[first..]);
        let (Some(outlines), None) = (&mut self.outlines, &self.frames) else { return false };
        if !self.pieces[first..].iter().all(|piece| piece.is_valid() && outlines.add(piece, size)) {
            return false;
        }
        self.size = greater(size, self.size);
        let layers = self.layers.get_or_insert_default();
        let Some(from) = layers.first_of_layer(first, self.pieces.len()) else { return false };
        layers.note_change(0);
        let there = (from..).zip(&self.pieces[from..]).filter(|(piece, _)| self.owners[*piece] != GONE);
        layers.put_from(from, SceneBoundary::without_lists(there.map(|(_, piece)| piece)));
        let extents: Vec<Aabb> = self.pieces[from..].iter().map(Placed::padded_bounds_of_valid).collect();
        self.index.put_from(from, &extents);
        true
    }

    /// Takes the pieces of an obstacle out of their layers. False where the scene has to be made anew: as above, and
    /// where more pieces are gone than are there.
    fn drops(&mut self, obstacle: &SceneObstacle) -> bool {
        if self.outlines.is_none() || self.frames.is_some() {
            return false;
        }
        let layers = self.layers.get_or_insert_default();
        layers.note_change(obstacle.count as usize);
        let there = self.pieces.len() - layers.gone();
        if layers.gone() > there || Frames::fits(there) {
            return false;
        }
        for number in obstacle.pieces() {
            let piece = &self.pieces[number];
            self.index.forget(number);
            let boundary = layers.boundary_of(number).unwrap_or(&mut self.boundary);
            if !boundary.forget(piece) {
                return false;
            }
        }
        if largest_coordinate(&self.pieces[obstacle.pieces()]) == self.size {
            self.size = largest_coordinate(self.pieces().map(|(_, piece)| piece));
        }
        true
    }

    /// The index of the scene made whole.
    pub(super) fn whole(&self) -> WholeView<'_> {
        let Some(layers) = &self.layers else { return WholeView::of_unchanged(&self.index) };
        layers.whole(|| {
            let pieces: Vec<u32> = self.obstacles.iter().flat_map(|own| own.first..own.first + own.count).collect();
            let extents: Vec<Aabb> = pieces.iter().map(|piece| self.pieces[*piece as usize].padded_bounds()).collect();
            WholeIndex { index: Index::new(&extents), pieces }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point2, Pose2, Shape};
    use crate::worlds::ObstacleKind;

    fn disc(x: u32, y: f64) -> Obstacle {
        let piece = (Pose2::new(f64::from(x), y, 0.0), Shape::Disc { radius: 0.25 });
        Obstacle::new("disc", ObstacleKind::Solid, vec![piece])
    }

    fn scene() -> Scene {
        let bounds = Aabb::new(Point2::origin(), Point2::new(9.0, 9.0));
        Scene::of_obstacles(bounds, &(0..100).map(|x| disc(x, 0.0)).collect::<Vec<_>>())
    }

    fn layer_count(scene: &Scene) -> usize {
        scene.layers.as_ref().map_or(0, |layers| layers.boundaries().len())
    }

    #[test]
    fn layers_are_as_few_as_the_digits_of_their_pieces_number() {
        let (mut scene, mut most) = (scene(), 0);
        for k in 0..5000 {
            scene.insert_obstacle(ObstacleId(k % 7), &disc(k, 1.0));
            most = most.max(layer_count(&scene));
            // each layer but the last has 64 pieces or more, and twice those of the next
            assert!((100 + k) >> layer_count(&scene).saturating_sub(2) >= 64, "{} of {k}", layer_count(&scene));
        }
        assert!(most > 3, "{most}");
    }

    #[test]
    fn what_is_gone_is_forgotten_before_it_is_more_than_what_is_there() {
        let (mut scene, mut most) = (scene(), 0);
        for k in 0..1000 {
            scene.remove_obstacle(ObstacleId(k % 100));
            scene.insert_obstacle(ObstacleId(k % 100), &disc(k, 1.0));
            most = most.max(scene.pieces.len());
            assert!(scene.pieces.len() <= 202, "{}", scene.pieces.len());
        }
        assert!(most > 140, "{most}: each time everything was made anew");
        // what is only taken out
        let mut scene = self::scene();
        (0..900).for_each(|k| scene.insert_obstacle(ObstacleId(u32::MAX), &disc(k, 2.0)));
        for there in (0..1000).rev() {
            scene.remove_obstacle(ObstacleId(there / 2));
            assert!(scene.pieces.len() <= 2 * there as usize + 1, "{} for {there}", scene.pieces.len());
        }
    }

    #[test]
    fn the_first_piece_of_a_layer_is_taken_out_of_it() {
        let mut scene = scene();
        (0..3).for_each(|k| scene.insert_obstacle(ObstacleId(0), &disc(k, 2.0)));
        scene.remove_obstacle(ObstacleId(2));
        assert_eq!((layer_count(&scene), scene.pieces.len(), scene.owners[100]), (1, 103, GONE));
    }

    #[test]
    fn a_small_scene_is_made_anew() {
        let mut scene = scene();
        scene.remove_obstacle(ObstacleId(50));
        assert!(scene.frames.is_none() && scene.pieces.len() == 100);
        (0..35).for_each(|_| scene.remove_obstacle(ObstacleId(50)));
        assert!(scene.frames.is_some() && scene.layers.is_none() && scene.pieces.len() == 64);
        scene.insert_obstacle(ObstacleId(0), &disc(0, 5.0));
        assert!(scene.frames.is_none() && scene.layers.is_none() && scene.pieces.len() == 65);
    }
}
