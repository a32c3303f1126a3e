//! Shorter and smoother paths that keep their certificates, and a margin.

use std::ops::RangeInclusive;

use super::path::Leg;
use super::{LinePath, Metric, PathError};
use crate::collision::Checker;
use crate::configuration::Chart;
use crate::num::lesser;
use crate::random::Stream;
use crate::robots::{ChartLine, Motion, Robot};

/// The clearance that shortcuts keep wherever what they replace has as much, metres, and that a [`VisibilityGraph`]
/// keeps about corners: far above the rounding of a clearance, so what is proven of a path is a number that a table
/// shows. More is kept in a scene whose obstacles are [larger](crate::collision::Scene::grown).
///
/// [`VisibilityGraph`]: super::VisibilityGraph
pub const MARGIN: f64 = 1e-3;

/// How often the cut at a corner is halved before the corner stays.
const HALVINGS: u32 = 4;

/// A place on a path: the number of a leg, and the parameter along it.
#[derive(Clone, Copy, Debug)]
struct LegParameter {
    leg: usize,
    s: f64,
}

impl<R: Robot<Configuration: Chart>> LinePath<R> {
    /// The path without the corners that it can do without: a corner goes where the edge between its neighbours is
    /// proven free and shorter. Never longer by the metric, and certified; it keeps the [`MARGIN`] where the path does.
    #[must_use]
    pub fn pruned(&self, checker: &Checker<R>, metric: &Metric) -> Self {
        let mut draft = PathDraft::of(self, checker, metric);
        let mut leg = 0;
        while leg + 1 < draft.legs.len() {
            if draft.join(LegParameter { leg, s: 0.0 }, LegParameter { leg: leg + 1, s: 1.0 }) {
                // the corner before may go now
                leg = leg.saturating_sub(1);
            } else {
                leg += 1;
            }
        }
        Self::of_legs(draft.legs)
    }

    /// The path after this many tries to join two of its places, drawn uniformly along it, by a straight edge. Never
    /// longer by the metric, and certified; it keeps the [`MARGIN`] where the path does.
    ///
    /// ```
    /// use motion_lab_core::planning::{Bounds, Metric, RrtConnect, solve};
    /// use motion_lab_core::prelude::*;
    /// let checker = ChainChecker::new(Scene::workbench(), Reach::<2>::workbench());
    /// let problem = Problem::try_new(checker.clone(), T2::new(2.0, 0.0), T2::new(3.1, 0.0), Seed(7))?;
    /// let path = solve(&mut RrtConnect::new(problem), &Bounds::default())?;
    /// let metric = Metric::unit(&path.start());
    /// let short = path.shortcut(&checker, &metric, &mut Stream::new(Seed(7), "shortcut"), 100);
    /// assert!(short.length(&metric) <= path.length(&metric));
    /// assert!(short.verify(checker.scene())? > 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn shortcut(&self, checker: &Checker<R>, metric: &Metric, stream: &mut Stream, tries: u32) -> Self {
        let mut draft = PathDraft::of(self, checker, metric);
        for _ in 0..tries {
            let (a, b) = (stream.unit(), stream.unit());
            let [from, to] = [lesser(a, b), if a < b { b } else { a }].map(|share| draft.place(share));
            draft.join(from, to);
        }
        Self::of_legs(draft.legs)
    }

    /// The path with its corners cut, this many times over: each cut replaces a corner by two of wider angles. Never
    /// longer by the metric, and certified; it keeps the [`MARGIN`] where the path does.
    #[must_use]
    pub fn smoothed(&self, checker: &Checker<R>, metric: &Metric, rounds: u32) -> Self {
        let mut draft = PathDraft::of(self, checker, metric);
        for _ in 0..rounds {
            let mut leg = 0;
            while leg + 1 < draft.legs.len() {
                leg += if draft.cut(leg) { 2 } else { 1 };
            }
        }
        Self::of_legs(draft.legs)
    }
}

/// The number of shortcuts that [`LinePath::shortened`] tries.
const SHORTCUTS: u32 = 200;

/// The greatest number of its rounds of corners that are cut.
const ROUNDS: u32 = 4;

/// The least by which such a round shortens the path, by the metric, for its corners to be worth their number.
const LEAST_GAIN: f64 = 1e-4;

impl<R: Robot<Configuration: Chart>> LinePath<R> {
    /// The path [pruned](Self::pruned), with 200 [shortcuts](Self::shortcut), pruned again and
    /// [smoothed](Self::smoothed) up to four times over, as long as that makes it shorter by 1e-4. Never longer by the
    /// metric, and certified; it keeps the [`MARGIN`] where the path does.
    #[must_use]
    pub fn shortened(&self, checker: &Checker<R>, metric: &Metric, stream: &mut Stream) -> Self {
        let cut = self.pruned(checker, metric).shortcut(checker, metric, stream, SHORTCUTS);
        let mut shortest = cut.pruned(checker, metric);
        for _ in 0..ROUNDS {
            let smooth = shortest.smoothed(checker, metric, 1);
            if shortest.length(metric) - smooth.length(metric) < LEAST_GAIN {
                break;
            }
            shortest = smooth;
        }
        shortest
    }
}

