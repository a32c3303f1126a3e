//! `DiscSpace`, where the centre of a disc may be.

use std::f64::consts::TAU;

use crate::collision::Scene;
use crate::geometry::{Aabb, Placed, Point2, Vector2};
use crate::num::hypot;

use super::rim::{Rim, TOLERANCE};

/// Where the centre of a disc may be: at least a distance from each obstacle, within the bounds.
#[derive(Clone, Debug)]
pub(super) struct DiscSpace {
    /// The obstacles, larger by the distance less the tolerance.
    blocks: Scene,
    bounds: Aabb,
}

impl DiscSpace {
    pub(super) fn new(scene: &Scene, distance: f64) -> Self {
        DiscSpace { blocks: scene.grown(distance - TOLERANCE), bounds: scene.bounds().grown(TOLERANCE) }
    }

    /// The rims about the vertices of all obstacles, from left to right. Obstacles that share a vertex and a radius
    /// share its rim.
    pub(super) fn rims(&self) -> Vec<Rim> {
        let mut rims: Vec<Rim> = self.blocks.pieces().flat_map(|(_, piece)| Rim::about(piece)).collect();
        let key = |rim: &Rim| [rim.centre.x, rim.centre.y, rim.radius];
        rims.sort_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
        });
        rims.dedup_by(|b, a| {
            let same = key(a) == key(b);
            if same {
                a.sides.append(&mut b.sides);
            }
            same
        });
        rims
    }

    /// Whether the straight way from `a` to `b` keeps clear.
    pub(super) fn is_free(&self, a: Point2, b: Point2) -> bool {
        let line = if a == b { Placed::new([a], 0.0) } else { Placed::new([a, b], 0.0) };
        self.bounds.contains(a) && self.bounds.contains(b) && !self.blocks.holds(&line)
    }

    /// The intervals of bearings, radians within `[0, 2 pi]` and in order, in which a rim's circle is blocked.
    ///
    /// Where the circle meets the boundary of a grown obstacle or a side of the bounds, it may become blocked or free;
    /// between two such bearings it is what it is in the middle.
    pub(super) fn blocked(&self, rim: &Rim) -> Vec<[f64; 2]> {
        let mut cuts = vec![0.0, TAU];
        let mut cut = |bearing: f64| cuts.push(if bearing < 0.0 { bearing + TAU } else { bearing });
        for (at, normal) in [
            (self.bounds.min, Vector2::x()),
            (self.bounds.min, Vector2::y()),
            (self.bounds.max, Vector2::x()),
            (self.bounds.max, Vector2::y()),
        ] {
            rim.across(at, normal).into_iter().flatten().for_each(&mut cut);
        }
        for piece in self.blocks.pieces_near(&Placed::new([rim.centre], rim.radius)) {
            let (core, radius) = (piece.core(), piece.radius());
            for (i, &vertex) in core.iter().enumerate() {
                rim.on_circle(vertex, radius).into_iter().flatten().for_each(&mut cut);
                let side = core[(i + 1) % core.len()] - vertex;
                let length = hypot(side.x, side.y);
                if length > 0.0 {
                    let normal = Vector2::new(-side.y, side.x) / length;
                    for offset in [radius, -radius] {
                        rim.across(vertex + normal * offset, normal).into_iter().flatten().for_each(&mut cut);
                    }
                }
            }
        }
        cuts.sort_by(f64::total_cmp);
        let mut blocked: Vec<[f64; 2]> = Vec::new();
        for ends in cuts.windows(2).filter(|ends| ends[0] < ends[1]) {
            let middle = rim.at(0.5 * (ends[0] + ends[1]));
            if self.is_free(middle, middle) {
                continue;
            }
            match blocked.last_mut() {
                Some(last) if last[1] == ends[0] => last[1] = ends[1],
                _ => blocked.push([ends[0], ends[1]]),
            }
        }
        blocked
    }
}
