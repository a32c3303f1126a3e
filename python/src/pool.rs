//! The threads that work out answers: one pool for each process.

use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Most threads that may be asked for.
const MAX_THREADS: usize = 1024;

/// The pool, and the process it was made in.
struct Kept {
    process: u32,
    /// How many threads were asked for; 0 for one for each core.
    threads: usize,
    pool: Option<Arc<ThreadPool>>,
}

/// It is locked with the interpreter's lock held alone, and for no longer than it takes to look: no thread holds it
/// while another forks.
static KEPT: Mutex<Kept> = Mutex::new(Kept { process: 0, threads: 0, pool: None });

/// The pool of this process. Threads do not survive a fork, so a child makes a pool of its own and leaves its parent's
/// alone.
fn pool(_py: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if kept.process != process {
        // what ends a pool waits for threads that a child does not have
        std::mem::forget(kept.pool.take());
        kept.process = process;
    }
    if let Some(pool) = &kept.pool {
        return Ok(Arc::clone(pool));
    }
    let made = ThreadPoolBuilder::new().num_threads(kept.threads).thread_name(|i| format!("motion-lab {i}")).build();
    let pool = Arc::new(made.map_err(|error| PyRuntimeError::new_err(error.to_string()))?);
    kept.pool = Some(Arc::clone(&pool));
    Ok(pool)
}

/// Runs `work` in the pool of this process, with the interpreter's lock released: whatever is parallel in it uses the
/// pool's threads.
///
/// # Errors
/// `RuntimeError` where the system gives no threads.
pub fn install<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = pool(py)?;
    Ok(py.detach(|| pool.install(work)))
}

/// Set how many threads work out the answers of large calls: `None`, as at the start, for one for each core (or what
/// the environment's `RAYON_NUM_THREADS` says). No answer depends on it. A forked process keeps the number and starts
/// threads of its own.
///
/// Raises ValueError for a number below 1 or above 1024.
#[pyfunction]
#[pyo3(signature = (n = None))]
pub fn set_threads(_py: Python<'_>, n: Option<i64>) -> PyResult<()> {
    let threads = match n {
        None => 0,
        Some(n) => usize::try_from(n)
            .ok()
            .filter(|n| (1..=MAX_THREADS).contains(n))
            .ok_or_else(|| PyValueError::new_err(format!("{n} threads: there must be 1 to {MAX_THREADS}")))?,
    };
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.process != std::process::id() {
        std::mem::forget(kept.pool.take());
        kept.process = std::process::id();
    }
    if kept.threads != threads {
        kept.threads = threads;
        // calls under way finish in the old pool, whose threads end after them
        kept.pool = None;
    }
    Ok(())
}

/// The number of threads that work out the answers of large calls.
///
/// Raises RuntimeError where the system gives no threads.
#[pyfunction]
pub fn threads(py: Python<'_>) -> PyResult<usize> {
    Ok(pool(py)?.current_num_threads())
}
