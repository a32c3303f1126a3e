//! Ctrl-C: finish the tick under way, keep what was done, and end; or end at once, and leave no unfinished file.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::output::abandon_all;

use crate::cli::Failure;

/// The exit code after Ctrl-C, where there is nothing to keep.
const ENDED: i32 = 130;

/// Whether the command asks from time to time whether to stop.
static LISTENS: AtomicBool = AtomicBool::new(false);

static ASKED: AtomicBool = AtomicBool::new(false);

/// Lets Ctrl-C and termination signals end the process with exit code 130, and take its unfinished files away. A
/// command that [listens](listen) is asked to stop instead; a second signal then ends it at once.
pub fn install() -> Result<(), Failure> {
    let handler = || {
        if !LISTENS.load(Ordering::Relaxed) || ASKED.swap(true, Ordering::Relaxed) {
            abandon_all(ENDED);
        }
    };
    ctrlc::set_handler(handler).map_err(Failure::internal)
}

/// Makes Ctrl-C and termination signals ask for a stop: the command calls [`asked_to_stop`] from time to time.
pub fn listen() {
    LISTENS.store(true, Ordering::Relaxed);
}

/// Whether somebody asked to stop.
pub fn asked_to_stop() -> bool {
    ASKED.load(Ordering::Relaxed)
}
