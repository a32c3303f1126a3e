//! Captures from the window: the widget in front as a file or on the clipboard, drawn in a thread while the window goes
//! on.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::{self, JoinHandle};

use bevy::prelude::*;

use super::clipboard::Clipboard;
use super::files::name;
use crate::capture::{film_with_robots, paint, write};
use crate::window::captured::{captured, subject};
use crate::window::run_files::shown_run;
use crate::window::ui::{CaptureOrder, Interface, Notice, UiState, Working};
use motion_lab_sim::capture::{CaptureError, CaptureForm, Paper};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::simulation::Transport;
use motion_lab_sim::tour::TourConfig;

/// The capture under way.
#[derive(Resource, Default)]
pub struct Capturing(Option<CaptureJob>);

struct CaptureJob {
    to: Destination,
    widget: Widget,
    progress: Arc<CaptureProgress>,
    work: JoinHandle<Result<(), CaptureError>>,
}

enum Destination {
    File(PathBuf),
    Clipboard,
}

impl Destination {
    /// Its name in the words on the work under way.
    fn name(&self) -> String {
        match self {
            Destination::File(path) => name(path),
            Destination::Clipboard => "the clipboard".into(),
        }
    }
}

/// The progress of a capture: pictures done, pictures in all, and whether it is to stop.
#[derive(Default)]
struct CaptureProgress {
    done: AtomicU64,
    all: AtomicU64,
    stop: AtomicBool,
}

/// Checks whether the widget in front can be captured as ordered, from a run of this configuration.
pub fn check(config: &TourConfig, state: &UiState, order: &CaptureOrder) -> Result<(), CaptureError> {
    subject(state, order.form)?.map_or(Ok(()), |subject| subject.check(config))
}

/// The notice of a capture that was not made.
pub fn not_captured(error: &CaptureError) -> Notice {
    Notice { text: format!("not captured: {error}"), is_error: true }
}

/// Begins a capture of the widget in front, and stops the one under way. [`follow`] reports progress and outcome.
pub fn capture(world: &mut World, order: &CaptureOrder, path: &Path) {
    let state = world.resource::<Interface>().0.clone();
    let widget = state.widget;
    // the file name's extension decides the format, where it names one
    let form = CaptureForm::of(path).unwrap_or(order.form);
    let paper = Paper { palette: state.theme().palette(), width: order.width, scale: order.scale as f32 };
    let (tick, span) = (world.resource::<Transport>().tick(), order.span);
    let frontier = world.resource::<Transport>().frontier();
    let run = shown_run(world, frontier);
    let progress = Arc::new(CaptureProgress::default());
    let (shared, to) = (Arc::clone(&progress), path.to_owned());
    let work = thread::spawn(move || {
        if form == CaptureForm::Gif
            && let Some(subject) = subject(&state, form)?
        {
            let (kinds, log) = (run.kinds.clone(), run.record()?);
            let go_on = |done, all| {
                shared.done.store(done, Ordering::Relaxed);
                shared.all.store(all, Ordering::Relaxed);
                !shared.stop.load(Ordering::Relaxed)
            };
            return film_with_robots(&log, &subject, span, &paper, &to, go_on, |app| kinds.add_to(app));
        }
        let figure = captured(&state, run, tick, paper.width_px())?;
        write(&figure, &paper, form, &to)
    });
    begin(world, CaptureJob { to: Destination::File(path.to_owned()), widget, progress, work });
}

/// Begins to copy the widget in front as it stands, and stops the capture under way. [`follow`] reports the outcome.
pub fn copy_picture(world: &mut World, order: &CaptureOrder) {
    let state = world.resource::<Interface>().0.clone();
    let widget = state.widget;
    let paper = Paper { palette: state.theme().palette(), width: order.width, scale: order.scale as f32 };
    let transport = world.resource::<Transport>();
    let (tick, frontier) = (transport.tick(), transport.frontier());
    let (run, clipboard) = (shown_run(world, frontier), world.resource::<Clipboard>().clone());
    let progress = Arc::new(CaptureProgress::default());
    let shared = Arc::clone(&progress);
    let work = thread::spawn(move || {
        let figure = captured(&state, run, tick, paper.width_px())?;
        if shared.stop.load(Ordering::Relaxed) {
            return Err(CaptureError::Stopped);
        }
        clipboard.put(&paint(&figure, &paper)?).map_err(CaptureError::Fault)
    });
    begin(world, CaptureJob { to: Destination::Clipboard, widget, progress, work });
}

/// Puts a job in place of the one under way, which is stopped.
fn begin(world: &mut World, job: CaptureJob) {
    if let Some(before) = &world.resource::<Capturing>().0 {
        before.progress.stop.store(true, Ordering::Relaxed);
    }
    world.resource_mut::<Capturing>().0 = Some(job);
    let state = &mut world.resource_mut::<Interface>().into_inner().0;
    state.dismiss_notice();
    state.working = Some(Working::default());
    follow(world);
}

/// Stops an abandoned capture at its next picture.
impl Drop for Capturing {
    fn drop(&mut self) {
        if let Some(job) = &self.0 {
            job.progress.stop.store(true, Ordering::Relaxed);
        }
    }
}

/// Reports the progress of the capture under way, and its outcome at the end.
pub fn follow(world: &mut World) {
    let Some(job) = world.resource_mut::<Capturing>().0.take() else { return };
    let state = &mut world.resource_mut::<Interface>().into_inner().0;
    if job.work.is_finished() {
        state.working = None;
        state.say_in(job.widget, ended(&job.to, job.work.join().unwrap_or(Err(fault()))));
        return;
    }
    let (done, all) = (job.progress.done.load(Ordering::Relaxed), job.progress.all.load(Ordering::Relaxed));
    let stop = state.working.as_ref().is_some_and(|w| w.stop);
    if stop {
        job.progress.stop.store(true, Ordering::Relaxed);
    }
    let text = match all {
        0 => format!("{}: drawing", job.to.name()),
        _ => format!("{}: picture {} of {all}", job.to.name(), done + 1),
    };
    state.working = Some(Working { text, stop });
    world.resource_mut::<Capturing>().0 = Some(job);
}

fn fault() -> CaptureError {
    CaptureError::Fault("a fault of the lab".into())
}

fn ended(to: &Destination, outcome: Result<(), CaptureError>) -> Notice {
    let (text, is_error) = match (to, outcome) {
        (Destination::Clipboard, Ok(())) => ("copied".into(), false),
        (Destination::Clipboard, Err(CaptureError::Stopped)) => ("not copied: stopped".into(), false),
        (Destination::Clipboard, Err(error)) => (format!("not copied: {error}"), true),
        (Destination::File(path), Ok(())) => (format!("{}: captured", name(path)), false),
        (Destination::File(path), Err(CaptureError::Stopped)) => {
            (format!("{}: stopped, no file was written", name(path)), false)
        }
        (Destination::File(path), Err(error)) => (format!("{}: not captured: {error}", path.display()), true),
    };
    Notice { text, is_error }
}
