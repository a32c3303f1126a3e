//! The lab in a page: started with a link, told of messages, and telling a listener what happens.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::time::Duration;

use bevy::prelude::*;
use bevy::time::TimeSystems;
use bevy::winit::{EventLoopProxyWrapper, WinitUserEvent};
use bevy_egui::egui::accesskit::{self, ActionData, ActionRequest, NodeId, TreeId};
use bevy_egui::{EguiContext, EguiInput, EguiOutput, EguiPreUpdateSet, egui};
use serde_json::{Value, json};
use wasm_bindgen::prelude::*;

use super::message::{Action, Message};
use super::mirror::mirror;
use super::{Link, LinkError, runs::RunParts};
use crate::app::{Interface, Shown, captured, new_run, open_log, open_world_text, recorded, shown_run, windowed_app};
use crate::capture::{Form, Paper};
use crate::picture::Role;
use crate::random::Seed;
use crate::run::Log;
use crate::simulation::{PendingInput, Playback, RunConfig, Transport, TransportCommand, obey};
use crate::ui::{CaptureOrder, Notice, SessionCommand, Settings, ThemeChoice, number_of, widgets};

/// What comes in from the page.
enum Incoming {
    Message(Message),
    File { name: String, bytes: Vec<u8> },
}

/// For so many frames to come no time passes; all, while the page is not seen.
const AWAY: u32 = u32::MAX;

/// The most that a frame lets pass, as Bevy has it.
const MOST: Duration = Duration::from_millis(250);

thread_local! {
    static INBOX: RefCell<Vec<Incoming>> = const { RefCell::new(Vec::new()) };
    static LISTENER: RefCell<Option<js_sys::Function>> = const { RefCell::new(None) };
    static WAKER: RefCell<Option<Box<dyn Fn()>>> = const { RefCell::new(None) };
    static STILL: Cell<u32> = const { Cell::new(0) };
}

/// Starts the lab on the canvas with the id `lab`, as the query of an address says, and tells `listener` what happens: it is called
/// with JSON, and with bytes where a file goes with it. `embedded` shows one widget without the rail; `settings` are those that the page
/// was told to keep, or nothing.
///
/// A query that is refused starts the book's run, and the lab says why.
#[wasm_bindgen]
pub fn lab_start(query: &str, embedded: bool, settings: &str, listener: js_sys::Function) {
    let link = Link::parse(query);
    LISTENER.set(Some(listener));
    let mut app = windowed_app();
    // Bevy has set its own by now
    let speak = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        tell(&json!({ "kind": "failed", "text": info.to_string() }));
        speak(info);
    }));
    let before = receive.after(EguiPreUpdateSet::ProcessInput).before(EguiPreUpdateSet::BeginPass);
    // of another version's settings the usual ones are better than none
    let settings = serde_json::from_str(settings).unwrap_or_default();
    app.insert_resource(Start { link, embedded, settings })
        .init_resource::<Told>()
        .init_resource::<Staged>()
        .add_systems(PostStartup, start)
        .add_systems(First, stand_still.before(TimeSystems))
        .add_systems(PreUpdate, before)
        .add_systems(Update, files)
        .add_systems(Last, report)
        .run();
}

/// Tells the lab something: JSON of a [`Message`].
///
/// # Errors
/// The reason, when it is no message.
#[wasm_bindgen]
pub fn lab_send(message: &str) -> Result<(), JsError> {
    let message: Message = serde_json::from_str(message).map_err(|e| JsError::new(&e.to_string()))?;
    match message {
        // no frame may come until the page is seen again
        Message::Visible { visible } => STILL.set(if visible { 2 } else { AWAY }),
        message => put(Incoming::Message(message)),
    }
    Ok(())
}

/// Opens a file: a run's log, or a world when its name ends in `.ron`. What came of it is said in the lab.
#[wasm_bindgen]
pub fn lab_open(name: &str, bytes: Vec<u8>) {
    put(Incoming::File { name: name.to_owned(), bytes });
}

fn put(incoming: Incoming) {
    INBOX.with_borrow_mut(|inbox| inbox.push(incoming));
    wake();
}

/// Asks for another frame: a paused lab sleeps.
fn wake() {
    WAKER.with_borrow(|waker| waker.iter().for_each(|wake| wake()));
}

fn tell(message: &Value) {
    tell_with(message, None);
}

