//! Robots that become robots of another type or kind before tick 0.

use motion_lab_core::prelude::*;
use motion_lab_core::robots::{HITCH, Hitch, RUSTY, Rusty};
use motion_lab_core::worlds::Resident;
use motion_lab_sim::run::{Event, RobotInput};
use motion_lab_sim::simulation::{Configuration, DriveMode, PendingInput, RobotModel, RunConfig, settle};

use super::*;

#[test]
fn a_rover_that_becomes_a_car_is_driven_as_its_new_mode_says_and_nothing_is_refused() {
    let mut app = app();
    let a = robot(app.world(), "A");
    let q = HitchCfg { body: Pose2::new(0.0, -1.0, 0.5), trailer: None };
    let mode = DriveMode::<Hitch> { manual: true, channels: [64, 9], target: None, refusals: 0 };
    let world = app.world_mut();
    world.entity_mut(a).remove::<RobotModel<Rusty>>();
    world.entity_mut(a).insert((RobotModel(HITCH), Configuration::<Hitch>(q), mode, named("A", "hitch")));
    settle(world);
    assert_eq!(refused(world), [""; 0]);
    assert_eq!(
        world.resource::<RunConfig>().config().worlds[0].robots[0],
        Resident::new("A", "hitch", [0.0, -1.0, 0.5])
    );
    let expected = [Event { tick: 1, robot: "A".into(), input: RobotInput::Drive(64, 9) }];
    assert_eq!(world.resource::<PendingInput>().script().events, expected);
    assert_agrees(world);
    steps(world, 10);
    assert_eq!(frame(world).robots[0].channels, [64, 9]);
    assert_recorded(world);
}

#[test]
fn a_kind_registered_twice_with_one_type_is_told_by_its_name() {
    use motion_lab_sim::simulation::RobotPlugin;
    let mut app = App::new();
    let big = Rusty { body_radius: 0.3, max_speed: 0.2, ..RUSTY };
    app.add_plugins((TimePlugin, SimulationPlugin, RobotPlugin::new("x-big", big)));
    start_run(app.world_mut(), config(), Seed(7)).unwrap();
    let a = robot(app.world(), "A");
    app.world_mut().entity_mut(a).insert((RobotModel(big), RobotName::new("A", "x-big")));
    app.update();
    assert!(refused(app.world_mut()).is_empty());
    let resident = app.world().resource::<RunConfig>().config().worlds[0].robots[0].clone();
    assert_eq!((resident.kind.as_str(), resident.sizes), ("x-big", None));
}
