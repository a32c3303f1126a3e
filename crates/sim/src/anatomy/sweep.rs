//! The swept tab's answer: the verdict on the motion to a second configuration, and the proof.

use super::words::{figure, metres};
use motion_lab_core::collision::{Certificate, Checker, Collision, EdgeVerdict, HitBy, UnresolvedReason};
use motion_lab_core::configuration::{AnyConfiguration, Configuration};
use motion_lab_core::num::greater;
use motion_lab_core::robots::{AnyRobot, ConfigurationError, Motion, Robot};

/// The motion along the chart's straight line to a second configuration.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SweptMotion {
    /// The configuration at the start.
    pub from: AnyConfiguration,
    /// The configuration at the end.
    pub to: AnyConfiguration,
    /// Whether the start is free.
    pub from_free: bool,
    /// Whether the end is free.
    pub to_free: bool,
    /// The verdict.
    pub verdict: EdgeVerdict,
    /// The steps that prove the motion free, up to the bracket if it hits.
    pub certificate: Certificate,
    /// Largest motion of the footprint within the bracket of a hit or the unresolved rest, metres; 0 for a free motion.
    pub width: f64,
    /// The answer of the query `swept` between the two footprints. There each part's frame moves in a straight line,
    /// which for an arm is another motion.
    pub straight_hits: bool,
}

impl SweptMotion {
    /// The motion from `from` to `to`.
    ///
    /// # Errors
    /// [`ConfigurationError`] when either is not a configuration of the checker's robot.
    pub fn new(
        checker: &Checker<AnyRobot>,
        from: &AnyConfiguration,
        to: &AnyConfiguration,
    ) -> Result<Self, ConfigurationError> {
        let mut certificate = Certificate::new();
        let verdict = checker.edge_certified(from, to, &mut certificate)?;
        let line = checker.robot().edge(from, to)?;
        let (start, end) = (line.footprint_at(0.0), line.footprint_at(1.0));
        let width = match verdict {
            EdgeVerdict::Free { .. } => 0.0,
            EdgeVerdict::Hit { free_until, contact_at, .. } => {
                (0..start.parts().len()).fold(0.0, |w, part| greater(line.bound(part, free_until, contact_at), w))
            }
            EdgeVerdict::Unresolved { gap, .. } => gap,
        };
        Ok(SweptMotion {
            from: *from,
            to: *to,
            from_free: checker.is_free(from),
            to_free: checker.is_free(to),
            verdict,
            certificate,
            width,
            straight_hits: checker.scene().swept(&start, &end),
        })
    }

    /// The configuration a fraction `s` along the motion.
    pub fn at(&self, s: f64) -> AnyConfiguration {
        self.from.interpolate(&self.to, s).unwrap_or(self.from)
    }

    /// The answer in words, line by line. `name` gives an obstacle's name; the robot names its parts.
    pub(super) fn words(
        &self,
        name: impl Fn(motion_lab_core::collision::ObstacleId) -> String,
        robot: &AnyRobot,
    ) -> Vec<String> {
        let free = |free| if free { "free" } else { "in contact" };
        let steps = match self.certificate.steps().len() {
            1 => "1 step".to_owned(),
            n => format!("{n} steps"),
        };
        let mut lines = vec![format!("start {}, end {}", free(self.from_free), free(self.to_free))];
        match self.verdict {
            EdgeVerdict::Free { clearance } => {
                lines.push(format!("free all the way, at least {} clear", metres(clearance)));
                lines.push(format!("proven in {steps}"));
            }
            EdgeVerdict::Hit { free_until, contact_at, part, by } => {
                let (part, at) = (robot.part_name(part), figure(contact_at, 7));
                let (hits, there) = match by {
                    HitBy::Obstacle(id) => (format!("{part} hits {}", name(id)), format!("in contact at s = {at}")),
                    HitBy::Limit => (format!("the hitch holds {part}"), format!("beyond its limit at s = {at}")),
                };
                lines.push(hits);
                lines.push(format!("proven free to s = {}, {steps}", figure(free_until, 7)));
                lines.push(there);
                lines.push(format!("between the two at most {} \u{b5}m", figure(self.width * 1e6, 2)));
            }
            EdgeVerdict::Unresolved { free_until, gap, reason } => {
                let why = match reason {
                    UnresolvedReason::Tolerance => "the gap is below what rounding can tell from contact",
                    UnresolvedReason::Budget => "the steps ran out",
                };
                lines.push(format!("unresolved: {why}"));
                lines.push(format!("proven free to s = {}, {steps}", figure(free_until, 7)));
                lines.push(format!("not known: the last {}", metres(gap)));
            }
        }
        let straight = if self.straight_hits { "hits" } else { "is free" };
        lines.push(format!("each part in a straight line: {straight}"));
        lines
    }
}
