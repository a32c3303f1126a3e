//! The way of an arm round what it meets, by a planner.

use std::sync::Arc;

use super::branches::Branches;
use super::{AvoidError, EvasionMeans, NoEvasion};
use crate::plans::{PlannerName, Task};
use crate::run::{Event, RobotInput};
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::planning::Bounds;
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;
use motion_lab_core::worlds::{Resident, World};

/// The greatest number of iterations of the planner from a tick.
const ITERATIONS: u64 = 5_000;

/// The inputs of a way round with their ticks, by what it is taken, and its last tick.
pub(super) type WayRound = (Vec<(u64, RobotInput)>, EvasionMeans, u64);

/// A way round from a tick to where the arm leaves the contact, that can be played, or why there is none.
pub(super) fn round_from(
    branches: &mut Branches,
    tick: u64,
    seed: Seed,
) -> Result<Result<WayRound, NoEvasion>, AvoidError> {
    let robot = branches.episode.robot.clone();
    let Some(ended) = branches.episode.ended else { return Ok(Err(NoEvasion::EndsInContact)) };
    let beyond = branches.run.seek(ended)?.clone();
    let before = branches.run.seek(tick - 1)?.clone();
    let standing = branches.run.standing_worlds();
    let resides = |world: &&Arc<World>| world.robots.iter().any(|resident| resident.name == robot);
    let Some(world) = standing.iter().find(resides) else { return Ok(Err(NoEvasion::NoInputs)) };
    if let Some(other) = world.robots.iter().find(|resident| resident.name != robot) {
        return Ok(Err(NoEvasion::Company(other.name.clone())));
    }
    let [from, to] = [&before, &beyond].map(|frame| branches.state(frame).configuration.to_vec());
    let robots = world.robots.iter().map(|resident| Resident { start: from.clone(), ..resident.clone() }).collect();
    let world = World { robots, ..World::clone(world) };
    let Some((arm, ends)) = world.robots.first().and_then(|resident| ends(resident, &to)) else {
        return Ok(Err(NoEvasion::NoInputs));
    };
    let task = Task::new(&robot, arm, world, ends);
    let no_path = |why: &dyn ToString| Ok(Err(NoEvasion::NoPath(why.to_string())));
    let mut attempt = match task.attempt(PlannerName::default_for(&arm), seed) {
        Ok(attempt) => attempt,
        Err(why) => return no_path(&why),
    };
    if let Err(why) = attempt.solve(&Bounds::of_iterations(ITERATIONS)) {
        return no_path(&why);
    }
    let played = match task.played(&*attempt, seed).1 {
        Some(Ok(played)) => played,
        Some(Err(why)) => return no_path(&why),
        None => return no_path(&"nothing of it can be played"),
    };
    let arrives = tick - 1 + played.ticks;
    let input = |Event { tick: after, input, .. }: Event| (tick - 1 + after, input);
    let inputs = played.script.events.into_iter().map(input).collect();
    Ok(Ok((inputs, EvasionMeans::Path { length: attempt.lengths().length, arrives }, arrives)))
}

/// An arm where it starts, and its configurations at both ends of a path; `None` for another robot.
fn ends(resident: &Resident, to: &[f64]) -> Option<(AnyRobot, [AnyConfiguration; 2])> {
    let (robot, start) = AnyRobot::of_resident(resident)?;
    let (_, goal) = AnyRobot::sized(&resident.kind, to, resident.sizes.as_ref())?;
    robot.about().is_arm().then_some((robot, [start, goal]))
}
