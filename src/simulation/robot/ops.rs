//! `RobotOps`, the operations of exclusive systems on a robot whose type they do not know.

use bevy::prelude::*;

use super::simulated::canonical;
use crate::collision::{Collision, Surroundings};
use crate::configuration::{Configuration as _, Coordinates};
use crate::geometry::{Footprint, Placed, Pose2};
use crate::run::{Quantized, RobotInput, RobotState};
use crate::simulation::{
    Configuration, Contacts, DriveMode, Extra, OwnState, PreviousConfiguration, ResidesIn, RobotId, RobotModel,
    RobotName, RobotView, Route, SimulatedRobot, SimulatedWorld, WorldScene,
};

/// The operations of a robot's kind. A component of the robot's entity.
#[derive(Component, Clone, Copy, Debug)]
#[component(immutable)]
pub struct RobotOps {
    /// Applies an input, or counts it as refused. The last argument holds the parts of the other robots of its world.
    pub(crate) apply: fn(&mut World, Entity, &RobotInput, &[Placed]),
    /// The robot's present footprint.
    pub(crate) footprint: fn(&World, Entity) -> Option<Footprint>,
    /// The pose of the frame that the robot's sensors are mounted in.
    pub(crate) mount_pose: fn(&World, Entity) -> Option<Pose2>,
    /// Whether a run that has a sensor of its own gives the robot one.
    pub(crate) senses: fn(&World, Entity) -> bool,
    /// The robot's state.
    pub(crate) encode: fn(&World, Entity) -> Option<RobotState>,
    /// Overwrites the robot's components by a state. `None`, with nothing changed, when the state does not fit the
    /// robot.
    pub(crate) decode: fn(&mut World, Entity, &RobotState) -> Option<()>,
    /// The robot as a view shows it.
    pub(crate) view: fn(&World, Entity) -> Option<RobotView>,
}

impl RobotOps {
    pub(crate) fn of<R: SimulatedRobot>() -> Self {
        RobotOps {
            apply: apply::<R>,
            footprint: footprint::<R>,
            mount_pose: mount_pose::<R>,
            senses: senses::<R>,
            encode: encode::<R>,
            decode: decode::<R>,
            view: view::<R>,
        }
    }
}

fn footprint<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Footprint> {
    let q = world.get::<Configuration<R>>(e)?.0;
    Some(world.get::<RobotModel<R>>(e)?.0.fitted(&q).footprint(&q))
}

fn mount_pose<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Pose2> {
    Some(world.get::<RobotModel<R>>(e)?.0.mount_pose(&world.get::<Configuration<R>>(e)?.0))
}

fn senses<R: SimulatedRobot>(world: &World, e: Entity) -> bool {
    let (robot, q) = (world.get::<RobotModel<R>>(e), world.get::<Configuration<R>>(e));
    robot.zip(q).is_some_and(|(robot, q)| robot.0.sensor_pose(&q.0).is_some())
}

/// The driver's new state after an accepted input, and the configuration that the robot is put in, if any. `None`
/// for a refused input.
fn accepted<R: SimulatedRobot>(
    robot: &R,
    q: &R::Configuration,
    mode: &DriveMode<R>,
    input: &RobotInput,
    is_free: impl Fn(&R::Configuration) -> bool,
) -> Option<(DriveMode<R>, Option<R::Configuration>)> {
    let values = |c: &[Quantized]| c.iter().map(|c| c.value()).collect::<Coordinates>();
    let taken_over = DriveMode { manual: true, ..*mode };
    let put = |q: R::Configuration| is_free(&q).then_some((DriveMode { target: None, ..taken_over }, Some(q)));
    match input {
        RobotInput::Drive(a, b) => {
            let channels = [*a, *b];
            let in_range = channels.iter().all(|c| (-128..=128).contains(c));
            (in_range && robot.driven([0.0; 2]).is_some())
                .then_some((DriveMode { channels, target: None, ..taken_over }, None))
        }
        RobotInput::MoveTo(target) => {
            let target = canonical(&robot.configuration_at(q, &values(target))?);
            robot.toward(q, &target)?;
            Some((DriveMode { target: Some(target), ..taken_over }, None))
        }
        RobotInput::Teleport(to) => put(canonical(&robot.configuration_at(q, &values(to))?)),
        RobotInput::SetTrailer(on) => {
            let to = canonical(&robot.with_trailer_set(q, *on)?);
            if to == *q { Some((taken_over, None)) } else { put(to) }
        }
        RobotInput::Release => Some((DriveMode { refusals: mode.refusals, ..DriveMode::default() }, None)),
    }
}

fn apply<R: SimulatedRobot>(world: &mut World, e: Entity, input: &RobotInput, others: &[Placed]) {
    let Some(changed) = (|| {
        let robot = &world.get::<RobotModel<R>>(e)?.0;
        let (q, mode) = (world.get::<Configuration<R>>(e)?.0, *world.get::<DriveMode<R>>(e)?);
        let inhabited = world.get::<ResidesIn>(e)?.0;
        let surroundings = Surroundings { scene: &world.get::<WorldScene>(inhabited)?.0, others };
        let is_free = |q: &R::Configuration| {
            let robot = robot.fitted(q);
            robot.is_within_limits(q) && !surroundings.intersects(&robot.footprint(q))
        };
        let (after, put) = accepted(robot, &q, &mode, input, is_free)
            .unwrap_or((DriveMode { refusals: mode.refusals.saturating_add(1), ..mode }, None));
        let mut extra = world.get::<OwnState<R>>(e)?.extra.clone();
        if mode.manual && !after.manual {
            robot.resume(&world.get::<Route<R>>(e)?.0, &q, &surroundings, &mut extra);
        }
        Some((after, put, extra))
    })() else {
        return;
    };
    let (after, put, extra) = changed;
    let mut robot = world.entity_mut(e);
    if let Some(mut mode) = robot.get_mut::<DriveMode<R>>() {
        *mode = after;
    }
    if let (Some(to), Some(mut q)) = (put, robot.get_mut::<Configuration<R>>()) {
        q.0 = to;
    }
    if let Some(mut own) = robot.get_mut::<OwnState<R>>() {
        own.extra = extra;
    }
}

fn encode<R: SimulatedRobot>(world: &World, e: Entity) -> Option<RobotState> {
    let (mode, contacts) = (world.get::<DriveMode<R>>(e)?, world.get::<Contacts<R>>(e)?);
    Some(RobotState {
        id: world.get::<RobotId>(e)?.0,
        configuration: world.get::<Configuration<R>>(e)?.0.coordinates(),
        extra: world.get::<OwnState<R>>(e)?.extra.clone(),
        channels: mode.channels,
        target: mode.target.map_or_else(Coordinates::new, |t| t.coordinates()),
        manual: mode.manual,
        in_contact: contacts.in_contact,
        contacts: contacts.episodes,
        flash: contacts.flash,
        refusals: mode.refusals,
    })
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
    let mut robot = world.entity_mut(e);
    *robot.get_mut::<DriveMode<R>>()? =
        DriveMode { manual: state.manual, channels: state.channels, target, refusals: state.refusals };
    *robot.get_mut::<Contacts<R>>()? = Contacts::new(state.in_contact, state.contacts, state.flash);
    robot.get_mut::<OwnState<R>>()?.extra = extra;
    robot.get_mut::<Configuration<R>>()?.0 = q;
    robot.get_mut::<PreviousConfiguration<R>>()?.0 = q;
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
