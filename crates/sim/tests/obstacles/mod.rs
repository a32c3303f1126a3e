//! Obstacles and doors: entities are what robots meet, and a run's script changes them.

mod before_tick_0;
mod captures;
mod doors;
mod growing;
mod live;
mod logs;
mod within_a_tick;

use motion_lab_core::prelude::*;
use motion_lab_sim::run::{Frame, Log, Quantized, Script, WorldChange, WorldEvent};
use motion_lab_sim::tour::TourConfig;

/// The door that Rusty's tour leaves room A by: y = 4.75, x from 2.5 to 3.375.
pub const DOOR: &str = "door A";

/// The Apartment alone, without a sensor.
pub fn apartment(ticks: u64) -> TourConfig {
    TourConfig { worlds: vec![World::apartment()], ticks, sensor: None }
}

/// A script of changes of the Apartment.
pub fn changes(of: &[(u64, WorldChange)]) -> Script {
    let event = |(tick, change): &(u64, WorldChange)| WorldEvent {
        tick: *tick,
        world: "Apartment".into(),
        change: change.clone(),
    };
    Script::new(vec![], of.iter().map(event).collect())
}

pub fn close() -> WorldChange {
    WorldChange::Close(DOOR.into())
}

pub fn open() -> WorldChange {
    WorldChange::Open(DOOR.into())
}

pub fn quantized(value: f64) -> Quantized {
    Quantized::try_new(value).unwrap()
}

/// Rusty's y at a frame.
pub fn y(frame: &Frame) -> f64 {
    frame.robots[0].configuration[1]
}

/// The tick at which Rusty's centre is first below the door's line; `None` if it never is.
pub fn passes(log: &Log) -> Option<u64> {
    log.frames().iter().find(|frame| y(frame) < 4.75).map(|frame| frame.tick)
}
