//! `LastValues`, the values of a robot as the simulation wrote them last.

use bevy::prelude::*;

use super::component_name::name_of;
use crate::run::{Event, Quantized, RobotInput, Script};
use crate::simulation::robot::driven::are_taken;
use crate::simulation::{
    Configuration, Contacts, Control, DriveMode, OwnState, PreviousConfiguration, RobotModel, SimulatedRobot,
};
use motion_lab_core::configuration::Configuration as _;

/// The values of a robot as the simulation wrote them last: what other systems write meanwhile differs from them, and
/// is put back. Only the simulation can name it.
#[derive(Component, Clone, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct LastValues<R: SimulatedRobot> {
    pub(crate) model: R,
    pub(crate) configuration: Configuration<R>,
    pub(crate) previous: PreviousConfiguration<R>,
    pub(crate) control: Control<R>,
    pub(crate) contacts: Contacts<R>,
    pub(crate) mode: DriveMode<R>,
    pub(crate) own: OwnState<R>,
}

/// What others have written into a robot that stands at tick 0.
#[derive(Debug, Default)]
pub(crate) struct FollowedValues {
    /// Whether its configuration or its model is another.
    pub(crate) is_moved: bool,
    /// The inputs that its drive mode stands for.
    pub(crate) inputs: Vec<RobotInput>,
    /// The names of the components that are put back.
    pub(crate) refused: Vec<String>,
}

impl<R: SimulatedRobot> LastValues<R> {
    /// The values of a robot at the start of a run.
    pub(crate) fn at_start(model: &R, q: R::Configuration) -> Self {
        LastValues {
            model: model.clone(),
            configuration: Configuration(q),
            previous: PreviousConfiguration(q),
            control: Control::default(),
            contacts: Contacts::default(),
            mode: DriveMode::default(),
            own: OwnState::new(model.initial_extra()),
        }
    }

    /// The values as components of the robot's entity, and what keeps them.
    pub(crate) fn into_parts(self) -> impl Bundle {
        let LastValues { configuration, previous, control, contacts, mode, own, .. } = self.clone();
        (configuration, previous, control, contacts, mode, own, self)
    }
}

impl<R: SimulatedRobot> LastValues<R> {
    /// Keeps the values that a tick has left.
    pub(crate) fn keep(
        &mut self,
        configuration: &Configuration<R>,
        previous: &PreviousConfiguration<R>,
        (control, own): (&Control<R>, &OwnState<R>),
        (contacts, mode): (&Contacts<R>, &DriveMode<R>),
    ) {
        self.configuration = *configuration;
        self.previous = *previous;
        self.control = *control;
        self.own.extra.clone_from(&own.extra);
        self.contacts = *contacts;
        self.mode = *mode;
    }
}

/// Compares the components of a robot with the values kept, puts those back that may not be written, and returns the
/// names of all that differ. Configuration and drive mode may be written at tick 0, and not later. One that is there
/// with other bits and compares as equal, as -0.0 does, is put back in silence; one that is missing stays so.
fn compare<R: SimulatedRobot>(world: &mut World, e: Entity, is_later: bool) -> Option<Vec<String>> {
    let mut robot = world.get_entity_mut(e).ok()?;
    let kept = robot.get::<LastValues<R>>()?.clone();
    let mut differing = Vec::new();
    let mut one = |differs: bool, name: fn() -> String| {
        if differs {
            differing.push(name());
        }
    };
    one(put(&mut robot, kept.configuration, is_later), name_of::<Configuration<R>>);
    one(put(&mut robot, kept.mode, is_later), name_of::<DriveMode<R>>);
    one(put(&mut robot, kept.previous, true), name_of::<PreviousConfiguration<R>>);
    one(put(&mut robot, kept.control, true), name_of::<Control<R>>);
    one(put(&mut robot, kept.contacts, true), name_of::<Contacts<R>>);
    one(put(&mut robot, kept.own, true), name_of::<OwnState<R>>);
    Some(differing)
}

/// Whether a component differs from the value kept; it then becomes that one, if it `is_put_back`.
fn put<C: Component<Mutability = bevy::ecs::component::Mutable> + PartialEq>(
    robot: &mut EntityWorldMut,
    kept: C,
    is_put_back: bool,
) -> bool {
    let Some(mut now) = robot.get_mut::<C>() else { return false };
    let differs = *now != kept;
    if !differs {
        // to the bit
        *now.bypass_change_detection() = kept;
    } else if is_put_back {
        *now = kept;
    }
    differs
}

