//! The lab in a page: it starts with a link, takes messages, and reports to a listener what happens.

use std::cell::Cell;
use std::time::Duration;

use bevy::prelude::*;
use bevy::time::TimeSystems;
use bevy::window::WindowResized;
use bevy::winit::{EventLoopProxyWrapper, UpdateMode, WinitSettings, WinitUserEvent};
use bevy_egui::EguiPreUpdateSet;
use serde_json::json;
use wasm_bindgen::prelude::*;

use super::super::message::{Message, PageRequest};
use super::canvas::add_plugins;
use super::controls::{Staged, Touched, receive};
use super::downloads::files;
use super::inbox::{Incoming, put, wake, wake_by};
use super::listener::{listen, tell};
use super::report::{Sent, report};
use super::run_link::{RunBefore, show_address};
use crate::web::link::{Link, ReadLink};
use crate::window::for_page::{Interface, limit, windowed_app};
use crate::window::ui::Settings;

/// Largest mark of a request, bytes.
const MAX_OF_MARK: usize = 100;

/// Largest message, bytes.
const MAX_BYTES: usize = 65_536;

/// Value of `STILL` while the page is hidden. `STILL` is the number of frames to come in which no time passes.
const AWAY: u32 = u32::MAX;

thread_local! {
    static STILL: Cell<u32> = const { Cell::new(0) };
}

/// Starts the lab on the canvas with the id `lab`.
///
/// `query` is the query of an address. One that is refused starts the book's run, and the lab says why. `embedded`
/// shows one widget without the rail. `settings` are the settings that the page keeps, as JSON, or nothing. `listener`
/// is called with JSON, and with bytes where a file goes with it.
#[wasm_bindgen]
pub fn lab_start(query: &str, embedded: bool, settings: &str, listener: js_sys::Function) {
    let link = Link::read(query);
    listen(listener);
    let mut app = windowed_app(add_plugins);
    // Bevy has set a hook of its own by now
    let speak = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        tell(&json!({ "kind": "failed", "text": info.to_string() }));
        speak(info);
    }));
    let before = receive.after(EguiPreUpdateSet::ProcessInput).before(EguiPreUpdateSet::BeginPass);
    // settings that can't be read, such as another version's, give way to the defaults
    let settings = serde_json::from_str(settings).unwrap_or_default();
    app.insert_resource(StartArguments { link, embedded, settings })
        .init_resource::<Sent>()
        .init_resource::<Staged>()
        .init_resource::<Touched>()
        .add_systems(PostStartup, start)
        .add_systems(First, stand_still.after(limit).before(TimeSystems))
        .add_systems(PreUpdate, before)
        .add_systems(Update, files)
        .add_systems(Last, (report, rest))
        .run();
}

/// Sends the lab a message: the JSON of a [`PageRequest`], at most 65,536 bytes.
///
/// # Errors
/// Says why the message is refused: it is too long, it is not a [`PageRequest`], its `request` has more than 100 bytes,
/// or too many messages wait for the lab's next frame.
#[wasm_bindgen]
pub fn lab_send(message: &str) -> Result<(), JsError> {
    if message.len() > MAX_BYTES {
        return Err(JsError::new(&format!("a message of {} bytes; the lab takes up to {MAX_BYTES}", message.len())));
    }
    let asked = PageRequest::read(message).map_err(|reason| JsError::new(&reason))?;
    if asked.request.as_ref().is_some_and(|mark| mark.len() > MAX_OF_MARK) {
        return Err(JsError::new(&format!("request: a mark has up to {MAX_OF_MARK} bytes")));
    }
    match asked.message {
        // no frame may come until the page is seen again
        Message::Visible { visible } => STILL.set(if visible { 2 } else { AWAY }),
        _ => take_in(Incoming::Message(asked))?,
    }
    Ok(())
}

/// Opens a file: a run's log, a world when its name ends in `.ron`, or a path when it ends in `.json`. A notice in the
/// lab says what came of it.
///
/// # Errors
/// The reason, when too many wait.
#[wasm_bindgen]
pub fn lab_open(name: &str, bytes: Vec<u8>) -> Result<(), JsError> {
    take_in(Incoming::File { name: name.to_owned(), bytes })
}

/// Panics in the next frame. No message does: this is for tests of the page, which see what it does then.
///
/// # Errors
/// The reason, when too many wait.
#[wasm_bindgen]
pub fn lab_fail() -> Result<(), JsError> {
    take_in(Incoming::Fail)
}

fn take_in(incoming: Incoming) -> Result<(), JsError> {
    if put(incoming) { Ok(()) } else { Err(JsError::new("the lab has not read what came before: this is lost")) }
}

/// The arguments of `lab_start`, kept for the start of the app.
#[derive(Resource)]
struct StartArguments {
    link: ReadLink,
    embedded: bool,
    settings: Settings,
}

fn start(world: &mut World) {
    let Some(StartArguments { link, embedded, settings }) = world.remove_resource() else { return };
    if let Some(proxy) = world.get_resource::<EventLoopProxyWrapper>() {
        let proxy = (**proxy).clone();
        // it fails only when the lab has ended
        wake_by(move || _ = proxy.send_event(WinitUserEvent::WakeUp));
    }
    let ui = &mut world.resource_mut::<Interface>().into_inner().0;
    ui.screen.embedded = embedded;
    ui.settings = settings;
    show_address(world, link, RunBefore::Books);
}

/// Number of frames, a second apart, after which a paused lab that nobody touches sleeps for good.
const FRAMES_TO_REST: u32 = 4;

/// The longest sleep. What the reader or the page does ends it.
const REST: Duration = Duration::from_secs(3600);

/// Lets a paused lab sleep once nothing has happened in some frames. A frame a second would keep the processor busy
/// where it draws.
fn rest(
    mut settings: ResMut<WinitSettings>,
    mut touched: ResMut<Touched>,
    mut resized: MessageReader<WindowResized>,
    mut frames: Local<u32>,
) {
    let is_resized = resized.read().count() > 0;
    if is_resized {
        // this frame was laid out for the size before
        wake();
    }
    let is_touched = std::mem::take(&mut touched.0) || is_resized;
    let UpdateMode::Reactive { wait, .. } = &mut settings.focused_mode else {
        *frames = 0;
        return;
    };
    *frames = if is_touched { 0 } else { frames.saturating_add(1) };
    if *frames >= FRAMES_TO_REST {
        *wait = REST;
        settings.unfocused_mode = settings.focused_mode;
    }
}

/// Lets no time pass while the page is hidden, and skips the time that passed meanwhile.
fn stand_still(mut time: ResMut<Time<Virtual>>) {
    let frames = STILL.get();
    if frames > 0 {
        time.set_max_delta(Duration::from_nanos(1));
    }
    if frames != AWAY {
        STILL.set(frames.saturating_sub(1));
    }
}
