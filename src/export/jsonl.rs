//! A line of JSON for each tick.

use std::io::Write;

use serde::Serialize;

use super::{ExportError, JsonNumber, frames};
use crate::run::{DT, Frame, Log, RobotScan, RobotState};
use crate::worlds::{Resident, World};

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
    /// What its first range sensor saw; null without one.
    ranges: Option<Vec<JsonNumber>>,
    /// What its further sensors saw, by their names; left out without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    further_scans: Vec<FurtherScan>,
}

/// The scan of a robot's second or later sensor.
#[derive(Serialize)]
struct FurtherScan {
    /// The sensor's name; null for one that the run's configuration does not have.
    sensor: Option<String>,
    ranges: Vec<JsonNumber>,
}

/// Writes a log as lines of JSON: an object for each tick from 0 on, with all that its frame holds. Times are seconds,
/// lengths metres, angles radians. Robots of a program's own kinds are written as any other.
///
/// # Errors
/// [`ExportError::Write`] when `out` fails.
pub fn write_jsonl(log: &Log, mut out: impl Write) -> Result<(), ExportError> {
    let residents: Vec<(&World, &Resident)> =
        log.config.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| (w, r))).collect();
    let mut line = Vec::new();
    for frame in frames(log) {
        let robots = residents.iter().zip(&frame.robots).map(|((world, resident), state)| {
            let (scan, further_scans) = scans(log, resident, state.id, frame);
            Robot { ranges: scan, further_scans, ..robot(world, resident, state) }
        });
        let tick = Tick {
            tick: frame.tick,
            time: JsonNumber(frame.tick as f64 * DT),
            digest: frame.digest().to_string(),
            robots: robots.collect(),
        };
        line.clear();
        serde_json::to_writer(&mut line, &tick).map_err(std::io::Error::from)?;
        line.push(b'\n');
        out.write_all(&line)?;
    }
    Ok(())
}

/// The ranges of a robot's first sensor, and the scans of the others.
fn scans(log: &Log, resident: &Resident, id: u32, frame: &Frame) -> (Option<Vec<JsonNumber>>, Vec<FurtherScan>) {
    let numbers = |scan: &RobotScan| scan.ranges.iter().copied().map(JsonNumber).collect();
    let scans: Vec<&RobotScan> = frame.scans.iter().filter(|scan| scan.robot == id).collect();
    let [first, further @ ..] = &scans[..] else { return (None, Vec::new()) };
    let sensors = if further.is_empty() { None } else { log.config.sensors_of(resident, scans.len()) };
    let name = |i: usize| sensors.as_ref()?.get(i).map(|sensor| sensor.name.clone());
    let further = further.iter().enumerate();
    let further = further.map(|(i, scan)| FurtherScan { sensor: name(i + 1), ranges: numbers(scan) });
    (Some(numbers(first)), further.collect())
}

/// A robot's state, still without its scans.
fn robot<'a>(world: &'a World, resident: &'a Resident, state: &RobotState) -> Robot<'a> {
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
        ranges: None,
        further_scans: Vec::new(),
    }
}
