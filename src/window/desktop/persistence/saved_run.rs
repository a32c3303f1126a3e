//! `SavedRun`, the run under way as a text from which the same run is made again.

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_128;

use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::World;
use motion_lab_sim::run::{Digest, Recipe, Script};
use motion_lab_sim::tour::TourConfig;

/// The first line of the file: what it is, and the version of its form.
const HEAD: &str = "motion-lab run under way 1";

/// Largest size of a file that is read, bytes.
pub const MAX_BYTES: u64 = 1 << 28;

/// All that determines a run, and where it stands. It holds no frames: the run is simulated again.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedRun {
    /// The run.
    pub recipe: Recipe,
    /// The tick at which the run stands.
    pub tick: u64,
    /// The last tick that it has reached.
    pub frontier: u64,
    /// The digest of the frame at `tick`, which the run made again is held to.
    pub frame: Digest,
}

/// Why a run can't be kept, or brought back.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SavedRunError {
    /// A file whose bytes are not those that were written.
    #[error("its file is damaged")]
    Damaged,
    /// A file of another kind, or of another version.
    #[error("its file is not one of this version of the program")]
    Foreign,
    /// A text in the file that can't be read.
    #[error("{item} in its file: {reason}")]
    Text { item: String, reason: String },
    /// A world made in code that world files can't describe.
    #[error("the world {0} is not one that a world file can describe")]
    World(String),
}

/// The run as it is written.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Run", deny_unknown_fields)]
struct RunText {
    seed: u64,
    tick: u64,
    frontier: u64,
    frame: String,
    ticks: u64,
    sensor: Option<SavedSensor>,
    worlds: Vec<String>,
    script: String,
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Sensor", deny_unknown_fields)]
struct SavedSensor {
    n_rays: u32,
    max_range: f64,
}

fn text(item: &str, reason: impl ToString) -> SavedRunError {
    SavedRunError::Text { item: item.to_owned(), reason: reason.to_string() }
}

/// The texts of a run's worlds.
///
/// # Errors
/// [`SavedRunError::World`] for one that its text would not give back.
pub fn world_texts(config: &TourConfig) -> Result<Vec<String>, SavedRunError> {
    let text = |world: &World| {
        let text = world.to_ron();
        let is_same = World::parse_recorded(&world.name, &text).is_ok_and(|read| read == *world);
        if is_same { Ok(text) } else { Err(SavedRunError::World(world.name.clone())) }
    };
    config.worlds.iter().map(text).collect()
}

impl SavedRun {
    /// The bytes of its file, by the texts of its worlds.
    ///
    /// # Errors
    /// [`SavedRunError::Text`] when they can't be written, which is a fault of the lab.
    pub fn to_bytes(&self, worlds: &[String]) -> Result<Vec<u8>, SavedRunError> {
        let Recipe { seed, config, script } = &self.recipe;
        let sensor = config.sensor.map(|s| SavedSensor { n_rays: s.n_rays, max_range: s.max_range });
        let run = RunText {
            seed: seed.0,
            tick: self.tick,
            frontier: self.frontier,
            frame: self.frame.to_string(),
            ticks: config.ticks,
            sensor,
            worlds: worlds.to_vec(),
            script: script.to_ron(),
        };
        let body = ron::to_string(&run).map_err(|error| text("the run", error))?;
        Ok(format!("{HEAD}\n{:032x}\n{body}\n", xxh3_128(body.as_bytes())).into_bytes())
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`SavedRunError`] says what is wrong with it.
    pub fn read(bytes: &[u8]) -> Result<Self, SavedRunError> {
        let whole = std::str::from_utf8(bytes).map_err(|_| SavedRunError::Damaged)?;
        let (head, rest) = whole.split_once('\n').ok_or(SavedRunError::Damaged)?;
        if head != HEAD {
            return Err(SavedRunError::Foreign);
        }
        let (hash, body) = rest.split_once('\n').ok_or(SavedRunError::Damaged)?;
        let body = body.strip_suffix('\n').ok_or(SavedRunError::Damaged)?;
        if hash != format!("{:032x}", xxh3_128(body.as_bytes())) {
            return Err(SavedRunError::Damaged);
        }
        let run: RunText = ron::from_str(body).map_err(|error| text("the run", error))?;
        let world = |(i, it): (usize, &String)| {
            let name = format!("world {i}");
            World::parse_recorded(&name, it).map_err(|error| text(&name, error))
        };
        let worlds: Vec<World> = run.worlds.iter().enumerate().map(world).collect::<Result<_, _>>()?;
        let sensor = run.sensor.map(|s| RangeSensor { n_rays: s.n_rays, max_range: s.max_range });
        let config = TourConfig { worlds, ticks: run.ticks, sensor };
        let script = Script::parse("script", &run.script).map_err(|error| text("the script", error))?;
        Ok(SavedRun {
            recipe: Recipe::new(config, (Seed(run.seed), script)),
            tick: run.tick,
            frontier: run.frontier,
            frame: Digest(u128::from_str_radix(&run.frame, 16).map_err(|error| text("the digest", error))?),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use motion_lab_sim::run::{Event, RobotInput};

    fn run() -> SavedRun {
        let events = vec![Event { tick: 3, robot: "Rusty".into(), input: RobotInput::Drive(128, -1) }];
        let config = TourConfig { ticks: 77, ..TourConfig::default() };
        SavedRun {
            recipe: Recipe::new(config, (Seed(u64::MAX), Script::new(events, vec![]))),
            tick: 4,
            frontier: 9,
            frame: Digest(1 << 127 | 5),
        }
    }

    #[test]
    fn a_run_is_read_as_it_was_written_to_the_last_bit() {
        let mut kept = run();
        // a number whose shortest decimal form is long
        let config = Arc::make_mut(&mut kept.recipe.config);
        config.sensor = Some(RangeSensor { n_rays: 3, max_range: 0.1 + 0.2 });
        config.worlds[0].robots[0].start[0] += 1e-13;
        let texts = world_texts(&kept.recipe.config).unwrap();
        assert_eq!(SavedRun::read(&kept.to_bytes(&texts).unwrap()).unwrap(), kept);
        let mut none = run();
        Arc::make_mut(&mut none.recipe.config).sensor = None;
        let texts = world_texts(&none.recipe.config).unwrap();
        assert_eq!(SavedRun::read(&none.to_bytes(&texts).unwrap()).unwrap(), none);
    }

    #[test]
    fn one_byte_changed_or_missing_anywhere_is_noticed() {
        let kept = run();
        let bytes = kept.to_bytes(&world_texts(&kept.recipe.config).unwrap()).unwrap();
        let mut refused = 0;
        for at in (0..bytes.len()).step_by(97).chain(0..80).chain([bytes.len() - 1]) {
            let mut changed = bytes.clone();
            changed[at] ^= 1;
            let cut = &bytes[..at];
            refused += usize::from(SavedRun::read(&changed).is_err() && SavedRun::read(cut).is_err());
        }
        assert!(refused > 100 && refused == (0..bytes.len()).step_by(97).count() + 81, "{refused}");
        assert_eq!(SavedRun::read(b"a cat\nand another\n"), Err(SavedRunError::Foreign));
        assert_eq!(SavedRun::read(&[0xff, 0xfe]), Err(SavedRunError::Damaged));
    }

    #[test]
    fn a_world_that_no_file_can_describe_is_not_kept() {
        let mut config = TourConfig::default();
        config.worlds[0].robots[0].start[0] = f64::NAN;
        assert!(matches!(world_texts(&config), Err(SavedRunError::World(name)) if name == config.worlds[0].name));
    }
}
