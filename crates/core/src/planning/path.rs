//! `CertifiedPath`, a path with the certificate of its whole length, and `UnprovenPath`, which is only called free.

use super::Metric;
use crate::collision::{Certificate, CertificateError, Checker, Collision, EdgeVerdict, verify_certificate};
use crate::configuration::{Chart, Configuration};
use crate::num::lesser;
use crate::robots::{ChartLine, ConfigurationError, Motion, Robot};

/// A leg of a path: a motion and the certificate that proves it free from its start to its end.
#[derive(Clone, Debug)]
pub struct Leg<M> {
    motion: M,
    certificate: Certificate,
}

impl<M> Leg<M> {
    /// The motion.
    pub fn motion(&self) -> &M {
        &self.motion
    }

    /// The certificate.
    pub fn certificate(&self) -> &Certificate {
        &self.certificate
    }
}

/// A path that is proven free along its whole length: legs that join, each with its certificate.
///
/// There is no way to make one without the proof. `M` is the type of its legs: the chart's straight lines, or what a
/// car drives under a constant control.
#[derive(Clone, Debug)]
pub struct CertifiedPath<M> {
    legs: Vec<Leg<M>>,
}

/// A path of straight lines in a robot's chart.
pub type LinePath<R> = CertifiedPath<ChartLine<R>>;

/// Why a path is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathError {
    /// A path without a leg.
    #[error("the path has no leg")]
    Empty,
    /// A configuration that is not one of the robot's.
    #[error("corner {corner}: {source}")]
    Configuration {
        /// The number of the corner at which the leg with it begins, from 0.
        corner: usize,
        /// What is wrong with it.
        source: ConfigurationError,
    },
    /// A leg that does not begin where the one before ends, bit for bit.
    #[error("leg {0} does not begin where the one before ends")]
    Broken(usize),
    /// A leg that is not proven free.
    #[error("leg {leg} is not proven free{}", why(verdict, obstacle.as_deref()))]
    NotFree {
        /// The number of the leg, from 0.
        leg: usize,
        /// What is known of it.
        verdict: EdgeVerdict,
        /// The name of the obstacle that it hits; `None` where it hits none.
        obstacle: Option<String>,
    },
    /// A leg whose certificate the verifier refuses.
    #[error("leg {leg}: {source}")]
    Certificate {
        /// The number of the leg, from 0.
        leg: usize,
        /// Why it is refused.
        source: CertificateError,
    },
    /// A leg whose certificate ends before the leg does.
    #[error("leg {leg} is proven up to {until} only")]
    Short {
        /// The number of the leg, from 0.
        leg: usize,
        /// Where its proof ends, in `[0, 1]`.
        until: f64,
    },
    /// A leg that leaves the bounds of the problem's scene.
    #[error("leg {0} leaves the world's bounds")]
    Outside(usize),
    /// A path that does not lead from the problem's start to its goal.
    #[error("the path does not lead from the start to the goal")]
    OtherEnds,
    /// A leg that the checker does not call free.
    #[error("leg {0} is not called free")]
    Refused(usize),
    /// A path that a black box calls free: there is no certificate.
    #[error("a black box calls it free, and nothing of it is proven")]
    Unproven,
    /// No path, although the planner says that it has one.
    #[error("there is none")]
    Missing,
}

/// Why a leg is not free, as far as its verdict says.
fn why(verdict: &EdgeVerdict, obstacle: Option<&str>) -> String {
    match (verdict, obstacle) {
        (EdgeVerdict::Hit { .. }, Some(name)) => format!(": it hits {name}"),
        (EdgeVerdict::Hit { .. }, None) => ": it leaves the robot's own limits".to_owned(),
        _ => String::new(),
    }
}

impl<M: Motion> CertifiedPath<M> {
    /// The path of these motions, with a certificate for each.
    ///
    /// # Errors
    /// [`PathError`]: no motion, motions that do not join, or one that is not proven free.
    pub fn try_new<R: Robot<Configuration = M::Configuration>>(
        checker: &Checker<R>,
        motions: impl IntoIterator<Item = M>,
    ) -> Result<Self, PathError> {
        let mut legs: Vec<Leg<M>> = Vec::new();
        for (leg, motion) in motions.into_iter().enumerate() {
            if legs.last().is_some_and(|before| before.motion.at(1.0) != motion.at(0.0)) {
                return Err(PathError::Broken(leg));
            }
            let mut certificate = Certificate::new();
            let verdict = checker.motion_certified(&motion, &mut certificate);
            if !verdict.is_free() {
                let EdgeVerdict::Hit { by, .. } = verdict else {
                    return Err(PathError::NotFree { leg, verdict, obstacle: None });
                };
                let obstacle = by.obstacle().and_then(|id| checker.scene().obstacle_name(id)).map(str::to_owned);
                return Err(PathError::NotFree { leg, verdict, obstacle });
            }
            legs.push(Leg { motion, certificate });
        }
        if legs.is_empty() { Err(PathError::Empty) } else { Ok(CertifiedPath { legs }) }
    }

    /// The path of these legs, at least one, which join.
    pub(super) fn of_legs(legs: Vec<Leg<M>>) -> Self {
        CertifiedPath { legs }
    }

    pub(super) fn into_legs(self) -> Vec<Leg<M>> {
        self.legs
    }

    /// The legs, at least one.
    pub fn legs(&self) -> &[Leg<M>] {
        &self.legs
    }

