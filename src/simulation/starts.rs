//! `Starts` and `Sweeps`, what the robots of one world see of one another within a tick.

use bevy::prelude::*;

use super::sweep::Sweep;
use super::{ResidesIn, RobotId, RobotOps, Roster};
use crate::collision::{Collision, Scene, Surroundings};
use crate::geometry::{Footprint, Placed, Point2};
use crate::worlds::Bounds;

/// The robots' footprints at the start of the tick, by ascending id.
#[derive(Resource, Default)]
pub struct Starts(Vec<(Entity, RobotId, Footprint)>);

/// The sets that the cut motions of the tick cover, in no particular order; of robots alone in their world, none.
#[derive(Resource)]
pub struct Sweeps {
    sweeps: Vec<(Entity, RobotId, Box<dyn Sweep>)>,
    nothing: Scene,
}

impl Default for Sweeps {
    fn default() -> Self {
        let origin = Point2::origin();
        Sweeps { sweeps: Vec::new(), nothing: Scene::empty(Bounds { min: origin, max: origin }) }
    }
}

impl Starts {
    /// The parts of the other robots in that world.
    pub fn others(&self, world: Entity, id: RobotId) -> Vec<Placed> {
        let others = self.0.iter().filter(|(w, i, _)| *w == world && *i != id);
        others.flat_map(|(_, _, f)| f.parts().iter().map(|p| p.placed().clone())).collect()
    }

    /// The distance between the footprints of two robots of one world, metres; 0 when either is unknown. `nothing` is a scene
    /// without obstacles.
    pub fn distance(&self, nothing: &Scene, world: Entity, a: RobotId, b: RobotId) -> f64 {
        let find = |id| self.0.iter().find(|(w, i, _)| *w == world && *i == id).map(|(_, _, f)| f);
        let (Some(a), Some(b)) = (find(a), find(b)) else { return 0.0 };
        let others: Vec<Placed> = b.parts().iter().map(|p| p.placed().clone()).collect();
        Surroundings { scene: nothing, others: &others }.distance(a)
    }
}

impl Sweeps {
    /// Adds the sweep of a robot.
    pub fn add(&mut self, world: Entity, id: RobotId, sweep: Box<dyn Sweep>) {
        self.sweeps.push((world, id, sweep));
    }

    /// The sweeps of the robots of that world with a lower id.
    pub fn below(&self, world: Entity, id: RobotId) -> impl Iterator<Item = (RobotId, &dyn Sweep)> {
        self.sweeps.iter().filter(move |(w, i, _)| *w == world && *i < id).map(|(_, i, s)| (*i, s.as_ref()))
    }

    /// A scene without obstacles.
    pub fn nothing(&self) -> &Scene {
        &self.nothing
    }
}

/// The parts of all robots now in `world` but `id`, by ascending id.
pub fn others_now(world: &World, inhabited: Entity, id: RobotId) -> Vec<Placed> {
    footprints_now(world)
        .filter(|(w, i, _)| *w == inhabited && *i != id)
        .flat_map(|(_, _, f)| f.parts().iter().map(|p| p.placed().clone()).collect::<Vec<_>>())
        .collect()
}

fn footprints_now(world: &World) -> impl Iterator<Item = (Entity, RobotId, Footprint)> {
    let robots = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    robots.iter().filter_map(|&e| {
        let ops = world.get::<RobotOps>(e)?;
        Some((world.get::<ResidesIn>(e)?.0, *world.get::<RobotId>(e)?, (ops.footprint)(world, e)?))
    })
}

/// Gathers the footprints at the start of the tick, and forgets the sweeps of the last.
pub(super) fn gather_starts(world: &mut World) {
    let starts = Starts(footprints_now(world).collect());
    world.insert_resource(starts);
    world.resource_mut::<Sweeps>().sweeps.clear();
}
