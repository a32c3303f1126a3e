//! `Route`, a closed one-way line that robots follow.

use super::error::RouteError;
use super::path::RoutePath;
use crate::geometry::Point2;

/// Smallest and largest radius of a route's corners, metres.
pub const ROUTE_RADII: [f64; 2] = [1e-3, 1e3];

/// Smallest and largest speed along a route, metres per second.
pub const ROUTE_SPEEDS: [f64; 2] = [1e-3, 10.0];

/// A closed one-way route: from corner to corner in their order, and from the last to the first. Each corner is rounded
/// by the same radius.
///
/// A route is no obstacle. The robots that name it follow it, each ahead of or behind the others by the distance along
/// it that lies between their starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// The unique name.
    pub name: String,
    /// The corners, metres, at least three.
    pub points: Vec<Point2>,
    /// The radius of the rounded corners, metres.
    pub radius: f64,
    /// The speed along it, metres per second. A run takes nine tenths of it or more, by its seed, for all of the
    /// route's robots alike.
    pub speed: f64,
}

impl Route {
    /// The line that the route is, its corners rounded.
    ///
    /// # Errors
    /// [`RouteError`]: fewer than three corners or more than [`MAX_ROUTE_POINTS`](super::MAX_ROUTE_POINTS), a radius or
    /// a speed out of range, a side shorter than a millimetre or too short for its rounded corners, a corner that turns
    /// back.
    pub fn path(&self) -> Result<RoutePath, RouteError> {
        within("radius", self.radius, ROUTE_RADII)?;
        within("speed", self.speed, ROUTE_SPEEDS)?;
        RoutePath::try_new(&self.points, self.radius)
    }
}

fn within(number: &'static str, value: f64, [least, most]: [f64; 2]) -> Result<(), RouteError> {
    // NaN lies in no range
    if (least..=most).contains(&value) { Ok(()) } else { Err(RouteError::Range { number, value, least, most }) }
}
