//! `Configuration`, a point of a configuration space.

use crate::short_list::ShortList;
use std::fmt::{Debug, Display};

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
