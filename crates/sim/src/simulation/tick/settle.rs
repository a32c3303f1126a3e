//! The systems that cut each motion, settle which robots advance, and count contacts.

use bevy::ecs::query::QueryData;
use bevy::prelude::*;

use super::crowd::NeighbourMemory;
use super::hold::{self, Advance};
use super::parallel::each;
use super::world_crowds::WorldCrowds;
use crate::simulation::components::CutOf;
use crate::simulation::robot::simulated::canonical;
use crate::simulation::truth::last_values::LastValues;
use crate::simulation::{
    Configuration, Contacts, Control, Cut, DriveMode, OwnState, PreviousConfiguration, ResidesIn, RobotId, RobotModel,
    SceneRevision, SimulatedRobot, TickMotion, WorldScene,
};
use motion_lab_core::collision::{Scene, Surroundings, is_free_among};
use motion_lab_core::configuration::Configuration as Coordinates;
use motion_lab_core::geometry::Placed;
use motion_lab_core::robots::Motion as _;

/// Number of ticks that a flash holds after contact: 0.3 s.
pub const FLASH_TICKS: u32 = 6;

/// The components of a robot that [`cut`] reads and writes.
type CutRobot<R> = (
    &'static RobotId,
    &'static ResidesIn,
    &'static Configuration<R>,
    &'static Control<R>,
    &'static TickMotion<R>,
    &'static mut Cut<R>,
);

/// Cuts every motion of a kind at the walls and at all other robots' starting footprints. A robot without others near
/// keeps its last cut while its configuration, its control and the scene stay the same.
pub(crate) fn cut<R: SimulatedRobot>(
    crowds: Res<WorldCrowds>,
    scenes: Query<(&WorldScene, &SceneRevision)>,
    mut robots: Query<CutRobot<R>>,
) {
    each(robots.iter_mut(), NeighbourMemory::default, |room, (&id, inhabited, q, u, motion, mut cut)| {
        let (Some(motion), Ok((WorldScene(scene), &revision))) = (&motion.0, scenes.get(inhabited.0)) else {
            *cut = Cut::new(0.0, false);
            return;
        };
        room.clear();
        if let Some(crowd) = crowds.of(id) {
            crowd.others(id.0, room);
        }
        let of =
            room.parts.is_empty().then_some(CutOf { robot: id, configuration: q.0, control: u.0, scene: revision });
        if of.is_none() || cut.of != of {
            *cut = Cut { of, ..cut_among(scene, &room.parts, motion) };
        }
    });
}

/// The cut of a motion among obstacles and the parts of other robots.
pub(crate) fn cut_among<R: SimulatedRobot>(scene: &Scene, others: &[Placed], motion: &R::Drive) -> Cut<R> {
    let surroundings = Surroundings { scene, others };
    if R::HELD {
        let Advance { until, blocked } = hold::advance(&surroundings, motion);
        Cut::new(until, blocked)
    } else {
        // a robot that is not held goes all the way, in contact unless proven free
        Cut::new(1.0, !is_free_among(&surroundings, motion))
    }
}

/// The components of a robot that [`settle`] reads and writes.
#[derive(QueryData)]
#[query_data(mutable)]
pub(crate) struct Settled<R: SimulatedRobot> {
    id: &'static RobotId,
    model: &'static RobotModel<R>,
    motion: &'static TickMotion<R>,
    cut: &'static Cut<R>,
    configuration: &'static mut Configuration<R>,
    contacts: &'static mut Contacts<R>,
    mode: &'static mut DriveMode<R>,
    previous: &'static PreviousConfiguration<R>,
    control: &'static Control<R>,
    own: &'static OwnState<R>,
    kept: &'static mut LastValues<R>,
}

/// Advances every robot of a kind along its cut motion, and counts contacts. A motion that meets the cut motion of a
/// robot with a lower id in its world is in contact; a robot that contact holds then stays where it started.
pub(crate) fn settle<R: SimulatedRobot>(mut crowds: ResMut<WorldCrowds>, mut robots: Query<Settled<R>>) {
    for settled in &mut robots {
        let SettledItem { id: &id, model, motion, cut, mut configuration, mut contacts, mut mode, .. } = settled;
        let (robot, motion) = (&model.0, motion.0.as_ref());
        let met = motion.is_some() && crowds.has_met(id);
        if let Some(motion) = motion {
            let until = if met && R::HELD { 0.0 } else { cut.until };
            if let Some(end) = end_of(robot, motion, until) {
                configuration.0 = end;
            }
        }
        *contacts = contacts.after(cut.contact || met);
        let q = configuration.0;
        if mode.target.is_some_and(|target| is_there(&target, &q)) {
            mode.target = None;
        }
        if let Some(crowd) = crowds.of_mut(id) {
            crowd.settle(id.0, &robot.fitted(&q).footprint(&q));
        }
        let SettledItem { previous, control, own, mut kept, .. } = settled;
        kept.keep(&configuration, previous, (control, own), (&contacts, &mode));
    }
}

/// Where a motion cut at `until` ends; `None` for what is no configuration of the robot, which then stays.
pub(crate) fn end_of<R: SimulatedRobot>(robot: &R, motion: &R::Drive, until: f64) -> Option<R::Configuration> {
    let end = canonical(&motion.at(until));
    robot.fitted(&end).check(&end).is_ok().then_some(end)
}

/// Whether a configuration is that of a target.
pub(crate) fn is_there<C: Coordinates>(target: &C, q: &C) -> bool {
    target.difference(q).is_ok_and(|d| d.iter().all(|x| *x == 0.0))
}

impl<R: SimulatedRobot> Contacts<R> {
    /// The contacts after one more tick, in contact or not.
    pub(crate) fn after(&self, in_contact: bool) -> Self {
        let begins = in_contact && !self.in_contact;
        let flash = if in_contact { FLASH_TICKS } else { self.flash.saturating_sub(1) };
        Contacts::new(in_contact, self.episodes.saturating_add(begins.into()), flash)
    }
}
