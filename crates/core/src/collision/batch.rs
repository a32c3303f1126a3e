//! Batch queries: many configurations at once, in parallel where threads exist.

use super::{Checker, EdgeVerdict};
use crate::robots::{ConfigurationError, Robot};

/// Applies `f` to every item, in parallel. The results are in the items' order, whatever the number of threads.
#[cfg(not(target_family = "wasm"))]
fn map<T: Sync, U: Send>(items: &[T], f: impl Fn(&T) -> U + Sync + Send) -> Vec<U> {
    use rayon::prelude::*;
    items.par_iter().map(f).collect()
}

/// Applies `f` to every item, one after the other: WebAssembly has one thread.
#[cfg(target_family = "wasm")]
fn map<T, U>(items: &[T], f: impl Fn(&T) -> U) -> Vec<U> {
    items.iter().map(f).collect()
}

impl<R: Robot> Checker<R> {
    /// [`is_free`](Self::is_free) of every configuration, in their order. The answers do not depend on the number of
    /// threads.
    ///
    /// ```
    /// use motion_lab_core::prelude::*;
    /// use motion_lab_core::collision::{ChainChecker, Scene};
    /// let c = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    /// let corner_and_post = [T2::new(2.0, 0.0), T2::new(2.53, 0.0)];
    /// assert_eq!(c.are_free(&corner_and_post), [true, false]);
    /// ```
    pub fn are_free(&self, configurations: &[R::Configuration]) -> Vec<bool> {
        map(configurations, |q| self.is_free(q))
    }

    /// [`distance`](Self::distance) of every configuration, in their order.
    pub fn distances(&self, configurations: &[R::Configuration]) -> Vec<f64> {
        map(configurations, |q| self.distance(q))
    }

    /// [`edge_free`](Self::edge_free) of every pair, in their order.
    pub fn edges_free(&self, pairs: &[(R::Configuration, R::Configuration)]) -> Vec<bool> {
        map(pairs, |(a, b)| self.edge_free(a, b))
    }

    /// [`edge`](Self::edge) of every pair, in their order.
    pub fn edges(
        &self,
        pairs: &[(R::Configuration, R::Configuration)],
    ) -> Vec<Result<EdgeVerdict, ConfigurationError>> {
        map(pairs, |(a, b)| self.edge(a, b))
    }
}
