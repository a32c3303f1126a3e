//! `RobotOps`, the operations of exclusive systems on a robot whose type they do not know.

use std::any::TypeId;
use std::cell::OnceCell;

use bevy::prelude::*;

use super::driven::InputTarget;
use super::refusal::InputRefusal;
use super::simulated::canonical;
use crate::run::{RobotInput, RobotState};
use crate::simulation::past::trail::Gauges;
use crate::simulation::tick::swept_set::{CoveredSet, CutMotion};
use crate::simulation::truth::last_values::{self, FollowedValues, LastValues};
use crate::simulation::{
    Configuration, Contacts, Control, Cut, DrawnTour, DriveMode, Extra, OwnState, PreviousConfiguration, ResidesIn,
    RobotId, RobotModel, RobotName, RobotView, SimulatedRobot, SimulatedWorld, TickMotion, WorldScene,
};
use motion_lab_core::collision::Surroundings;
use motion_lab_core::configuration::{Configuration as _, Coordinates};
use motion_lab_core::geometry::{Footprint, Placed, Pose2};

/// The operations of a robot's kind. A component of the robot's entity.
#[derive(Component, Clone, Copy, Debug)]
#[component(immutable)]
pub struct RobotOps {
    /// The robot's type.
    pub(crate) of_type: TypeId,
    /// Applies an input, or counts it as refused and says why. The last argument gives the parts of the other robots of
    /// its world.
    pub(crate) apply: fn(&mut World, Entity, &RobotInput, &dyn Fn(&World) -> Vec<Placed>) -> Option<InputRefusal>,
    pub(crate) footprint: fn(&World, Entity) -> Option<Footprint>,
    /// What a history keeps of the robot beside its state.
    pub(crate) gauges: fn(&World, Entity) -> Option<Gauges>,
    /// The pose of the frame that the robot's sensors are mounted in.
    pub(crate) mount_pose: fn(&World, Entity) -> Option<Pose2>,
    /// Calls the last argument with the sweep of the robot's cut motion in this tick, and the parameter at which it is
    /// cut. Without a motion it does nothing.
    pub(crate) with_sweep: fn(&World, Entity, &mut dyn FnMut(&dyn CoveredSet, f64)),
    /// Whether a run that has a sensor of its own gives the robot one.
    pub(crate) senses: fn(&World, Entity) -> bool,
    pub(crate) encode: fn(&World, Entity) -> Option<RobotState>,
    /// The tick's control, as it prints: in full, so that equal texts are equal controls.
    pub(crate) control: fn(&World, Entity) -> Option<String>,
    /// Overwrites the robot's components by a state. `None`, with nothing changed, when the state does not fit the
    /// robot.
    pub(crate) decode: fn(&mut World, Entity, &RobotState) -> Option<()>,
    /// Puts back what others have written into the robot in a run, and returns the names of the components; `None`
    /// where one is missing.
    pub(crate) put_back: fn(&mut World, Entity) -> Option<Vec<String>>,
    /// Takes what others have written into the robot at tick 0.
    pub(crate) follow: fn(&mut World, Entity) -> FollowedValues,
    /// The robot as a view shows it.
    pub(crate) view: fn(&World, Entity) -> Option<RobotView>,
}

impl RobotOps {
    pub(crate) fn of<R: SimulatedRobot>() -> Self {
        RobotOps {
            of_type: TypeId::of::<R>(),
            apply: apply::<R>,
            footprint: footprint::<R>,
            gauges: gauges::<R>,
            mount_pose: mount_pose::<R>,
            with_sweep: with_sweep::<R>,
            senses: senses::<R>,
            encode: encode::<R>,
            control: control::<R>,
            decode: decode::<R>,
            put_back: last_values::put_back::<R>,
            follow: last_values::follow::<R>,
            view: view::<R>,
        }
    }
}

fn footprint<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Footprint> {
    let robot = world.get_entity(e).ok()?;
    let q = robot.get::<Configuration<R>>()?.0;
    Some(robot.get::<RobotModel<R>>()?.0.fitted(&q).footprint(&q))
}

fn gauges<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Gauges> {
    let robot = &world.get::<RobotModel<R>>(e)?.0;
    let q = world.get::<Configuration<R>>(e)?.0;
    let footprint = robot.fitted(&q).footprint(&q);
    let odometer = robot.odometer(&world.get::<OwnState<R>>(e)?.extra);
    Some(Gauges { footprint, odometer, has_tip: robot.tip(&q).is_some() })
}

fn mount_pose<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Pose2> {
    Some(world.get::<RobotModel<R>>(e)?.0.mount_pose(&world.get::<Configuration<R>>(e)?.0))
}

fn with_sweep<R: SimulatedRobot>(world: &World, e: Entity, visit: &mut dyn FnMut(&dyn CoveredSet, f64)) {
    if let (Some(TickMotion(Some(motion))), Some(cut)) = (world.get::<TickMotion<R>>(e), world.get::<Cut<R>>(e)) {
        visit(&CutMotion { motion, until: cut.until }, cut.until);
    }
}

fn senses<R: SimulatedRobot>(world: &World, e: Entity) -> bool {
    let (robot, q) = (world.get::<RobotModel<R>>(e), world.get::<Configuration<R>>(e));
    robot.zip(q).is_some_and(|(robot, q)| robot.0.sensor_pose(&q.0).is_some())
}

