//! Working on a path in rounds, between which somebody may ask to stop.

use motion_lab::planning::{Bounds, NoPath};
use motion_lab::plans::{PlanAttempt, PlannerName};

use crate::cli::support::interrupt;

/// The iterations of a round.
const ROUND: u64 = 500;

/// Works on a path until it is there, there will be none, or as many iterations are done as somebody allows; without a
/// word the planner's usual number. Who gives a number has the path shortened up to there, by a planner that can. `see`
/// gets the number of iterations after each round. `None` where somebody asked to stop.
pub fn solve(
    attempt: &mut dyn PlanAttempt,
    planner: PlannerName,
    given: Option<u64>,
    mut see: impl FnMut(u64),
) -> Option<Result<(), NoPath>> {
    let iterations = given.unwrap_or(planner.iterations());
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
            Ok(()) if given.is_some() => return improve(attempt, iterations, see),
            solved => return Some(solved),
        }
    }
}

/// Goes on with a path up to a number of iterations, or to where the planner does nothing more.
fn improve(attempt: &mut dyn PlanAttempt, iterations: u64, mut see: impl FnMut(u64)) -> Option<Result<(), NoPath>> {
    loop {
        let bound = iterations.min(attempt.effort().iterations + ROUND);
        if let Err(refused) = attempt.improve(&Bounds::of_iterations(bound)) {
            return Some(Err(refused));
        }
        let done = attempt.effort().iterations;
        if done < bound || done >= iterations {
            return Some(Ok(()));
        }
        see(done);
        if interrupt::asked_to_stop() {
            return None;
        }
    }
}
