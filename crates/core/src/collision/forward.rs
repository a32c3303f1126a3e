//! `Collision` for a checker behind a reference or an `Arc`.

use std::sync::Arc;

use super::{Collision, Witness};
use crate::geometry::{Footprint, Placed};

macro_rules! passes_on {
    ($($holder:ty),*) => { $(
        /// Forwards every query to the checker behind it.
        impl<C: Collision + ?Sized> Collision for $holder {
            fn intersects(&self, footprint: &Footprint) -> bool {
                (**self).intersects(footprint)
            }

            fn distance(&self, footprint: &Footprint) -> f64 {
                (**self).distance(footprint)
            }

            fn distance_of_hull(&self, hull: Placed) -> f64 {
                (**self).distance_of_hull(hull)
            }

            fn distance_of_hull_within(&self, hull: Placed, within: f64) -> f64 {
                (**self).distance_of_hull_within(hull, within)
            }

            fn clears(&self, from: &Placed, to: &Placed, reach: f64) -> bool {
                (**self).clears(from, to, reach)
            }

            fn witness(&self, footprint: &Footprint) -> Option<Witness> {
                (**self).witness(footprint)
            }

            fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
                (**self).swept(a, b)
            }
        }
    )* };
}
passes_on!(&C, Arc<C>);
