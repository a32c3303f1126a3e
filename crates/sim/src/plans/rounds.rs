//! Working on a path in rounds, between which somebody may ask to stop.

use motion_lab_core::planning::{Bounds, NoPath};

use super::attempt::PlanAttempt;
use super::named::PlannerName;

/// The iterations of a round.
const ROUND: u64 = 500;

/// Works on a path until it is there, there will be none, or as many iterations are done as somebody allows; without a
/// word the planner's usual number. Who gives a number has the path shortened up to there, by a planner that can. After
/// each round `goes_on` sees the attempt, and says whether it goes on. `None` where it does not.
pub fn solve_in_rounds(
    attempt: &mut dyn PlanAttempt,
    planner: PlannerName,
    given: Option<u64>,
    mut goes_on: impl FnMut(&dyn PlanAttempt) -> bool,
) -> Option<Result<(), NoPath>> {
    let iterations = given.unwrap_or(planner.iterations());
    let mut bound = 0;
    loop {
        bound = iterations.min(bound + ROUND);
        match attempt.solve(&Bounds::of_iterations(bound)) {
            Err(NoPath::Exhausted { .. }) if bound < iterations => {
                if !goes_on(attempt) {
                    return None;
                }
            }
            Ok(()) if given.is_some() => return improve(attempt, iterations, goes_on),
            solved => return Some(solved),
        }
    }
}

/// Goes on with a path up to a number of iterations, or to where the planner does nothing more.
fn improve(
    attempt: &mut dyn PlanAttempt,
    iterations: u64,
    mut goes_on: impl FnMut(&dyn PlanAttempt) -> bool,
) -> Option<Result<(), NoPath>> {
    loop {
        if attempt.effort().iterations < iterations && !goes_on(attempt) {
            return None;
        }
        let bound = iterations.min(attempt.effort().iterations + ROUND);
        if let Err(refused) = attempt.improve(&Bounds::of_iterations(bound)) {
            return Some(Err(refused));
        }
        let done = attempt.effort().iterations;
        if done < bound || done >= iterations {
            return Some(Ok(()));
        }
    }
}