/// Whether the components of a robot are those that the simulation wrote last: what is part of a frame to the bit.
/// `None` where one is missing.
fn are_untouched<R: SimulatedRobot>(world: &World, e: Entity) -> Option<bool> {
    let robot = world.get_entity(e).ok()?;
    let last = robot.get::<LastValues<R>>()?;
    let (q, mode, own) = (robot.get::<Configuration<R>>()?, robot.get::<DriveMode<R>>()?, robot.get::<OwnState<R>>()?);
    let same_mode = *mode == last.mode && mode.target.zip(last.mode.target).is_none_or(|(now, last)| same(&now, &last));
    let same_own = own.extra.iter().map(|x| x.to_bits()).eq(last.own.extra.iter().map(|x| x.to_bits()));
    let others = robot.get::<PreviousConfiguration<R>>()? == &last.previous
        && robot.get::<Control<R>>()? == &last.control
        && robot.get::<Contacts<R>>()? == &last.contacts;
    Some(same(&q.0, &last.configuration.0) && same_mode && same_own && others)
}

/// Whether two configurations have the same bits.
fn same<C: motion_lab_core::configuration::Configuration>(a: &C, b: &C) -> bool {
    a.coordinates().iter().map(|x| x.to_bits()).eq(b.coordinates().iter().map(|x| x.to_bits()))
}

/// Puts the values of a robot back, and returns the names of the components that differed; `None` where one is missing.
pub(crate) fn put_back<R: SimulatedRobot>(world: &mut World, e: Entity) -> Option<Vec<String>> {
    if are_untouched::<R>(world, e)? { Some(Vec::new()) } else { compare::<R>(world, e, true) }
}

/// Takes what others have written into a robot at tick 0, one that is new in the run too. All but its configuration is
/// put back.
pub(crate) fn follow<R: SimulatedRobot>(world: &mut World, e: Entity) -> FollowedValues {
    let model = world.get::<RobotModel<R>>(e).map(|model| &model.0);
    let has_its_model = model.zip(world.get::<LastValues<R>>(e)).is_some_and(|(model, last)| *model == last.model);
    if has_its_model && are_untouched::<R>(world, e) == Some(true) {
        return FollowedValues::default();
    }
    let mut refused = compare::<R>(world, e, false).unwrap_or_default();
    let [of_configuration, of_mode] = [name_of::<Configuration<R>>(), name_of::<DriveMode<R>>()];
    let is_moved = !has_its_model || refused.contains(&of_configuration);
    refused.retain(|name| *name != of_configuration && *name != of_mode);
    let inputs = inputs_of_mode::<R>(world, e).unwrap_or_else(|| {
        refused.push(of_mode);
        Vec::new()
    });
    if let Some(mut mode) = world.get_mut::<DriveMode<R>>(e) {
        mode.set_if_neq(DriveMode::default());
    }
    FollowedValues { is_moved, inputs, refused }
}

/// The inputs that make a touring robot be driven as its mode says. None for the tour; `None` for what no input gives.
fn inputs_of_mode<R: SimulatedRobot>(world: &World, e: Entity) -> Option<Vec<RobotInput>> {
    let mode = world.get::<DriveMode<R>>(e).copied().unwrap_or_default();
    let DriveMode { manual, channels: [a, b], target, refusals } = mode;
    if mode == DriveMode::default() {
        return Some(Vec::new());
    } else if !manual || refusals > 0 {
        return None;
    }
    let to = |q: R::Configuration| q.coordinates().iter().map(|&c| Quantized::try_new(c)).collect::<Option<_>>();
    let mut inputs = Vec::new();
    if target.is_none() || [a, b] != [0; 2] {
        inputs.push(RobotInput::Drive(a, b));
    }
    if let Some(target) = target {
        inputs.push(RobotInput::MoveTo(to(target)?));
    }
    let event = |input: &RobotInput| Event { tick: 1, robot: "its robot".into(), input: input.clone() };
    Script::new(inputs.iter().map(event).collect(), Vec::new()).check().ok()?;
    let (robot, q) = (world.get::<RobotModel<R>>(e)?, world.get::<Configuration<R>>(e)?);
    are_taken(&robot.0, &q.0, &inputs).then_some(inputs)
}