fn tell_with(message: &Value, bytes: Option<&[u8]>) {
    let Some(listener) = LISTENER.with_borrow(Clone::clone) else { return };
    let bytes = bytes.map_or(JsValue::UNDEFINED, |b| js_sys::Uint8Array::from(b).into());
    // a listener that throws is the page's fault and must not stop the lab
    let _ = listener.call2(&JsValue::NULL, &JsValue::from_str(&message.to_string()), &bytes);
}

#[derive(Resource)]
struct Start {
    link: Result<Link, LinkError>,
    embedded: bool,
    settings: Settings,
}

/// Events of egui that wait for their frame: a field must have the focus before it takes letters.
#[derive(Resource, Default)]
struct Staged(VecDeque<Vec<egui::Event>>);

/// What the listener was told last.
#[derive(Resource, Default)]
struct Told {
    frames: u64,
    state: Value,
    settings: Option<Settings>,
    tree: Value,
    /// Which run: its configuration's address, its seed, how many events.
    run: Option<(usize, Seed, usize)>,
    /// When the last of these was told, seconds since the start.
    at: f64,
}

fn start(world: &mut World) {
    let Some(Start { link, embedded, settings }) = world.remove_resource() else { return };
    let (link, refused) = match link {
        Ok(link) => (link, None),
        Err(error) => (Link::default(), Some(Notice { text: format!("the link: {error}"), is_error: true })),
    };
    if let Some(proxy) = world.get_resource::<EventLoopProxyWrapper>() {
        let proxy = (**proxy).clone();
        // it fails only when the lab has ended
        WAKER.set(Some(Box::new(move || _ = proxy.send_event(WinitUserEvent::WakeUp))));
    }
    {
        let ui = &mut world.resource_mut::<Interface>().into_inner().0;
        ui.embedded = embedded;
        ui.settings = settings;
        ui.widget = link.widget.as_deref().and_then(number_of).unwrap_or(0);
        ui.settings.theme = link.theme.unwrap_or(ui.settings.theme);
    }
    // an address without a run plays the book's
    if link != (Link { widget: link.widget.clone(), theme: link.theme, ..Link::default() }) {
        let notice = match open_link(world, &link) {
            Ok(notice) => notice,
            Err(text) => Some(Notice { text, is_error: true }),
        };
        world.resource_mut::<Interface>().0.notice = notice;
    }
    if refused.is_some() {
        world.resource_mut::<Interface>().0.notice = refused;
    }
    if world.resource::<Interface>().0.widget != 0 {
        world.resource_mut::<Transport>().playback = Playback::Paused;
    }
}

/// Runs a link's run up to its tick and compares the digest that came with it.
fn open_link(world: &mut World, link: &Link) -> Result<Option<Notice>, String> {
    new_run(world, link.config(), link.seed)?;
    if !link.script.events.is_empty() {
        crate::simulation::start_run(world, link.config(), (link.seed, link.script.clone()))
            .map_err(|e| e.to_string())?;
    }
    world.resource_mut::<Transport>().playback = if link.tick == 0 { Playback::Playing } else { Playback::Paused };
    obey(world, TransportCommand::Seek(link.tick))?;
    if link.tick == 0 {
        return Ok(None);
    }
    let digest = recorded(world)?.0.digest().to_string();
    Ok(Some(match &link.digest {
        None => Notice { text: format!("tick {}, digest {digest}", link.tick), is_error: false },
        Some(told) if *told == digest => Notice {
            text: format!("the same run to the last bit: tick {}, digest {digest}", link.tick),
            is_error: false,
        },
        Some(told) => {
            Notice { text: format!("another run than the link's: digest {digest}, not {told}"), is_error: true }
        }
    }))
}

/// Lets no time pass while the page is not seen, and none of that which passed meanwhile.
fn stand_still(mut time: ResMut<Time<Virtual>>) {
    let frames = STILL.get();
    time.set_max_delta(if frames > 0 { Duration::from_nanos(1) } else { MOST });
    if frames != AWAY {
        STILL.set(frames.saturating_sub(1));
    }
}

