//! The simulator: whole runs.

mod app;
mod car;
mod contacts;
pub mod crowd;
mod driving;
mod exercises;
mod kinds;
mod refusals;
mod state;
mod tour;
mod tow;

use motion_lab_core::prelude::*;
use motion_lab_sim::run::{Event, Frame, Quantized, RobotInput, Script};
use motion_lab_sim::tour::TourConfig;

/// The tour's configuration for `ticks` ticks, with a sensor of few rays.
pub(crate) fn tour(ticks: u64) -> TourConfig {
    let mut config = TourConfig { ticks, ..TourConfig::default() };
    if let Some(sensor) = &mut config.sensor {
        sensor.n_rays = 12;
    }
    config
}

/// An event of a script.
pub(crate) fn event(tick: u64, robot: &str, input: RobotInput) -> Event {
    Event { tick, robot: robot.into(), input }
}

/// Coordinates quantized as in a script.
pub(crate) fn quantized(values: &[f64]) -> Vec<Quantized> {
    values.iter().map(|&v| Quantized::try_new(v).unwrap()).collect()
}

/// A script with these events.
pub(crate) fn script(events: Vec<Event>) -> Script {
    Script { events, ..Script::empty() }
}

/// Wild but valid driving of the tour's three robots: every kind of input, sensible or not.
pub(crate) fn wild_script(seed: u64, ticks: u64) -> Script {
    let mut draws = Stream::new(Seed(seed), "wild script");
    let mut events = Vec::new();
    for tick in 1..=ticks {
        if draws.below(6) > 0 {
            continue;
        }
        let robot = ["Rusty", "Reach", "Hitch"][draws.below(3) as usize];
        let mut channel = || draws.below(257) as i16 - 128;
        let (a, b) = (channel(), channel());
        let mut place = |n: u64| -> Vec<f64> { (0..n).map(|_| draws.uniform(-3.0, 12.0)).collect() };
        let input = match place(1)[0] as i64 {
            -3..0 => RobotInput::Release,
            0..6 => RobotInput::Drive(a, b),
            6..8 => RobotInput::MoveTo(quantized(&place(2))),
            8..10 => RobotInput::Teleport(quantized(&place(if robot == "Reach" { 2 } else { 3 }))),
            _ => RobotInput::SetTrailer(a > 0),
        };
        events.push(event(tick, robot, input));
    }
    script(events)
}

/// Fails unless the two frames are equal in every bit.
#[track_caller]
pub(crate) fn assert_same(a: &Frame, b: &Frame) {
    assert_eq!(a, b);
    assert_eq!(a.digest(), b.digest(), "equal as numbers, but not in their bits");
}
