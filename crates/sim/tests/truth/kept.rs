//! What the simulation keeps for itself: parts of entities that nobody else can name, and what is kept of a scene.

use bevy::ecs::component::ComponentId;
use motion_lab_core::prelude::*;
use motion_lab_core::robots::Rusty;
use motion_lab_core::worlds::{Obstacle, ObstacleKind};
use motion_lab_sim::simulation::{
    Configuration, Contacts, Control, Cut, DrawnTour, DriveMode, OwnState, PreviousConfiguration, ResidesIn, RobotId,
    RobotModel, RobotName, RobotOps, RunConfig, Sensors, Slip, TickMotion,
};

use super::in_run::refusals_of;
use super::*;

fn a(world: &Ecs) -> Entity {
    robot(world, "A")
}

#[test]
fn what_is_kept_of_another_run_changes_no_bit() {
    let at = |x| vec![(Pose2::new(x, 0.0, 0.0), Shape::Disc { radius: 0.1 })];
    let mut walled = config();
    walled.worlds[0].robots.truncate(1);
    let free = walled.clone();
    walled.worlds[0].obstacles.push(Obstacle::new("near", ObstacleKind::Solid, at(0.6)));
    let begin = |app: &mut App, config: &TourConfig| {
        start_run(app.world_mut(), config.clone(), Seed(7)).unwrap();
        drive(app, "A", (128, 0));
    };
    let mut app = app();
    begin(&mut app, &walled);
    while frame(app.world()).robots[0].contacts == 0 {
        assert!(frame(app.world()).tick < 40);
        step(app.world_mut());
    }
    let tick = frame(app.world()).tick;
    let held = *app.world().get::<Cut<Rusty>>(a(app.world())).unwrap();
    // the same motion from the same place, with nothing in its way
    begin(&mut app, &free);
    steps(app.world_mut(), tick - 1);
    let a = a(app.world());
    *app.world_mut().get_mut::<Cut<Rusty>>(a).unwrap() = held;
    step(app.world_mut());
    assert_eq!(frame(app.world()).robots[0].contacts, 0);
    assert_recorded(app.world());
}

/// The parts of a rover that others can name.
type Nameable = (
    (RobotModel<Rusty>, Configuration<Rusty>, PreviousConfiguration<Rusty>, Control<Rusty>, Contacts<Rusty>),
    (DriveMode<Rusty>, OwnState<Rusty>, DrawnTour<Rusty>, TickMotion<Rusty>, Cut<Rusty>, Slip),
    (RobotId, RobotName, ResidesIn, RobotOps, Sensors),
);

/// The components of a rover that nobody else can name, by their numbers, which are those of every such app.
fn unnameable() -> Vec<ComponentId> {
    let mut app = app();
    let a = a(app.world());
    let components = |world: &Ecs| world.entity(a).archetype().components().to_vec();
    let before = components(app.world());
    // at tick 0 they stay away until the run is settled
    app.world_mut().entity_mut(a).retain::<Nameable>();
    let after = components(app.world());
    before.into_iter().filter(|component| !after.contains(component)).collect()
}

/// The entities of a run are known and compared by components that nobody else can name; but they can be removed.
#[test]
fn an_entity_that_loses_what_only_the_simulation_can_name_is_still_the_runs() {
    let unnameable = unnameable();
    assert_eq!(unnameable.len(), 2);
    let lose = |world: &mut Ecs, lost: &[ComponentId]| {
        let a = a(world);
        world.entity_mut(a).remove_by_ids(lost);
        a
    };
    for lost in [&unnameable[..1], &unnameable[1..], &unnameable] {
        assert_eq!(refusals_of(|world| _ = lose(world, lost)), [""; 0]);
        let said = refusals_of(|world| {
            let a = lose(world, lost);
            world.get_mut::<Configuration<Rusty>>(a).unwrap().0.x += 0.25;
        });
        assert!(said.len() == 1 && said[0].contains("Configuration<Rusty> was changed past"), "{said:?}");
        let said = refusals_of(|world| {
            let a = lose(world, lost);
            world.despawn(a);
        });
        assert!(said[0].starts_with("robot \"A\" (entity "), "{said:?}");
        // at tick 0 it is the run's first robot as before
        let mut app = app();
        lose(app.world_mut(), lost);
        steps(app.world_mut(), 5);
        assert_agrees(app.world_mut());
        assert_recorded(app.world());
        assert_eq!(app.world().resource::<RunConfig>().config().worlds, config().worlds);
    }
    let said = refusals_of(|world| {
        let a = a(world);
        world.entity_mut(a).retain::<(RobotModel<Rusty>, Configuration<Rusty>, RobotName, ResidesIn)>();
    });
    assert!(said.len() > 5, "{said:?}");
}
