//! A problem file as written.

use serde::{Deserialize, Serialize};

use motion_lab_core::configuration::WrittenCoordinate;
use motion_lab_sim::problems::ProblemGenerator;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Problems", deny_unknown_fields)]
pub(super) struct ProblemsText {
    pub version: u64,
    pub sets: Vec<SetText>,
}

/// A set of problems.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum SetText {
    /// From the first start to the first goal, from the second to the second, and so on.
    Paired(EndsText),
    /// From each start to each goal; the goal changes with every problem.
    Crossed(EndsText),
    /// The problems of a MovingAI scenario.
    Scenario(ScenarioText),
    /// Problems by a seed.
    Generated(GeneratedText),
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EndsText {
    #[serde(default)]
    pub name: Option<String>,
    /// A built-in world, or a file relative to the problem file's folder.
    pub world: String,
    /// A resident of the world, or a kind.
    pub robot: String,
    pub starts: Vec<Vec<WrittenCoordinate>>,
    pub goals: Vec<Vec<WrittenCoordinate>>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ScenarioText {
    #[serde(default)]
    pub name: Option<String>,
    /// The scenario's file.
    pub file: String,
    /// The world that was made of its map.
    pub world: String,
    pub robot: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GeneratedText {
    #[serde(default)]
    pub name: Option<String>,
    pub of: ProblemGenerator,
    pub count: u64,
    #[serde(default = "one")]
    pub seed: u64,
}

fn one() -> u64 {
    1
}

impl SetText {
    /// The name that is written.
    pub fn written_name(&self) -> Option<&str> {
        match self {
            SetText::Paired(EndsText { name, .. })
            | SetText::Crossed(EndsText { name, .. })
            | SetText::Scenario(ScenarioText { name, .. })
            | SetText::Generated(GeneratedText { name, .. }) => name.as_deref(),
        }
    }

    /// The name that is written, else what its problems come from.
    pub fn name(&self) -> &str {
        let from = match self {
            SetText::Paired(EndsText { world, .. }) | SetText::Crossed(EndsText { world, .. }) => world,
            SetText::Scenario(ScenarioText { file, .. }) => file,
            SetText::Generated(GeneratedText { of, .. }) => of.name(),
        };
        self.written_name().unwrap_or(from)
    }
}