/// Does what has come in.
fn receive(world: &mut World) {
    for incoming in INBOX.take() {
        let done = match incoming {
            Incoming::File { name, bytes } => {
                let notice = open(world, &name, &bytes);
                world.resource_mut::<Interface>().0.notice = Some(notice);
                Ok(())
            }
            Incoming::Message(message) => take(world, message),
        };
        if let Err(text) = done {
            world.resource_mut::<Interface>().0.notice = Some(Notice { text, is_error: true });
        }
    }
    let events = world.resource_mut::<Staged>().0.pop_front().unwrap_or_default();
    let mut inputs = world.query::<&mut EguiInput>();
    for mut input in inputs.iter_mut(world) {
        // while a twin in the page has the focus, the canvas does not; egui would let its fields rest
        input.focused = true;
        input.events.extend(events.iter().cloned());
    }
    if !world.resource::<Staged>().0.is_empty() {
        wake();
    }
}

fn open(world: &mut World, name: &str, bytes: &[u8]) -> Notice {
    let refused = |error: String| Notice { text: format!("{name}: not opened: {error}"), is_error: true };
    if name.ends_with(".ron") {
        return match std::str::from_utf8(bytes) {
            Ok(text) => open_world_text(world, name, text),
            Err(_) => refused("it is not text".into()),
        };
    }
    open_log(world, name, bytes).unwrap_or_else(refused)
}

fn take(world: &mut World, message: Message) -> Result<(), String> {
    let transport = |world: &mut World, command| obey(world, command).map(|_| ());
    let ui = |world: &mut World, change: &dyn Fn(&mut crate::ui::UiState)| {
        change(&mut world.resource_mut::<Interface>().into_inner().0);
        Ok(())
    };
    match message {
        Message::Act { id, action, value } => act(world, &id, action, value),
        Message::Key { key, pressed, shift } => {
            let name = if key == " " { "Space" } else { &key };
            let key = egui::Key::from_name(name).ok_or_else(|| format!("{name} is no key"))?;
            let modifiers = if shift { egui::Modifiers::SHIFT } else { egui::Modifiers::NONE };
            let event = egui::Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
            world.resource_mut::<Staged>().0.push_back(vec![event]);
            Ok(())
        }
        Message::Paste { text } => {
            world.resource_mut::<Staged>().0.push_back(vec![egui::Event::Paste(text)]);
            Ok(())
        }
        Message::Light { role } => {
            let role = role.and_then(|name| Role::ALL.into_iter().find(|r| r.name() == name));
            ui(world, &|ui| ui.page_lit = role)
        }
        Message::Play => transport(world, TransportCommand::Play),
        Message::Pause => transport(world, TransportCommand::Pause),
        Message::Step => transport(world, TransportCommand::Step),
        Message::StepBack => transport(world, TransportCommand::StepBack),
        Message::Seek { tick } => transport(world, TransportCommand::Seek(tick)),
        Message::Reset => transport(world, TransportCommand::Reset),
        Message::Reroll => transport(world, TransportCommand::ReRoll),
        Message::Seed { seed } => {
            let seed = seed.parse().map_err(|_| format!("{seed}: not a seed"))?;
            transport(world, TransportCommand::SetSeed(Seed(seed)))
        }
        Message::Widget { id } => {
            let number = number_of(&id).ok_or_else(|| format!("{id} is no widget"))?;
            if number != 0 {
                transport(world, TransportCommand::Pause)?;
            }
            ui(world, &|ui| ui.widget = number)
        }
        Message::Theme { name } => {
            let choice = ThemeChoice::ALL.into_iter().find(|t| t.name().eq_ignore_ascii_case(&name));
            let choice = choice.ok_or_else(|| format!("{name} is no theme"))?;
            ui(world, &|ui| ui.settings.theme = choice)
        }
        Message::System { dark, reduced_motion } => ui(world, &|ui| {
            ui.system_theme = if dark { crate::ui::Theme::Dark } else { crate::ui::Theme::Light };
            ui.settings.reduced_motion |= reduced_motion;
        }),
        Message::Link => {
            let said = link(world).and_then(|l| l.query().map_err(|e| e.to_string()).map(|q| (q, l.digest)));
            tell(&match said {
                Ok((query, digest)) => json!({ "kind": "link", "query": query, "digest": digest }),
                Err(error) => json!({ "kind": "link", "error": error }),
            });
            Ok(())
        }
        Message::Save => {
            world.write_message(SessionCommand::Save);
            Ok(())
        }
        Message::Visible { .. } => Ok(()),
        // it is asked for, to see what the page does then
        Message::Fail => panic!("a page asked the lab to fail"),
    }
}

