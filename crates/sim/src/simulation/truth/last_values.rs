//! `LastValues`, the values of a robot as the simulation wrote them last.

use bevy::prelude::*;

use super::component_name::name_of;
use crate::run::{Quantized, RobotInput};
use crate::simulation::{
    Configuration, Contacts, Control, DriveMode, OwnState, PreviousConfiguration, RobotModel, SimulatedRobot,
};
use motion_lab_core::configuration::Configuration as _;

/// The values of a robot as the simulation wrote them last: what other systems write meanwhile differs from them, and
/// put back. Only the simulation can name it.
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
    /// The input that its drive mode stands for.
    pub(crate) input: Option<RobotInput>,
    /// The names of the components that nobody else may write.
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

    /// Puts the values on the robot's entity, and is kept there.
    pub(crate) fn insert(self, robot: &mut EntityWorldMut) {
        let LastValues { configuration, previous, control, contacts, mode, own, .. } = self.clone();
        robot.insert((configuration, previous, control, contacts, mode, own, self));
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

/// Compares the components of a robot with the values kept, puts those back that `puts_back` says, and returns the
/// names of all that differ. One that is there with other bits and compares as equal, as -0.0 does, is put back in
/// silence.
fn compare<R: SimulatedRobot>(world: &mut World, e: Entity, puts_back: bool) -> Option<Vec<String>> {
    let mut robot = world.get_entity_mut(e).ok()?;
    let kept = robot.get::<LastValues<R>>()?.clone();
    let mut differing = Vec::new();
    let mut one = |differs: Option<bool>, name: fn() -> String| {
        if differs == Some(true) {
            differing.push(name());
        }
    };
    one(put(&mut robot, kept.configuration, puts_back), name_of::<Configuration<R>>);
    one(put(&mut robot, kept.previous, true), name_of::<PreviousConfiguration<R>>);
    one(put(&mut robot, kept.control, true), name_of::<Control<R>>);
    one(put(&mut robot, kept.contacts, true), name_of::<Contacts<R>>);
    one(put(&mut robot, kept.mode, puts_back), name_of::<DriveMode<R>>);
    one(put(&mut robot, kept.own, true), name_of::<OwnState<R>>);
    Some(differing)
}

/// Whether a component differs from the value kept; it then becomes that one, if `puts_back`. `None` where it is
/// missing.
fn put<C: Component<Mutability = bevy::ecs::component::Mutable> + PartialEq>(
    robot: &mut EntityWorldMut,
    kept: C,
    puts_back: bool,
) -> Option<bool> {
    let mut now = robot.get_mut::<C>()?;
    let differs = *now != kept;
    if differs && puts_back {
        *now = kept;
    } else if puts_back {
        *now.bypass_change_detection() = kept;
    }
    Some(differs)
}

/// Whether the components of a robot are those that the simulation wrote last: what is part of a frame to the bit.
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

/// Puts the values of a robot back, and returns the names of the components that differed.
pub(crate) fn put_back<R: SimulatedRobot>(world: &mut World, e: Entity) -> Vec<String> {
    if are_untouched::<R>(world, e) == Some(true) {
        return Vec::new();
    }
    compare::<R>(world, e, true).unwrap_or_default()
}

/// Takes what others have written into a robot at tick 0. All but its configuration is put back.
pub(crate) fn follow<R: SimulatedRobot>(world: &mut World, e: Entity) -> FollowedValues {
    let Some(mut refused) = compare::<R>(world, e, false) else { return FollowedValues::default() };
    let has_moved = refused.iter().any(|name| *name == name_of::<Configuration<R>>());
    let is_another =
        world.get::<RobotModel<R>>(e).zip(world.get::<LastValues<R>>(e)).is_some_and(|(m, k)| m.0 != k.model);
    refused.retain(|name| *name != name_of::<Configuration<R>>());
    let mode = world.get::<DriveMode<R>>(e).copied().unwrap_or_default();
    let input = world.get::<RobotModel<R>>(e).and_then(|model| input_of(&model.0, &mode));
    // a mode that an input stands for becomes that input
    refused.retain(|name| input.is_none() || *name != name_of::<DriveMode<R>>());
    if let Some(mut now) = world.get_mut::<DriveMode<R>>(e) {
        now.set_if_neq(DriveMode::default());
    }
    FollowedValues { is_moved: has_moved || is_another, input, refused }
}

/// The input that makes a touring robot be driven so. `None` for the tour, and for what no input gives.
fn input_of<R: SimulatedRobot>(model: &R, mode: &DriveMode<R>) -> Option<RobotInput> {
    let DriveMode { manual, channels: [a, b], target, refusals } = *mode;
    if !manual || refusals > 0 {
        return None;
    }
    if let Some(target) = target {
        let coordinates = target.coordinates();
        return coordinates.iter().map(|&c| Quantized::try_new(c)).collect::<Option<_>>().map(RobotInput::MoveTo);
    }
    let is_driven = model.driven([0.0; 2]).is_some() && [a, b].iter().all(|c| (-128..=128).contains(c));
    is_driven.then_some(RobotInput::Drive(a, b))
}
