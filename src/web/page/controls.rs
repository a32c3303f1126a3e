//! Carries out what the page asks of the lab.

use std::collections::VecDeque;

use bevy::prelude::*;
use bevy_egui::egui::accesskit::{self, ActionData, ActionRequest, NodeId, TreeId};
use bevy_egui::{EguiInput, egui};
use serde_json::{Value, json};

use super::super::message::{Input, Message, PageRequest, WidgetAction};
use super::downloads::picture;
use super::error::PageError;
use super::inbox::{Incoming, take_all, wake};
use super::listener::tell;
use super::report::Sent;
use super::run_link::{RunBefore, link_of, show_address};
use crate::web::link::{Link, MAX_LINK_TICK};
use crate::window::for_page::{
    Interface, explain, open_log, open_path_text, open_world_text, play_way_out, seek_in_background, stop_background,
};
use crate::window::ui::{Notice, SessionCommand, UiState};
use motion_lab_core::configuration::Configuration as _;
use motion_lab_core::picture::{Role, Theme};
use motion_lab_core::random::Seed;
use motion_lab_core::robots::CHANNEL_UNITS;
use motion_lab_sim::anatomy::Tab;
use motion_lab_sim::manifest::{Lesson, ThemeChoice, Widget};
use motion_lab_sim::run::{Event, Script, WorldChange, WorldEvent};
use motion_lab_sim::simulation::{
    RobotCommand, RobotKinds, RunCommand, RunConfig, Transport, TransportCommand, WorldCommand,
};

/// Events for egui, a list for each frame to come: a field must have the focus before it takes letters.
#[derive(Resource, Default)]
pub struct Staged(VecDeque<Vec<egui::Event>>);

/// Whether something was asked of the lab or done with it in this frame.
#[derive(Resource, Default)]
pub struct Touched(pub bool);

/// Largest number of frames that events are kept for: what comes then is refused.
const MAX_STAGED: usize = 1000;

/// Width of the sheet of a figure that the page asks for, pixels.
const FIGURE_WIDTH: u32 = 1280;

/// Most dots for each pixel of the sheet.
const MAX_DOTS: u32 = 3;

/// Carries out the messages and opens the files that have come in, and gives egui the events of this frame.
pub fn receive(world: &mut World) {
    let all = take_all();
    let mut is_touched = !all.is_empty();
    for incoming in all {
        match incoming {
            Incoming::File { name, bytes } => {
                if let Some(notice) = open(world, &name, &bytes) {
                    world.resource_mut::<Interface>().0.say(notice);
                }
            }
            Incoming::Message(asked) => answer(world, asked),
            Incoming::Fail => panic!("the page asked the lab to fail"),
        }
    }
    let events = world.resource_mut::<Staged>().0.pop_front().unwrap_or_default();
    let mut inputs = world.query::<&mut EguiInput>();
    for mut input in inputs.iter_mut(world) {
        // while a control of the page has the focus, the canvas has not, and egui would let its fields rest
        input.focused = true;
        input.events.extend(events.iter().cloned());
        is_touched |= input.events.iter().any(|event| !matches!(event, egui::Event::ModifiersChanged(_)));
    }
    world.resource_mut::<Touched>().0 |= is_touched;
    if !world.resource::<Staged>().0.is_empty() {
        wake();
    }
}

/// Carries out a request and tells what came of it: a link or a figure; that it is done, where it bears a mark; or why
/// not.
fn answer(world: &mut World, PageRequest { message, request, around }: PageRequest) {
    match take(world, message) {
        Ok(None) if request.is_none() => {}
        Ok(said) => {
            let mut said = said.unwrap_or_else(|| json!({ "kind": "done" }));
            said["request"] = json!(request);
            tell(&said);
        }
        Err(error) => {
            let text = error.to_string();
            tell(&json!({ "kind": "error", "text": text, "request": request }));
            if !around {
                world.resource_mut::<Interface>().0.say(Notice { text, is_error: true });
            }
        }
    }
}

/// Returns what came of it; nothing yet where it takes long and goes on in the background.
fn open(world: &mut World, name: &str, bytes: &[u8]) -> Option<Notice> {
    let refused = |error: String| Notice { text: format!("{name}: not opened: {error}"), is_error: true };
    if name.ends_with(".ron") {
        return Some(match std::str::from_utf8(bytes) {
            Ok(text) => open_world_text(world, name, text),
            Err(_) => refused("it is not text".into()),
        });
    }
    if name.ends_with(".json") {
        return Some(match std::str::from_utf8(bytes) {
            Ok(text) => open_path_text(world, name, text),
            Err(_) => refused("it is not text".into()),
        });
    }
    open_log(world, name, bytes).unwrap_or_else(|error| Some(refused(error.to_string())))
}

