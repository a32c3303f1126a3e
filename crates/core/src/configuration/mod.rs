//! Configurations: typed values, one type per configuration space.
//!
//! | robot | space | type |
//! |---|---|---|
//! | Rusty, as a planner sees it | R^2 | [`R2`] |
//! | Rusty, in the simulator | SE(2) | [`Pose2`](crate::geometry::Pose2) |
//! | Reach | the torus T^N | [`Tn<N>`](Tn), [`T2`] |
//! | Hitch | SE(2), or SE(2) x S^1 with a trailer | [`HitchCfg`] |
//!
//! A function does not accept a configuration of another type. This does not compile:
//!
//! ```compile_fail,E0308
//! use motion_lab_core::prelude::*;
//! let reach = Reach::<2>::choset();
//! reach.tip(&HitchCfg { body: Pose2::IDENTITY, trailer: None }); // a car is not an arm
//! ```
//!
//! The twin that differs in that one type compiles:
//!
//! ```
//! use motion_lab_core::prelude::*;
//! let reach = Reach::<2>::choset();
//! reach.tip(&T2::new(0.0, 0.0));
//! ```
//!
//! A three-link arm's configuration is not a two-link arm's, and a pose is not a point of the plane:
//!
//! ```compile_fail,E0308
//! use motion_lab_core::prelude::*;
//! Reach::<2>::choset().tip(&Tn([0.0, 0.0, 0.0]));
//! ```
//! ```
//! use motion_lab_core::prelude::*;
//! Reach::<2>::choset().tip(&Tn([0.0, 0.0]));
//! ```
//! ```compile_fail,E0308
//! use motion_lab_core::prelude::*;
//! RustyDisc::default().footprint(&Pose2::new(0.0, 0.0, 0.0));
//! ```
//! ```
//! use motion_lab_core::prelude::*;
//! RustyDisc::default().footprint(&R2::new(0.0, 0.0));
//! ```

mod any;
mod chart;
mod configuration_trait;
mod hitch;
mod input_kind;
mod kind;
mod kind_sizes;
mod kinds;
mod pose;
mod r2;
mod sizes;
mod torus;
mod written;

pub use any::AnyConfiguration;
pub use chart::Chart;
pub(crate) use chart::gap;
pub use configuration_trait::{ChartMismatch, Configuration, Coordinates};
pub use hitch::HitchCfg;
pub use input_kind::InputKind;
pub use kind::{RobotKind, Space};
pub use kinds::Kinds;
pub use r2::R2;
pub use sizes::{ArmSizes, CarSizes, DiscSizes, MAX_SIZE, MAX_STEER, MIN_AXLES, Sizes, SizesError, TrailerSizes};
pub use torus::{T2, Tn};
pub use written::{WrittenCoordinate, WrittenCoordinateError};
