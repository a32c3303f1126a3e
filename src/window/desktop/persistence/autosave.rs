//! Keeping the run under way in a file, so that a program that ends without a word loses none of the reader's input.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use bevy::prelude::*;

use super::saved_run::{MAX_BYTES, SavedRun, SavedRunError, world_texts};
use super::slot::{Slot, folder_of_runs, forget, left_behind, move_away, remove_stale_locks};
use crate::window::background::{self, Background};
use crate::window::error::SessionError;
use crate::window::ui::{Interface, Notice, Offer};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::run::Recipe;
use motion_lab_sim::simulation::{
    LatestFrame, PendingInput, Playback, RunConfig, Transport, TransportCommand, checkpoint, extend_frontier,
    is_under_way, recipe, seek, start_recipe,
};
use motion_lab_sim::tour::TourConfig;

/// Least time between two looks at the run, by the window's clock.
pub const EVERY: Duration = Duration::from_secs(3);

/// Largest number of runs that are left for later. Older ones are taken away.
const MAX_LEFT: usize = 8;

/// Keeps the run under way while it has input that is in no file, and offers the one that a window before left.
///
/// Nothing is written of a run without input: seed and configuration alone are easily had again. A run that was opened
/// from a file or saved to one is not written either, until its input changes.
pub struct AutosavePlugin {
    /// The folder for the files; `None` to keep nothing.
    pub folder: Option<PathBuf>,
}

impl Default for AutosavePlugin {
    fn default() -> Self {
        AutosavePlugin { folder: folder_of_runs() }
    }
}

impl Plugin for AutosavePlugin {
    fn build(&self, app: &mut App) {
        let Some(folder) = self.folder.clone() else { return };
        app.insert_resource(Autosave { folder, ..default() })
            .add_systems(PostStartup, offer)
            .add_systems(Update, (answer, arrive).chain())
            .add_systems(Last, (keep, keep_at_the_end).chain());
    }
}

/// The run under way as it is kept, and the one that was left.
#[derive(Resource, Default)]
pub struct Autosave {
    folder: PathBuf,
    /// The files of this window, from the first write on.
    slot: Option<Slot>,
    writing: Option<JoinHandle<SaveOutcome>>,
    /// The run as it was written last.
    written: Option<SavedRun>,
    /// The texts of the worlds of a configuration, which take long to make for large worlds.
    texts: Option<Texts>,
    in_file: Option<InFile>,
    /// When the run was last compared with what was written, by the window's clock.
    looked: Option<Duration>,
    /// The run that was left and is offered, and its file.
    offered: Option<(PathBuf, SavedRun)>,
    /// The run on its way back.
    pending: Option<SavedRun>,
    /// The file of the run that was brought back, until that run is written anew.
    came_from: Option<PathBuf>,
    has_failed: bool,
}

/// The texts of the worlds of this configuration.
#[derive(Clone)]
struct Texts {
    of: Arc<TourConfig>,
    texts: Arc<[String]>,
}

/// What a thread gives back.
struct SaveOutcome {
    slot: Option<Slot>,
    texts: Option<Texts>,
    run: SavedRun,
    outcome: Result<(), String>,
}

/// A run that is in a file of the reader's.
struct InFile {
    recipe: Recipe,
    /// Whether the file has been written.
    is_there: Arc<AtomicBool>,
}

/// Notes that the run under way, with input up to `ticks`, is in a file of the reader's once the flag that this returns
/// is set.
pub fn note_in_file(world: &mut World, ticks: u64) -> Arc<AtomicBool> {
    let is_there = Arc::new(AtomicBool::new(false));
    let Some(mut recipe) = recipe(world) else { return is_there };
    recipe.script.truncate_after(ticks);
    if let Some(mut autosave) = world.get_resource_mut::<Autosave>() {
        autosave.in_file = Some(InFile { recipe, is_there: Arc::clone(&is_there) });
    }
    is_there
}

/// Whether there is input that would be lost.
fn is_worth_keeping(world: &World) -> bool {
    let script = world.resource::<PendingInput>().script();
    let Some(config) = world.get_resource::<RunConfig>().map(RunConfig::config) else { return false };
    let is_this = |file: &InFile| {
        let Recipe { seed, config: in_file, script: saved } = &file.recipe;
        file.is_there.load(Ordering::Acquire)
            && *seed == world.resource::<Transport>().seed()
            && (Arc::ptr_eq(in_file, config) || in_file == config)
            && saved == script
    };
    !script.is_empty() && !world.resource::<Autosave>().in_file.as_ref().is_some_and(is_this)
}

/// The run as it stands.
fn present(world: &World) -> Option<SavedRun> {
    let transport = world.resource::<Transport>();
    let (tick, frontier) = (transport.tick(), transport.frontier());
    let frame = world.resource::<LatestFrame>().frame().digest();
    Some(SavedRun { recipe: recipe(world)?, tick, frontier, frame })
}

