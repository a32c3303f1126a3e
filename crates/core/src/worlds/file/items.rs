//! Checks the items of a world file and converts them.

use super::description::{BoundsText, DoorText, ObstacleText, PlaceText, PolylineText, ShapeText, Xy, point};
use crate::geometry::{Aabb, ConvexPolygon, MAX_COORDINATE, Point2, Pose2, Shape, ShapeError, convex_hull};
use crate::worlds::{
    Door, MAX_CONCAVE_VERTICES, MAX_ITEMS, Mark, Obstacle, ObstacleKind, Place, RayCount, Resident, WorldProblem,
};

/// The shapes, corners and rays that a world may still have. Cutting up concave polygons takes
/// quadratic time.
pub(crate) struct Budget {
    left: usize,
    corners: usize,
    route_corners: usize,
    rays: RayCount,
}

impl Default for Budget {
    fn default() -> Self {
        Budget { left: MAX_ITEMS, corners: MAX_CORNERS, route_corners: MAX_ITEMS, rays: RayCount::default() }
    }
}

/// Largest number of corners of all concave polygons of a world together.
const MAX_CORNERS: usize = MAX_ITEMS;

impl Budget {
    fn spend(&mut self, shapes: usize) -> Result<(), WorldProblem> {
        self.left = self.left.checked_sub(shapes).ok_or(WorldProblem::TooMany { what: "shapes" })?;
        Ok(())
    }

    fn spend_corners(&mut self, corners: usize) -> Result<(), WorldProblem> {
        let what = "corners of concave polygons";
        self.corners = self.corners.checked_sub(corners).ok_or(WorldProblem::TooMany { what })?;
        Ok(())
    }

    pub(super) fn spend_rays(&mut self, robot: &Resident) -> Result<(), WorldProblem> {
        Ok(self.rays.add(robot.own_rays())?)
    }

    pub(super) fn spend_corners_of_routes(&mut self, corners: usize) -> Result<(), WorldProblem> {
        let what = "corners of routes";
        self.route_corners = self.route_corners.checked_sub(corners).ok_or(WorldProblem::TooMany { what })?;
        Ok(())
    }
}

pub(crate) fn make_point(xy: Xy) -> Result<Point2, ShapeError> {
    let p = point(xy);
    // written so that NaN fails it
    if p.x.abs() <= MAX_COORDINATE && p.y.abs() <= MAX_COORDINATE {
        Ok(p)
    } else {
        Err(ShapeError::Coordinate(p.x, p.y))
    }
}

pub(crate) fn make_bounds(text: &BoundsText) -> Result<Aabb, WorldProblem> {
    let (min, max) = (make_point(text.min)?, make_point(text.max)?);
    make_box(min, max)?;
    Ok(Aabb { min, max })
}

/// Makes a box; refuses corners in the wrong order.
fn make_box(min: Point2, max: Point2) -> Result<Shape, WorldProblem> {
    if max.x < min.x || max.y < min.y {
        return Err(WorldProblem::SwappedBox { min: [min.x, min.y], max: [max.x, max.y] });
    }
    Ok(Shape::try_rectangle(min, max)?)
}

/// Returns the points of a polyline and its segments. A closed polyline repeats its first point at the end, whether its
/// text does, as polygons of other programs do, or not.
fn make_polyline(text: &PolylineText) -> Result<(Vec<Point2>, Vec<Shape>), WorldProblem> {
    let least = if text.closed { 3 } else { 2 };
    let mut points: Vec<Point2> = text.points.iter().map(|&xy| point(xy)).collect();
    if text.closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    if points.len() < least {
        return Err(WorldProblem::TooFewPoints { found: points.len(), least });
    }
    if text.closed {
        points.push(points[0]);
    }
    let segment = |(index, ends): (usize, &[Point2])| {
        Shape::try_segment(ends[0], ends[1]).map_err(|source| WorldProblem::Segment { index, source })
    };
    let segments = points.windows(2).enumerate().map(segment).collect::<Result<_, _>>()?;
    Ok((points, segments))
}

