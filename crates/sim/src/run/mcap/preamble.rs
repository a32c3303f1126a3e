//! `Preamble`, the part of a log before its first tick: everything that determines the run.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::record::{self, Cursor, Record, opcode};
use super::record_writer::RecordWriter;
use super::{
    DIGEST_FORMAT_VERSION, FORMAT_VERSION, FORMAT_VERSION_WITH_CHANGES, FORMAT_VERSION_WITH_MANY_CHANGES, GENERATOR,
    LogError, MAX_REPEATED_CHANGES, ReadLog,
};
use crate::run::{DT, Frame, LogKind, Recipe, Script};
use crate::tour::TourConfig;
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{World, ron_in_words};

/// The name of the metadata record.
const METADATA: &str = "motion-lab";
const CONFIG: &str = "config.ron";
const SCRIPT: &str = "script.ron";

/// A run before its first tick, with its texts in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Preamble {
    pub recipe: Recipe,
    /// The initial frame; `None` in a log of digests.
    pub initial: Option<Frame>,
    /// The program that wrote the log.
    pub program: String,
    /// The texts of the worlds, in order. They are kept as read, because another version of the program may print a
    /// world differently.
    pub world_texts: Vec<String>,
    /// The version of the log's format.
    pub format: &'static str,
}

/// The run's settings as written in the file. The worlds are named by their attachments.
#[derive(Deserialize)]
#[serde(rename = "Config", deny_unknown_fields)]
struct ConfigText {
    ticks: u64,
    sensor: Option<PreambleSensor>,
    worlds: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PreambleSensor {
    n_rays: u32,
    max_range: f64,
}

fn content(item: &str, reason: &str) -> LogError {
    LogError::Content { item: item.to_owned(), reason: reason.to_owned() }
}

fn world_file(index: usize) -> String {
    format!("worlds/{index}.ron")
}

/// Checks that a log can hold a run of this recipe, but for the worlds that are `known` to be as a file describes them.
pub fn check_recordable(recipe: &Recipe, known: impl Fn(&World) -> bool) -> Result<(), LogError> {
    check_run(recipe)?;
    let mut worlds = recipe.config.worlds.iter().enumerate().filter(|(_, world)| !known(world));
    worlds.try_for_each(|(i, world)| check_world(i, world, &world.to_ron()))
}

/// Checks a recipe, but for what is in its worlds.
fn check_run(recipe: &Recipe) -> Result<(), LogError> {
    let Recipe { config, script, .. } = recipe;
    config.validate()?;
    script.check()?;
    script.check_robots(&config.robot_names().collect::<Vec<_>>())?;
    script.check_worlds(&config.worlds)?;
    Ok(())
}

/// Checks that the text of the world of this number says what it is.
fn check_world(index: usize, world: &World, text: &str) -> Result<(), LogError> {
    let name = world_file(index);
    match World::parse_recorded(&name, text) {
        Ok(read) if read == *world => Ok(()),
        Ok(_) => Err(content(&name, "the world is not one that a world file can describe")),
        Err(e) => Err(content(&name, &e.to_string())),
    }
}

/// The version of the format of the log of a script, with its frames.
fn format_with_frames(script: &Script) -> &'static str {
    match script.changes.len() {
        0 => FORMAT_VERSION,
        1..=MAX_REPEATED_CHANGES => FORMAT_VERSION_WITH_CHANGES,
        _ => FORMAT_VERSION_WITH_MANY_CHANGES,
    }
}

impl Preamble {
    /// The preamble of a run that this program records.
    pub fn new(recipe: &Recipe, kind: LogKind, initial: &Frame) -> Result<Self, LogError> {
        Self::of_run(recipe, (kind == LogKind::Frames).then(|| initial.clone()))
    }

    /// The preamble of a run of which this program keeps digests.
    pub fn of_digests(recipe: &Recipe) -> Result<Self, LogError> {
        Self::of_run(recipe, None)
    }

    /// The preamble of a log as it was read.
    pub fn of_read(read: &ReadLog) -> Self {
        let ReadLog { log, program, world_texts, format, .. } = read;
        let (recipe, initial) = (log.recipe.clone(), log.initial().cloned());
        Preamble { recipe, initial, program: program.clone(), world_texts: world_texts.clone(), format }
    }

    fn of_run(recipe: &Recipe, initial: Option<Frame>) -> Result<Self, LogError> {
        let worlds = &recipe.config.worlds;
        let format = initial.as_ref().map_or(DIGEST_FORMAT_VERSION, |_| format_with_frames(&recipe.script));
        let preamble = Preamble {
            recipe: recipe.clone(),
            initial,
            format,
            program: concat!("motion-lab ", env!("CARGO_PKG_VERSION")).to_owned(),
            world_texts: worlds.iter().map(World::to_ron).collect(),
        };
        preamble.check()?;
        // a world assembled by hand may hold what the file format cannot express; a replay would then run in another
        // world
        let mut worlds = worlds.iter().zip(&preamble.world_texts).enumerate();
        worlds.try_for_each(|(i, (world, text))| check_world(i, world, text))?;
        Ok(preamble)
    }

