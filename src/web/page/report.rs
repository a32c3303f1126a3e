//! The report: the state of the lab, sent to the page.

use std::collections::BTreeSet;

use bevy::prelude::*;
use bevy_egui::{EguiContext, EguiOutput, egui};
use serde_json::{Value, json};

use super::listener::tell;
use crate::web::mirror::mirror;
use crate::web::query_value::query_value;
use crate::window::for_page::{Interface, ShownDashboard};
use crate::window::ui::{AskedTwin, AtlasState, LessonState, PlanState, Settings, ShownChance};
use motion_lab_core::configuration::Configuration;
use motion_lab_core::picture::{Role, Theme};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::manifest::{ThemeChoice, Widget};
use motion_lab_sim::recording::RunParts;
use motion_lab_sim::run::Recipe;
use motion_lab_sim::simulation::{Playback, Transport, recipe};

/// The last values sent to the page.
#[derive(Resource, Default)]
pub struct Sent {
    frames: u64,
    state: Value,
    settings: Option<Settings>,
    tree: Value,
    lesson: Value,
    run: Option<Recipe>,
    /// Time of the last report, seconds since the start.
    at: f64,
}

impl Sent {
    /// Lets the state and the lesson be told once more.
    pub fn forget(&mut self) {
        (self.state, self.lesson) = (Value::Null, Value::Null);
    }
}

/// The paper that a link chose for this visit.
#[derive(Resource)]
pub struct LinkedTheme {
    /// The link's choice.
    pub theme: ThemeChoice,
    /// The reader's own, which the page keeps.
    pub own: ThemeChoice,
}

/// The settings that the page keeps. A link's paper is not among them until the reader chooses another.
fn saved_settings(world: &mut World) -> Settings {
    let mut settings = world.resource::<Interface>().0.settings.clone();
    match world.get_resource::<LinkedTheme>() {
        Some(linked) if linked.theme == settings.theme => settings.theme = linked.own,
        _ => _ = world.remove_resource::<LinkedTheme>(),
    }
    settings
}

/// Sends the page what has changed: at most ten times a second while the run plays, in every frame while it is paused.
pub fn report(world: &mut World) {
    copied(world);
    let now = world.resource::<Time<Real>>().elapsed_secs_f64();
    let mut sent = world.remove_resource::<Sent>().unwrap_or_default();
    sent.frames += 1;
    if sent.frames == 1 {
        let mut contexts = world.query::<&mut EguiContext>();
        for mut context in contexts.iter_mut(world) {
            context.get_mut().enable_accesskit();
        }
    }
    if sent.frames == 2 {
        tell(&json!({ "kind": "ready" }));
    }
    let still = world.resource::<Transport>().playback == Playback::Paused;
    if sent.frames > 2 && (still || now - sent.at >= 0.1) {
        sent.at = now;
        let state = state(world);
        if state != sent.state {
            tell(&state);
            sent.state = state;
        }
        let lesson = lesson(world);
        if lesson != sent.lesson {
            tell(&lesson);
            sent.lesson = lesson;
        }
        let settings = saved_settings(world);
        if sent.settings.as_ref() != Some(&settings) {
            tell(&json!({ "kind": "settings", "settings": settings }));
            sent.settings = Some(settings);
        }
        if let Some(tree) = tree(world)
            && tree != sent.tree
        {
            tell(&tree);
            sent.tree = tree;
        }
        let present = recipe(world);
        // a new tick alone is not sent: the page knows it from the state
        if let Some(present) = present.filter(|present| sent.run.as_ref() != Some(present)) {
            tell(&json!({ "kind": "run", "parts": RunParts { ticks: 0, ..RunParts::of(&present) } }));
            sent.run = Some(present);
        }
    }
    world.insert_resource(sent);
}

/// Sends the page the text that was copied: only a page may write to the clipboard.
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

