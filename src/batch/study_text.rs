//! A study as written, and `Bundle`, a study with the contents of everything it names.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use xxhash_rust::xxh3::xxh3_128;

use super::points::Combinations;
use super::problem_set::ProblemBundle;
use super::values::Over;
use motion_lab_core::configuration::WrittenCoordinate;
use motion_lab_sim::run::Digest;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Sweep", deny_unknown_fields)]
pub(super) struct StudyText {
    pub version: u64,
    /// Built-in worlds or files, relative to the study's folder. Empty without a warehouse: the tour's three.
    #[serde(default)]
    pub worlds: Vec<String>,
    #[serde(default)]
    pub warehouse: Option<WarehouseText>,
    /// The robots that are kept; all of them where it is empty.
    #[serde(default)]
    pub robots: Vec<String>,
    /// The input script's file, relative to the study's folder; without one every robot tours.
    #[serde(default)]
    pub script: Option<String>,
    /// Who plans the way of the goal's robot, which then follows it; without one there is a script, or a tour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub planner: Option<PlannerText>,
    #[serde(default)]
    pub seed: Option<u64>,
    #[serde(default)]
    pub ticks: Option<TicksText>,
    #[serde(default)]
    pub sensor: Option<RunSensorText>,
    /// Rovers without the run's range sensor.
    #[serde(default)]
    pub no_sensor: bool,
    #[serde(default)]
    pub goal: Option<GoalText>,
    #[serde(default)]
    pub axes: Vec<AxisText>,
    #[serde(default)]
    pub points: Combinations,
}

impl StudyText {
    /// Whether its worlds are those of its problems.
    pub fn has_filed_problems(&self) -> bool {
        self.axes.iter().any(|axis| axis.over.problem_file().is_some_and(|(_, is_filed)| is_filed))
    }

    /// Whether a robot of this name takes part.
    pub fn keeps(&self, robot: &str) -> bool {
        self.robots.is_empty() || self.robots.iter().any(|kept| kept == robot)
    }
}

/// The length of a run, as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a number of ticks, or Planned")]
pub(super) enum TicksText {
    Ticks(u64),
    Named(NamedLength),
}

/// A length by a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum NamedLength {
    /// As long as the script that plays the planner's path.
    Planned,
}

/// A planner of `motion-lab plan`, and what it may do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlannerText {
    /// Its name; the usual one of the robot where it is left out.
    #[serde(default)]
    pub name: Option<String>,
    /// The greatest number of iterations.
    #[serde(default)]
    pub iterations: Option<u64>,
    /// How much larger a rover is planned, metres.
    #[serde(default = "two_centimetres")]
    pub tube: f64,
    /// The clearance that the path is to keep, metres; no field of the line where none is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clearance: Option<f64>,
}

fn two_centimetres() -> f64 {
    0.02
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WarehouseText {
    pub robots: u64,
    #[serde(default = "one")]
    pub seed: u64,
    #[serde(default)]
    pub trailers: bool,
}

fn one() -> u64 {
    1
}

/// The range sensor that a run gives its rovers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RunSensorText {
    pub rays: u32,
    pub range: f64,
}

/// Where a robot should be, with a tolerance for each coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalText {
    pub robot: String,
    pub at: Vec<WrittenCoordinate>,
    pub within: Vec<WrittenCoordinate>,
}

impl GoalText {
    /// The configuration.
    pub fn at(&self) -> Vec<f64> {
        self.at.iter().map(|coordinate| coordinate.value()).collect()
    }

    /// The tolerances.
    pub fn within(&self) -> Vec<f64> {
        self.within.iter().map(|coordinate| coordinate.value()).collect()
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisText {
    /// The parameter's name.
    pub vary: String,
    /// Its values, which may be many: the study and its checked axes share them.
    #[serde(deserialize_with = "shared", serialize_with = "unshared")]
    pub over: Arc<Over>,
}

fn shared<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<Over>, D::Error> {
    Over::deserialize(deserializer).map(Arc::new)
}

fn unshared<S: Serializer>(over: &Arc<Over>, serializer: S) -> Result<S::Ok, S::Error> {
    over.as_ref().serialize(serializer)
}

/// An item of a study that an error is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StudyItem {
    Version,
    Robots,
    Goal,
    Planner,
    Points,
    Axis(usize),
    Whole,
}

/// What a bundle begins with.
pub(super) const FORMAT: &str = "motion-lab sweep 1";

/// A study with the canonical texts of its worlds, scripts and scenarios, by the names it gives them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Bundle {
    pub format: String,
    #[serde(rename = "plan")]
    pub study: StudyText,
    pub worlds: BTreeMap<String, String>,
    pub scripts: BTreeMap<String, String>,
    /// The scenarios of its problems, a field of the line only where there are some.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub scenarios: BTreeMap<String, String>,
    /// The problem files, likewise.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub problems: BTreeMap<String, ProblemBundle>,
}

/// The digest of a bundle's line: equal digests mean equal sweeps.
pub(super) fn digest_of(line: &str) -> Digest {
    Digest(xxh3_128(line.as_bytes()))
}
