//! Robots that become robots of another type or kind before tick 0.

use motion_lab_core::configuration::{CarSizes, Sizes, TrailerSizes};
use motion_lab_core::prelude::*;
use motion_lab_core::robots::{CarBody, HITCH, Hitch, RUSTY, Rusty};
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

/// The resident has no sizes before: those of its new model are its own.
#[test]
fn a_car_of_another_make_has_its_sizes_in_the_configuration() {
    let mut app = app();
    let c = robot(app.world(), "C");
    let make = Hitch { wheelbase: 2.0, body: CarBody { width: 1.5, ..HITCH.body }, jackknife: Some(1.0), ..HITCH };
    app.world_mut().entity_mut(c).insert(RobotModel(make));
    let trailer = TrailerSizes {
        hitch_len: HITCH.with_trailer().hitch_len.unwrap(),
        width: HITCH.trailer_body.width,
        front_overhang: HITCH.trailer_body.front_overhang,
        rear_overhang: HITCH.trailer_body.rear_overhang,
        jackknife: Some(1.0),
    };
    let CarBody { length, rear_overhang, .. } = HITCH.body;
    let car = CarSizes { wheelbase: 2.0, length, width: 1.5, rear_overhang, max_steer: HITCH.max_steer, trailer };
    let world = app.world_mut();
    settle(world);
    assert_eq!(refused(world), [""; 0]);
    assert_eq!(world.resource::<RunConfig>().config().worlds[0].robots[2].sizes, Some(Sizes::Car(car)));
    assert_agrees(world);
    steps(world, 10);
    assert_recorded(world);
}