    fn check(&self) -> Result<(), LogError> {
        check_run(&self.recipe)?;
        self.initial.as_ref().map_or(Ok(()), |initial| self.check_frame(initial, 0))
    }

    /// Checks that `frame` can be this run's frame of tick `expected`.
    pub fn check_frame(&self, frame: &Frame, expected: u64) -> Result<(), LogError> {
        let (tick, ticks) = (frame.tick, self.recipe.config.ticks);
        if tick != expected {
            return Err(LogError::Order { expected, found: tick });
        }
        if tick > ticks {
            return Err(LogError::Beyond { tick, ticks });
        }
        let robots = self.recipe.config.robot_names().count();
        let ids_are_right = frame.robots.len() == robots && (0..).zip(&frame.robots).all(|(id, r)| r.id == id);
        let scans_are_right = frame.scans.is_sorted_by_key(|scan| scan.robot)
            && frame.scans.last().is_none_or(|scan| (scan.robot as usize) < robots);
        if !ids_are_right || !scans_are_right {
            return Err(LogError::Robots { tick, robots });
        }
        if !frame.obstacles.are_in_order()
            || frame.obstacles.last().is_some_and(|o| o.world as usize >= self.recipe.config.worlds.len())
            || frame.obstacles.iter().any(|o| !o.pose.is_finite())
            || (!frame.obstacles.is_empty() && self.recipe.script.changes.is_empty())
        {
            return Err(LogError::Obstacles { tick });
        }
        match frame.first_nan() {
            Some((robot, field)) => Err(LogError::NotANumber { tick, robot, field }),
            None => Ok(()),
        }
    }

    /// What the log has of the run.
    pub fn kind(&self) -> LogKind {
        if self.initial.is_some() { LogKind::Frames } else { LogKind::Digests }
    }

    /// The greatest range of each scan of the initial frame, metres; `None` for one of a sensor that is not the
    /// configuration's.
    pub fn max_ranges(&self) -> Vec<Option<f64>> {
        let config = &self.recipe.config;
        let residents: Vec<_> = config.residents().collect();
        let scans = self.initial.iter().flat_map(|initial| initial.scans.chunk_by(|a, b| a.robot == b.robot));
        let ranges = scans.flat_map(|scans| {
            let resident = scans.first().and_then(|scan| residents.get(scan.robot as usize));
            let sensors = resident.and_then(|resident| config.sensors_of(resident, scans.len()));
            let range = |i: usize| sensors.as_ref()?.get(i).map(|sensor| sensor.rays.sensor.max_range);
            (0..scans.len()).map(range).collect::<Vec<_>>()
        });
        ranges.collect()
    }

    fn metadata(&self) -> BTreeMap<String, String> {
        let entry = |key: &str, value: String| (key.to_owned(), value);
        let hashes = self.recipe.config.worlds.iter().enumerate();
        let hashes = hashes.map(|(i, world)| (world_file(i), format!("{:032x}", world.content_hash())));
        [
            entry("format", self.format.to_owned()),
            entry("program", self.program.clone()),
            entry("seed", self.recipe.seed.to_string()),
            entry("dt", format!("{DT:?}")),
            entry("ticks", self.recipe.config.ticks.to_string()),
            entry("generator", GENERATOR.to_owned()),
        ]
        .into_iter()
        .chain(hashes)
        .collect()
    }

    fn config_text(&self) -> String {
        let TourConfig { worlds, ticks, sensor } = &*self.recipe.config;
        let sensor = match sensor {
            Some(RangeSensor { n_rays, max_range }) => format!("Some((n_rays: {n_rays}, max_range: {max_range:?}))"),
            None => "None".to_owned(),
        };
        let worlds: Vec<String> = (0..worlds.len()).map(world_file).collect();
        format!("Config(\n    ticks: {ticks},\n    sensor: {sensor},\n    worlds: {worlds:?},\n)\n")
    }

    /// Writes the metadata record and the attachments.
    pub fn put(&self, records: &mut RecordWriter) -> Result<(), LogError> {
        records.metadata(METADATA, self.metadata())?;
        records.attachment(CONFIG.to_owned(), &self.config_text())?;
        for (i, text) in self.world_texts.iter().enumerate() {
            records.attachment(world_file(i), text)?;
        }
        records.attachment(SCRIPT.to_owned(), &self.recipe.script.to_ron())
    }

