//! Working on a path in rounds, between which somebody may ask to stop.

use motion_lab::planning::{Bounds, NoPath};
use motion_lab::plans::PlanAttempt;

use crate::cli::support::interrupt;

/// The iterations of a round.
const ROUND: u64 = 500;

/// Works on a path until it is there, there will be none, or `iterations` are done. `see` gets the number of iterations
/// after each round. `None` where somebody asked to stop.
pub fn solve(attempt: &mut dyn PlanAttempt, iterations: u64, mut see: impl FnMut(u64)) -> Option<Result<(), NoPath>> {
    let mut bound = 0;
    loop {
        bound = iterations.min(bound + ROUND);
        match attempt.solve(&Bounds::of_iterations(bound)) {
            Err(NoPath::Exhausted { .. }) if bound < iterations => {
                see(bound);
                if interrupt::asked_to_stop() {
                    return None;
                }
            }
            solved => return Some(solved),
        }
    }
}
