//! Runs and worlds as bytes, saved and opened for the window and the web page alike.

use bevy::ecs::world::World;

use super::background::{self, Check, Done, Save};
use super::error::SessionError;
use crate::window::ui::{AtlasState, Interface, Notice};
use motion_lab_sim::atlas::Editor;
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::recording::{Recorder, Run, RunError};
use motion_lab_sim::run::{Comparison, Log, LogError, LogKind, LogWriter, MAX_ROBOTS_IN_FULL, Recipe};
use motion_lab_sim::simulation::{LatestFrame, Playback, RobotKinds, Transport, checkpoint, recipe, start_recipe};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

/// The run that is shown, with the kinds of robots that the program registered.
pub struct ShownRun {
    /// The run.
    pub recipe: Recipe,
    /// The kinds.
    pub kinds: RobotKinds,
}

impl ShownRun {
    /// The run, recorded with every frame.
    pub fn record(self) -> Result<Log, RunError> {
        Run::record_recipe(self.recipe, LogKind::Frames, |app| self.kinds.add_to(app))
    }
}

/// The present run up to `ticks`.
pub fn shown_run(world: &World, ticks: u64) -> ShownRun {
    // before the first run there is the tour
    let present = recipe(world).unwrap_or_else(|| Recipe::new(TourConfig::default(), BOOK_SEED));
    let config = TourConfig { ticks, ..TourConfig::clone(&present.config) };
    let mut recipe = Recipe { config: config.into(), ..present };
    recipe.script.truncate_after(ticks);
    ShownRun { recipe, kinds: world.resource::<RobotKinds>().clone() }
}

/// The run as far as it has come, recorded from its recipe, and its log's bytes.
pub fn recorded(world: &World) -> Result<(Log, Vec<u8>), SessionError> {
    let frontier = world.resource::<Transport>().frontier();
    if frontier == 0 {
        return Err(SessionError::NotRun);
    }
    let log = shown_run(world, frontier).record()?;
    let mut bytes = Vec::new();
    log.write_mcap(&mut bytes)?;
    Ok((log, bytes))
}

/// Saves the run as far as it has come, as a log whose bytes `done` takes: with its frames up to 100 robots, with a
/// digest of each second above. Returns what came of it; nothing yet where it takes long and goes on in the background.
pub fn save(world: &mut World, done: Done) -> Result<Option<Notice>, SessionError> {
    background::stop(world);
    let frontier = world.resource::<Transport>().frontier();
    if world.resource::<LatestFrame>().frame().robots.len() > MAX_ROBOTS_IN_FULL && frontier > 0 {
        let ShownRun { recipe, kinds } = shown_run(world, frontier);
        let recorder = Recorder::of_with_robots(&recipe, |app| kinds.add_to(app))?;
        let writer = LogWriter::new(Vec::new(), &recipe, LogKind::Digests, recorder.frame())?;
        return background::save(world, Save::begin(recorder, writer, recipe.config.ticks, done));
    }
    let (log, bytes) = recorded(world)?;
    let digest = log.digest().map_or_else(String::new, |digest| format!(", digest {digest}"));
    done(&bytes, format!("saved, {} ticks{digest}", log.ticks())).map(Some)
}

/// Opens a log in place of the present run: simulates it again from its seed and script and compares every frame, or
/// the digest of every second.
///
/// The run is shown paused, at its start or at the first tick that differs. Where the log can't be read, the present
/// run stays. Returns what came of it; nothing yet where it takes long and goes on in the background.
pub fn open_log(world: &mut World, name: &str, bytes: &[u8]) -> Result<Option<Notice>, SessionError> {
    let (log, damage) = read_log(bytes)?;
    background::stop(world);
    checkpoint(world);
    let speed = world.resource::<Transport>().speed;
    start_recipe(world, log.recipe.clone())?;
    world.resource_mut::<Interface>().0.played = false;
    let mut transport = world.resource_mut::<Transport>();
    (transport.playback, transport.speed) = (Playback::Paused, speed);
    let comparison = Comparison::begin(log, world.resource::<LatestFrame>().frame());
    background::check(world, Check::begin(name, comparison, damage))
}

/// The log in these bytes, or its sealed beginning and words on the damage.
fn read_log(bytes: &[u8]) -> Result<(Log, Option<String>), LogError> {
    match Log::read_mcap(bytes) {
        Ok(read) => Ok((read.log, None)),
        Err(LogError::Damaged(mut damaged)) => {
            // said before the recovered part is taken out: the message names it
            let message = damaged.to_string();
            match damaged.recovered.take() {
                Some(read) => Ok((read.log, Some(message))),
                None => Err(LogError::Damaged(damaged)),
            }
        }
        Err(error) => Err(error),
    }
}

/// The text of the plan's path as a file; `None` without a path of the planner's own.
pub fn path_text(world: &World) -> Option<String> {
    world.resource::<Interface>().0.plan.file()?.to_json().ok()
}

/// Opens the text of a path's file in the plan. Where it is refused, the present plan stays.
pub fn open_path_text(world: &mut World, name: &str, text: &str) -> Notice {
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    let atlas = ui.atlas.world().clone();
    match ui.plan.read(name, text, &atlas) {
        Ok(()) => {
            ui.widget = Widget::Plan;
            Notice { text: format!("{name}: opened"), is_error: false }
        }
        Err(error) => Notice { text: format!("{name}: not opened: {error}"), is_error: true },
    }
}

/// Opens a world file's text in the atlas. Where it is refused, the present one stays.
pub fn open_world_text(world: &mut World, name: &str, text: &str) -> Notice {
    match Editor::open(name, text) {
        Ok(editor) => {
            let ui = &mut world.resource_mut::<Interface>().into_inner().0;
            ui.open_world(AtlasState::edited(editor));
            ui.widget = Widget::Atlas;
            Notice { text: format!("{name}: opened"), is_error: false }
        }
        Err(error) => Notice { text: format!("{name}: not opened: {error}"), is_error: true },
    }
}
