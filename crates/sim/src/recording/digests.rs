//! Recording and verifying digest logs: runs without their frames.

use bevy::app::App;

use super::{Recorder, Run, RunError, RunInput};
use crate::run::{DIGEST_TICKS, DifferingSecond, Digest, DigestComparison, DigestLog, RunDigest};
use crate::tour::TourConfig;

/// The result of [`verify_digests`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DigestVerification {
    /// The number of recorded ticks.
    pub recorded: u64,
    /// The number of them that the simulated run equals in every bit, from the first on: whole seconds, where it
    /// differs.
    pub identical: u64,
    /// The digest of the simulated run, as far as the recording goes.
    pub digest: Digest,
    /// The first second that differs; `None` if all agree.
    pub difference: Option<DifferingSecond>,
}

impl Run {
    /// Runs `config` for its ticks and returns the log without frames: a digest of each second.
    ///
    /// # Errors
    /// [`RunError`] names the invalid part of the configuration or the script.
    pub fn record_digests(config: TourConfig, input: impl Into<RunInput>) -> Result<DigestLog, RunError> {
        let RunInput { seed, script } = input.into();
        let mut run = Recorder::new(config.clone(), (seed, script.clone()))?.without_keyframes();
        let mut so_far = RunDigest::new(seed, &config, &script, run.frame());
        let (start, mut digests, ticks) = (DigestLog::kept(so_far.digest()), Vec::new(), config.ticks);
        for tick in 1..=ticks {
            so_far.tick(run.step());
            if tick == ticks || tick.is_multiple_of(DIGEST_TICKS) {
                digests.push(DigestLog::kept(so_far.digest()));
            }
        }
        Ok(DigestLog { seed, config, script, start, digests, ticks, digest: Some(so_far.digest()) })
    }
}

/// Simulates the run of a digest log again, from its seed, configuration and script, as far as the log goes, and
/// compares the digest of every second. Calls `on_tick` with the run at every tick from 0 on.
///
/// # Errors
/// [`RunError`] when the log's configuration or script cannot be run. A run that differs is no error.
pub fn verify_digests(log: &DigestLog, on_tick: impl FnMut(&Recorder)) -> Result<DigestVerification, RunError> {
    verify_digests_with_robots(log, |_| {}, on_tick)
}

/// [`verify_digests`] of a log with kinds of robots that a program added: see
/// [`verify_with_robots`](super::verify_with_robots).
///
/// # Errors
/// [`RunError`] when the log's configuration or script cannot be run, as with a kind that `add` does not add.
pub fn verify_digests_with_robots(
    log: &DigestLog,
    add: impl FnOnce(&mut App),
    mut on_tick: impl FnMut(&Recorder),
) -> Result<DigestVerification, RunError> {
    let mut run = Recorder::with_robots(log.config.clone(), (log.seed, log.script.clone()), add)?.without_keyframes();
    let mut digest = RunDigest::new(log.seed, &log.config, &log.script, run.frame());
    let mut comparison = DigestComparison::with(log);
    comparison.tick(0, &digest);
    on_tick(&run);
    for tick in 1..=log.ticks {
        digest.tick(run.step());
        comparison.tick(tick, &digest);
        on_tick(&run);
    }
    Ok(DigestVerification {
        recorded: comparison.recorded(),
        identical: comparison.identical(),
        digest: digest.digest(),
        difference: comparison.difference().copied(),
    })
}
