//! A small run for tests: two robots, three ticks, numbers of every sort.

use std::sync::Arc;

use super::{
    DT, Event, Frame, Log, ObstacleStates, Quantized, Recipe, Recorded, RobotInput, RobotScan, RobotState, Script,
};
use crate::tour::TourConfig;
use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::{Aabb, Point2};
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{Resident, World};

const SUBNORMAL: f64 = 4.9e-324;

pub fn frame(tick: u64) -> Frame {
    let time = tick as f64 * DT;
    let car = RobotState {
        id: 0,
        configuration: Coordinates::from_slice(&[1.0 + time, -0.0, SUBNORMAL]),
        extra: [-0.0, f64::MAX, -SUBNORMAL].into_iter().collect(),
        channels: [-128, 128],
        target: Coordinates::new(),
        manual: true,
        in_contact: tick == 2,
        contacts: u32::from(tick >= 2),
        flash: u32::MAX,
        refusals: 0,
    };
    let arm = RobotState {
        id: 1,
        configuration: Coordinates::from_slice(&[0.1 * time, 0.0]),
        extra: [].into_iter().collect(),
        channels: [0, 0],
        target: Coordinates::from_slice(&[f64::MIN_POSITIVE, -1.0 / 3.0]),
        manual: false,
        in_contact: false,
        contacts: 0,
        flash: 0,
        refusals: 1,
    };
    let scan = RobotScan { robot: 0, ranges: [0.0, 1.0 + time, f64::INFINITY].into() };
    Frame { tick, robots: vec![car, arm], scans: vec![scan], obstacles: ObstacleStates::new() }
}

pub fn log() -> Log {
    let resident = |name: &str, kind: &str, start: &[f64]| Resident::new(name, kind, start);
    let world = World {
        name: "Yard".into(),
        bounds: Aabb { min: Point2::new(-1.0, -2.0), max: Point2::new(3.0, 4.0) },
        obstacles: vec![],
        doors: vec![],
        routes: vec![],
        places: vec![],
        marks: vec![],
        robots: vec![resident("Car", "rusty", &[1.0, 0.1, 0.2]), resident("Arm", "reach", &[0.0, 0.5])],
    };
    let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
    let events = vec![
        event(1, "Car", RobotInput::Drive(-128, 128)),
        event(1, "Arm", RobotInput::MoveTo(vec![Quantized(1 << 20), Quantized(-1)])),
        event(3, "Car", RobotInput::Release),
    ];
    let config = TourConfig { worlds: vec![world], ticks: 3, sensor: Some(RangeSensor { n_rays: 3, max_range: 4.0 }) };
    let recipe = Recipe::new(config, (Seed(u64::MAX - 1), Script::new(events, vec![])));
    Log::with_frames(recipe, frame(0), (1..=3).map(frame).collect())
}

/// The configuration of a log, to be changed.
pub fn config_of(log: &mut Log) -> &mut TourConfig {
    Arc::make_mut(&mut log.recipe.config)
}

/// The initial frame and the others, to be changed.
pub fn frames_of(log: &mut Log) -> (&mut Frame, &mut Vec<Frame>) {
    match &mut log.recorded {
        Recorded::Frames { initial, frames } => (initial, frames),
        Recorded::Digests(_) => panic!("a log of digests has no frames"),
    }
}