/// Carries out a message, and returns its answer where it has one.
fn take(world: &mut World, message: Message) -> Result<Option<Value>, PageError> {
    let transport = |world: &mut World, command: TransportCommand| {
        if !seek_in_background(world, &command) {
            // what else is asked of the run ends the work under way
            stop_background(world);
            world.write_message(RunCommand::from(command));
        }
        Ok(None)
    };
    let ui = |world: &mut World, change: &dyn Fn(&mut UiState)| {
        change(&mut world.resource_mut::<Interface>().into_inner().0);
        Ok(None)
    };
    if world.resource::<Staged>().0.len() >= MAX_STAGED
        && matches!(message, Message::Act { .. } | Message::Key { .. } | Message::Paste { .. })
    {
        return Err(PageError::Busy);
    }
    match message {
        Message::Act { id, action, value } => act(world, &id, action, value).map(|()| None),
        Message::Key { key, pressed, shift } => {
            let name = if key == " " { "Space" } else { &key };
            let key = egui::Key::from_name(name).ok_or_else(|| PageError::Key(name.to_owned()))?;
            let modifiers = if shift { egui::Modifiers::SHIFT } else { egui::Modifiers::NONE };
            let event = egui::Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
            world.resource_mut::<Staged>().0.push_back(vec![event]);
            Ok(None)
        }
        Message::Paste { text } => {
            world.resource_mut::<Staged>().0.push_back(vec![egui::Event::Paste(text)]);
            Ok(None)
        }
        Message::Light { role } => {
            let named = |name: &str| {
                let found = Role::ALL.into_iter().find(|r| r.name() == name);
                found.ok_or_else(|| PageError::Role(name.to_owned()))
            };
            let role = role.as_deref().map(named).transpose()?;
            ui(world, &|ui| ui.pointer.page_lit = role.map(|role| (ui.widget, role)))
        }
        Message::NotCopied => ui(world, &|ui| {
            let text = "not copied: the browser does not let the page copy".to_owned();
            ui.say(Notice { text, is_error: true });
        }),
        Message::Open { query } => {
            let address = Link::read(&query);
            // who asks hears what is wrong; half of an address would be another one
            address.run.clone().and(address.view.clone())?;
            stop_background(world);
            show_address(world, address, RunBefore::Other);
            Ok(None)
        }
        Message::Play => transport(world, TransportCommand::Play),
        Message::Pause => transport(world, TransportCommand::Pause),
        Message::Step => transport(world, TransportCommand::Step),
        Message::StepBack => transport(world, TransportCommand::StepBack),
        Message::Seek { tick } if tick > MAX_LINK_TICK => Err(PageError::Tick(tick)),
        Message::Seek { tick } => transport(world, TransportCommand::Seek(tick)),
        Message::Why => {
            explain(world);
            Ok(None)
        }
        Message::WayOut => {
            play_way_out(world);
            Ok(None)
        }
        Message::Reset => transport(world, TransportCommand::Reset),
        Message::Reroll => transport(world, TransportCommand::ReRoll),
        Message::Seed { seed } => {
            let seed = seed.parse().map_err(|_| PageError::Seed(seed))?;
            transport(world, TransportCommand::SetSeed(Seed(seed)))
        }
        Message::Widget { id } => {
            let widget = Widget::of(&id).ok_or(PageError::Widget(id))?;
            if widget != Widget::Dashboard {
                transport(world, TransportCommand::Pause)?;
            }
            ui(world, &|ui| ui.widget = widget)
        }
        Message::Lesson { id } => {
            let named = |id: String| Lesson::of(&id).ok_or(PageError::Lesson(id));
            let lesson = id.map(named).transpose()?;
            ui(world, &|ui| match lesson {
                Some(lesson) => ui.begin(lesson),
                None => ui.lesson = None,
            })
        }
        Message::Tab { id } => {
            let tab = Tab::ALL.into_iter().find(|tab| tab.name() == id).ok_or(PageError::Tab(id))?;
            ui(world, &|ui| ui.anatomy.anatomy.tab = tab)
        }
        Message::Configuration { coordinates } => {
            let ui = &mut world.resource_mut::<Interface>().into_inner().0;
            let anatomy = &mut ui.anatomy.anatomy;
            let known = anatomy.q().with_coordinates(&coordinates);
            let count = anatomy.q().coordinates().len();
            let q = known.ok_or_else(|| PageError::Configuration(format!("it has {count} coordinates")))?;
            anatomy.set_q(q).map_err(|error| PageError::Configuration(error.to_string()))?;
            // a lesson that the next frame begins would put it elsewhere
            ui.lesson.iter_mut().filter(|lesson| !lesson.is_ready).for_each(|lesson| lesson.start = Some(q));
            Ok(None)
        }
        Message::Robot { robot, input } => give(world, robot, input).map(|()| None),
        Message::Door { world: of, name, open } => {
            let change = if open { WorldChange::Open } else { WorldChange::Close }(name);
            let tick = world.resource::<Transport>().tick() + 1;
            let event = WorldEvent { tick, world: of.clone(), change: change.clone() };
            check(world, Script::new(vec![], vec![event]))?;
            transport(world, TransportCommand::Checkpoint)?;
            world.write_message(RunCommand::from(WorldCommand { world: of, change }));
            Ok(None)
        }
        Message::Stick { channels: (ahead, left) } => {
            let most = CHANNEL_UNITS as i16;
            ui(world, &|ui| ui.hand.stick = (ahead.clamp(-most, most), left.clamp(-most, most)))
        }
        Message::Figure { png } => {
            let svg = picture(world, FIGURE_WIDTH)?;
            let dots = png.map(|dots| dots.clamp(1, MAX_DOTS));
            Ok(Some(json!({ "kind": "figure", "svg": svg, "png": dots })))
        }
        Message::Theme { name } => {
            let choice = ThemeChoice::ALL.into_iter().find(|t| t.name().eq_ignore_ascii_case(&name));
            let choice = choice.ok_or(PageError::Theme(name))?;
            ui(world, &|ui| ui.settings.theme = choice)
        }
        Message::System { dark, reduced_motion, touch } => ui(world, &|ui| {
            ui.screen.system_theme = if dark { Theme::Dark } else { Theme::Light };
            ui.screen.system_reduced_motion = reduced_motion;
            ui.pointer.is_touched |= touch;
        }),
        Message::State => {
            world.resource_mut::<Sent>().forget();
            Ok(None)
        }
        Message::Link => {
            let said = link_of(world).and_then(|l| Ok((l.query()?, l.digest)));
            Ok(Some(match said {
                Ok((query, digest)) => json!({ "kind": "link", "query": query, "digest": digest }),
                Err(error) => json!({ "kind": "link", "error": error.to_string() }),
            }))
        }
        Message::Save => {
            world.write_message(SessionCommand::Save);
            Ok(None)
        }
        Message::Visible { .. } => Ok(None),
    }
}

