//! `RunReading`, what conditions are about.

use crate::recording::{Recorder, RunError};
use crate::run::{Digest, Recipe, RobotStats, RunDigest, RunStats, StatsGatherer};
use motion_lab_core::configuration::Kinds;

/// What is read of a run for a condition.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RunReading {
    /// The stats of its robots, as far as they are asked for.
    pub stats: RunStats,
    /// Its digest, if it is asked for.
    pub digest: Option<Digest>,
}

impl RunReading {
    /// Simulates a run and reads it, with or without clearances and the digest, which take time. Asks `go_on` after
    /// each tick; `None` once it says no.
    pub(super) fn of(
        recipe: &Recipe,
        clearance: bool,
        digest: bool,
        mut go_on: impl FnMut() -> bool,
    ) -> Result<Option<Self>, RunError> {
        let kinds = Kinds::default();
        let mut run = Recorder::of(recipe)?.without_keyframes();
        let stats = StatsGatherer::new(&recipe.config, &recipe.script, &kinds);
        let mut stats = if clearance { stats } else { stats.without_clearance() };
        stats.see(run.frame());
        let mut hashed = digest.then(|| RunDigest::new(recipe, run.frame()));
        while !run.is_complete() {
            if !go_on() {
                return Ok(None);
            }
            let frame = run.step();
            stats.see(frame);
            if let Some(hashed) = &mut hashed {
                hashed.tick(frame);
            }
        }
        Ok(Some(RunReading { stats: stats.stats(), digest: hashed.map(|hashed| hashed.digest()) }))
    }

    /// The stats of the robot of this name.
    pub(super) fn robot(&self, name: &str) -> Option<&RobotStats> {
        self.stats.robots.iter().find(|robot| robot.name == name)
    }
}
