//! `ProblemBundle`, a problem file with the contents of everything it names.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::set::ProblemSet;
use super::text::{ProblemsText, SetText};
use motion_lab_core::worlds::World;
use motion_lab_import::Scenario;

/// A problem file with the canonical texts of its worlds and scenarios, by the names it gives them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProblemBundle {
    pub(super) file: ProblemsText,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) worlds: BTreeMap<String, String>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) scenarios: BTreeMap<String, String>,
}

impl ProblemBundle {
    /// The problems.
    ///
    /// # Errors
    /// The reason, in words, against a set that can't be.
    pub fn set(&self) -> Result<ProblemSet, String> {
        self.made().map_err(|(i, reason)| match i.and_then(|i| self.file.sets.get(i)) {
            Some(set) => format!("{:?}: {reason}", SetText::name(set)),
            None => reason,
        })
    }

    /// The problems, or the set that can't be and why; no set where what they name can't be read.
    pub(super) fn made(&self) -> Result<ProblemSet, (Option<usize>, String)> {
        if self.file.sets.is_empty() {
            return Err((None, "it has no set of problems".into()));
        }
        let mut worlds = BTreeMap::new();
        for (name, text) in &self.worlds {
            let world = World::parse_recorded(name, text).map_err(|error| (None, error.to_string()))?;
            worlds.insert(name.clone(), world);
        }
        let mut scenarios = BTreeMap::new();
        for (name, text) in &self.scenarios {
            let scenario = Scenario::parse(name, text).map_err(|error| (None, error.to_string()))?;
            scenarios.insert(name.clone(), Arc::new(scenario));
        }
        ProblemSet::of_texts(&self.file.sets, &worlds, &scenarios).map_err(|(i, reason)| (Some(i), reason))
    }
}
