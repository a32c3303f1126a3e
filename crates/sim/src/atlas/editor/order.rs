//! The order of a shape's corners, which an edit would change.

use std::cmp::Reverse;

use super::EditShape;
use motion_lab_core::geometry::{Point2, Vector2};

impl EditShape {
    /// The same shape with its corners in the order of an earlier one, so that corner 2 is the one it was.
    ///
    /// A hull begins at its lowest leftmost corner, and a convex polygon goes counter-clockwise, however they were
    /// written. One corner that moves can so renumber others, and in a hull pass one. Here the corners that have stayed
    /// keep their numbers; where none has, as in a move of the whole, those do that the move alone explains best. The
    /// order of lines is their own.
    #[must_use]
    pub fn ordered_as(&self, earlier: &EditShape) -> EditShape {
        match (self, earlier) {
            (EditShape::Polygon(points), EditShape::Polygon(were)) => EditShape::Polygon(ordered(points, were)),
            (EditShape::Rounded { points, radius }, EditShape::Rounded { points: were, .. }) => {
                let points = matched(points, were).unwrap_or_else(|| ordered(points, were));
                EditShape::Rounded { points, radius: *radius }
            }
            (EditShape::Union(members), EditShape::Union(were)) if members.len() == were.len() => {
                EditShape::Union(members.iter().zip(were).map(|(member, was)| member.ordered_as(was)).collect())
            }
            _ => self.clone(),
        }
    }
}

/// A ring in the order that begins at a corner and goes one way round.
#[derive(Clone, Copy)]
struct Order<'a> {
    ring: &'a [Point2],
    first: usize,
    is_reversed: bool,
}

impl Order<'_> {
    fn corner(&self, i: usize) -> Point2 {
        let n = self.ring.len();
        self.ring[if self.is_reversed { (self.first + n - i) % n } else { (self.first + i) % n }]
    }

    /// Number of corners that are where they were, counted from both ends.
    fn unmoved_corners(&self, were: &[Point2]) -> usize {
        let (n, m) = (self.ring.len(), were.len());
        let both = if n < m { n } else { m };
        let before = (0..both).take_while(|i| self.corner(*i) == were[*i]).count();
        let behind = (0..both - before).take_while(|i| self.corner(n - 1 - i) == were[m - 1 - i]).count();
        before + behind
    }

    /// The sum of the squares of what a move of the whole by `by` leaves of the corners' ways.
    fn unlike(&self, were: &[Point2], by: Vector2) -> f64 {
        were.iter().enumerate().map(|(i, was)| (self.corner(i) - was - by).norm_squared()).sum()
    }
}

/// The corners of a hull, which have no order of their own, each with the number that it had. A new one has the number
/// of the one that is gone. `None` if more than one is new or gone.
fn matched(corners: &[Point2], were: &[Point2]) -> Option<Vec<Point2>> {
    let mut new = corners.iter().filter(|corner| !were.contains(corner));
    let kept = were.iter().filter(|was| corners.contains(was)).count();
    if kept + 1 < corners.len() || kept + 1 < were.len() {
        return None;
    }
    let known = were.iter().filter_map(|was| if corners.contains(was) { Some(was) } else { new.next() });
    let known: Vec<Point2> = known.copied().collect();
    Some(known.into_iter().chain(new.copied()).collect())
}

/// The ring in the order that is nearest to an earlier one.
fn ordered(ring: &[Point2], were: &[Point2]) -> Vec<Point2> {
    let (n, m) = (ring.len(), were.len());
    if ring == were {
        return ring.to_vec();
    }
    let orders = || {
        let one_way = |is_reversed| (0..n).map(move |first| Order { ring, first, is_reversed });
        one_way(false).chain(one_way(true))
    };
    // one corner was moved, added or removed, and all others are where they were
    let near = orders().enumerate().max_by_key(|(i, order)| (order.unmoved_corners(were), Reverse(*i)));
    let near = near
        .map(|(_, order)| order)
        .filter(|order| order.unmoved_corners(were) + 1 >= n && order.unmoved_corners(were) + 1 >= m);
    let sum = |points: &[Point2]| points.iter().fold(Vector2::zeros(), |sum, p| sum + p.coords);
    let moved = || {
        let by = (sum(ring) - sum(were)) / n as f64;
        orders().filter(|_| n == m).min_by(|a, b| a.unlike(were, by).total_cmp(&b.unlike(were, by)))
    };
    let order = near.or_else(moved);
    order.map_or_else(|| ring.to_vec(), |order| (0..n).map(|i| order.corner(i)).collect())
}

