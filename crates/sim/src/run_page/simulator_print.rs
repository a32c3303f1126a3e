//! `simulator_print`, by which two builds of the simulator are told apart.

use crate::recording::{Recorder, RunError};
use crate::run::{DIGEST_FORMAT_VERSION, Event, Recipe, RobotInput, RunDigest, Script, WorldChange, WorldEvent};
use crate::tour::{BOOK_SEED, TourConfig};

/// The length of the run whose digest is a part of the print, ticks: two seconds.
const TICKS: u64 = 40;

/// Which simulator this is: its version, the format of its logs of digests, and the digest of a run. Simulators whose
/// runs differ have other prints; those of one version that differ only in what that run does not meet have not.
///
/// # Errors
/// [`RunError`] when that run does not start: a fault of the library.
pub fn simulator_print() -> Result<String, RunError> {
    let event = |robot: &str, input| Event { tick: 2, robot: robot.to_owned(), input };
    let events = vec![
        event("Hitch", RobotInput::SetTrailer(false)),
        event("Hitch", RobotInput::Drive(96, -64)),
        event("Rusty", RobotInput::Drive(-128, 32)),
    ];
    let change = WorldChange::Close("door C".to_owned());
    let changes = vec![WorldEvent { tick: 3, world: "Apartment".to_owned(), change }];
    let config = TourConfig { ticks: TICKS, ..TourConfig::default() };
    let recipe = Recipe::new(config, (BOOK_SEED, Script::new(events, changes)));
    let mut run = Recorder::of(&recipe)?.without_keyframes();
    let mut digest = RunDigest::new(&recipe, run.frame());
    for _ in 0..TICKS {
        digest.tick(run.step());
    }
    Ok(format!("motion-lab {}, log format {DIGEST_FORMAT_VERSION}, {}", env!("CARGO_PKG_VERSION"), digest.digest()))
}
