//! Batch queries: many configurations at once, in parallel where threads exist. The answers do not depend on the number
//! of threads.

use super::{Checker, EdgeVerdict, Rows, RowsError, Witness};
use crate::robots::{ConfigurationError, Robot};

/// Largest number of answers that the caller's own thread works out alone.
#[cfg(not(target_family = "wasm"))]
const MAX_ALONE: usize = 64;

/// Answers every question, given by its number, in its place, in parallel.
fn fill<T: Send>(answers: &mut [T], answer: impl Fn(usize, &mut T) + Sync + Send) {
    let one = |(i, place): (usize, &mut T)| answer(i, place);
    #[cfg(not(target_family = "wasm"))]
    if answers.len() > MAX_ALONE {
        use rayon::prelude::*;
        return answers.par_iter_mut().enumerate().for_each(one);
    }
    answers.iter_mut().enumerate().for_each(one);
}

/// A list of `count` answers, worked out in parallel; each place holds `before` until then.
fn filled<T: Clone + Send>(count: usize, before: T, answer: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    let mut answers = vec![before; count];
    fill(&mut answers, |i, place| *place = answer(i));
    answers
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
        filled(configurations.len(), false, |i| self.is_free(&configurations[i]))
    }

    /// [`distance`](Self::distance) of every configuration, in their order.
    pub fn distances(&self, configurations: &[R::Configuration]) -> Vec<f64> {
        filled(configurations.len(), 0.0, |i| self.distance(&configurations[i]))
    }

    /// [`edge_free`](Self::edge_free) of every pair, in their order.
    pub fn edges_free(&self, pairs: &[(R::Configuration, R::Configuration)]) -> Vec<bool> {
        filled(pairs.len(), false, |i| self.edge_free(&pairs[i].0, &pairs[i].1))
    }

    /// [`edge`](Self::edge) of every pair, in their order.
    pub fn edges(
        &self,
        pairs: &[(R::Configuration, R::Configuration)],
    ) -> Vec<Result<EdgeVerdict, ConfigurationError>> {
        filled(pairs.len(), Err(ConfigurationError::OtherRobot), |i| self.edge(&pairs[i].0, &pairs[i].1))
    }

    /// [`is_free`](Self::is_free) of every row, written into the caller's memory.
    ///
    /// # Errors
    /// [`RowsError::Places`], as of all that follow, unless there is a place for each row; nothing is written then.
    pub fn are_free_into(&self, q: &Rows<'_, R>, free: &mut [bool]) -> Result<(), RowsError> {
        self.each_row(q, free, |q| self.is_free(q))
    }

    /// Whether the robot touches an obstacle at every row, touching included; its own limits don't matter.
    ///
    /// # Errors
    /// As of [`are_free_into`](Self::are_free_into).
    pub fn intersects_into(&self, q: &Rows<'_, R>, hits: &mut [bool]) -> Result<(), RowsError> {
        self.each_row(q, hits, |q| self.asked().intersects(&self.robot().footprint(q)))
    }

    /// [`distance`](Self::distance) of every row, metres, 0 in contact.
    ///
    /// # Errors
    /// As of [`are_free_into`](Self::are_free_into).
    pub fn distances_into(&self, q: &Rows<'_, R>, distances: &mut [f64]) -> Result<(), RowsError> {
        self.each_row(q, distances, |q| self.distance(q))
    }

    /// [`witness`](Self::witness) of every row; `None` in an empty scene.
    ///
    /// # Errors
    /// As of [`are_free_into`](Self::are_free_into).
    pub fn witnesses_into(&self, q: &Rows<'_, R>, witnesses: &mut [Option<Witness>]) -> Result<(), RowsError> {
        self.each_row(q, witnesses, |q| self.asked().witness(&self.robot().footprint(q)))
    }

    /// [`edge_free`](Self::edge_free) from every row of `from` to the same row of `to`.
    ///
    /// # Errors
    /// As of [`are_free_into`](Self::are_free_into); [`RowsError::Pairs`] too where the two differ in number.
    pub fn edges_free_into(&self, from: &Rows<'_, R>, to: &Rows<'_, R>, free: &mut [bool]) -> Result<(), RowsError> {
        self.each_pair(from, to, free, |a, b| self.edge_free(a, b))
    }

    /// [`edge`](Self::edge) from every row of `from` to the same row of `to`.
    ///
    /// # Errors
    /// As of [`edges_free_into`](Self::edges_free_into).
    pub fn edges_into(
        &self,
        from: &Rows<'_, R>,
        to: &Rows<'_, R>,
        verdicts: &mut [Result<EdgeVerdict, ConfigurationError>],
    ) -> Result<(), RowsError> {
        self.each_pair(from, to, verdicts, |a, b| self.edge(a, b))
    }

    fn each_row<T: Send>(
        &self,
        q: &Rows<'_, R>,
        answers: &mut [T],
        answer: impl Fn(&R::Configuration) -> T + Sync + Send,
    ) -> Result<(), RowsError> {
        fit(q.len(), answers.len())?;
        // each row was read before, when it was checked
        fill(answers, |i, place| {
            if let Some(q) = q.configuration(i) {
                *place = answer(&q);
            }
        });
        Ok(())
    }

    fn each_pair<T: Send>(
        &self,
        from: &Rows<'_, R>,
        to: &Rows<'_, R>,
        answers: &mut [T],
        answer: impl Fn(&R::Configuration, &R::Configuration) -> T + Sync + Send,
    ) -> Result<(), RowsError> {
        if from.len() != to.len() {
            return Err(RowsError::Pairs { from: from.len(), to: to.len() });
        }
        fit(from.len(), answers.len())?;
        fill(answers, |i, place| {
            if let (Some(a), Some(b)) = (from.configuration(i), to.configuration(i)) {
                *place = answer(&a, &b);
            }
        });
        Ok(())
    }
}

/// Refuses answers whose number is not that of their places.
fn fit(answers: usize, places: usize) -> Result<(), RowsError> {
    if answers == places { Ok(()) } else { Err(RowsError::Places { answers, places }) }
}