/// The link of what is shown.
fn link(world: &World) -> Result<Link, String> {
    let Transport { seed, tick, .. } = *world.resource::<Transport>();
    let (config, script) = shown_run(world, tick);
    let mut link = Link::of(seed, &config, script.clone()).map_err(|e| e.to_string())?;
    if tick > 0 {
        let log = crate::recording::Run::record(config, (seed, script)).map_err(|e| e.to_string())?;
        link.digest = Some(log.digest().to_string());
    }
    let ui = &world.resource::<Interface>().0;
    link.widget = (ui.widget != 0).then(|| widgets().get(ui.widget).map(|w| w.id.clone())).flatten();
    link.theme = Some(ui.settings.theme).filter(|t| *t != ThemeChoice::System);
    Ok(link)
}

/// Does something with a widget, as assistive technology asks for it.
fn act(world: &mut World, id: &str, action: Action, value: Option<String>) -> Result<(), String> {
    let target_node = NodeId::from(id.parse::<u64>().map_err(|_| format!("{id} is no widget of the canvas"))?);
    let request = |action, data| {
        egui::Event::AccessKitActionRequest(ActionRequest { action, target_tree: TreeId::ROOT, target_node, data })
    };
    let staged = &mut world.resource_mut::<Staged>().0;
    match (action, value) {
        (Action::Click, _) => staged.push_back(vec![request(accesskit::Action::Click, None)]),
        (Action::Focus, _) => staged.push_back(vec![request(accesskit::Action::Focus, None)]),
        (Action::Set, Some(value)) => match value.parse::<f64>().ok().filter(|v| v.is_finite()) {
            Some(number) => {
                let data = Some(ActionData::NumericValue(number));
                staged.push_back(vec![request(accesskit::Action::SetValue, data)]);
            }
            None => return Err(format!("{value}: not a number")),
        },
        (Action::Type, Some(value)) => {
            let key =
                |key, modifiers| egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
            staged.push_back(vec![request(accesskit::Action::Focus, None)]);
            staged.push_back(vec![key(egui::Key::A, egui::Modifiers::COMMAND), egui::Event::Text(value)]);
            staged.push_back(vec![key(egui::Key::Enter, egui::Modifiers::NONE)]);
        }
        (Action::Set | Action::Type, None) => return Err("there is nothing to set it to".into()),
    }
    Ok(())
}

/// Gives the page what the lab would ask a dialog for.
fn files(world: &mut World) {
    let asked: Vec<SessionCommand> = world.resource_mut::<Messages<SessionCommand>>().drain().collect();
    for command in asked {
        let notice = match command {
            SessionCommand::Save => recorded(world).map(|(log, bytes)| {
                tell_with(&json!({ "kind": "file", "name": "run.mcap" }), Some(&bytes));
                saved(&log)
            }),
            SessionCommand::SaveWorld => {
                let atlas = &mut world.resource_mut::<Interface>().into_inner().0.atlas;
                tell_with(&json!({ "kind": "file", "name": "world.ron" }), Some(atlas.text().as_bytes()));
                atlas.mark_saved(std::path::Path::new("world.ron"));
                Ok("world.ron: saved".into())
            }
            SessionCommand::Open => {
                tell(&json!({ "kind": "ask", "accept": ".mcap" }));
                continue;
            }
            SessionCommand::OpenWorld => {
                tell(&json!({ "kind": "ask", "accept": ".ron" }));
                continue;
            }
            SessionCommand::Capture(order) => picture(world, &order),
            SessionCommand::RunWorld | SessionCommand::Links { .. } => continue,
        };
        let notice = match notice {
            Ok(text) => Notice { text, is_error: false },
            Err(error) => Notice { text: format!("not saved: {error}"), is_error: true },
        };
        world.resource_mut::<Interface>().0.notice = Some(notice);
    }
}

/// Gives the page a picture of the widget in front.
fn picture(world: &World, order: &CaptureOrder) -> Result<String, String> {
    let Transport { seed, tick, frontier, .. } = *world.resource::<Transport>();
    let (config, script) = shown_run(world, frontier);
    let ui = &world.resource::<Interface>().0;
    let paper = Paper { palette: ui.theme().palette(), width: order.width, scale: 1.0 };
    let figure = captured(ui, (config, seed, script), tick, paper.width_px()).map_err(|e| e.to_string())?;
    let name = format!("{}.svg", widgets().get(ui.widget).map_or("picture", |w| &w.id));
    tell_with(&json!({ "kind": "file", "name": name }), Some(figure.svg(&paper).as_bytes()));
    let also =
        if order.form == Form::Svg { "" } else { "; pixels and moving pictures are made by `motion-lab capture`" };
    Ok(format!("{name}: saved{also}"))
}