struct PathDraft<'a, R: Robot> {
    checker: &'a Checker<R>,
    metric: &'a Metric,
    legs: Vec<Leg<ChartLine<R>>>,
}

impl<'a, R: Robot<Configuration: Chart>> PathDraft<'a, R> {
    fn of(path: &LinePath<R>, checker: &'a Checker<R>, metric: &'a Metric) -> Self {
        PathDraft { checker, metric, legs: path.legs().to_vec() }
    }

    fn at(&self, place: LegParameter) -> R::Configuration {
        self.legs[place.leg].motion().at(place.s)
    }

    fn length(&self, leg: usize) -> f64 {
        self.metric.distance(&self.at(LegParameter { leg, s: 0.0 }), &self.at(LegParameter { leg, s: 1.0 }))
    }

    /// The place at a share of the path's length.
    fn place(&self, share: f64) -> LegParameter {
        let total: f64 = (0..self.legs.len()).map(|leg| self.length(leg)).sum();
        let mut rest = share * total;
        for leg in 0..self.legs.len() {
            let length = self.length(leg);
            if rest < length {
                return LegParameter { leg, s: rest / length };
            }
            rest -= length;
        }
        LegParameter { leg: self.legs.len() - 1, s: 1.0 }
    }

    /// Joins two places by a straight edge, if all that is new is proven free and it shortens the path.
    fn join(&mut self, from: LegParameter, to: LegParameter) -> bool {
        if from.leg >= to.leg {
            return false;
        }
        let (start, end) = (LegParameter { s: 0.0, ..from }, LegParameter { s: 1.0, ..to });
        let mut corners = vec![self.at(start)];
        for (place, is_corner) in [(from, from.s == 0.0), (to, to.s == 1.0), (end, false)] {
            let q = self.at(place);
            if !is_corner && corners.last() != Some(&q) {
                corners.push(q);
            }
        }
        let shorter: f64 = corners.windows(2).map(|ends| self.metric.distance(&ends[0], &ends[1])).sum();
        let present: f64 = (from.leg..=to.leg).map(|leg| self.length(leg)).sum();
        if shorter >= present || !self.checker.edge_free(&self.at(from), &self.at(to)) {
            return false;
        }
        match self.through(&corners, self.clearance_of(from.leg..=to.leg)) {
            Ok(path) => {
                self.legs.splice(from.leg..=to.leg, path.into_legs()).for_each(drop);
                true
            }
            Err(_) => false,
        }
    }

    /// The clearance that what replaces these legs is to keep, metres: the margin where they have it, else theirs.
    fn clearance_of(&self, legs: RangeInclusive<usize>) -> f64 {
        let proven = |leg: &Leg<ChartLine<R>>| leg.certificate().clearance();
        let least = self.legs[legs.clone()].iter().fold(f64::INFINITY, |least, leg| lesser(proven(leg), least));
        // a certificate may prove less than there is
        let has_margin = least >= MARGIN || {
            let motions = self.legs[legs].iter().map(|leg| leg.motion().clone());
            LinePath::try_keeping(self.checker, motions, MARGIN).is_ok()
        };
        if has_margin { MARGIN } else { least }
    }

    /// The path through these corners, if it is proven to keep a clearance.
    fn through(&self, corners: &[R::Configuration], kept: f64) -> Result<LinePath<R>, PathError> {
        let path = LinePath::through(self.checker, corners)?;
        if path.clearance() >= kept {
            return Ok(path);
        }
        LinePath::try_keeping(self.checker, path.into_legs().into_iter().map(|leg| leg.motion().clone()), kept)
    }

    /// Cuts the corner at the end of a leg.
    fn cut(&mut self, leg: usize) -> bool {
        let [before, after] = [leg, leg + 1].map(|leg| self.length(leg));
        let mut far = 0.5 * lesser(before, after);
        for _ in 0..HALVINGS {
            if self.join(LegParameter { leg, s: 1.0 - far / before }, LegParameter { leg: leg + 1, s: far / after }) {
                return true;
            }
            far *= 0.5;
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::Scene;
    use crate::configuration::R2;
    use crate::geometry::{Aabb, Point2};
    use crate::robots::RustyDisc;

    #[test]
    fn a_place_on_a_path_is_as_far_along_it_as_its_share() {
        let bounds = Aabb { min: Point2::new(-9.0, -9.0), max: Point2::new(9.0, 9.0) };
        let checker = Checker::new(Scene::empty(bounds), RustyDisc::default());
        // 2 m, 1 m and 3 m
        let corners = [R2::new(0.0, 0.0), R2::new(2.0, 0.0), R2::new(2.0, 1.0), R2::new(-1.0, 1.0)];
        let path = LinePath::through(&checker, &corners).unwrap();
        let metric = Metric::unit(&corners[0]);
        let draft = PathDraft::of(&path, &checker, &metric);
        for (share, leg, s) in [(0.0, 0, 0.0), (0.25, 0, 0.75), (2.5 / 6.0, 1, 0.5), (0.75, 2, 0.5), (1.0, 2, 1.0)] {
            let place = draft.place(share);
            assert!(place.leg == leg && (place.s - s).abs() < 1e-12, "{share}: {place:?}");
        }
    }
}
