//! The state of the whole simulation as a `Frame`: taken and put back.

use bevy::prelude::*;

use super::obstacles::roster::ObstacleRoster;
use super::robot::ops::state_of;
use super::{
    Configuration, Contacts, DriveMode, Keyframes, LatestFrame, OwnState, RestoreError, RobotId, RobotOps, Roster,
    SimulatedRobot, Transport,
};
use crate::run::Frame;

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
    frame.obstacles.extend(world.get_resource::<ObstacleRoster>().into_iter().flat_map(ObstacleRoster::states));
}

/// The components of a robot that are its state.
type Encoded<R> =
    (&'static RobotId, &'static Configuration<R>, &'static OwnState<R>, &'static DriveMode<R>, &'static Contacts<R>);

/// The robots' states of the tick, as far as they are taken.
#[derive(Resource, Default)]
pub(super) struct TakenStates(usize);

/// Writes the states of the robots of a kind into the frame, in the places of their ids. It runs for crowds; of few
/// robots [`record`] takes the states itself.
pub(crate) fn encode<R: SimulatedRobot>(
    mut frame: ResMut<LatestFrame>,
    mut taken: ResMut<TakenStates>,
    robots: Query<Encoded<R>>,
) {
    for (&id, Configuration(q), own, mode, contacts) in &robots {
        if let Some(state) = frame.0.robots.get_mut(id.0 as usize) {
            *state = state_of(id, q, own, mode, contacts);
            taken.0 += 1;
        }
    }
}

/// Takes the frame of the tick, with the states that its robots and its sensors have written.
pub(super) fn record(world: &mut World) {
    let taken = std::mem::take(&mut world.resource_mut::<TakenStates>().0);
    let mut frame = std::mem::replace(&mut *world.resource_mut::<LatestFrame>(), LatestFrame::of_no_run()).0;
    let robots = world.get_resource::<Roster>().map_or(0, |roster| roster.robots().len());
    if taken != robots || frame.robots.len() != robots {
        snapshot_robots(world, &mut frame);
    }
    snapshot_rest(world, &mut frame);
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
    super::obstacles::roster::restore(world, tick, &frame.obstacles)?;
    world.resource_mut::<Transport>().tick = tick;
    super::tick::sense::sense_now(world);
    record(world);
    Ok(())
}
