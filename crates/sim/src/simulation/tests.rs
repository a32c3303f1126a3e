//! Tests that need the module's private items.

use bevy::prelude::*;

use super::{LatestFrame, SimulationPlugin, SimulationSchedule, start_run, start_run_in_order, step};
use crate::run::{Event, Frame, Recipe, RobotInput, Script};
use crate::tour::TourConfig;
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::random::{Seed, Stream};
use motion_lab_core::worlds::{Resident, World as WorldModel};

/// Seven robots of three kinds, close together in an open world, all driven at once.
fn crowd() -> Recipe {
    let resident = |name: &str, kind: &str, start: &[f64]| Resident::new(name, kind, start);
    let robots = vec![
        resident("a", "rusty", &[0.3, 0.3, 0.0]),
        resident("arm", "reach", &[2.0, 0.5]),
        resident("b", "rusty", &[0.6, 0.3, 3.0]),
        resident("car", "hitch", &[4.0, 0.0, 3.1]),
        resident("c", "rusty", &[0.45, 0.6, -1.5]),
        resident("arm 2", "reach3", &[0.1, 0.2, 0.3]),
        resident("d", "rusty", &[0.9, 0.6, -2.5]),
    ];
    let bounds = Aabb { min: Point2::new(-5.0, -5.0), max: Point2::new(5.0, 5.0) };
    let mut draws = Stream::new(Seed(1), "crowd");
    let mut events = Vec::new();
    for tick in (1..120).step_by(10) {
        for robot in ["a", "b", "c", "d", "car"] {
            let input = RobotInput::Drive(draws.below(257) as i16 - 128, draws.below(129) as i16 - 64);
            events.push(Event { tick, robot: robot.into(), input });
        }
    }
    let world = WorldModel {
        name: "open".into(),
        bounds,
        obstacles: vec![],
        doors: vec![],
        routes: vec![],
        places: vec![],
        marks: vec![],
        robots,
    };
    let config = TourConfig { worlds: vec![world], ticks: 120, sensor: None };
    Recipe::new(config, (Seed(3), Script { events, ..Script::empty() }))
}

fn run(order: &[usize]) -> Vec<Frame> {
    let mut app = App::new();
    app.add_plugins(SimulationPlugin);
    run_in(&mut app, order)
}

fn run_in(app: &mut App, order: &[usize]) -> Vec<Frame> {
    start_run_in_order(app.world_mut(), crowd(), order).unwrap();
    (0..120)
        .map(|_| {
            step(app.world_mut());
            app.world().resource::<LatestFrame>().frame().clone()
        })
        .collect()
}

#[test]
fn the_order_of_spawning_does_not_matter() {
    let frames = run(&[0, 1, 2, 3, 4, 5, 6]);
    let contacts: u32 = frames[119].robots.iter().map(|r| r.contacts).sum();
    assert!(contacts > 10, "they meet one another: {contacts} times");
    for order in [[6, 5, 4, 3, 2, 1, 0], [3, 0, 6, 2, 5, 1, 4]] {
        assert_eq!(run(&order), frames);
    }
}

#[test]
fn a_tick_has_systems_for_the_robots_that_were_there_and_later_ones_get_theirs() {
    let mut app = App::new();
    app.add_plugins(SimulationPlugin);
    let systems = |app: &App| app.world().resource::<Schedules>().get(SimulationSchedule).unwrap().systems_len();
    let apartment = TourConfig { worlds: vec![WorldModel::apartment()], ..TourConfig::default() };
    start_run(app.world_mut(), apartment, Seed(3)).unwrap();
    step(app.world_mut());
    let of_one_type = systems(&app);
    assert_eq!(run_in(&mut app, &[3, 0, 6, 2, 5, 1, 4]), run(&[0, 1, 2, 3, 4, 5, 6]), "whatever ran before");
    // four systems for each of the car and the two arms
    assert_eq!(systems(&app), of_one_type + 12);
}
