//! `verify`, the run of a log simulated again and compared with it.

use bevy::app::App;

use super::{Recorder, RunError};
use crate::run::{Comparison, Difference, Digest, Log};

/// The result of [`verify`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Verification {
    /// The number of recorded ticks.
    pub recorded: u64,
    /// The number of them that the simulated run equals in every bit, from the first on: whole seconds, where a log of
    /// digests differs.
    pub identical: u64,
    /// The digest of the simulated run, as far as the recording goes.
    pub digest: Digest,
    /// The first place that differs. `None` if all agree.
    pub difference: Option<Difference>,
}

/// Simulates a log's run again, from its seed, configuration and script alone, as far as it is recorded, and compares
/// every frame to the last bit, or the digest of every second. Calls `on_tick` with the run at every tick from 0 on.
///
/// # Errors
/// [`RunError`] when the log's configuration or script cannot be run. A run that differs is no error.
///
/// ```
/// use motion_lab_sim::recording::{Run, verify};
/// use motion_lab_sim::tour::{BOOK_SEED, TourConfig};
/// let mut log = Run::record(TourConfig { ticks: 20, ..TourConfig::default() }, BOOK_SEED)?;
/// assert_eq!(verify(&log, |_| {})?.identical, 20);
/// log.frames_mut()[4].robots[0].contacts += 1; // a forged recording
/// assert_eq!(verify(&log, |_| {})?.identical, 4);
/// # Ok::<(), motion_lab_sim::recording::RunError>(())
/// ```
pub fn verify(log: &Log, on_tick: impl FnMut(&Recorder)) -> Result<Verification, RunError> {
    verify_with_robots(log, |_| {}, on_tick)
}

/// [`verify`] of a log with kinds of robots that a program added: `add` adds them, by
/// [`RobotPlugin`](crate::simulation::RobotPlugin) or [`RobotKinds::add_to`](crate::simulation::RobotKinds::add_to).
///
/// # Errors
/// [`RunError`] when the log's configuration or script cannot be run, as with a kind that `add` does not add.
pub fn verify_with_robots(
    log: &Log,
    add: impl FnOnce(&mut App),
    mut on_tick: impl FnMut(&Recorder),
) -> Result<Verification, RunError> {
    let mut run = Recorder::of_with_robots(&log.recipe, add)?.without_keyframes();
    let mut comparison = Comparison::begin(log, run.frame());
    on_tick(&run);
    for _ in 0..log.ticks() {
        comparison.tick(run.step());
        on_tick(&run);
    }
    Ok(Verification {
        recorded: log.ticks(),
        identical: comparison.identical(),
        digest: comparison.digest(),
        difference: comparison.difference().cloned(),
    })
}