fn apply<R: SimulatedRobot>(
    world: &mut World,
    e: Entity,
    input: &RobotInput,
    others: &dyn Fn(&World) -> Vec<Placed>,
) -> Option<InputRefusal> {
    let (after, refused) = (|| {
        let (model, route) = (world.get::<RobotModel<R>>(e)?, world.get::<DrawnTour<R>>(e)?);
        let (q, mode) = (world.get::<Configuration<R>>(e)?.0, *world.get::<DriveMode<R>>(e)?);
        let extra = world.get::<OwnState<R>>(e)?.extra.clone();
        let scene = &world.get::<WorldScene>(world.get::<ResidesIn>(e)?.0)?.0;
        // most inputs need no others
        let parts = OnceCell::new();
        let surroundings = || Surroundings { scene, others: parts.get_or_init(|| others(world)) };
        let (after, refused) = InputTarget { q, mode, extra }.after(&model.0, &route.0, input, surroundings);
        Some((after, refused.map(|why| InputRefusal::of(why, input.kind(), &model.0, &surroundings()))))
    })()?;
    let mut robot = world.entity_mut(e);
    if let Some(mut mode) = robot.get_mut::<DriveMode<R>>() {
        *mode = after.mode;
    }
    if let Some(mut q) = robot.get_mut::<Configuration<R>>() {
        q.0 = after.q;
    }
    if let Some(mut own) = robot.get_mut::<OwnState<R>>() {
        own.extra = after.extra;
    }
    refused
}

fn encode<R: SimulatedRobot>(world: &World, e: Entity) -> Option<RobotState> {
    let (mode, contacts) = (world.get::<DriveMode<R>>(e)?, world.get::<Contacts<R>>(e)?);
    let own = world.get::<OwnState<R>>(e)?;
    Some(state_of(*world.get::<RobotId>(e)?, &world.get::<Configuration<R>>(e)?.0, own, mode, contacts))
}

fn control<R: SimulatedRobot>(world: &World, e: Entity) -> Option<String> {
    Some(format!("{:?}", world.get::<Control<R>>(e)?.0))
}

/// The state of a robot with these components.
pub(crate) fn state_of<R: SimulatedRobot>(
    RobotId(id): RobotId,
    q: &R::Configuration,
    own: &OwnState<R>,
    mode: &DriveMode<R>,
    contacts: &Contacts<R>,
) -> RobotState {
    RobotState {
        id,
        configuration: q.coordinates(),
        extra: own.extra.clone(),
        channels: mode.channels,
        target: mode.target.map_or_else(Coordinates::new, |t| t.coordinates()),
        manual: mode.manual,
        in_contact: contacts.in_contact,
        contacts: contacts.episodes,
        flash: contacts.flash,
        refusals: mode.refusals,
    }
}

fn decode<R: SimulatedRobot>(world: &mut World, e: Entity, state: &RobotState) -> Option<()> {
    let robot = &world.get::<RobotModel<R>>(e)?.0;
    let q = canonical(&R::Configuration::from_coordinates(&state.configuration)?);
    robot.fitted(&q).check(&q).ok()?;
    let target = match &state.target[..] {
        [] => None,
        coordinates => Some(R::Configuration::from_coordinates(coordinates)?),
    };
    let extra: Extra = state.extra.iter().map(|x| x + 0.0).collect();
    if extra.len() != robot.initial_extra().len() || extra.iter().any(|x| x.is_nan()) {
        return None;
    }
    let values = LastValues {
        mode: DriveMode { manual: state.manual, channels: state.channels, target, refusals: state.refusals },
        contacts: Contacts::new(state.in_contact, state.contacts, state.flash),
        own: OwnState::new(extra),
        ..LastValues::at_start(robot, q)
    };
    world.entity_mut(e).insert(values.into_parts());
    Some(())
}

fn view<R: SimulatedRobot>(world: &World, e: Entity) -> Option<RobotView> {
    let robot = &world.get::<RobotModel<R>>(e)?.0;
    let (q, previous) = (world.get::<Configuration<R>>(e)?.0, world.get::<PreviousConfiguration<R>>(e)?.0);
    let (mode, contacts) = (world.get::<DriveMode<R>>(e)?, world.get::<Contacts<R>>(e)?);
    let name = world.get::<RobotName>(e)?;
    Some(RobotView {
        id: world.get::<RobotId>(e)?.0,
        name: name.name.clone(),
        kind: name.kind.clone(),
        about: name.about,
        model: robot.lab_model(),
        world: world.get::<SimulatedWorld>(world.get::<ResidesIn>(e)?.0)?.index,
        configuration: q.to_string(),
        configuration_in_full: format!("{q:?}"),
        coordinates: q.coordinates(),
        footprint: robot.fitted(&q).footprint(&q),
        previous_footprint: robot.fitted(&previous).footprint(&previous),
        tip: robot.tip(&q),
        in_contact: contacts.in_contact,
        contacts: contacts.episodes,
        flash: contacts.flash,
        manual: mode.manual,
        channels: mode.channels,
        refusals: mode.refusals,
        encoders: robot.encoders(&world.get::<OwnState<R>>(e)?.extra),
        odometer: robot.odometer(&world.get::<OwnState<R>>(e)?.extra),
    })
}
