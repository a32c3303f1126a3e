//! Runs as the light WebAssembly build exports them: recorded from their parts, verified, drawn, put into pages.

use serde::Serialize;
use wasm_bindgen::prelude::*;

use super::link::{Link, ReadLink};
use motion_lab_core::picture::Theme;
use motion_lab_sim::capture::RunFigure;
use motion_lab_sim::recording::{Recorder, RunError, RunParts, TickDigests, Verification, verify};
use motion_lab_sim::run::{Difference, Log, LogError, LogKind, LogWriter, Recipe, RunDigest};
#[cfg(not(feature = "web"))]
use motion_lab_sim::run_page::{PageTemplate, UnfinishedPage};

/// Why no log came of a run.
#[derive(Debug, thiserror::Error)]
enum RecordError {
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
fn written(recipe: &Recipe, kind: LogKind) -> Result<Vec<u8>, RecordError> {
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

/// The page that holds such a run: see [`PageTemplate`]. It is made of the text of a template and the bytes of this
/// module.
///
/// # Errors
/// The reason, when a part or the template is refused.
#[cfg(not(feature = "web"))]
#[wasm_bindgen]
pub fn run_page(parts: &str, template: String, module: &[u8]) -> Result<String, JsError> {
    let template = PageTemplate::of(template, module).map_err(error)?;
    UnfinishedPage::of_run(&template, recipe_of(parts)?).and_then(UnfinishedPage::page).map_err(error)
}

/// Which simulator this is: see [`simulator_print`](motion_lab_sim::run_page::simulator_print).
///
/// # Errors
/// A fault of the library.
#[cfg(not(feature = "web"))]
#[wasm_bindgen]
pub fn simulator_print() -> Result<String, JsError> {
    motion_lab_sim::run_page::simulator_print().map_err(error)
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

/// The digests of a run from its parts, for comparing builds: one a line, from tick 0 on, then the run's own, then that
/// of them all ([`TickDigests`]).
///
/// # Errors
/// The reason, when a part is refused.
#[wasm_bindgen]
pub fn tick_digests(parts: &str) -> Result<String, JsError> {
    let mut digests = TickDigests::of(&recipe_of(parts)?).map_err(error)?;
    let mut lines: Vec<String> = digests.by_ref().map(|digest| digest.to_string()).collect();
    lines.extend([digests.run(), digests.digest()].map(|digest| digest.to_string()));
    Ok(lines.join("\n"))
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
