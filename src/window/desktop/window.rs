//! Opening the window, or saying in one line why there is none.

use std::any::Any;
use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook, take_hook};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use bevy::prelude::*;
use bevy::window::WindowCloseRequested;

use super::files::open_run;
use crate::window::ui::{Closing, Interface, Notice};
use motion_lab_core::worlds::World as WorldModel;
use motion_lab_sim::simulation::{Playback, Transport, start_run};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

/// Why there is no window. Each prints as one line; where no window opened, the line names the command that needs none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WindowError {
    /// No display is set.
    #[error("no display: neither DISPLAY nor WAYLAND_DISPLAY is set; `motion-lab --help` lists what needs none")]
    NoDisplay,
    /// The display or the graphics adapter did not answer.
    #[error("no window could be opened ({0}); `motion-lab --help` lists what needs none")]
    NotOpened(String),
    /// The window was closed by an error.
    #[error("the window closed with code {0}")]
    Closed(u8),
}

/// Opens the lab in a window and returns when it is closed.
///
/// # Errors
/// [`WindowError::NoDisplay`] when the environment names no display, [`WindowError::NotOpened`] when the window system
/// or the graphics adapter fails before the first frame, [`WindowError::Closed`] when an error closes the window. A
/// panic after the first frame is a fault of the lab and goes on as one.
pub fn run_window() -> Result<(), WindowError> {
    run_window_with(|_| {})
}

/// [`run_window`] in an app that `add` has added to: kinds of robots of a program's own by
/// [`RobotPlugin`](motion_lab_sim::simulation::RobotPlugin), systems, and the run to begin with by
/// [`start_run`].
///
/// # Errors
/// As [`run_window`].
pub fn run_window_with(add: impl FnOnce(&mut App)) -> Result<(), WindowError> {
    check_display(|name| std::env::var_os(name))?;
    let opened = Arc::new(AtomicBool::new(false));
    // A failure before the first frame is reported in one line below. After it, panics print as usual.
    let speak = take_hook();
    let quiet = Arc::clone(&opened);
    set_hook(Box::new(move |info| {
        if quiet.load(Ordering::Relaxed) {
            speak(info);
        }
    }));
    let first_frame = Arc::clone(&opened);
    let outcome = catch_unwind(AssertUnwindSafe(move || {
        let mut app = crate::window::windowed_app(super::add_default_plugins);
        add(&mut app);
        app.add_systems(Last, move || first_frame.store(true, Ordering::Relaxed));
        app.run()
    }));
    match outcome {
        Ok(AppExit::Success) => Ok(()),
        Ok(AppExit::Error(code)) => Err(WindowError::Closed(code.get())),
        Err(panic) if opened.load(Ordering::Relaxed) => resume_unwind(panic),
        Err(panic) => Err(WindowError::NotOpened(first_sentence(panic.as_ref()))),
    }
}

/// What [`open_in_window`] begins with.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Opened {
    /// The tour of the three worlds, from the book's seed. It plays.
    Tour,
    /// A run of this world, from the book's seed, in place of the three worlds' tour. It plays.
    World(Box<WorldModel>),
    /// A run of the world in this file, which is put among the recent files.
    WorldFile(PathBuf, Box<WorldModel>),
    /// A recorded run: simulated again and compared with what was recorded, and shown paused. The window says what came
    /// of it, also where the file can't be read.
    Log(PathBuf),
}

/// [`run_window_with`] that begins with a world or a recorded run.
///
/// # Errors
/// As [`run_window`].
pub fn open_in_window(what: Opened, add: impl FnOnce(&mut App)) -> Result<(), WindowError> {
    run_window_with(move |app| {
        let mut what = Some(what);
        app.add_systems(PostStartup, move |world: &mut World| {
            if let Some(notice) = what.take().and_then(|what| open(world, what)) {
                world.resource_mut::<Interface>().0.say(notice);
            }
        });
        add(app);
    })
}

/// Begins with a world or a recorded run. Returns what to say of it.
pub(in crate::window) fn open(world: &mut World, what: Opened) -> Option<Notice> {
    match what {
        Opened::Tour => None,
        Opened::WorldFile(path, model) => {
            world.resource_mut::<Interface>().0.recent.put_first(&path);
            open(world, Opened::World(model))
        }
        Opened::World(model) => {
            let config = TourConfig { worlds: vec![*model], ..TourConfig::default() };
            let started = start_run(world, config, BOOK_SEED);
            world.resource_mut::<Transport>().playback = Playback::Playing;
            Some(Notice { text: format!("the world does not run: {}", started.err()?), is_error: true })
        }
        Opened::Log(path) => open_run(world, &path),
    }
}

/// Ends the program when the window is to close. Where edits of worlds are in no file, asks first.
pub fn close(
    mut asked: MessageReader<WindowCloseRequested>,
    mut interface: ResMut<Interface>,
    mut exits: MessageWriter<AppExit>,
) {
    if asked.read().count() > 0 {
        let is_safe = interface.0.unsaved().is_empty();
        interface.0.closing = Some(if is_safe { Closing::Agreed } else { Closing::Asking });
    }
    if interface.0.closing == Some(Closing::Agreed) {
        exits.write(AppExit::Success);
    }
}

/// Checks that there is a display. On Linux one of two variables must name it; other systems always have one.
fn check_display(variable: impl Fn(&str) -> Option<OsString>) -> Result<(), WindowError> {
    let set = |name| variable(name).is_some_and(|value| !value.is_empty());
    if cfg!(target_os = "linux") && !set("DISPLAY") && !set("WAYLAND_DISPLAY") {
        return Err(WindowError::NoDisplay);
    }
    Ok(())
}

/// The first sentence of a panic's message.
fn first_sentence(panic: &(dyn Any + Send)) -> String {
    let said = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
    let line = said.and_then(|s| s.lines().next()).unwrap_or("unknown reason");
    let sentence = line.split_once("! ").or(line.split_once(". ")).map_or(line, |(first, _)| first);
    sentence.trim_end_matches(['.', '!']).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn a_display_is_one_of_two_variables_that_says_something() {
        let with = |set: &'static [(&str, &str)]| {
            check_display(move |name| set.iter().find(|(n, _)| *n == name).map(|(_, v)| OsString::from(v)))
        };
        assert_eq!(with(&[]), Err(WindowError::NoDisplay));
        assert_eq!(with(&[("DISPLAY", "")]), Err(WindowError::NoDisplay));
        assert_eq!(with(&[("DISPLAY", ":0")]), Ok(()));
        assert_eq!(with(&[("WAYLAND_DISPLAY", "wayland-0")]), Ok(()));
    }

    #[test]
    fn every_way_to_have_no_window_is_one_line_that_names_the_command() {
        let said = |message: &'static str| {
            first_sentence(catch_unwind(|| std::panic::panic_any(message)).unwrap_err().as_ref())
        };
        let adapter = WindowError::NotOpened(said("Unable to find a GPU! Make sure.\nSee there"));
        for error in [WindowError::NoDisplay, adapter] {
            let line = error.to_string();
            assert!(!line.contains('\n') && line.contains("`motion-lab --help` lists"), "{line}");
        }
        assert_eq!(said("Unable to find a GPU! Make sure.\nSee there"), "Unable to find a GPU");
    }
}
