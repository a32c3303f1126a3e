//! Long work that Ctrl+C stops.

use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::pool;

/// How long work goes on before somebody may stop it.
pub const PIECE: Duration = Duration::from_millis(20);
/// From this number of robots on the library divides a tick among threads.
const MANY: usize = 256;

/// Calls `step` until it has an answer, with the interpreter's lock released, and hears Ctrl+C in between. `robots` of
/// them are at work at once: where they are many, in the pool.
///
/// # Errors
/// `KeyboardInterrupt`, and whatever else a signal's handler raises. What was done until then stays done.
pub fn until<T: Send>(py: Python<'_>, robots: usize, mut step: impl FnMut() -> Option<T> + Send) -> PyResult<T> {
    let mut piece = || {
        let begun = Instant::now();
        loop {
            let answer = step();
            if answer.is_some() || begun.elapsed() > PIECE {
                return answer;
            }
        }
    };
    loop {
        if let Some(answer) = once(py, robots, &mut piece)? {
            return Ok(answer);
        }
        py.check_signals()?;
    }
}

/// Does work of which Ctrl+C is heard only afterwards, with the interpreter's lock released: where many robots are at
/// work, in the pool.
///
/// # Errors
/// `RuntimeError` where the system gives no threads.
pub fn once<T: Send>(py: Python<'_>, robots: usize, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    if robots < MANY { Ok(py.detach(work)) } else { pool::install(py, work) }
}
