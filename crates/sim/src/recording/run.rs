//! `Run`, recording and replaying of whole runs.

use std::sync::Arc;

use bevy::app::App;

use super::{Recorder, RunError};
use crate::run::{DIGEST_TICKS, Frame, Log, LogKind, Recipe, Recorded, RunDigest, RunInput, SecondDigests};
use crate::tour::TourConfig;

/// Records and replays whole runs.
#[derive(Clone, Copy, Debug)]
pub struct Run;

impl Run {
    /// Runs `config` for its ticks and returns the log. The input is a seed, a script (at the book's seed), or both.
    ///
    /// # Errors
    /// [`RunError`] names the invalid part of the configuration or the script; [`RunError::Frames`] is that of a run
    /// whose frames would take more than [`MAX_FRAME_BYTES`](super::MAX_FRAME_BYTES).
    pub fn record(config: impl Into<Arc<TourConfig>>, input: impl Into<RunInput>) -> Result<Log, RunError> {
        Self::record_with_robots(config, input, |_| {})
    }

    /// [`record`](Self::record) with further kinds of robots. Sensors that `add`'s observers spawn on robots are in the
    /// log's configuration, so the run needs no program to be run again.
    ///
    /// # Errors
    /// [`RunError`] names the invalid part of the configuration or the script.
    pub fn record_with_robots(
        config: impl Into<Arc<TourConfig>>,
        input: impl Into<RunInput>,
        add: impl FnOnce(&mut App),
    ) -> Result<Log, RunError> {
        Self::record_recipe(Recipe::new(config, input), LogKind::Frames, add)
    }

    /// The log of a recipe's run, of this kind, with further kinds of robots.
    ///
    /// # Errors
    /// [`RunError`] names the invalid part of the configuration or the script.
    pub fn record_recipe(recipe: Recipe, kind: LogKind, add: impl FnOnce(&mut App)) -> Result<Log, RunError> {
        let mut recorder = Recorder::of_with_robots(&recipe, add)?.without_keyframes();
        let recipe = Recipe { config: recorder.shared_config(), ..recipe };
        let ticks = recipe.config.ticks;
        if kind == LogKind::Frames {
            let initial = recorder.frame().clone();
            let frames = recorder.frames(ticks)?;
            return Ok(Log::with_frames(recipe, initial, frames));
        }
        let mut run = RunDigest::new(&recipe, recorder.frame());
        let (start, mut digests) = (run.lower_half(), Vec::new());
        for tick in 1..=ticks {
            run.tick(recorder.step());
            if tick == ticks || tick.is_multiple_of(DIGEST_TICKS) {
                digests.push(run.lower_half());
            }
        }
        let digests = SecondDigests { start, digests, ticks, whole: Some(run.digest()) };
        Ok(Log { recipe, recorded: Recorded::Digests(digests) })
    }

    /// Simulates a log's run again and returns the frames from tick 1 to the last. It uses the log's seed,
    /// configuration and script, not its frames.
    ///
    /// # Errors
    /// [`RunError`] when the log's configuration or script cannot be run.
    pub fn replay(log: &Log) -> Result<Vec<Frame>, RunError> {
        Self::replay_with_robots(log, |_| {})
    }

    /// [`replay`](Self::replay) with further kinds of robots.
    ///
    /// # Errors
    /// [`RunError`] when the log's configuration or script cannot be run.
    pub fn replay_with_robots(log: &Log, add: impl FnOnce(&mut App)) -> Result<Vec<Frame>, RunError> {
        let mut recorder = Recorder::of_with_robots(&log.recipe, add)?.without_keyframes();
        recorder.frames(log.recipe.config.ticks)
    }

    /// Calls `watch` with the run in the state of each of the log's frames, from tick 0 on. Nothing is simulated: the
    /// frames are taken as they are, and a log of digests has none.
    ///
    /// # Errors
    /// [`RunError`] when the run cannot start or a frame does not fit it, and every error of `watch`.
    pub fn show<E: From<RunError>>(log: &Log, watch: impl FnMut(&Recorder) -> Result<(), E>) -> Result<(), E> {
        Self::show_with_robots(log, |_| {}, watch)
    }

    /// [`show`](Self::show) with further kinds of robots.
    ///
    /// # Errors
    /// As [`show`](Self::show).
    pub fn show_with_robots<E: From<RunError>>(
        log: &Log,
        add: impl FnOnce(&mut App),
        mut watch: impl FnMut(&Recorder) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut run = Recorder::of_with_robots(&log.recipe, add)?.without_keyframes();
        for frame in log.initial().into_iter().chain(log.frames()) {
            run.restore(frame)?;
            watch(&run)?;
        }
        Ok(())
    }
}
