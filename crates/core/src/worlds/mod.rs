//! Worlds: lists of named geometry, never bitmaps.
//!
//! A world file ([`World::parse`]) is RON, in metres and radians:
//!
//! ```ron
//! World(
//!     version: 1,
//!     name: "Yard",
//!     bounds: (min: (0, 0), max: (8, 6)),       // what is shown, and where robots are; not an obstacle
//!     walls: [                                   // thin polylines
//!         (name: "the fence", points: [(0, 0), (8, 0), (8, 6), (0, 6)], closed: true),
//!     ],
//!     obstacles: [
//!         (name: "the tree", shape: Disc(center: (2, 3), radius: 0.4)),
//!         (name: "the shed", shape: Box(min: (5, 4), max: (7, 5.5))),
//!         (name: "the pond", shape: Polygon([(4, 1), (6, 1), (5.5, 2), (6, 3), (4, 3)])),
//!         (name: "the log", shape: Rounded(points: [(1, 1), (2, 1)], radius: 0.2)),
//!         (name: "the table", shape: Union([Box(min: (1, 4), max: (3, 5)), Disc(center: (3, 4.5), radius: 0.5)])),
//!     ],
//!     places: [(name: "home", pose: (x: 3, y: 5.5, theta: 0))],
//!     marks: [(name: "the path", points: [(0, 3), (4, 3.5)])],   // painted, never collided with
//!     robots: [(name: "Rusty", kind: "rusty", start: [3, 5.5, 0])],
//! )
//! ```
//!
//! The range sensor of a robot may be noisy. Its parameters are those of [`BeamModel`]; one that is left out is 0, or 1
//! for `lambda_short`:
//!
//! ```ron
//! (name: "Rusty", kind: "rusty", start: [3, 5.5, 0],
//!     sensor: (sigma_hit: 0.02, z_short: 0.05, lambda_short: 1, z_miss: 0.01, z_max: 0.01, z_rand: 0.01)),
//! ```
//!
//! A robot of any kind may carry range sensors of its own, each with a name, a number of rays and a greatest range.
//! Left out, the field of view is a full turn, the mount is the robot's own frame, and the sensor is exact:
//!
//! ```ron
//! (name: "Hitch", kind: "hitch", start: [3, 1, 0], sensors: [
//!     (name: "ahead", rays: 90, range: 4, field_of_view: 1.57, mount: (x: 0.5, y: 0, theta: 0)),
//!     (name: "behind", rays: 30, range: 2, mount: (x: -0.4, y: 0, theta: 3.14), noise: (sigma_hit: 0.02)),
//! ]),
//! ```
//!
//! Rovers carry the sensor of the run besides; its noise is what `sensor` says.
//!
//! A robot has the sizes of its kind unless its world says others, one field for each sort of robot. A number that is
//! left out is the kind's own, of [`Sizes`](crate::configuration::Sizes):
//!
//! ```ron
//! (name: "Big", kind: "rusty", start: [3, 5.5, 0], disc: (radius: 0.25, track: 0.4, wheel_radius: 0.05)),
//! (name: "Short", kind: "reach", start: [0.1, 0.2], arm: (base: (2, 2), lengths: [0.5, 0.4], radius: 0.02)),
//! (name: "Lorry", kind: "hitch", start: [6, 2, 0],
//!     car: (wheelbase: 4, length: 5.6, width: 2, rear_overhang: 0.8, max_steer: 0.4,
//!         trailer: (hitch_len: 3, width: 1.8, front_overhang: 1.2, rear_overhang: 1))),
//! ```
//!
//! Routes are closed one-way lines, and a robot that names one follows it, from where it starts, when nobody drives it.
//! Their corners are rounded by `radius`, and `speed` is in metres per second:
//!
//! ```ron
//! routes: [(name: "round", points: [(1, 1), (7, 1), (7, 3)], radius: 0.5, speed: 0.4)],
//! robots: [(name: "Rusty", kind: "rusty", start: [3, 1, 0], route: "round")],
//! ```
//!
//! The bounds hold the robots' positions, their sides included: a rover's centre, the middle of a car's rear axle, an
//! arm's base. A robot that starts outside them is refused, as is one that is larger than they are. Planners and their
//! paths keep to them ([`Problem`](crate::collision::Problem)); a robot's footprint may reach over them, and drivers
//! may leave them.
//!
//! Every angle may be written in degrees, in quotes, as in `start: [3, 5.5, "90deg"]`: those of starts, of the poses of
//! places and mounts, of fields of view, `max_steer` and `jackknife`; [`turns`] finds those that were meant so and are
//! not.
//!
//! Every list may be left out. A name is unique in the whole world. A robot's `start` is its configuration's
//! coordinates: `rusty` x, y, theta; `reach` th1, th2; `reach3` th1, th2, th3; `hitch` x, y, theta, and psi with a
//! trailer. Other kinds begin with `x-` and belong to programs that register them.

mod beam;
mod builder;
mod built_in;
mod convex_pieces;
mod error;
mod file;
mod grid;
mod limits;
mod model;
mod outside;
mod route;
mod sensor;
#[cfg(test)]
mod tests;
mod warehouse;

pub use beam::{BeamError, BeamModel};
pub use builder::WorldBuilder;
pub use built_in::UnknownWorld;
pub use convex_pieces::{MAX_CONCAVE_VERTICES, OutlineError, convex_pieces};
pub use error::{WorldError, WorldItem, WorldProblem};
pub use file::comments::comments;
pub use file::description::{ShapeText, Xy};
#[doc(hidden)]
pub use file::name::check_name;
pub use file::parse::turns;
#[doc(hidden)]
pub use file::resident::check_sensors;
#[doc(hidden)]
pub use file::ron_words::{begin_of, ron_in_words};
pub use grid::cells::{Grid, GridError, MAX_CELLS};
pub use grid::distance_transform::DistanceTransform;
pub use grid::ros_export::RosFiles;
pub use grid::voronoi::VoronoiDiagram;
pub use limits::{MAX_ITEMS, WORLD_VERSION};
pub use model::{Door, Mark, Obstacle, ObstacleKind, Outline, Place, Resident, SourceShape, World};
pub use outside::OutsideError;
pub use route::{MAX_ROUTE_POINTS, ROUTE_RADII, ROUTE_SPEEDS, Route, RouteError, RoutePath};
#[doc(hidden)]
pub use sensor::check_mount;
pub use sensor::{
    AllRaysError, FanSensor, MAX_ALL_RAYS, MAX_RANGE, MAX_RAYS, MAX_SENSORS, MIN_FIELD_OF_VIEW, MIN_RANGE, RangeSensor,
    RayCount, ResidentSensor, ResidentSensorError, ResidentSensorProblem, SensorError,
};
pub use warehouse::{WAREHOUSE_ROBOTS, Warehouse, WarehouseError};