pub(crate) fn make_wall(text: &PolylineText, budget: &mut Budget) -> Result<Obstacle, WorldProblem> {
    let (_, segments) = make_polyline(text)?;
    budget.spend(segments.len())?;
    let pieces = segments.into_iter().map(|s| (Pose2::IDENTITY, s)).collect();
    Ok(Obstacle::new(&text.name, ObstacleKind::Wall, pieces))
}

pub(crate) fn make_door(text: &DoorText, budget: &mut Budget) -> Result<Door, WorldProblem> {
    let (a, b) = (make_point(text.hinge)?, make_point(text.end)?);
    Shape::try_segment(a, b)?;
    budget.spend(1)?;
    Ok(Door { name: text.name.clone(), a, b, open: text.open })
}

pub(crate) fn make_mark(text: &PolylineText) -> Result<Mark, WorldProblem> {
    let (points, _) = make_polyline(text)?;
    Ok(Mark { name: text.name.clone(), points })
}

pub(crate) fn make_solid(text: &ObstacleText, budget: &mut Budget) -> Result<Obstacle, WorldProblem> {
    let mut solid = Obstacle::new(&text.name, ObstacleKind::Solid, Vec::new());
    make_pieces(&text.shape, &mut solid, budget)?;
    Ok(solid)
}

/// Appends the pieces of a shape. The recursion ends: ron reads no union nested deeper than its limit of 128.
fn make_pieces(text: &ShapeText, solid: &mut Obstacle, budget: &mut Budget) -> Result<(), WorldProblem> {
    let before = solid.pieces.len();
    let at_origin = |shape| (Pose2::IDENTITY, shape);
    match text {
        ShapeText::Disc { center, radius } => {
            let center = make_point(*center)?;
            solid.pieces.push((Pose2::new(center.x, center.y, 0.0), Shape::try_disc(*radius)?));
        }
        ShapeText::Box { min, max } => solid.pieces.push(at_origin(make_box(make_point(*min)?, make_point(*max)?)?)),
        ShapeText::Polygon(outline) => {
            let points: Vec<Point2> = outline.iter().map(|&xy| point(xy)).collect();
            // `add_polygon` refuses concave outlines with more vertices
            if points.len() <= MAX_CONCAVE_VERTICES && ConvexPolygon::try_new(&points).is_err() {
                budget.spend_corners(points.len())?;
            }
            solid.add_polygon(&points)?;
        }
        ShapeText::Rounded { points, radius } => {
            let points: Vec<Point2> = points.iter().map(|&xy| make_point(xy)).collect::<Result<_, _>>()?;
            solid.pieces.push(at_origin(make_rounded(&points, *radius)?));
        }
        ShapeText::Union(members) => {
            if members.is_empty() {
                return Err(WorldProblem::EmptyUnion);
            }
            return members.iter().try_for_each(|member| make_pieces(member, solid, budget));
        }
    }
    budget.spend(solid.pieces.len() - before)
}

fn make_rounded(points: &[Point2], radius: f64) -> Result<Shape, WorldProblem> {
    let found = convex_hull(points).len();
    if found < 2 {
        return Err(WorldProblem::TooFewPoints { found, least: 2 });
    }
    Ok(Shape::try_rounded(points, radius)?)
}

pub(crate) fn make_place(text: &PlaceText) -> Result<Place, WorldProblem> {
    let p = make_point((text.pose.x, text.pose.y))?;
    let theta = finite(text.pose.theta.value(), "the heading")?;
    Ok(Place { name: text.name.clone(), pose: Pose2::new(p.x, p.y, theta) })
}

pub(crate) fn finite(x: f64, what: &'static str) -> Result<f64, WorldProblem> {
    if x.is_finite() { Ok(x + 0.0) } else { Err(WorldProblem::NotFinite(what)) }
}