    /// Where the path begins.
    pub fn start(&self) -> M::Configuration {
        self.legs[0].motion.at(0.0)
    }

    /// Where the path ends.
    pub fn goal(&self) -> M::Configuration {
        self.legs[self.legs.len() - 1].motion.at(1.0)
    }

    /// The corners: the start, and the end of each leg.
    pub fn corners(&self) -> Vec<M::Configuration> {
        std::iter::once(self.start()).chain(self.legs.iter().map(|leg| leg.motion.at(1.0))).collect()
    }

    /// The clearance proven along the whole path, metres; infinity in an empty scene.
    pub fn clearance(&self) -> f64 {
        self.legs.iter().fold(f64::INFINITY, |least, leg| lesser(leg.certificate.clearance(), least))
    }

    /// Checks the certificates by [`verify_certificate`], and that the legs join.
    /// Returns the proven clearance, metres.
    ///
    /// # Errors
    /// [`PathError`] names the first leg that is not proven.
    pub fn verify(&self, collision: &dyn Collision) -> Result<f64, PathError> {
        for (number, leg) in self.legs.iter().enumerate() {
            if number > 0 && self.legs[number - 1].motion.at(1.0) != leg.motion.at(0.0) {
                return Err(PathError::Broken(number));
            }
            let until = verify_certificate(collision, &leg.motion, &leg.certificate)
                .map_err(|source| PathError::Certificate { leg: number, source })?;
            if until != 1.0 {
                return Err(PathError::Short { leg: number, until });
            }
        }
        Ok(self.clearance())
    }
}

/// A path that a checker calls free along every leg, such as one with a
/// [black box](crate::collision::Checker::with_black_box). Nothing of it is proven: it has neither a certificate nor a
/// clearance, and it may lead through a wall.
#[derive(Clone, Debug)]
pub struct UnprovenPath<M> {
    motions: Vec<M>,
}

impl<M: Motion> UnprovenPath<M> {
    /// The path of these motions, if the checker calls each of them free.
    ///
    /// # Errors
    /// [`PathError`]: no motion, motions that do not join, or one that is not called free.
    pub fn try_new<R: Robot<Configuration = M::Configuration>>(
        checker: &Checker<R>,
        motions: Vec<M>,
    ) -> Result<Self, PathError> {
        if motions.is_empty() {
            return Err(PathError::Empty);
        }
        for (leg, motion) in motions.iter().enumerate() {
            if leg > 0 && motions[leg - 1].at(1.0) != motion.at(0.0) {
                return Err(PathError::Broken(leg));
            }
            if !checker.motion_free(motion) {
                return Err(PathError::Refused(leg));
            }
        }
        Ok(UnprovenPath { motions })
    }

    /// The legs' motions, at least one.
    pub fn motions(&self) -> &[M] {
        &self.motions
    }

    /// Where the path begins.
    pub fn start(&self) -> M::Configuration {
        self.motions[0].at(0.0)
    }

    /// Where the path ends.
    pub fn goal(&self) -> M::Configuration {
        self.motions[self.motions.len() - 1].at(1.0)
    }

    /// The corners: the start, and the end of each leg.
    pub fn corners(&self) -> Vec<M::Configuration> {
        std::iter::once(self.start()).chain(self.motions.iter().map(|motion| motion.at(1.0))).collect()
    }
}

impl<M: Motion + Clone> UnprovenPath<M> {
    /// The same path with its proof by the checker's exact scene, if it has one.
    ///
    /// # Errors
    /// [`PathError::NotFree`] says which leg is not proven free, where it hits and what.
    pub fn certified<R: Robot<Configuration = M::Configuration>>(
        &self,
        checker: &Checker<R>,
    ) -> Result<CertifiedPath<M>, PathError> {
        CertifiedPath::try_new(checker, self.motions.iter().cloned())
    }
}

/// The chart's straight lines through these corners; of a single corner the line that stays there.
pub(super) fn chart_lines<R: Robot>(
    checker: &Checker<R>,
    corners: &[R::Configuration],
) -> Result<Vec<ChartLine<R>>, PathError> {
    let line =
        |corner: usize, a, b| checker.robot().edge(a, b).map_err(|source| PathError::Configuration { corner, source });
    match corners {
        [] => Err(PathError::Empty),
        [only] => line(0, only, only).map(|line| vec![line]),
        _ => corners.windows(2).enumerate().map(|(i, ends)| line(i, &ends[0], &ends[1])).collect(),
    }
}

impl<R: Robot> CertifiedPath<ChartLine<R>> {
    /// The path of the chart's straight lines through these corners. A single corner gives the path that stays there.
    ///
    /// # Errors
    /// [`PathError`]: no corner, one that is not a configuration of the robot, or a line that is not proven free.
    pub fn through(checker: &Checker<R>, corners: &[R::Configuration]) -> Result<Self, PathError> {
        Self::try_new(checker, chart_lines(checker, corners)?)
    }

    /// The length of the path by a metric.
    pub fn length(&self, metric: &Metric) -> f64
    where
        R::Configuration: Chart,
    {
        self.legs.iter().map(|leg| metric.distance(&leg.motion.at(0.0), &leg.motion.at(1.0))).sum()
    }
}

/// Whether two configurations are one, their angles in range.
pub fn is_same<C: Configuration>(a: &C, b: &C) -> bool {
    a.in_chart() == b.in_chart()
}
