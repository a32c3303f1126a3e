//! `ExactAnswer`, what the exact checker says of a path that a black box calls free.

use std::fmt::{Display, Formatter};

use crate::capture::proven;
use motion_lab_core::collision::Scene;
use motion_lab_core::planning::PathError;
use motion_lab_sim::export::JsonNumber;
use serde::Serialize;

use crate::cli::commands::query::{EdgeAnswer, edge};

/// What the exact checker says of a path that a black box calls free.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum ExactAnswer {
    /// The whole path is free.
    Free { edge: &'static str, clearance: JsonNumber },
    /// The leg of this number, from 0, is not proven free.
    Leg {
        leg: usize,
        #[serde(flatten)]
        verdict: EdgeAnswer,
    },
    /// The path is refused for another reason.
    Refused { reason: String },
}

impl ExactAnswer {
    /// What the scene says: the clearance that it proves, or why it proves none.
    pub fn of(scene: &Scene, judged: Result<f64, PathError>) -> Self {
        match judged {
            Ok(clearance) => ExactAnswer::Free { edge: "free", clearance: JsonNumber(clearance) },
            Err(PathError::NotFree { leg, verdict, .. }) => ExactAnswer::Leg { leg, verdict: edge(scene, verdict) },
            Err(other) => ExactAnswer::Refused { reason: other.to_string() },
        }
    }
}

impl Display for ExactAnswer {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            ExactAnswer::Free { clearance, .. } => {
                write!(f, "free, with a clearance of {} m proven along the whole path", proven(clearance.0))
            }
            ExactAnswer::Leg { leg, verdict: EdgeAnswer::Hit { free_until, obstacle, .. } } => {
                let what = obstacle.as_deref().unwrap_or("the robot's own limit");
                write!(f, "leg {leg} hits {what}, at {:.4} of its length", free_until.0)
            }
            ExactAnswer::Leg { leg, .. } => write!(f, "leg {leg} is not proven free"),
            ExactAnswer::Refused { reason } => write!(f, "{reason}"),
        }
    }
}
