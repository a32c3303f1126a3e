//! `EditShape`, the shape of a wall, an obstacle or a painted mark, and how handles change it.

use motion_lab_core::geometry::{Point2, Pose2, Shape, Vector2, convex_hull};
use motion_lab_core::num::hypot;
use motion_lab_core::worlds::{Obstacle, ObstacleKind, OutlineError, SourceShape};

/// The shape of a wall, an obstacle or a painted mark, with its handles.
#[derive(Clone, Debug, PartialEq)]
pub enum EditShape {
    /// A thin polyline. One that ends where it starts is closed.
    Wall(Vec<Point2>),
    /// A painted polyline, never collided with. One that ends where it starts is closed.
    Mark(Vec<Point2>),
    /// A disc.
    Disc {
        /// Its centre.
        centre: Point2,
        /// Its radius.
        radius: f64,
    },
    /// A box with sides along the axes.
    Box {
        /// The corner with the least coordinates.
        min: Point2,
        /// The corner with the greatest.
        max: Point2,
    },
    /// A simple polygon, convex or not, in either orientation.
    Polygon(Vec<Point2>),
    /// The convex hull of points, grown by a radius.
    Rounded {
        /// The points.
        points: Vec<Point2>,
        /// The radius.
        radius: f64,
    },
    /// Several shapes as one.
    Union(Vec<EditShape>),
}

/// A point of a shape that can be dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Its number on the shape.
    pub index: usize,
    /// Its position.
    pub at: Point2,
    /// Whether dragging it makes a new corner, because it is the middle of an edge.
    pub makes_corner: bool,
}

