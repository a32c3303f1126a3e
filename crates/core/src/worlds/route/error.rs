//! `RouteError`, why a route is refused.

use crate::geometry::ShapeError;

/// Largest number of corners of a route.
pub const MAX_ROUTE_POINTS: usize = 1000;

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
