//! Points, poses, shapes and footprints: plain values in metres and radians, x right, y up, counter-clockwise positive.

mod aabb;
mod arc;
mod footprint;
mod hull;
mod parts;
mod placed;
mod point;
mod polygon;
mod pose;
mod segment;
mod shape;
mod sin_cos;

pub use aabb::Aabb;
pub(crate) use aabb::square;
pub use arc::CircularArc;
pub use footprint::Footprint;
pub use hull::{Vertices, convex_hull};
pub use parts::Part;
pub use placed::{Placed, largest_coordinate};
pub use point::{MAX_COORDINATE, MIN_FEATURE, Point2, Vector2, cross, orientation};
pub use polygon::{ConvexPolygon, PolygonError};
pub use pose::{Pose2, Tangent2};
pub use segment::Segment;
pub use shape::{Shape, ShapeError};
pub(crate) use sin_cos::SinCos;