impl EditShape {
    /// The shape of an obstacle of a world.
    pub fn of(obstacle: &Obstacle) -> EditShape {
        if obstacle.kind == ObstacleKind::Wall {
            let mut points: Vec<Point2> = Vec::new();
            for placed in obstacle.placed() {
                for p in placed.core() {
                    if points.last() != Some(p) {
                        points.push(*p);
                    }
                }
            }
            return EditShape::Wall(points);
        }
        let shape = |written: &SourceShape<'_>| match written {
            SourceShape::Outline(points) => EditShape::Polygon(points.to_vec()),
            SourceShape::Piece((pose, shape)) => match shape {
                Shape::Disc { radius } => EditShape::Disc { centre: pose.position(), radius: *radius },
                Shape::Rectangle { min, max } if *pose == Pose2::IDENTITY => EditShape::Box { min: *min, max: *max },
                Shape::Polygon(_) => EditShape::Polygon(shape.place(pose).core().to_vec()),
                _ => {
                    let placed = shape.place(pose);
                    EditShape::Rounded { points: placed.core().to_vec(), radius: placed.radius() }
                }
            },
        };
        match &obstacle.written()[..] {
            [one] => shape(one),
            several => EditShape::Union(several.iter().map(shape).collect()),
        }
    }

    /// The obstacle of this shape. Its numbers are not checked here, but when the world's text is read.
    ///
    /// # Errors
    /// [`OutlineError`] for an invalid polygon.
    pub(super) fn obstacle(&self, name: &str) -> Result<Obstacle, OutlineError> {
        let kind = if matches!(self, EditShape::Wall(_)) { ObstacleKind::Wall } else { ObstacleKind::Solid };
        let mut obstacle = Obstacle::new(name, kind, Vec::new());
        self.add_to(&mut obstacle)?;
        Ok(obstacle)
    }

    fn add_to(&self, obstacle: &mut Obstacle) -> Result<(), OutlineError> {
        let pieces = &mut obstacle.pieces;
        match self {
            EditShape::Wall(points) | EditShape::Mark(points) => {
                pieces.extend(points.windows(2).map(|w| (Pose2::IDENTITY, Shape::Segment { a: w[0], b: w[1] })));
            }
            EditShape::Disc { centre, radius } => {
                pieces.push((Pose2::new(centre.x, centre.y, 0.0), Shape::Disc { radius: *radius }));
            }
            EditShape::Box { min, max } => pieces.push((Pose2::IDENTITY, Shape::Rectangle { min: *min, max: *max })),
            EditShape::Polygon(points) => obstacle.add_polygon(points)?,
            EditShape::Rounded { points, radius } => {
                pieces
                    .push((Pose2::IDENTITY, Shape::Hull { vertices: convex_hull(points)[..].into(), radius: *radius }));
            }
            EditShape::Union(members) => members.iter().try_for_each(|member| member.add_to(obstacle))?,
        }
        Ok(())
    }

    /// The corners of a polyline or polygon without the closing one, whether it is closed, and the least number of
    /// corners.
    fn ring(&self) -> Option<(&[Point2], bool, usize)> {
        match self {
            EditShape::Wall(points) | EditShape::Mark(points) => {
                let closed = points.len() > 2 && points.first() == points.last();
                Some((&points[..points.len() - usize::from(closed)], closed, if closed { 3 } else { 2 }))
            }
            EditShape::Polygon(points) => Some((points, true, 3)),
            _ => None,
        }
    }

    /// The same polyline or polygon with other corners.
    fn with_ring(&self, mut ring: Vec<Point2>, closed: bool) -> EditShape {
        match self {
            EditShape::Polygon(_) => EditShape::Polygon(ring),
            line => {
                ring.extend(ring.first().copied().filter(|_| closed));
                if matches!(line, EditShape::Mark(_)) { EditShape::Mark(ring) } else { EditShape::Wall(ring) }
            }
        }
    }

    /// The points to drag: the corners of a polyline or a polygon and then the middles of its edges, a box's four
    /// corners, a disc's centre and a point of its rim, a rounded shape's points, and those of a union's members.
    pub fn handles(&self) -> Vec<Handle> {
        let corners = self.points();
        let middles = self.ring().map_or_else(Vec::new, |(ring, closed, _)| {
            let edges = if closed { ring.len() } else { ring.len() - 1 };
            (0..edges).map(|i| nalgebra::center(&ring[i], &ring[(i + 1) % ring.len()])).collect()
        });
        let makes = corners.iter().map(|_| false).chain(middles.iter().map(|_| true));
        let handle = |(index, (at, makes_corner))| Handle { index, at, makes_corner };
        corners.iter().chain(&middles).copied().zip(makes).enumerate().map(handle).collect()
    }

    fn points(&self) -> Vec<Point2> {
        match self {
            EditShape::Wall(_) | EditShape::Mark(_) => self.ring().map_or_else(Vec::new, |(ring, ..)| ring.to_vec()),
            EditShape::Disc { centre, radius } => vec![*centre, Point2::new(centre.x + radius, centre.y)],
            EditShape::Box { min, max } => {
                vec![*min, Point2::new(max.x, min.y), *max, Point2::new(min.x, max.y)]
            }
            EditShape::Polygon(points) | EditShape::Rounded { points, .. } => points.clone(),
            EditShape::Union(members) => members.iter().flat_map(EditShape::points).collect(),
        }
    }

    /// The corners beside the corner of handle `index`. Dragged onto one of them, the corner goes away.
    pub fn neighbours(&self, index: usize) -> Vec<Point2> {
        let Some((ring, closed, _)) = self.ring().filter(|(ring, ..)| index < ring.len()) else { return Vec::new() };
        let n = ring.len();
        let before = if index > 0 || closed { Some((index + n - 1) % n) } else { None };
        let after = if index + 1 < n || closed { Some((index + 1) % n) } else { None };
        before.into_iter().chain(after).map(|i| ring[i]).collect()
    }

    /// The shape with one of its handles dragged. A box keeps the opposite corner. A disc's rim changes its radius. The
    /// middle of an edge becomes a corner. A corner dragged onto its neighbour goes away, unless too few would remain.
    #[must_use]
    pub fn with_handle(&self, index: usize, to: Point2) -> EditShape {
        if let Some((ring, closed, least)) = self.ring() {
            let n = ring.len();
            let mut ring = ring.to_vec();
            let edges = if closed { n } else { n - 1 };
            if index >= n + edges {
                return self.clone();
            } else if index >= n {
                ring.insert(index - n + 1, to);
            } else if n > least && self.neighbours(index).contains(&to) {
                ring.remove(index);
            } else {
                ring[index] = to;
            }
            return self.with_ring(ring, closed);
        }
        let mut shape = self.clone();
        match &mut shape {
            EditShape::Rounded { points, .. } => {
                if let Some(p) = points.get_mut(index) {
                    *p = to;
                }
            }
            EditShape::Disc { centre, .. } if index == 0 => *centre = to,
            EditShape::Disc { centre, radius } => *radius = hypot(to.x - centre.x, to.y - centre.y),
            EditShape::Box { min, max } => {
                let corners = self.points();
                if let Some(opposite) = corners.get((index + 2) % 4).filter(|_| index < 4) {
                    let order = |a: f64, b: f64| if a <= b { (a, b) } else { (b, a) };
                    let ((x0, x1), (y0, y1)) = (order(opposite.x, to.x), order(opposite.y, to.y));
                    (*min, *max) = (Point2::new(x0, y0), Point2::new(x1, y1));
                }
            }
            EditShape::Union(members) => {
                let mut index = index;
                for member in members {
                    let own = member.points().len();
                    if index < own {
                        *member = member.with_handle(index, to);
                        break;
                    }
                    index -= own;
                }
            }
            EditShape::Wall(_) | EditShape::Mark(_) | EditShape::Polygon(_) => {}
        }
        shape
    }

    /// The shape moved, its coordinates rounded to a nanometre.
    #[must_use]
    pub fn moved(&self, by: Vector2) -> EditShape {
        let moved = |p: &Point2| (p + by).map(tidy);
        let all = |points: &[Point2]| points.iter().map(moved).collect();
        match self {
            EditShape::Wall(points) => EditShape::Wall(all(points)),
            EditShape::Mark(points) => EditShape::Mark(all(points)),
            EditShape::Disc { centre, radius } => EditShape::Disc { centre: moved(centre), radius: *radius },
            EditShape::Box { min, max } => EditShape::Box { min: moved(min), max: moved(max) },
            EditShape::Polygon(points) => EditShape::Polygon(all(points)),
            EditShape::Rounded { points, radius } => EditShape::Rounded { points: all(points), radius: *radius },
            EditShape::Union(members) => EditShape::Union(members.iter().map(|m| m.moved(by)).collect()),
        }
    }
}

/// A coordinate rounded to the nanometre, which removes the rounding errors of sums.
pub(super) fn tidy(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
