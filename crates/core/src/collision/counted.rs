//! `Counted`, a checker that counts its queries.

use std::sync::atomic::{AtomicU64, Ordering};

use super::{Collision, Witness};
use crate::geometry::{Footprint, Placed};

/// A [`Collision`] that forwards every query to another checker and counts it. Planners are compared by these counts.
///
/// The hooks are forwarded too, so the queries counted are those that the other checker answers without a counter.
///
/// ```
/// use motion_lab_core::prelude::*;
/// use motion_lab_core::collision::{Collision, Counted, Scene};
/// let counted = Counted::new(Scene::of_walls(&[]));
/// counted.distance(&Footprint::disc(Point2::new(0.0, 0.0), 0.11));
/// assert_eq!(counted.counts().distance, 1);
/// ```
#[derive(Debug, Default)]
pub struct Counted<C> {
    inner: C,
    intersects: AtomicU64,
    distance: AtomicU64,
    distance_of_hull: AtomicU64,
    clears: AtomicU64,
    witness: AtomicU64,
    swept: AtomicU64,
}

/// How often each query was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueryCounts {
    /// `intersects`.
    pub intersects: u64,
    /// `distance`.
    pub distance: u64,
    /// `distance_of_hull` and `distance_of_hull_within`: the distances that a march asks to prove its steps.
    pub distance_of_hull: u64,
    /// `clears`, the separation test, whatever its answer.
    pub clears: u64,
    /// `witness`.
    pub witness: u64,
    /// `swept`; the queries it makes in turn are not counted.
    pub swept: u64,
}

impl<C: Collision> Counted<C> {
    /// Counts the queries that go to `inner`.
    pub fn new(inner: C) -> Self {
        let zero = AtomicU64::default;
        Counted {
            inner,
            intersects: zero(),
            distance: zero(),
            distance_of_hull: zero(),
            clears: zero(),
            witness: zero(),
            swept: zero(),
        }
    }

    /// The checker that answers.
    pub fn inner(&self) -> &C {
        &self.inner
    }

    /// The counts so far.
    pub fn counts(&self) -> QueryCounts {
        let read = |c: &AtomicU64| c.load(Ordering::Relaxed);
        QueryCounts {
            intersects: read(&self.intersects),
            distance: read(&self.distance),
            distance_of_hull: read(&self.distance_of_hull),
            clears: read(&self.clears),
            witness: read(&self.witness),
            swept: read(&self.swept),
        }
    }
}

impl<C: Collision> Collision for Counted<C> {
    fn intersects(&self, footprint: &Footprint) -> bool {
        self.intersects.fetch_add(1, Ordering::Relaxed);
        self.inner.intersects(footprint)
    }

    fn distance(&self, footprint: &Footprint) -> f64 {
        self.distance.fetch_add(1, Ordering::Relaxed);
        self.inner.distance(footprint)
    }

    fn distance_of_hull(&self, hull: Placed) -> f64 {
        self.distance_of_hull.fetch_add(1, Ordering::Relaxed);
        self.inner.distance_of_hull(hull)
    }

    fn distance_of_hull_within(&self, hull: Placed, within: f64) -> f64 {
        self.distance_of_hull.fetch_add(1, Ordering::Relaxed);
        self.inner.distance_of_hull_within(hull, within)
    }

    fn clears(&self, from: &Placed, to: &Placed, reach: f64) -> bool {
        self.clears.fetch_add(1, Ordering::Relaxed);
        self.inner.clears(from, to, reach)
    }

    fn witness(&self, footprint: &Footprint) -> Option<Witness> {
        self.witness.fetch_add(1, Ordering::Relaxed);
        self.inner.witness(footprint)
    }

    fn swept(&self, a: &Footprint, b: &Footprint) -> bool {
        self.swept.fetch_add(1, Ordering::Relaxed);
        self.inner.swept(a, b)
    }
}
