//! A line of JSON for each tick.

use std::io::Write;

use serde::{Serialize, Serializer};

use super::columns::StateList;
use super::every_frame::every_frame;
use super::{ExportError, JsonNumber};
use crate::run::{DT, Frame, Log, RobotScan, RobotState};
use motion_lab_core::configuration::Kinds;
use motion_lab_core::worlds::{Resident, World};

#[derive(Serialize)]
struct Tick<'a> {
    tick: u64,
    time_s: JsonNumber,
    /// Of the frame, as 32 hexadecimal digits.
    digest: String,
    robots: Vec<RobotJson<'a>>,
}

/// The numbers of a list by their names. One that is named and not there is null.
struct NamedNumbers<'a> {
    list: StateList,
    names: &'a [String],
    numbers: &'a [f64],
}

impl Serialize for NamedNumbers<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let NamedNumbers { list, names, numbers } = self;
        let named = names.iter().enumerate().map(|(i, name)| (name.clone(), numbers.get(i).copied().map(JsonNumber)));
        let rest = numbers.iter().enumerate().skip(names.len());
        let rest = rest.map(|(i, x)| (list.numbered(i), Some(JsonNumber(*x))));
        serializer.collect_map(named.chain(rest))
    }
}

/// A robot with what stays the same from tick to tick.
struct Still<'a> {
    world: &'a World,
    resident: &'a Resident,
    /// The names of the numbers of its lists.
    configuration: Vec<String>,
    extra: Vec<String>,
    target: Vec<String>,
}

impl<'a> Still<'a> {
    fn of(world: &'a World, resident: &'a Resident, kinds: &Kinds) -> Self {
        let [configuration, extra, target] = [StateList::Configuration, StateList::Extra, StateList::Target]
            .map(|list| list.named(kinds.of(&resident.kind)));
        Still { world, resident, configuration, extra, target }
    }
}

/// A robot's state after a tick, named as [`RobotState`] names it.
#[derive(Serialize)]
struct RobotJson<'a> {
    id: u32,
    name: &'a str,
    kind: &'a str,
    world: &'a str,
    configuration: NamedNumbers<'a>,
    extra: NamedNumbers<'a>,
    channels: [i16; 2],
    target: NamedNumbers<'a>,
    manual: bool,
    in_contact: bool,
    contacts: u32,
    flash: u32,
    refusals: u32,
    /// What its first range sensor saw; null without one.
    ranges_m: Option<Vec<JsonNumber>>,
    /// What its further sensors saw, by their names; left out without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    further_scans: Vec<FurtherScan>,
}

/// The scan of a robot's second or later sensor.
#[derive(Serialize)]
struct FurtherScan {
    /// The sensor's name; null for one that the run's configuration does not have.
    sensor: Option<String>,
    ranges_m: Vec<JsonNumber>,
}

/// Writes a log as lines of JSON: an object for each tick from 0 on, with all that its frame holds. A name ends with
/// its unit: `_s` seconds, `_m` metres, `_rad` radians.
///
/// `configuration`, `extra` and `target` are objects whose keys are those of [`write_csv`](super::write_csv)'s columns:
/// `x_m`, `theta1_rad`. A kind has the same keys in every run; a number that is not there, as a trailer's heading, is
/// null. Those of a program's own kinds are `configuration0`, `extra0`, `target0` and so on;
/// [`write_jsonl_of_kinds`] has names for them. The text `"inf"` is the
/// range of a ray that meets nothing within reach.
///
/// # Errors
/// [`ExportError::Write`] when `out` fails.
pub fn write_jsonl(log: &Log, out: impl Write) -> Result<(), ExportError> {
    write_jsonl_of_kinds(log, &Kinds::default(), out)
}

/// [`write_jsonl`] with kinds of robots that a program added, whose numbers are called as
/// [`write_csv_of_kinds`](super::write_csv_of_kinds) calls them.
///
/// # Errors
/// As [`write_jsonl`].
pub fn write_jsonl_of_kinds(log: &Log, kinds: &Kinds, mut out: impl Write) -> Result<(), ExportError> {
    let robots: Vec<Still<'_>> =
        log.recipe.config.worlds.iter().flat_map(|w| w.robots.iter().map(move |r| Still::of(w, r, kinds))).collect();
    let mut line = Vec::new();
    for frame in every_frame(log) {
        let robots = robots.iter().zip(&frame.robots).map(|(still, state)| {
            let (ranges_m, further_scans) = scans(log, still.resident, state.id, frame);
            RobotJson { ranges_m, further_scans, ..robot(still, state) }
        });
        let tick = Tick {
            tick: frame.tick,
            time_s: JsonNumber(frame.tick as f64 * DT),
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
    let sensors = if further.is_empty() { None } else { log.recipe.config.sensors_of(resident, scans.len()) };
    let name = |i: usize| sensors.as_ref()?.get(i).map(|sensor| sensor.name.clone());
    let further = further.iter().enumerate();
    let further = further.map(|(i, scan)| FurtherScan { sensor: name(i + 1), ranges_m: numbers(scan) });
    (Some(numbers(first)), further.collect())
}

/// A robot's state, still without its scans.
fn robot<'a>(still: &'a Still<'a>, state: &'a RobotState) -> RobotJson<'a> {
    // taken apart by name, so that a field added later can't be forgotten here
    let RobotState { id, configuration, extra, channels, target, manual, in_contact, contacts, flash, refusals } =
        state;
    RobotJson {
        id: *id,
        name: &still.resident.name,
        kind: &still.resident.kind,
        world: &still.world.name,
        configuration: NamedNumbers {
            list: StateList::Configuration,
            names: &still.configuration,
            numbers: configuration,
        },
        extra: NamedNumbers { list: StateList::Extra, names: &still.extra, numbers: extra },
        channels: *channels,
        target: NamedNumbers { list: StateList::Target, names: &still.target, numbers: target },
        manual: *manual,
        in_contact: *in_contact,
        contacts: *contacts,
        flash: *flash,
        refusals: *refusals,
        ranges_m: None,
        further_scans: Vec::new(),
    }
}
