//! The state of the whole simulation as a `Frame`: taken and put back.

use bevy::prelude::*;

use super::obstacles::roster::ObstacleRoster;
use super::robot::ops::state_of;
use super::{
    Configuration, Contacts, DriveMode, Keyframes, LatestFrame, OwnState, RestoreError, RobotId, RobotOps, Roster,
    SimulatedRobot, Transport,
};
use crate::run::{Frame, RobotState};

/// The state of the simulation now: the canonical form, the same for equal states. The scans are those of the latest
/// frame.
pub fn snapshot(world: &World) -> Frame {
    let mut frame =
        world.get_resource::<LatestFrame>().map_or_else(|| LatestFrame::of_no_run().0, |latest| latest.0.clone());
    snapshot_robots(world, &mut frame);
    snapshot_rest(world, &mut frame);
    frame
}

/// Takes the robots of a frame from their components.
fn snapshot_robots(world: &World, frame: &mut Frame) {
    let robots = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    frame.robots.clear();
    frame.robots.extend(robots.iter().filter_map(|&e| (world.get::<RobotOps>(e)?.encode)(world, e)));
}

/// Takes all of a frame but the robots and the scans.
fn snapshot_rest(world: &World, frame: &mut Frame) {
    frame.tick = world.get_resource::<Transport>().map_or(0, |t| t.tick);
    frame.obstacles.clear();
    if let Some(roster) = world.get_resource::<ObstacleRoster>() {
        roster.add_states_to(&mut frame.obstacles);
    }
}

/// The components of a robot that are its state.
type Encoded<R> = (
    Entity,
    &'static RobotId,
    &'static Configuration<R>,
    &'static OwnState<R>,
    &'static DriveMode<R>,
    &'static Contacts<R>,
);

/// What takes the states of the robots of a kind, whose components it has found once and for all.
trait StateTaker: Send + Sync {
    /// Writes the states into the places of the robots' ids, and returns how many.
    fn take(&mut self, world: &World, robots: &[Entity], states: &mut [RobotState]) -> usize;
}

impl<R: SimulatedRobot> StateTaker for QueryState<Encoded<R>> {
    fn take(&mut self, world: &World, robots: &[Entity], states: &mut [RobotState]) -> usize {
        let mut taken = 0;
        for (entity, &id, Configuration(q), own, mode, contacts) in self.iter(world) {
            let place = id.0 as usize;
            if robots.get(place) == Some(&entity)
                && let Some(state) = states.get_mut(place)
            {
                *state = state_of(id, q, own, mode, contacts);
                taken += 1;
            }
        }
        taken
    }
}

/// The takers of all kinds that have robots.
#[derive(Resource, Default)]
pub(crate) struct StateTakers(Vec<Box<dyn StateTaker>>);

impl StateTakers {
    /// Takes the states of the robots of this kind too, from now on.
    pub(crate) fn add<R: SimulatedRobot>(world: &mut World) {
        let taker = world.query::<Encoded<R>>();
        world.get_resource_or_init::<StateTakers>().0.push(Box::new(taker));
    }
}

/// Takes the frame of the tick, with the scans that its sensors have written.
pub(super) fn record(world: &mut World) {
    let mut takers = std::mem::take(&mut world.resource_mut::<StateTakers>().0);
    let mut frame = std::mem::replace(&mut *world.resource_mut::<LatestFrame>(), LatestFrame::of_no_run()).0;
    let robots = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    let states = &mut frame.robots[..];
    let is_all_there = states.len() == robots.len()
        && takers.iter_mut().map(|taker| taker.take(world, robots, states)).sum::<usize>() == robots.len();
    if !is_all_there {
        snapshot_robots(world, &mut frame);
    }
    snapshot_rest(world, &mut frame);
    world.resource_mut::<StateTakers>().0 = takers;
    world.resource_mut::<Keyframes>().keep(&frame);
    world.resource_mut::<LatestFrame>().0 = frame;
    super::history::note_if_history(world);
}

/// Puts the simulation into the state of a frame, without looking at what others have changed.
pub(super) fn put_frame(world: &mut World, frame: &Frame) -> Result<(), RestoreError> {
    let robots: Vec<Entity> = world.get_resource::<Roster>().map_or_else(Vec::new, |r| r.robots().to_vec());
    let tick = frame.tick;
    if robots.len() != frame.robots.len() {
        return Err(RestoreError::Robots { tick, found: frame.robots.len(), expected: robots.len() });
    }
    for (&robot, state) in robots.iter().zip(&frame.robots) {
        let refused = RestoreError::Robot { tick, id: state.id };
        let (Some(id), Some(ops)) = (world.get::<RobotId>(robot), world.get::<RobotOps>(robot).copied()) else {
            return Err(refused);
        };
        if id.0 != state.id || (ops.decode)(world, robot, state).is_none() {
            return Err(refused);
        }
    }
    super::obstacles::sync::restore(world, tick, &frame.obstacles)?;
    world.resource_mut::<Transport>().tick = tick;
    super::tick::sense::sense_now(world);
    record(world);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::truth::touched::at_work;
    use crate::simulation::{headless_app, start_run, step};
    use crate::tour::{BOOK_SEED, TourConfig};
    use motion_lab_core::geometry::Pose2;
    use motion_lab_core::robots::Rusty;

    #[test]
    fn a_frame_holds_the_states_of_the_runs_robots_and_of_no_others() {
        let mut app = headless_app();
        let world = app.world_mut();
        start_run(world, TourConfig::default(), BOOK_SEED).unwrap();
        (0..3).for_each(|_| step(world));
        let frame = world.resource::<LatestFrame>().frame().clone();
        assert_eq!((frame.robots.len(), &frame), (3, &snapshot(world)));
        let ids =
            |world: &World| world.resource::<LatestFrame>().frame().robots.iter().map(|r| r.id).collect::<Vec<_>>();
        at_work(world, |world| {
            // an entity with the id of the rover and all that is a rover's state
            let rover = world.resource::<Roster>().named("Rusty").unwrap();
            let (id, mode) = (*world.get::<RobotId>(rover).unwrap(), *world.get::<DriveMode<Rusty>>(rover).unwrap());
            let own = OwnState::<Rusty>::new(world.get::<OwnState<Rusty>>(rover).unwrap().extra.clone());
            let elsewhere = Configuration::<Rusty>(Pose2::new(9.0, 1.0, 0.0));
            world.spawn((id, elsewhere, own, mode, Contacts::<Rusty>::new(true, 7, 1)));
            record(world);
            assert_eq!(world.resource::<LatestFrame>().frame(), &frame);
            // nor does it stand in for the rover
            world.entity_mut(rover).remove::<Contacts<Rusty>>();
            record(world);
            assert_eq!(ids(world), [1, 2]);
        });
    }
}
