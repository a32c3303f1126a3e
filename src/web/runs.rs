//! Runs as the light WebAssembly build exports them: recorded from their parts, verified, drawn.

use serde::{Deserialize, Serialize};
use wasm_bindgen::prelude::*;

use super::link::{Link, ReadLink};
use motion_lab_core::picture::Theme;
use motion_lab_core::random::Seed;
use motion_lab_core::sensors::RangeSensor;
use motion_lab_core::worlds::{World, WorldError};
use motion_lab_sim::capture::RunFigure;
use motion_lab_sim::recording::{Recorder, RunError, Verification, verify};
use motion_lab_sim::run::{Difference, Log, LogError, LogKind, LogWriter, Recipe, RunDigest, Script, ScriptError};
use motion_lab_sim::tour::TourConfig;

/// The parts of a run, as JSON. A page keeps them so that it can record the run again when the lab has stopped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunParts {
    /// The seed, in decimal.
    pub seed: String,
    /// World files.
    pub worlds: Vec<String>,
    /// The input script.
    pub script: String,
    /// The number of ticks. Input after them is left out.
    pub ticks: u64,
    /// The rays and the range of the range sensor, metres.
    pub sensor: Option<(u32, f64)>,
}

impl RunParts {
    /// The parts of a run of no ticks yet.
    #[cfg(feature = "web")]
    pub fn of(recipe: &Recipe) -> Self {
        let Recipe { seed, config, script } = recipe;
        RunParts {
            seed: seed.to_string(),
            worlds: config.worlds.iter().map(World::to_ron).collect(),
            script: script.to_ron(),
            ticks: 0,
            sensor: config.sensor.map(|s| (s.n_rays, s.max_range)),
        }
    }

    fn recipe(&self) -> Result<Recipe, PartsError> {
        let seed = self.seed.parse().map_err(|_| PartsError::Seed(self.seed.clone()))?;
        let parse = |text: &String| World::parse_recorded("the world", text);
        let worlds = self.worlds.iter().map(parse).collect::<Result<_, _>>()?;
        let mut script = Script::parse("the script", &self.script)?;
        script.truncate_after(self.ticks);
        let sensor = self.sensor.map(|(n_rays, max_range)| RangeSensor { n_rays, max_range });
        Ok(Recipe::new(TourConfig { worlds, ticks: self.ticks, sensor }, (Seed(seed), script)))
    }
}

