//! `Starts` and `Sweeps`, the footprints and motions of a tick by which the robots of one world meet.

use bevy::prelude::*;

use super::sweep::Sweep;
use crate::collision::footprint_distance;
use crate::geometry::{Footprint, Placed};
use crate::simulation::{Residents, ResidesIn, RobotId, RobotOps, Roster};

/// The robots' footprints at the start of the tick, by ascending id. Robots alone in their world are left out.
#[derive(Resource, Default)]
pub struct Starts(Vec<(Entity, RobotId, Footprint)>);

/// The sets that the tick's cut motions cover, in no particular order. Robots alone in their world are left out.
#[derive(Resource, Default)]
pub struct Sweeps(Vec<(Entity, RobotId, Box<dyn Sweep>)>);

impl Starts {
    /// The parts of the other robots in that world.
    pub fn others(&self, world: Entity, id: RobotId) -> Vec<Placed> {
        let others = self.0.iter().filter(|(w, i, _)| *w == world && *i != id);
        others.flat_map(|(_, _, f)| f.parts().iter().map(|p| p.placed().clone())).collect()
    }

    /// The distance between the footprints of two robots of one world, metres; 0 when either is unknown.
    pub fn distance(&self, world: Entity, a: RobotId, b: RobotId) -> f64 {
        let find = |id| self.0.iter().find(|(w, i, _)| *w == world && *i == id).map(|(_, _, f)| f);
        find(a).zip(find(b)).map_or(0.0, |(a, b)| footprint_distance(a, b))
    }
}

impl Sweeps {
    /// Adds the sweep of a robot.
    pub fn add(&mut self, world: Entity, id: RobotId, sweep: Box<dyn Sweep>) {
        self.0.push((world, id, sweep));
    }

    /// The sweeps of the robots of that world with a lower id.
    pub fn below(&self, world: Entity, id: RobotId) -> impl Iterator<Item = (RobotId, &dyn Sweep)> {
        self.0.iter().filter(move |(w, i, _)| *w == world && *i < id).map(|(_, i, s)| (*i, s.as_ref()))
    }
}

/// The parts of all robots now in `world` but `id`, by ascending id.
pub fn others_now(world: &World, inhabited: Entity, id: RobotId) -> Vec<Placed> {
    let mut parts = Vec::new();
    if lives_alone(world, inhabited) {
        return parts;
    }
    for (e, _, _) in robots(world).filter(|(_, w, i)| *w == inhabited && *i != id) {
        if let Some(footprint) = world.get::<RobotOps>(e).and_then(|ops| (ops.footprint)(world, e)) {
            parts.extend(footprint.parts().iter().map(|p| p.placed().clone()));
        }
    }
    parts
}

/// Whether at most one robot lives in that world.
fn lives_alone(world: &World, inhabited: Entity) -> bool {
    world.get::<Residents>(inhabited).is_none_or(|residents| residents.len() < 2)
}

/// Each robot with its world and id, by ascending id.
fn robots(world: &World) -> impl Iterator<Item = (Entity, Entity, RobotId)> {
    let robots = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    robots.iter().filter_map(|&e| Some((e, world.get::<ResidesIn>(e)?.0, *world.get::<RobotId>(e)?)))
}

/// Gathers the footprints at the start of the tick, and forgets the sweeps of the last.
pub(crate) fn gather_starts(world: &mut World) {
    let mut starts = std::mem::take(&mut world.resource_mut::<Starts>().0);
    starts.clear();
    for (e, inhabited, id) in robots(world) {
        if lives_alone(world, inhabited) {
            continue;
        }
        let ops = world.get::<RobotOps>(e);
        if let Some(footprint) = ops.and_then(|ops| (ops.footprint)(world, e)) {
            starts.push((inhabited, id, footprint));
        }
    }
    world.resource_mut::<Starts>().0 = starts;
    world.resource_mut::<Sweeps>().0.clear();
}
