//! `RunParts`, what a run is made of, as JSON.

use serde::{Deserialize, Serialize};

use crate::run::{Recipe, Script, ScriptError};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{World, WorldError};

/// The parts of a run, as JSON. A page keeps them so that it can record the run again when the lab has stopped; builds
/// of the lab hand each other runs by them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunParts {
    /// The seed, in decimal.
    pub seed: String,
    /// World files.
    pub worlds: Vec<String>,
    /// The input script.
    pub script: String,
    /// The number of ticks. Input after them is left out.
    pub ticks: u64,
    /// The rays and the range of the range sensor, metres.
    pub sensor: Option<(u32, f64)>,
}

/// Why the parts of a run make none.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PartsError {
    /// Not a number from 0 to 2^64 - 1.
    #[error("{0}: not a seed")]
    Seed(String),
    /// A world file that is refused.
    #[error(transparent)]
    World(#[from] WorldError),
    /// A script that is refused.
    #[error(transparent)]
    Script(#[from] ScriptError),
}

impl RunParts {
    /// The parts of a recipe.
    pub fn of(recipe: &Recipe) -> Self {
        let Recipe { seed, config, script } = recipe;
        RunParts {
            seed: seed.to_string(),
            worlds: config.worlds.iter().map(World::to_ron).collect(),
            script: script.to_ron(),
            ticks: config.ticks,
            sensor: config.sensor.map(|s| (s.n_rays, s.max_range)),
        }
    }

    /// The recipe that these are the parts of.
    ///
    /// # Errors
    /// [`PartsError`] for the first part that is refused.
    pub fn recipe(&self) -> Result<Recipe, PartsError> {
        let seed = self.seed.parse().map_err(|_| PartsError::Seed(self.seed.clone()))?;
        let parse = |text: &String| World::parse_recorded("the world", text);
        let worlds = self.worlds.iter().map(parse).collect::<Result<_, _>>()?;
        let mut script = Script::parse("the script", &self.script)?;
        script.truncate_after(self.ticks);
        let sensor = self.sensor.map(|(n_rays, max_range)| RangeSensor { n_rays, max_range });
        Ok(Recipe::new(TourConfig { worlds, ticks: self.ticks, sensor }, (Seed(seed), script)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tour::BOOK_SEED;

    #[test]
    fn a_recipe_comes_back_from_its_parts_and_a_wrong_part_is_named() {
        let sensor = Some(RangeSensor { n_rays: 7, max_range: 0.1 + 0.2 });
        let recipe = Recipe::new(TourConfig { ticks: 5, sensor, ..TourConfig::default() }, BOOK_SEED);
        let parts = RunParts::of(&recipe);
        let json = serde_json::to_string(&parts).unwrap();
        assert_eq!(serde_json::from_str::<RunParts>(&json).unwrap().recipe().unwrap(), recipe);
        let refused = |parts: RunParts| parts.recipe().unwrap_err().to_string();
        assert_eq!(refused(RunParts { seed: "-1".into(), ..parts.clone() }), "-1: not a seed");
        assert!(refused(RunParts { worlds: vec!["(".into()], ..parts.clone() }).starts_with("the world:1:"));
        assert!(refused(RunParts { script: "(".into(), ..parts }).starts_with("the script:1:"));
    }
}