    /// Reads the preamble from sealed records. `initial` is the frame in their messages.
    pub fn read(records: &[Record<'_>], initial: Option<Frame>) -> Result<Self, LogError> {
        let mut files: BTreeMap<&str, &str> = BTreeMap::new();
        let mut metadata = BTreeMap::new();
        for record in records {
            let mut cursor = Cursor(record.content);
            match record.opcode {
                opcode::METADATA if cursor.str() == Some(METADATA) => {
                    metadata = cursor.map().ok_or_else(|| content(METADATA, "the metadata can't be read"))?;
                }
                opcode::ATTACHMENT => {
                    let (name, data) = record::attachment(record.content)
                        .and_then(|(name, data)| Some((name, std::str::from_utf8(data).ok()?)))
                        .ok_or_else(|| content("an attachment", "it is not text"))?;
                    files.insert(name, data);
                }
                _ => {}
            }
        }
        let entry = |key: &str| metadata.get(key).ok_or_else(|| content(key, "the metadata lacks it"));
        let version = entry("format")?;
        let initial = match version.as_str() {
            FORMAT_VERSION | FORMAT_VERSION_WITH_CHANGES | FORMAT_VERSION_WITH_MANY_CHANGES => {
                Some(initial.ok_or_else(|| content("/frame", "there is no initial frame"))?)
            }
            DIGEST_FORMAT_VERSION => None,
            _ => return Err(LogError::Version(version.clone())),
        };
        let file = |name: &str| files.get(name).copied().ok_or_else(|| content(name, "the attachment is missing"));
        let text = file(CONFIG)?;
        let config: ConfigText =
            ron::from_str(text).map_err(|e| content(CONFIG, &format!("{}: {}", e.span, ron_in_words(text, &e))))?;
        let mut worlds = Vec::new();
        let mut world_texts = Vec::new();
        for (i, name) in config.worlds.iter().enumerate() {
            // each name must be the one of its number, so that no text can stand for several worlds
            if *name != world_file(i) {
                return Err(content(CONFIG, "the worlds are not numbered from 0"));
            }
            let text = file(name)?;
            let world = World::parse_recorded(name, text).map_err(|e| content(name, &e.to_string()))?;
            if *entry(name)? != format!("{:032x}", world.content_hash()) {
                return Err(content(name, "the world is not the one whose content hash the metadata has"));
            }
            worlds.push(world);
            world_texts.push(text.to_owned());
        }
        let sensor = config.sensor.map(|s| RangeSensor { n_rays: s.n_rays, max_range: s.max_range });
        let seed = Seed(entry("seed")?.parse().map_err(|_| content("seed", "it is not a whole number below 2^64"))?);
        let config = TourConfig { worlds, ticks: config.ticks, sensor };
        let recipe = Recipe::new(config, (seed, Script::parse(SCRIPT, file(SCRIPT)?)?));
        let format = match (&initial, format_with_frames(&recipe.script)) {
            (None, _) => DIGEST_FORMAT_VERSION,
            // logs of before repeat any number of changes
            (_, FORMAT_VERSION_WITH_MANY_CHANGES) if version == FORMAT_VERSION_WITH_CHANGES => {
                FORMAT_VERSION_WITH_CHANGES
            }
            (_, usual) => usual,
        };
        let preamble = Preamble { recipe, initial, program: entry("program")?.clone(), world_texts, format };
        preamble.check()?;
        Ok(preamble)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{RobotScan, fixture};
    use motion_lab_core::worlds::ResidentSensor;

    #[test]
    fn each_scan_has_the_greatest_range_of_its_own_sensor() {
        let log = fixture::log();
        let (mut config, mut initial) = (TourConfig::clone(&log.recipe.config), log.initial().unwrap().clone());
        let sensor = |name: &str, max_range: f64| ResidentSensor::new(name, RangeSensor { n_rays: 1, max_range });
        config.worlds[0].robots[0].sensors = vec![sensor("far", 9.0)];
        config.worlds[0].robots[1].sensors = vec![sensor("b", 7.0), sensor("a", 5.0)];
        initial.scans = [0, 0, 1, 1].map(|robot| RobotScan { robot, ranges: [1.0].into() }).to_vec();
        let recipe = Recipe { config: config.into(), ..log.recipe };
        let preamble = |initial: &Frame| Preamble::new(&recipe, LogKind::Frames, initial);
        let ranges = |initial: &Frame| preamble(initial).unwrap().max_ranges();
        assert_eq!(ranges(&initial), [Some(4.0), Some(9.0), Some(5.0), Some(7.0)]);
        initial.scans.insert(4, RobotScan { robot: 1, ranges: [1.0].into() });
        assert_eq!(ranges(&initial), [Some(4.0), Some(9.0), None, None, None], "one from code, whichever it is");
        initial.scans.swap(0, 4);
        let refused = preamble(&initial).unwrap_err();
        assert!(matches!(refused, LogError::Robots { tick: 0, .. }), "{refused}");
    }
}