/// The state that the page shows by its own means.
fn state(world: &World) -> Value {
    let shown = &world.resource::<ShownDashboard>().0;
    let ui = &world.resource::<Interface>().0;
    let robots = shown.cockpits.iter().flat_map(|c| &c.robots).map(|r| {
        let coordinates: &[f64] = &r.coordinates;
        json!({
            "name": r.name, "configuration": r.readout, "coordinates": coordinates, "trailer": r.trailer,
            "contacts": r.contacts, "touching": r.flash, "driven": r.manual,
        })
    });
    let doors = shown.cockpits.iter().map(|c| c.atlas.world()).flat_map(|world| {
        world.doors.iter().map(|door| json!({ "world": world.name, "name": door.name, "open": door.open }))
    });
    let query = &ui.anatomy.anatomy;
    let is_asked = matches!(ui.widget, Widget::Anatomy | Widget::Cspace);
    let kinds = shown.cockpits.iter().flat_map(|c| &c.robots).filter_map(|r| Some((r.about?, r.coordinates.len())));
    let formulas: BTreeSet<String> = match ui.widget {
        Widget::Anatomy => BTreeSet::from([query.tab.name().to_owned()]),
        Widget::Dashboard => kinds.map(|(about, coordinates)| format!("{}.{coordinates}", about.name)).collect(),
        Widget::Cspace if matches!(query.checker().robot(), AnyRobot::Reach(_)) => {
            BTreeSet::from(["annulus".to_owned()])
        }
        Widget::Cspace | Widget::Atlas | Widget::Plan => BTreeSet::new(),
    };
    json!({
        "kind": "state",
        "tick": shown.tick,
        "frontier": shown.frontier,
        "seed": shown.seed.to_string(),
        "playing": shown.playing,
        "widget": ui.widget.id(),
        "theme": if ui.theme() == Theme::Dark { "dark" } else { "light" },
        "lit": ui.pointer.lit.map(Role::name),
        "formulas": formulas,
        "armed": ui.hand.armed,
        "covered": ui.is_covered(),
        "blocked": ui.twin.as_ref().and_then(AskedTwin::blocked),
        "notice": ui.notice().map(|n| json!({ "text": n.text, "error": n.is_error })),
        "robots": robots.collect::<Vec<_>>(),
        "doors": doors.collect::<Vec<_>>(),
        "query": is_asked.then(|| query_value(query)),
        "why": ui.chance.as_ref().map(why),
        "plan": (ui.widget == Widget::Plan).then(|| plan(&ui.plan)),
        "atlas": (ui.widget == Widget::Atlas).then(|| atlas(&ui.atlas)),
    })
}

/// What is known of the contact that was asked about.
fn why(chance: &ShownChance) -> Value {
    let name = chance.config.robot_names().nth(chance.robot as usize);
    json!({
        "robot": name, "contact": chance.contact, "text": chance.text,
        "last_chance": chance.way_out.as_ref().map(|way_out| way_out.tick),
    })
}

/// What came of a plan.
fn plan(plan: &PlanState) -> Value {
    let task = plan.task();
    let (stage, why) = match plan.stage() {
        crate::window::ui::plan::PlanStage::Growing => ("growing", None),
        crate::window::ui::plan::PlanStage::Solved => ("solved", None),
        crate::window::ui::plan::PlanStage::Ended(reason) => ("ended", Some(reason.to_string())),
        crate::window::ui::plan::PlanStage::Read(_, judged) => {
            ("read", judged.as_ref().and_then(|judged| judged.proof.as_ref().err()).map(ToString::to_string))
        }
    };
    let clearance = match plan.stage() {
        crate::window::ui::plan::PlanStage::Read(_, judged) => {
            judged.as_ref().and_then(|judged| judged.proof.as_ref().ok().copied())
        }
        _ => plan.lengths().map(|lengths| lengths.clearance),
    };
    json!({
        "planner": plan.planner().id(), "robot": task.name, "world": task.world.name,
        "start": &task.start.coordinates()[..], "goal": &task.goal.coordinates()[..], "seed": plan.seed().to_string(),
        "stage": stage, "why": why, "iterations": plan.effort().iterations,
        "length": plan.lengths().map(|l| l.length), "clearance": clearance,
    })
}

/// What came of what was done in the atlas.
fn atlas(atlas: &AtlasState) -> Value {
    let robots = atlas.atlas().robots().iter();
    json!({
        "world": atlas.world().name, "selected": atlas.selected, "refused": atlas.refusal().or(atlas.message.clone()),
        "robots": robots.map(|r| json!({ "name": r.name, "coordinates": &r.q.coordinates()[..] })).collect::<Vec<_>>(),
    })
}

/// The lesson under way and what came of it; nothing before there was one.
fn lesson(world: &World) -> Value {
    let under_way = world.resource::<Interface>().0.lesson.as_ref();
    let described = |under_way: &LessonState| {
        let LessonState { lesson, took, .. } = under_way;
        json!({ "kind": "lesson", "id": lesson.id(), "done": took.is_some(), "seconds": took })
    };
    under_way.map_or_else(|| json!({ "kind": "lesson", "id": null }), described)
}

/// The widgets of the canvas; `None` where egui has nothing new of them.
fn tree(world: &mut World) -> Option<Value> {
    let mut outputs = world.query::<&EguiOutput>();
    let output = outputs.iter(world).find_map(|o| o.platform_output.accesskit_update.as_ref())?;
    Some(json!({ "kind": "tree", "widgets": mirror(output) }))
}
