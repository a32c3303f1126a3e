//! `Route`, a closed one-way line that robots of a world follow, and why one is refused.

mod path;

use crate::geometry::{Point2, ShapeError};

pub use path::RoutePath;

/// Largest number of corners of a route.
pub const MAX_ROUTE_POINTS: usize = 1000;
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

/// Why a route is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RouteError {
    /// Too few corners, or too many.
    #[error("{0} points: a route has 3 to {MAX_ROUTE_POINTS}")]
    Points(usize),
    /// A side that is none.
    #[error("from points[{index}] on: {source}")]
    Side {
        /// The index of the side's first corner, from 0.
        index: usize,
        /// What is wrong with it.
        source: ShapeError,
    },
    /// A radius or a speed out of range, or not finite.
    #[error("{number} {value}: it must be from {least} to {most}")]
    Range {
        /// The number, as world files name it.
        number: &'static str,
        /// Its value.
        value: f64,
        /// The least that it may be.
        least: f64,
        /// The most that it may be.
        most: f64,
    },
    /// A corner at which the route goes back the way it came.
    #[error("points[{0}]: the route turns back on itself")]
    TurnsBack(usize),
    /// A side too short for its rounded corners.
    #[error(
        "from points[{index}] on: a side of {length} m, but its corners of radius {radius} m take {needed} m of it"
    )]
    ShortSide {
        /// The index of the side's first corner, from 0.
        index: usize,
        /// The side's length, metres.
        length: f64,
        /// The radius of the corners, metres.
        radius: f64,
        /// How much of the side the two corners take, metres.
        needed: f64,
    },
}

impl Route {
    /// The line that the route is, its corners rounded.
    ///
    /// # Errors
    /// [`RouteError`]: fewer than three corners or more than [`MAX_ROUTE_POINTS`], a radius or a speed out of range, a
    /// side shorter than a millimetre or too short for its rounded corners, a corner that turns back.
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
