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
mod hitch;
mod input_kind;
mod kind;
mod kinds;
mod pose;
mod r2;
mod sizes;
mod torus;

use std::fmt::{Debug, Display};

pub use any::AnyConfiguration;
pub use chart::Chart;
pub(crate) use chart::gap;
pub use hitch::HitchCfg;
pub use input_kind::InputKind;
pub use kind::{RobotKind, Space};
pub use kinds::Kinds;
pub use r2::R2;
pub use sizes::{ArmSizes, CarSizes, DiscSizes, MAX_SIZE, MAX_STEER, MIN_AXLES, Sizes, SizesError, TrailerSizes};
pub use torus::{T2, Tn};

use crate::short_list::ShortList;

/// The coordinates of a configuration in its chart: metres and radians, angles wrapped to `(-pi, pi]`.
pub type Coordinates = ShortList<f64, 4>;

/// Two configurations that lie in different spaces, so that no chart line joins them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no chart line joins a configuration with a trailer and one without")]
pub struct ChartMismatch;

/// A point of a configuration space.
pub trait Configuration: Copy + Debug + Display + PartialEq + Send + Sync + 'static {
    /// Whether every coordinate is finite.
    fn is_finite(&self) -> bool;

    /// The chart difference from `self` to `to`, coordinate by coordinate. Angles go the short way round, and a
    /// difference of exactly pi goes the positive way.
    ///
    /// # Errors
    /// [`ChartMismatch`] when the two lie in different spaces.
    fn difference(&self, to: &Self) -> Result<Coordinates, ChartMismatch>;

    /// The configuration a fraction `s` in `[0, 1]` along the chart's straight line from `self` to `to`. At 0 it is
    /// `self` and at 1 it is `to`, bit for bit.
    ///
    /// # Errors
    /// [`ChartMismatch`] when the two lie in different spaces.
    fn interpolate(&self, to: &Self, s: f64) -> Result<Self, ChartMismatch>;

    /// The same configuration with its angles in `(-pi, pi]`; angles that are there already keep their bits. Edges and
    /// drives begin with it. A configuration without angles is returned as it is.
    #[must_use]
    fn in_chart(&self) -> Self {
        *self
    }

    /// The coordinates in the chart.
    fn coordinates(&self) -> Coordinates;

    /// The coordinates' names, in the same order and number: `x`, `y`, `theta`, `th1`, `psi`.
    fn coordinate_names(&self) -> Vec<String>;

    /// The configuration with these coordinates, bit for bit; `None` when their number fits no configuration of this
    /// type.
    fn from_coordinates(coordinates: &[f64]) -> Option<Self>;
}
