//! The machine's pace: a fixed piece of work, timed once in every round.

use std::hint::black_box;
use std::sync::Mutex;
use std::time::Instant;

use crate::interval::quantile;

/// The times so far, nanoseconds.
static TIMES: Mutex<Vec<f64>> = Mutex::new(Vec::new());

/// Times some thousand dependent multiplications, which no compiler shortens and no cache disturbs.
pub fn beat() {
    let start = Instant::now();
    let mut state = black_box(1_u64);
    for _ in 0..4_000 {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(black_box(1));
    }
    black_box(state);
    TIMES.lock().expect("one thread").push(start.elapsed().as_secs_f64() * 1e9);
}

/// How much longer the work took in the last quarter of all rounds than in the first, and the spread between its
/// quartiles.
pub fn say() -> String {
    let times = TIMES.lock().expect("one thread");
    if times.len() < 4 {
        return "Too few rounds to tell the machine's pace".into();
    }
    let quarter = times.len() / 4;
    let [first, last] = [&times[..quarter], &times[times.len() - quarter..]].map(|part| quantile(part, 0.5));
    let spread = 0.5 * (quantile(&times, 0.75) - quantile(&times, 0.25)) / quantile(&times, 0.5);
    format!(
        "The machine's pace, by a fixed piece of work in each of {} rounds: {:+.1} % time in the last quarter against \
         the first, half the distance between the quartiles {:.1} %",
        times.len(),
        100.0 * (last / first - 1.0),
        100.0 * spread
    )
}
