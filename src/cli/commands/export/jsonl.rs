//! A line of JSON for each tick.

use motion_lab::run::{DT, Frame, Log, RobotState};
use motion_lab::worlds::{Resident, World};
use serde::Serialize;

use super::frames;
use super::sink::Sink;
use crate::cli::Failure;
use crate::cli::support::json_number::JsonNumber;

/// A tick.
#[derive(Serialize)]
struct Tick<'a> {
    tick: u64,
    /// Seconds.
    time: JsonNumber,
    /// Of the frame, as 32 hexadecimal digits.
    digest: String,
    robots: Vec<Robot<'a>>,
}

/// A robot's state after a tick, named as [`RobotState`] names it.
#[derive(Serialize)]
struct Robot<'a> {
    id: u32,
    name: &'a str,
    kind: &'a str,
    world: &'a str,
    configuration: Vec<JsonNumber>,
    extra: Vec<JsonNumber>,
    channels: [i16; 2],
    target: Vec<JsonNumber>,
    manual: bool,
    in_contact: bool,
    contacts: u32,
    flash: u32,
    refusals: u32,
    /// What its range sensor saw; null without one.
    ranges: Option<Vec<JsonNumber>>,
}

/// Writes a line for each tick from 0 on.
pub fn write(log: &Log, sink: &mut Sink) -> Result<(), Failure> {
    let residents: Vec<(&World, &Resident)> =
        log.config.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| (w, r))).collect();
    for frame in frames(log) {
        if sink.is_closed() {
            break;
        }
        let robots =
            residents.iter().zip(&frame.robots).map(|((world, resident), state)| robot(world, resident, state, frame));
        let tick = Tick {
            tick: frame.tick,
            time: JsonNumber(frame.tick as f64 * DT),
            digest: frame.digest().to_string(),
            robots: robots.collect(),
        };
        sink.line(serde_json::to_string(&tick).map_err(Failure::internal)?)?;
    }
    Ok(())
}

fn robot<'a>(world: &'a World, resident: &'a Resident, state: &RobotState, frame: &Frame) -> Robot<'a> {
    // taken apart by name, so that a field added later can't be forgotten here
    let RobotState { id, configuration, extra, channels, target, manual, in_contact, contacts, flash, refusals } =
        state;
    let numbers = |list: &[f64]| list.iter().copied().map(JsonNumber).collect();
    Robot {
        id: *id,
        name: &resident.name,
        kind: &resident.kind,
        world: &world.name,
        configuration: numbers(configuration),
        extra: numbers(extra),
        channels: *channels,
        target: numbers(target),
        manual: *manual,
        in_contact: *in_contact,
        contacts: *contacts,
        flash: *flash,
        refusals: *refusals,
        ranges: frame.scans.iter().find(|scan| scan.robot == *id).map(|scan| numbers(&scan.ranges)),
    }
}