/// Gives a robot of the run an input that its kind takes.
fn give(world: &mut World, robot: String, input: Input) -> Result<(), PageError> {
    let input = input.robot_input().ok_or_else(|| PageError::Coordinate(robot.clone()))?;
    let event = Event { tick: world.resource::<Transport>().tick() + 1, robot: robot.clone(), input: input.clone() };
    check(world, Script::new(vec![event], vec![]))?;
    world.write_message(RunCommand::from(RobotCommand { robot, input }));
    Ok(())
}

/// Refuses what the run can't take.
fn check(world: &World, script: Script) -> Result<(), PageError> {
    let kinds = world.resource::<RobotKinds>().known();
    Ok(script.check_for_kinds(world.resource::<RunConfig>().config(), &kinds)?)
}

/// Acts on a widget by AccessKit's requests, as assistive technology does.
fn act(world: &mut World, id: &str, action: WidgetAction, value: Option<String>) -> Result<(), PageError> {
    let target_node = NodeId::from(id.parse::<u64>().map_err(|_| PageError::Control(id.to_owned()))?);
    let request = |action, data| {
        egui::Event::AccessKitActionRequest(ActionRequest { action, target_tree: TreeId::ROOT, target_node, data })
    };
    let staged = &mut world.resource_mut::<Staged>().0;
    match (action, value) {
        (WidgetAction::Click, _) => staged.push_back(vec![request(accesskit::Action::Click, None)]),
        (WidgetAction::Focus, _) => staged.push_back(vec![request(accesskit::Action::Focus, None)]),
        (WidgetAction::Set, Some(value)) => match value.parse::<f64>().ok().filter(|v| v.is_finite()) {
            Some(number) => {
                let data = Some(ActionData::NumericValue(number));
                staged.push_back(vec![request(accesskit::Action::SetValue, data)]);
            }
            None => return Err(PageError::Number(value)),
        },
        (WidgetAction::Type, Some(value)) => {
            let key =
                |key, modifiers| egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
            staged.push_back(vec![request(accesskit::Action::Focus, None)]);
            staged.push_back(vec![key(egui::Key::A, egui::Modifiers::COMMAND), egui::Event::Text(value)]);
            staged.push_back(vec![key(egui::Key::Enter, egui::Modifiers::NONE)]);
        }
        (WidgetAction::Set | WidgetAction::Type, None) => return Err(PageError::NoValue),
    }
    Ok(())
}
