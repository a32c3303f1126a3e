//! `WorldCrowds`, the crowds of a run's worlds, and the systems by which robots of one world meet.

use bevy::prelude::*;

use super::crowd::{Crowd, NeighbourMemory};
use super::hold::margin_from;
use super::parallel::each;
use super::swept_set::{CoveredSet, sweeps_meet};
use crate::simulation::{Residents, RobotId, RobotOps, Roster};
use motion_lab_core::geometry::Placed;

/// The crowds of the worlds with more than one robot.
#[derive(Resource, Default)]
pub struct WorldCrowds {
    crowds: Vec<Crowd>,
    /// The number of each robot's crowd in `crowds`, by id; `None` for a robot alone in its world.
    of: Vec<Option<u32>>,
    /// Whether each robot's motion meets that of a robot with a lower id, by id.
    met: Vec<bool>,
}

impl WorldCrowds {
    /// The crowds of a run, by the number of robots in each of its worlds.
    pub fn new(robots: impl IntoIterator<Item = usize>) -> Self {
        let mut all = WorldCrowds::default();
        for count in robots {
            let first = all.of.len() as u32;
            let crowd = (count > 1).then_some(all.crowds.len() as u32);
            if crowd.is_some() {
                all.crowds.push(Crowd::new(first..first + count as u32));
            }
            all.of.extend(std::iter::repeat_n(crowd, count));
        }
        all.met = vec![false; all.of.len()];
        all
    }

    /// Whether there are any; a run condition.
    pub(crate) fn are_there(crowds: Res<WorldCrowds>) -> bool {
        !crowds.crowds.is_empty()
    }

    /// The crowd of a robot; `None` for one that is alone in its world.
    pub fn of(&self, RobotId(id): RobotId) -> Option<&Crowd> {
        self.crowds.get((*self.of.get(id as usize)?)? as usize)
    }

    /// As [`of`](Self::of), to be changed.
    pub fn of_mut(&mut self, RobotId(id): RobotId) -> Option<&mut Crowd> {
        self.crowds.get_mut((*self.of.get(id as usize)?)? as usize)
    }

    /// Whether the robot's motion meets that of a robot with a lower id in its world.
    pub fn has_met(&self, RobotId(id): RobotId) -> bool {
        self.met.get(id as usize).is_some_and(|met| *met)
    }
}

/// Begins the tick's crowds.
pub(crate) fn begin(mut crowds: ResMut<WorldCrowds>) {
    crowds.crowds.iter_mut().for_each(Crowd::begin);
}

/// Makes the index of each crowd, once all robots have their bodies.
pub(crate) fn index(mut crowds: ResMut<WorldCrowds>) {
    crowds.crowds.iter_mut().for_each(Crowd::index);
}

/// Puts the robots' bodies where they stand now, with no motion to come.
pub(crate) fn stand(world: &mut World) {
    let mut crowds = std::mem::take(&mut *world.resource_mut::<WorldCrowds>());
    let roster = world.get_resource::<Roster>().map_or(&[][..], Roster::robots);
    for crowd in &mut crowds.crowds {
        crowd.begin();
        for id in crowd.ids() {
            let Some(&robot) = roster.get(id as usize) else { continue };
            if let Some(footprint) = world.get::<RobotOps>(robot).and_then(|ops| (ops.footprint)(world, robot)) {
                crowd.put(id, &footprint, 0.0);
            }
        }
        crowd.index();
    }
    *world.resource_mut::<WorldCrowds>() = crowds;
}

/// Finds the robots whose cut motions meet that of a robot with a lower id in their world.
pub(crate) fn meet(world: &mut World) {
    let mut crowds = std::mem::take(&mut *world.resource_mut::<WorldCrowds>());
    let WorldCrowds { crowds: all, met, .. } = &mut crowds;
    let world_now: &World = world;
    for crowd in all {
        let ids = crowd.ids();
        let Some(met) = met.get_mut(ids.start as usize..ids.end as usize) else { continue };
        let search =
            |room: &mut NeighbourMemory, (met, id): (&mut bool, u32)| *met = meets_lower(world_now, crowd, id, room);
        each(met.iter_mut().zip(ids), NeighbourMemory::default, search);
    }
    *world.resource_mut::<WorldCrowds>() = crowds;
}

/// Whether a robot's cut motion meets that of a robot with a lower id.
fn meets_lower(world: &World, crowd: &Crowd, id: u32, room: &mut NeighbourMemory) -> bool {
    crowd.lower(id, room);
    let mut met = false;
    if !room.places.is_empty() {
        with_sweep(world, id, &mut |own, until| {
            // a robot that stays where it is meets nobody: the others' motions are cut at it
            met = until > 0.0 && room.places.iter().any(|&lower| meets(world, crowd, (id, own), lower));
        });
    }
    met
}

/// Whether a robot's cut motion meets that of another.
fn meets(world: &World, crowd: &Crowd, (id, own): (u32, &dyn CoveredSet), other: u32) -> bool {
    let mut met = false;
    with_sweep(world, other, &mut |sweep, _| {
        // the motion is already cut at robots that stand still
        met = !sweep.is_still() && sweeps_meet(own, sweep, margin_from(crowd.distance(id, other)));
    });
    met
}

/// Calls `visit` with the sweep of a robot's cut motion and the parameter at which it is cut, if it has a motion.
pub(super) fn with_sweep(world: &World, id: u32, visit: &mut dyn FnMut(&dyn CoveredSet, f64)) {
    let robot = world.get_resource::<Roster>().and_then(|roster| roster.robots().get(id as usize).copied());
    if let Some((robot, ops)) = robot.and_then(|robot| Some((robot, world.get::<RobotOps>(robot)?))) {
        (ops.with_sweep)(world, robot, visit);
    }
}

/// The parts of all robots now in `world` but `id`, by ascending id.
pub fn others_now(world: &World, inhabited: Entity, id: RobotId) -> Vec<Placed> {
    let mut robots: Vec<(RobotId, Entity)> = world.get::<Residents>(inhabited).map_or_else(Vec::new, |residents| {
        residents.iter().filter_map(|robot| Some((*world.get::<RobotId>(robot)?, robot))).collect()
    });
    robots.retain(|(other, _)| *other != id);
    robots.sort_unstable();
    let mut parts = Vec::new();
    for (_, robot) in robots {
        if let Some(footprint) = world.get::<RobotOps>(robot).and_then(|ops| (ops.footprint)(world, robot)) {
            parts.extend(footprint.parts().iter().map(|p| p.placed().clone()));
        }
    }
    parts
}
