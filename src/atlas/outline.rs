//! `EditShape`, the shape of a wall or obstacle as a hand changes it.

use crate::geometry::{Point2, Pose2, Shape, Vector2, convex_hull};
use crate::num::hypot;
use crate::worlds::{Obstacle, ObstacleKind, OutlineError, convex_pieces};

/// The shape of a wall or an obstacle, with the points that a hand can drag.
#[derive(Clone, Debug, PartialEq)]
pub enum EditShape {
    /// A thin polyline. One that ends where it starts is closed.
    Wall(Vec<Point2>),
    /// A disc.
    Disc {
        /// Its centre.
        center: Point2,
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
    /// A simple polygon, convex or not, in either orientation. A concave one is kept as its convex pieces.
    Polygon(Vec<Point2>),
    /// All points within a radius of the hull of these.
    Rounded {
        /// The points.
        points: Vec<Point2>,
        /// The radius.
        radius: f64,
    },
    /// Several as one.
    Union(Vec<EditShape>),
}

/// A point to drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Its number on its thing.
    pub index: usize,
    /// Where it is.
    pub at: Point2,
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
        let piece = |(pose, shape): &(Pose2, Shape)| match shape {
            Shape::Disc { radius } => EditShape::Disc { center: pose.position(), radius: *radius },
            Shape::Rectangle { min, max } if *pose == Pose2::IDENTITY => EditShape::Box { min: *min, max: *max },
            Shape::Polygon(_) => EditShape::Polygon(shape.place(pose).core().to_vec()),
            _ => {
                let placed = shape.place(pose);
                EditShape::Rounded { points: placed.core().to_vec(), radius: placed.radius() }
            }
        };
        match &obstacle.pieces[..] {
            [one] => piece(one),
            several => EditShape::Union(several.iter().map(piece).collect()),
        }
    }

    /// Whether it is a wall.
    pub fn is_wall(&self) -> bool {
        matches!(self, EditShape::Wall(_))
    }

    /// The obstacle of this shape. Its numbers are not checked: reading the world's text does that.
    ///
    /// # Errors
    /// [`OutlineError`] when a polygon is none.
    pub(super) fn obstacle(&self, name: &str) -> Result<Obstacle, OutlineError> {
        let kind = if self.is_wall() { ObstacleKind::Wall } else { ObstacleKind::Solid };
        let mut pieces = Vec::new();
        self.add_pieces(&mut pieces)?;
        Ok(Obstacle { name: name.to_owned(), kind, pieces })
    }

    fn add_pieces(&self, out: &mut Vec<(Pose2, Shape)>) -> Result<(), OutlineError> {
        match self {
            EditShape::Wall(points) => {
                out.extend(points.windows(2).map(|w| (Pose2::IDENTITY, Shape::Segment { a: w[0], b: w[1] })));
            }
            EditShape::Disc { center, radius } => {
                out.push((Pose2::new(center.x, center.y, 0.0), Shape::Disc { radius: *radius }));
            }
            EditShape::Box { min, max } => out.push((Pose2::IDENTITY, Shape::Rectangle { min: *min, max: *max })),
            EditShape::Polygon(points) => {
                out.extend(convex_pieces(points)?.into_iter().map(|p| (Pose2::IDENTITY, Shape::Polygon(p))));
            }
            EditShape::Rounded { points, radius } => {
                out.push((Pose2::IDENTITY, Shape::Hull { vertices: convex_hull(points), radius: *radius }));
            }
            EditShape::Union(members) => members.iter().try_for_each(|member| member.add_pieces(out))?,
        }
        Ok(())
    }

    /// The points to drag: a wall's and a polygon's corners, a box's four, a disc's centre and a point of its rim.
    pub fn handles(&self) -> Vec<Handle> {
        self.points().into_iter().enumerate().map(|(index, at)| Handle { index, at }).collect()
    }

    fn points(&self) -> Vec<Point2> {
        match self {
            EditShape::Wall(points) => {
                let closed = points.len() > 2 && points.first() == points.last();
                points[..points.len() - usize::from(closed)].to_vec()
            }
            EditShape::Disc { center, radius } => vec![*center, Point2::new(center.x + radius, center.y)],
            EditShape::Box { min, max } => {
                vec![*min, Point2::new(max.x, min.y), *max, Point2::new(min.x, max.y)]
            }
            EditShape::Polygon(points) | EditShape::Rounded { points, .. } => points.clone(),
            EditShape::Union(members) => members.iter().flat_map(EditShape::points).collect(),
        }
    }

    /// The shape with one of its handles dragged. A box keeps the corner opposite; a disc's rim changes its radius.
    #[must_use]
    pub fn with_handle(&self, index: usize, to: Point2) -> EditShape {
        let mut shape = self.clone();
        match &mut shape {
            EditShape::Wall(points) => {
                let closed = points.len() > 2 && points.first() == points.last();
                if let Some(p) = points.get_mut(index) {
                    *p = to;
                }
                if let (true, 0, Some(last)) = (closed, index, points.last_mut()) {
                    *last = to;
                }
            }
            EditShape::Polygon(points) | EditShape::Rounded { points, .. } => {
                if let Some(p) = points.get_mut(index) {
                    *p = to;
                }
            }
            EditShape::Disc { center, .. } if index == 0 => *center = to,
            EditShape::Disc { center, radius } => *radius = hypot(to.x - center.x, to.y - center.y),
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
        }
        shape
    }

    /// The shape moved.
    #[must_use]
    pub fn moved(&self, by: Vector2) -> EditShape {
        let all = |points: &[Point2]| points.iter().map(|p| p + by).collect();
        match self {
            EditShape::Wall(points) => EditShape::Wall(all(points)),
            EditShape::Disc { center, radius } => EditShape::Disc { center: center + by, radius: *radius },
            EditShape::Box { min, max } => EditShape::Box { min: min + by, max: max + by },
            EditShape::Polygon(points) => EditShape::Polygon(all(points)),
            EditShape::Rounded { points, radius } => EditShape::Rounded { points: all(points), radius: *radius },
            EditShape::Union(members) => EditShape::Union(members.iter().map(|m| m.moved(by)).collect()),
        }
    }
}
