//! `Route`, a closed one-way line that robots of a world follow, and why one is refused.

mod closed_line;
mod error;
mod path;

pub use closed_line::{ROUTE_RADII, ROUTE_SPEEDS, Route};
pub use error::{MAX_ROUTE_POINTS, RouteError};
pub use path::RoutePath;