fn saved(log: &Log) -> String {
    format!("run.mcap: saved, {} ticks, digest {}", log.frames.len(), log.digest())
}

/// Tells the page how things stand, at most ten times a second.
fn report(world: &mut World) {
    copied(world);
    let now = world.resource::<Time<Real>>().elapsed_secs_f64();
    let mut told = world.remove_resource::<Told>().unwrap_or_default();
    told.frames += 1;
    if told.frames == 1 {
        let mut contexts = world.query::<&mut EguiContext>();
        for mut context in contexts.iter_mut(world) {
            context.get_mut().enable_accesskit();
        }
    }
    if told.frames == 2 {
        tell(&json!({ "kind": "ready" }));
    }
    let still = world.resource::<Transport>().playback == Playback::Paused;
    if told.frames > 2 && (still || now - told.at >= 0.1) {
        told.at = now;
        let state = state(world);
        if state != told.state {
            tell(&state);
            told.state = state;
        }
        let settings = &world.resource::<Interface>().0.settings;
        if told.settings.as_ref() != Some(settings) {
            tell(&json!({ "kind": "settings", "settings": settings }));
            told.settings = Some(settings.clone());
        }
        if let Some(tree) = tree(world)
            && tree != told.tree
        {
            tell(&tree);
            told.tree = tree;
        }
        let key = {
            let events = world.resource::<PendingInput>().script().events.len();
            let config = std::sync::Arc::as_ptr(&world.resource::<RunConfig>().0) as usize;
            Some((config, world.resource::<Transport>().seed, events))
        };
        if key != told.run {
            tell(&run(world));
            told.run = key;
        }
    }
    world.insert_resource(told);
}

/// Gives the page what was copied: only a page may write to the clipboard.
fn copied(world: &mut World) {
    let mut outputs = world.query::<&mut EguiOutput>();
    for mut output in outputs.iter_mut(world) {
        for command in output.bypass_change_detection().platform_output.commands.drain(..) {
            if let egui::OutputCommand::CopyText(text) = command {
                tell(&json!({ "kind": "copy", "text": text }));
            }
        }
    }
}

fn state(world: &World) -> Value {
    let shown = &world.resource::<Shown>().0;
    let ui = &world.resource::<Interface>().0;
    let robots = shown.cockpits.iter().flat_map(|c| &c.robots).map(|r| {
        json!({ "name": r.name, "configuration": r.readout, "contacts": r.contacts, "touching": r.flash, "driven": r.manual })
    });
    json!({
        "kind": "state",
        "tick": shown.tick,
        "frontier": shown.frontier,
        "seed": shown.seed.to_string(),
        "playing": shown.playing,
        "widget": widgets().get(ui.widget).map(|w| &w.id),
        "theme": if ui.theme() == crate::ui::Theme::Dark { "dark" } else { "light" },
        "lit": ui.lit.map(Role::name),
        "armed": ui.armed,
        "notice": ui.notice.as_ref().map(|n| json!({ "text": n.text, "error": n.is_error })),
        "robots": robots.collect::<Vec<_>>(),
    })
}

fn tree(world: &mut World) -> Option<Value> {
    let mut outputs = world.query::<&EguiOutput>();
    let output = outputs.iter(world).find_map(|o| o.platform_output.accesskit_update.as_ref())?;
    Some(json!({ "kind": "tree", "widgets": mirror(output) }))
}

/// The parts of the run, for a page that outlives the lab.
fn run(world: &World) -> Value {
    let Transport { seed, frontier, .. } = *world.resource::<Transport>();
    // a new tick is no news: the page knows it from the state
    let (config, script) = shown_run(world, frontier);
    let parts = RunParts {
        seed: seed.to_string(),
        worlds: config.worlds.iter().map(crate::worlds::World::to_ron).collect(),
        script: script.to_ron(),
        ticks: 0,
    };
    json!({ "kind": "run", "parts": parts })
}
