//! Ctrl-C: finish the tick under way, keep what was done, and end.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::cli::Failure;

static ASKED: AtomicBool = AtomicBool::new(false);

/// Makes Ctrl-C and termination signals ask for a stop instead of ending the process. A second one ends it at once,
/// with exit code 130.
pub fn listen() -> Result<(), Failure> {
    let handler = || {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    };
    ctrlc::set_handler(handler).map_err(Failure::internal)
}

/// Whether somebody asked to stop.
pub fn asked_to_stop() -> bool {
    ASKED.load(Ordering::Relaxed)
}