#[cfg(test)]
mod tests {
    use super::super::{Editor, Op};
    use super::*;
    use motion_lab_core::geometry::Aabb;
    use motion_lab_core::worlds::World;

    fn points(places: &[[f64; 2]]) -> Vec<Point2> {
        places.iter().map(|[x, y]| Point2::new(*x, *y)).collect()
    }

    /// The shape as a world holds it, in an order of its own.
    fn held(shape: &EditShape) -> EditShape {
        let mut editor = Editor::new(World::empty("Yard", Aabb::new(Point2::origin(), Point2::new(12.0, 8.0))));
        editor.apply(&Op::Add { name: "it".into(), shape: shape.clone() }).unwrap();
        editor.shape("it").unwrap()
    }

    #[test]
    fn corners_keep_their_numbers_whichever_one_is_moved_and_wherever() {
        let ring = points(&[[2.0, 2.0], [5.0, 2.0], [6.0, 4.0], [4.0, 6.0], [2.0, 4.0]]);
        let hull = |points: Vec<Point2>| EditShape::Rounded { points, radius: 0.25 };
        let (mut count, mut renumbered) = (0, 0);
        for make in [EditShape::Polygon as fn(Vec<Point2>) -> EditShape, hull] {
            for n in [3, 5] {
                let before = held(&make(ring[..n].to_vec()));
                for corner in 0..n {
                    for to in points(&[[1.0, 1.0], [1.0, 5.0], [8.0, 1.5], [6.5, 6.5], [3.5, 7.0], [4.0, 1.0]]) {
                        let now = match &before {
                            EditShape::Polygon(points) | EditShape::Rounded { points, .. } => {
                                let mut points = points.clone();
                                points[corner] = to;
                                make(points)
                            }
                            _ => panic!("a ring"),
                        };
                        let mut editor =
                            Editor::new(World::empty("Yard", Aabb::new(Point2::origin(), Point2::new(12.0, 8.0))));
                        // a corner may cross an edge, or fall into the hull of the others
                        if editor.apply(&Op::Add { name: "it".into(), shape: now.clone() }).is_err() {
                            continue;
                        }
                        let after = editor.shape("it").unwrap();
                        if after.handles().len() != now.handles().len() {
                            continue;
                        }
                        count += 1;
                        renumbered += usize::from(after != now);
                        assert_eq!(after.ordered_as(&before), now, "corner {corner} of {n} to {to}");
                    }
                }
            }
        }
        assert!(count > 50 && renumbered > 20, "{renumbered} of {count}");
    }

    #[test]
    fn corners_keep_their_numbers_when_the_whole_moves_and_when_one_comes_or_goes() {
        let square = EditShape::Polygon(points(&[[4.0, 4.0], [4.0, 3.0], [3.0, 3.0], [3.0, 4.0]]));
        for by in [[1.0, 0.0], [0.0, -1.0], [0.05, 0.05], [-1.0, 1.0]] {
            let moved = square.moved(by.into());
            assert_ne!(held(&moved), moved, "the world has an order of its own");
            assert_eq!(held(&moved).ordered_as(&square), moved, "{by:?}");
        }
        let with = EditShape::Polygon(points(&[[4.0, 4.0], [4.5, 3.5], [4.0, 3.0], [3.0, 3.0], [3.0, 4.0]]));
        assert_eq!(held(&with).ordered_as(&square), with);
        assert_eq!(held(&square).ordered_as(&with), square);
        let union = |shape: &EditShape| EditShape::Union(vec![held(&with), shape.clone()]);
        assert_eq!(union(&held(&square)).ordered_as(&union(&square)), union(&square));
        // another kind of shape has its own order
        let line = EditShape::Wall(points(&[[1.0, 1.0], [0.0, 0.0]]));
        assert_eq!(line.ordered_as(&square), line);
    }
}