/// Why the parts of a run make none.
#[derive(Debug, thiserror::Error)]
enum PartsError {
    /// Not a number from 0 to 2^64 - 1.
    #[error("{0}: not a seed")]
    Seed(String),
    /// A world file that is refused.
    #[error(transparent)]
    World(#[from] WorldError),
    /// A script that is refused.
    #[error(transparent)]
    Script(#[from] ScriptError),
    /// The run cannot start.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The log cannot be written.
    #[error(transparent)]
    Log(#[from] LogError),
}

/// The result of simulating a log again.
#[derive(Debug, Serialize)]
struct RunCheck {
    /// Whether every frame came out equal to the last bit, and the file is whole.
    verified: bool,
    /// The number of ticks in the log.
    ticks: u64,
    /// The first tick that differs.
    diverging_tick: Option<u64>,
    /// The run's digest, computed anew.
    digest: String,
    seed: String,
    /// The result in words.
    text: String,
}

/// The bytes of a run's log.
fn written(recipe: &Recipe, kind: LogKind) -> Result<Vec<u8>, PartsError> {
    let mut run = Recorder::of(recipe)?.without_keyframes();
    let mut writer = LogWriter::new(Vec::new(), recipe, kind, run.frame())?;
    for _ in 0..recipe.config.ticks {
        writer.tick(run.step())?;
    }
    Ok(writer.finish()?)
}

fn error(text: impl ToString) -> JsError {
    JsError::new(&text.to_string())
}

fn recipe_of(parts: &str) -> Result<Recipe, JsError> {
    let parts: RunParts = serde_json::from_str(parts).map_err(error)?;
    parts.recipe().map_err(error)
}

/// The bytes of the log of a run from its parts, as JSON: `{ "seed", "worlds", "script", "ticks", "sensor" }`.
///
/// # Errors
/// The reason, when a part is refused.
#[wasm_bindgen]
pub fn record_log(parts: &str) -> Result<Vec<u8>, JsError> {
    let recipe = recipe_of(parts)?;
    written(&recipe, LogKind::usual(&recipe.config)).map_err(error)
}

/// The bytes of the log of such a run with a digest of each second instead of its frames: a fiftieth of them.
///
/// # Errors
/// The reason, when a part is refused.
#[wasm_bindgen]
pub fn record_digests(parts: &str) -> Result<Vec<u8>, JsError> {
    written(&recipe_of(parts)?, LogKind::Digests).map_err(error)
}

/// The bytes of the log of the run that the query of an address stands for, with a digest of each second.
///
/// # Errors
/// The reason, when a field is refused.
#[wasm_bindgen]
pub fn record_link(query: &str) -> Result<Vec<u8>, JsError> {
    let ReadLink { link, run, .. } = Link::read(query);
    run.map_err(error)?;
    let mut recipe = link.recipe();
    // what comes later is no part of the run up to the link's tick
    recipe.script.truncate_after(recipe.config.ticks);
    written(&recipe, LogKind::Digests).map_err(error)
}

/// Simulates a log's run again from its seed, configuration and script, and compares every frame to the last bit, or
/// the digest of every second. JSON:
/// `{ "verified", "ticks", "diverging_tick", "digest", "seed", "text" }`.
///
/// # Errors
/// The reason, when the bytes are no log, or one that was cut or damaged.
#[wasm_bindgen]
pub fn verify_log(bytes: &[u8]) -> Result<String, JsError> {
    let log = Log::read_mcap(bytes).map_err(error)?.log;
    let Verification { recorded, digest, difference, .. } = verify(&log, |_| {}).map_err(error)?;
    let verdict = RunCheck {
        verified: difference.is_none(),
        ticks: recorded,
        diverging_tick: difference.as_ref().map(Difference::first_tick),
        digest: digest.to_string(),
        seed: log.recipe.seed.to_string(),
        text: match difference {
            None => format!("bit-identical, {recorded} of {recorded}"),
            Some(difference) => difference.to_string(),
        },
    };
    serde_json::to_string(&verdict).map_err(error)
}

/// A log's run, simulated again to be watched: what its figure shows at a tick.
#[wasm_bindgen]
pub struct Replay {
    recipe: Recipe,
    recorder: Recorder,
    figure: RunFigure,
    digest: RunDigest,
}

#[wasm_bindgen]
impl Replay {
    /// The run of a log of either kind, at tick 0.
    ///
    /// # Errors
    /// The reason, when the bytes are no log, or one that was cut or damaged.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8]) -> Result<Self, JsError> {
        Replay::begin(Log::read_mcap(bytes).map_err(error)?.log.recipe)
    }

    fn begin(recipe: Recipe) -> Result<Self, JsError> {
        let recorder = Recorder::of(&recipe).map_err(error)?.without_keyframes();
        let mut figure = RunFigure::default();
        figure.watch(recorder.view());
        let digest = RunDigest::new(&recipe, recorder.frame());
        Ok(Replay { recipe, recorder, figure, digest })
    }

    /// The figure of the run up to a tick, at most its last, as SVG on light or dark paper. A tick before the one
    /// shown last begins anew.
    ///
    /// # Errors
    /// The reason, when the run does not start again.
    pub fn at(&mut self, tick: u64, dark: bool) -> Result<String, JsError> {
        if tick < self.recorder.frame().tick {
            *self = Replay::begin(self.recipe.clone())?;
        }
        while self.recorder.frame().tick < tick.min(self.recipe.config.ticks) {
            self.digest.tick(self.recorder.step());
            self.figure.watch(self.recorder.view());
        }
        let theme = if dark { Theme::Dark } else { Theme::Light };
        let shown = self.recorder.frame().tick;
        Ok(self.figure.svg(&self.recipe, shown, self.digest.digest(), theme))
    }
}
