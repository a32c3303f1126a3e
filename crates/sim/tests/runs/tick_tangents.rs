//! Ticks of the simulator whose motion grazes: exactly tangent it is a contact, as for an edge; a little off it is not.

use bevy::app::App;
use motion_lab_core::prelude::*;
use motion_lab_core::worlds::Resident;
use motion_lab_sim::recording::Run;
use motion_lab_sim::run::{Event, Quantized, RobotInput, RobotState, Script};
use motion_lab_sim::simulation::RobotPlugin;
use motion_lab_sim::tour::TourConfig;

use oracle::grazing::{Grazed, HAIR, about_a_circle, beside_a_line};
use oracle::seen::{Seen, world_of};

/// An arm of 2 m with thick links, and a rover without slip, both with dimensions that are exact.
fn robots(app: &mut App) {
    let arm = Reach { base: Point2::origin(), lengths: [1.0, 1.0], link_radius: 0.25 };
    app.add_plugins((
        RobotPlugin::new("thick", arm),
        RobotPlugin::new("smooth", Rusty { body_radius: 0.25, max_slip: 0.0, ..RUSTY }),
    ));
}

/// The robot after one tick with this thing in the way.
fn after_a_tick(thing: &Seen, kind: &str, start: &[f64], input: RobotInput) -> RobotState {
    let mut world = world_of(std::slice::from_ref(thing), false);
    world.robots.push(Resident::new("it", kind, start));
    let script = Script { events: vec![Event { tick: 1, robot: "it".into(), input }], ..Script::empty() };
    let config = TourConfig { worlds: vec![world], ticks: 1, sensor: None };
    let log = Run::record_with_robots(config, (Seed(1), script), robots).unwrap();
    log.into_frames().remove(0).robots.remove(0)
}

#[test]
fn an_arm_whose_tick_grazes_is_in_contact_and_goes_on() {
    // motions through angle 0 within the tick: one so short that a single step's proof fails by less than a nanometre,
    // and long ones
    for (from, to) in [(-1.0 / 128.0, 1.0 / 128.0), (-0.375, 0.5), (0.25, -0.0625)] {
        for Grazed { what, thing, away } in about_a_circle(2.25, 2.5) {
            if what.ends_with("3-4-5") {
                continue; // not on the way
            }
            let tick = |thing: &Seen| {
                let target = [to, 0.0].map(|angle| Quantized::try_new(angle).unwrap());
                after_a_tick(thing, "thick", &[from, 0.0], RobotInput::MoveTo(target.to_vec()))
            };
            let touching = tick(&thing);
            assert!(touching.in_contact && touching.contacts == 1, "{what}, from {from} to {to}: {touching:?}");
            assert_eq!(touching.configuration[..], [to, 0.0], "nothing holds an arm");
            let off = tick(&thing.map(|p| p + away));
            assert!(!off.in_contact && off.contacts == 0, "{what}, a hair off, from {from} to {to}: {off:?}");
        }
    }
}

#[test]
fn a_rover_whose_tick_grazes_is_held_before_it_and_a_tenth_of_a_millimetre_off_goes_by() {
    for Grazed { what, thing, .. } in beside_a_line() {
        // 3 cm ahead past x = 0, from 2 cm before it
        let tick = |thing: &Seen| after_a_tick(thing, "smooth", &[-0.02, 0.0, 0.0], RobotInput::Drive(128, 0));
        let touching = tick(&thing);
        assert!(touching.in_contact && touching.contacts == 1, "{what}: {touching:?}");
        assert!(touching.configuration[0] < 0.0, "{what}: it goes through, to {:?}", touching.configuration);
        let off = tick(&thing.map(|p| p + Vector2::new(0.0, 131_072.0 * HAIR)));
        assert!(!off.in_contact && (off.configuration[0] - 0.01).abs() < 1e-12, "{what}: {off:?}");
    }
}