/// Whether the run stands as it was written.
fn is_written(world: &World) -> bool {
    let transport = world.resource::<Transport>();
    let (tick, frontier) = (transport.tick(), transport.frontier());
    let is_as = |written: &SavedRun| {
        (written.tick, written.frontier) == (tick, frontier) && is_under_way(world, &written.recipe)
    };
    world.resource::<Autosave>().written.as_ref().is_some_and(is_as)
}

/// Writes the run in a thread, if it has changed since it was written last.
fn keep(world: &mut World) {
    let now = world.resource::<Time<Real>>().elapsed();
    let autosave = world.resource_mut::<Autosave>().into_inner();
    if autosave.looked.is_some_and(|looked| now.saturating_sub(looked) < EVERY) {
        return;
    }
    let is_writing = autosave.writing.as_ref().is_some_and(|w| !w.is_finished());
    // a run on its way to another tick stands nowhere
    if is_writing || world.resource::<Background>().is_under_way() {
        return;
    }
    world.resource_mut::<Autosave>().looked = Some(now);
    end_writing(world);
    if !is_worth_keeping(world) {
        world.resource_mut::<Autosave>().keep_nothing();
    } else if !is_written(world)
        && let Some(run) = present(world)
    {
        let autosave = world.resource_mut::<Autosave>().into_inner();
        let (folder, slot, texts) = (autosave.folder.clone(), autosave.slot.take(), autosave.texts.clone());
        autosave.writing = Some(thread::spawn(move || write(&folder, slot, texts, run)));
    }
}

/// Writes a run, with a slot and the texts of its worlds where they are known.
fn write(folder: &Path, slot: Option<Slot>, texts: Option<Texts>, run: SavedRun) -> SaveOutcome {
    let mut written = SaveOutcome { slot, texts, run, outcome: Ok(()) };
    written.outcome = written.write(folder);
    written
}

impl SaveOutcome {
    fn write(&mut self, folder: &Path) -> Result<(), String> {
        let said = |error: SavedRunError| error.to_string();
        let texts = match self.texts.take().filter(|texts| Arc::ptr_eq(&texts.of, &self.run.recipe.config)) {
            Some(texts) => texts,
            None => {
                let config = &self.run.recipe.config;
                Texts { of: Arc::clone(config), texts: world_texts(config).map_err(said)?.into() }
            }
        };
        let bytes = self.run.to_bytes(&texts.texts).map_err(said)?;
        self.texts = Some(texts);
        let slot = match self.slot.take() {
            Some(slot) => slot,
            None => Slot::take(folder, std::process::id()).map_err(|error| error.to_string())?,
        };
        let outcome = slot.write(&bytes).map_err(|error| error.to_string());
        self.slot = Some(slot);
        outcome
    }
}

/// Waits for the file being written, if any, and notes what came of it.
fn end_writing(world: &mut World) {
    let autosave = world.resource_mut::<Autosave>().into_inner();
    let Some(Ok(written)) = autosave.writing.take().map(JoinHandle::join) else { return };
    note(world, written);
}

fn note(world: &mut World, SaveOutcome { slot, texts, run, outcome }: SaveOutcome) {
    let autosave = world.resource_mut::<Autosave>().into_inner();
    (autosave.slot, autosave.texts) = (slot, texts);
    // also where it failed, so that the same run is not tried again and again
    autosave.written = Some(run);
    let Err(error) = outcome else {
        autosave.has_failed = false;
        autosave.came_from.take().iter().for_each(|left| forget(left));
        return;
    };
    if !std::mem::replace(&mut autosave.has_failed, true) {
        let text = format!("the run can't be kept for the next start ({error}); Save writes it as a file");
        world.resource_mut::<Interface>().0.say_in(Widget::Dashboard, Notice { text, is_error: true });
    }
}

impl Autosave {
    /// Takes this window's file away, and the one that the present run came from.
    fn keep_nothing(&mut self) {
        self.written = None;
        if self.pending.is_some() {
            return;
        }
        if let Some(slot) = &self.slot {
            slot.clear();
        }
        self.came_from.take().iter().for_each(|left| forget(left));
    }
}

/// At the ordinary end, keeps input that is in no file for the next start, and else leaves nothing.
fn keep_at_the_end(world: &mut World, mut exits: Local<bevy::ecs::message::MessageCursor<AppExit>>) {
    if exits.read(world.resource::<Messages<AppExit>>()).count() == 0 {
        return;
    }
    end_writing(world);
    let is_complete = !world.resource::<Background>().is_under_way();
    if !is_worth_keeping(world) {
        world.resource_mut::<Autosave>().keep_nothing();
    } else if is_complete
        && !is_written(world)
        && let Some(run) = present(world)
    {
        let autosave = world.resource_mut::<Autosave>().into_inner();
        let written = write(&autosave.folder, autosave.slot.take(), autosave.texts.take(), run);
        note(world, written);
    }
    if let Some(slot) = world.resource_mut::<Autosave>().slot.take() {
        slot.release();
    }
}

