//! `Certificate`, the proof that a motion is free. The verifier that accepts it is `verifier.rs`.

/// One proven step of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProvenStep {
    /// Where the step begins.
    pub from: f64,
    /// Where the step ends.
    pub to: f64,
    /// The clearance proven along it, metres.
    pub clearance: f64,
}

/// The steps that prove a motion free from 0 to [`proven_until`](Self::proven_until). Its memory can be reused between
/// edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Certificate {
    margin: f64,
    steps: Vec<ProvenStep>,
}

/// Why a certificate is not accepted.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CertificateError {
    /// A margin below 0 or not finite: what is above it need not be free.
    #[error("the margin is {0} m: it must be finite and not below 0 m")]
    Margin(f64),
    /// The steps do not begin at 0 or do not join.
    #[error("step {0} does not begin where the one before ends")]
    Broken(usize),
    /// A step that does not end after it begins, or that ends beyond 1.
    #[error("step {0} does not go forward within [0, 1]")]
    Backward(usize),
    /// A step that goes on after the motion has left its robot's own limits.
    #[error("step {step} goes beyond the robot's own limit, within which the motion is up to {within_until}")]
    BeyondLimit {
        /// The number of the step, from 0.
        step: usize,
        /// Where the motion leaves the limit.
        within_until: f64,
    },
    /// A step whose claimed clearance is more than the distance and the motion bound prove.
    #[error("step {step} claims {claimed} m of clearance, but only {proven} m are proven")]
    Unproven {
        /// The number of the step, from 0.
        step: usize,
        /// The clearance that the certificate claims, metres.
        claimed: f64,
        /// The clearance that the verifier proves, metres.
        proven: f64,
    },
}

impl Certificate {
    /// An empty certificate.
    pub fn new() -> Self {
        Self::default()
    }

    /// The clearance that every step must exceed, metres.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    pub(crate) fn clear(&mut self, margin: f64) {
        self.margin = margin;
        self.steps.clear();
    }

    /// Makes the steps of a motion's beginning, up to the parameter `until`, those of the whole motion.
    pub(crate) fn scale(&mut self, until: f64) {
        if until <= 0.0 {
            self.steps.clear();
        }
        for step in &mut self.steps {
            *step = ProvenStep { from: step.from * until, to: step.to * until, ..*step };
        }
    }

    pub(crate) fn push(&mut self, step: ProvenStep) {
        self.steps.push(step);
    }

    /// The steps in order.
    pub fn steps(&self) -> &[ProvenStep] {
        &self.steps
    }

    /// A certificate with these steps and this margin, to verify proofs made elsewhere.
    pub fn from_steps(margin: f64, steps: Vec<ProvenStep>) -> Self {
        Certificate { margin, steps }
    }

    /// Where the proof ends: 1 when the whole motion is proven free.
    pub fn proven_until(&self) -> f64 {
        self.steps.last().map_or(0.0, |s| s.to)
    }

    /// The clearance proven along all steps, metres; infinity without a step.
    pub fn clearance(&self) -> f64 {
        self.steps.iter().fold(f64::INFINITY, |c, s| crate::num::lesser(s.clearance, c))
    }
}
