//! The systems that cut each motion, settle which robots advance, and count contacts.

use bevy::prelude::*;

use super::hold::{self, Advance, margin_from};
use super::starts::{Starts, Sweeps};
use super::sweep::{CutMotion, sweeps_meet};
use crate::collision::{Surroundings, is_free_among};
use crate::configuration::Configuration as _;
use crate::robots::Motion as _;
use crate::simulation::robot::simulated::canonical;
use crate::simulation::{
    Configuration, Contacts, Control, Cut, CutOf, DriveMode, ResidesIn, RobotId, RobotModel, SceneRevision,
    SimulatedRobot, TickMotion, WorldScene,
};

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

/// Cuts every motion of a kind at the walls and at all other robots' starting footprints. A robot alone in its world
/// keeps its last cut while its configuration, its control and the scene stay the same.
pub(crate) fn cut<R: SimulatedRobot>(
    starts: Res<Starts>,
    mut sweeps: ResMut<Sweeps>,
    scenes: Query<(&WorldScene, &SceneRevision)>,
    mut robots: Query<CutRobot<R>>,
) {
    for (&id, &ResidesIn(world), Configuration(q), Control(u), TickMotion(motion), mut cut) in &mut robots {
        let (Some(motion), Ok((WorldScene(scene), &revision))) = (motion, scenes.get(world)) else {
            *cut = Cut::new(0.0, false);
            continue;
        };
        let others = starts.others(world, id);
        let of = others.is_empty().then_some(CutOf { configuration: *q, control: *u, scene: revision });
        if of.is_some() && cut.of == of {
            continue;
        }
        let surroundings = Surroundings { scene, others: &others };
        *cut = if R::HELD {
            let Advance { until, blocked } = hold::advance(&surroundings, motion);
            Cut::new(until, blocked)
        } else {
            // a robot that is not held goes all the way, in contact unless proven free
            Cut::new(1.0, !is_free_among(&surroundings, motion))
        };
        cut.of = of;
        if !others.is_empty() {
            sweeps.add(world, id, Box::new(CutMotion { motion: motion.clone(), until: cut.until }));
        }
    }
}

/// The components of a robot that [`settle`] reads and writes.
type Settled<R> = (
    &'static RobotId,
    &'static ResidesIn,
    &'static RobotModel<R>,
    &'static TickMotion<R>,
    &'static Cut<R>,
    &'static mut Configuration<R>,
    &'static mut Contacts<R>,
    &'static mut DriveMode<R>,
);

/// Advances every robot of a kind along its cut motion, and counts contacts. A motion that meets the cut motion of a
/// robot with a lower id in its world is in contact; a robot that contact holds then stays where it started.
pub(crate) fn settle<R: SimulatedRobot>(starts: Res<Starts>, sweeps: Res<Sweeps>, mut robots: Query<Settled<R>>) {
    for (&id, &ResidesIn(world), RobotModel(robot), TickMotion(motion), cut, mut q, mut contacts, mut mode) in
        &mut robots
    {
        let (mut until, mut in_contact) = (cut.until, cut.contact);
        if let Some(motion) = motion {
            let met = until > 0.0
                && sweeps.below(world, id).any(|(lower, sweep)| {
                    // the motion is already cut at robots that stand still
                    if sweep.is_still() {
                        return false;
                    }
                    let own = CutMotion { motion: motion.clone(), until };
                    let margin = margin_from(starts.distance(world, id, lower));
                    sweeps_meet(&own, sweep, margin)
                });
            in_contact |= met;
            if met && R::HELD {
                until = 0.0;
            }
            let end = canonical(&motion.at(until));
            if robot.fitted(&end).check(&end).is_ok() {
                q.0 = end;
            }
        }
        let episode = in_contact && !contacts.in_contact;
        let flash = if in_contact { FLASH_TICKS } else { contacts.flash.saturating_sub(1) };
        *contacts = Contacts::new(in_contact, contacts.episodes.saturating_add(episode.into()), flash);
        let arrived = mode.target.is_some_and(|t| t.difference(&q.0).is_ok_and(|d| d.iter().all(|x| *x == 0.0)));
        if arrived {
            mode.target = None;
        }
    }
}