/// Offers the last run that was left. One that can't be read is set apart, with a notice.
fn offer(world: &mut World) {
    let folder = world.resource::<Autosave>().folder.clone();
    remove_stale_locks(&folder);
    let mut left = left_behind(&folder).into_iter();
    for path in left.by_ref().take(MAX_LEFT) {
        match read(&path) {
            Ok(run) => {
                let (inputs, tick) = (run.recipe.inputs(), run.tick);
                let inputs = if inputs == 1 { "1 input".to_owned() } else { format!("{inputs} inputs") };
                let text = format!("The run of before is kept: seed {}, {inputs}, at tick {tick}.", run.recipe.seed);
                world.resource_mut::<Interface>().0.offer = Some(Offer { text, answer: None });
                world.resource_mut::<Autosave>().offered = Some((path, run));
                break;
            }
            Err(reason) => {
                let aside = move_away(&path);
                let text = format!("the run of before can't be brought back: {reason}; it is now {}", aside.display());
                world.resource_mut::<Interface>().0.say_in(Widget::Dashboard, Notice { text, is_error: true });
            }
        }
    }
    // the others wait for the next start, but not all of them for ever
    left.skip(MAX_LEFT).for_each(|old| forget(&old));
}

fn read(path: &Path) -> Result<SavedRun, String> {
    let about = fs::metadata(path).map_err(|error| error.to_string())?;
    if about.len() > MAX_BYTES {
        return Err(format!("{} bytes: at most {MAX_BYTES} are read", about.len()));
    }
    let bytes = fs::read(path).map_err(|error| error.to_string())?;
    SavedRun::read(&bytes).map_err(|error| error.to_string())
}

/// Does what the reader wants done with the run that is offered.
fn answer(world: &mut World) {
    let offer = &mut world.resource_mut::<Interface>().into_inner().0.offer;
    let Some(is_wanted) = offer.as_ref().and_then(|offer| offer.answer) else { return };
    *offer = None;
    let Some((path, run)) = world.resource_mut::<Autosave>().offered.take() else { return };
    if !is_wanted {
        return forget(&path);
    }
    // the file stays until the run is written anew
    match bring_back(world, run) {
        Ok(()) => world.resource_mut::<Autosave>().came_from = Some(path),
        Err(error) => {
            let text = format!("the run of before can't be brought back: {error}; it stays in {}", path.display());
            world.resource_mut::<Autosave>().pending = None;
            world.resource_mut::<Interface>().0.say_in(Widget::Dashboard, Notice { text, is_error: true });
        }
    }
}

/// Starts the run again in place of the present one, which an undo brings back, and goes to where it stood, paused.
fn bring_back(world: &mut World, run: SavedRun) -> Result<(), SessionError> {
    background::stop(world);
    checkpoint(world);
    let speed = world.resource::<Transport>().speed;
    start_recipe(world, run.recipe.clone())?;
    let (tick, frontier) = (run.tick, run.frontier);
    world.resource_mut::<Autosave>().pending = Some(run);
    world.resource_mut::<Interface>().0.widget = Widget::Dashboard;
    let mut transport = world.resource_mut::<Transport>();
    (transport.playback, transport.speed) = (Playback::Paused, speed);
    if !background::seek_in_background(world, &TransportCommand::Seek(tick)) {
        // first to the last tick reached, so that the time line knows what lies ahead
        if !background::is_long(world, frontier) {
            seek(world, frontier)?;
        }
        seek(world, tick)?;
    }
    extend_frontier(world, frontier);
    arrive(world);
    Ok(())
}

/// Says whether the run that was brought back stands as it stood, to the last bit, once it has come there.
fn arrive(world: &mut World) {
    if world.resource::<Autosave>().pending.is_none() || world.resource::<Background>().is_under_way() {
        return;
    }
    let Some(run) = world.resource_mut::<Autosave>().pending.take() else { return };
    let frame = world.resource::<LatestFrame>().frame();
    // somebody stopped it on its way, or went elsewhere
    if frame.tick != run.tick {
        return;
    }
    let is_error = frame.digest() != run.frame;
    let how = if is_error { "not as it was: this program moves differently" } else { "bit-identical" };
    let text = format!("the run of before, seed {}, stands at tick {}: {how}", run.recipe.seed, run.tick);
    world.resource_mut::<Interface>().0.say_in(Widget::Dashboard, Notice { text, is_error });
}
