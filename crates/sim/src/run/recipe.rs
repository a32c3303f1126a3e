//! `Recipe`, what a run is.

use std::sync::Arc;

use super::Script;
use crate::tour::{BOOK_SEED, TourConfig};
use motion_lab_core::random::Seed;

/// What a run is: one recipe gives one run, to the last bit, wherever and whenever it is simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// The seed.
    pub seed: Seed,
    /// The settings, with the worlds themselves.
    pub config: Arc<TourConfig>,
    /// The inputs.
    pub script: Script,
}

impl Recipe {
    /// The recipe of these settings with a seed, a script (at the book's seed), or both.
    ///
    /// ```
    /// use motion_lab_core::random::Seed;
    /// use motion_lab_sim::run::{Recipe, Script};
    /// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
    /// let recipe = Recipe::new(TourConfig::default(), Seed(7));
    /// assert!(recipe.seed == Seed(7) && recipe.script == Script::empty());
    /// assert_eq!(Recipe::new(TourConfig::default(), Script::empty()).seed, BOOK_SEED);
    /// ```
    pub fn new(config: impl Into<Arc<TourConfig>>, input: impl Into<RunInput>) -> Self {
        let RunInput { seed, script } = input.into();
        Recipe { seed, config: config.into(), script }
    }

    /// The number of inputs: events of robots and changes of worlds.
    pub fn inputs(&self) -> usize {
        self.script.events.len() + self.script.changes.len()
    }
}

/// The input of a run beside its settings: a seed, a script, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct RunInput {
    /// The seed.
    pub seed: Seed,
    /// The script.
    pub script: Script,
}

impl From<Seed> for RunInput {
    fn from(seed: Seed) -> Self {
        RunInput { seed, script: Script::empty() }
    }
}

impl From<(Seed, Script)> for RunInput {
    fn from((seed, script): (Seed, Script)) -> Self {
        RunInput { seed, script }
    }
}

/// A script alone runs at the book's seed.
impl From<Script> for RunInput {
    fn from(script: Script) -> Self {
        RunInput { seed: BOOK_SEED, script }
    }
}
