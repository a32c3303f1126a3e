//! World atlas: worlds with their names, robots put by a click, the derived grid, and the editor.

use bevy_egui::egui::{
    Align2, ComboBox, RichText, ScrollArea, Slider, Ui, UiBuilder, Vec2, WidgetInfo, WidgetType, vec2,
};

use super::chart;
use super::panel::edit_panel;
use super::state::{AtlasState, Mode};
use crate::window::ui::anatomy::in_front::PutInRun;
use crate::window::ui::keys::{AtlasAction, SessionAction, keep_arrows};
use crate::window::ui::number::{NumberInput, TypedKind};
use crate::window::ui::paint::button::LabButton;
use crate::window::ui::paint::plate::{PlateAnchor, plate, refusal};
use crate::window::ui::paint::sheet::{ScreenSheet, sheet, split};
use crate::window::ui::paint::touch::worded;
use crate::window::ui::{Command, Dashboard, FrameColours, SessionCommand, UiState};
use motion_lab_core::picture::{Picture, ScreenPoint, Thing, pick, readout};
use motion_lab_core::worlds::World;
use motion_lab_sim::atlas::Template;
use motion_lab_sim::manifest::{HintTask, Widget};

/// Width of the panel beside the paper, points.
const SIDE: f32 = 300.0;

/// Movement of the pointer on the screen beyond which a press is a drag, points.
const DRAGGED: f64 = 8.0;

/// Distance on the screen within which what is drawn or dragged snaps to a corner, points.
const SNAP: f64 = 10.0;

/// Shows the widget.
pub fn atlas_view(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let words = Widget::Atlas.text();
    if !look.low {
        crate::window::ui::menu::head(ui, words, model, look, state, commands);
    }
    let room = ui.available_rect_before_wrap();
    let still = state.atlas.still();
    let (paper, beside) = split(&still, room, look, SIDE);
    let (space, beside) = chart::split(ui, [paper, beside], look, &mut state.atlas);
    let fit = crate::window::ui::paint::canvas::fit(&still, paper);
    let mut moving = state.atlas.over();
    if state.settings.labels {
        moving.items.extend(state.atlas.labels(fit.px_per_metre()).iter().cloned());
    }
    let hover = ui.input(|i| i.pointer.latest_pos()).filter(|p| paper.contains(*p));
    let at = hover.map(|p| fit.world_from_screen([f64::from(p.x), f64::from(p.y)]));
    if at.is_some() && ui.input(|i| i.pointer.delta() != Vec2::ZERO) {
        state.atlas.probe = None;
    }
    moving.items.extend(state.atlas.probe_items(state.atlas.probe.or(at)));
    let placing = state.atlas.placing.filter(|_| state.atlas.mode == Mode::Edit);
    // Alt leaves out the snapping
    let reach = (!ui.input(|i| i.modifiers.alt)).then_some(SNAP / fit.px_per_metre());
    if placing.is_none() {
        state.atlas.drawn_from = None;
    }
    if let Some((template, at)) = placing.zip(at) {
        moving.items.extend(match state.atlas.drawn_from {
            Some(from) => state.atlas.drawn_items(template, [from, at], reach),
            None => state.atlas.added_items(template, at),
        });
    }
    let spoken = state.atlas.described();
    if ui.input(|i| i.pointer.any_pressed()) {
        // its reason has been read; what this press enters may be refused in turn
        state.atlas.message = None;
    }
    let on = sheet(ui, paper, spoken, &still, &moving, look);
    if on.response.is_pointer_button_down_on() || on.response.clicked() {
        // before the paper is acted on
        state.atlas.enter();
    }
    state.focus.paper = on.response.has_focus();
    if state.focus.paper {
        keep_arrows(ui, on.response.id);
    }
    if let Some(template) = placing {
        let place =
            PlateAnchor { at: paper.center_top() + vec2(0.0, 8.0), pivot: Align2::CENTER_TOP, width: paper.width() };
        plate(ui.ctx(), "placing", place, false, look, |ui| {
            ui.label(worded(ui, &format!("Click where the {} goes, or drag. Escape drops it.", template.title())))
        });
    }
    // where the robot is drawn low, the words stand above it
    let refused = state.atlas.refused_on_paper();
    if let Some((words, at)) = &refused {
        let low =
            at.is_some_and(|at| on.fit.screen_from_world(at)[1] > f64::from(paper.bottom() - 0.4 * paper.height()));
        let (at, pivot) = if low {
            (paper.center_top() + vec2(0.0, 8.0), Align2::CENTER_TOP)
        } else {
            (paper.center_bottom() - vec2(0.0, 8.0), Align2::CENTER_BOTTOM)
        };
        let place = PlateAnchor { at, pivot, width: (paper.width() - 32.0).min(440.0) };
        plate(ui.ctx(), "refused", place, false, look, |ui| refusal(ui, words, look));
    }
    match state.atlas.mode {
        Mode::Put => {
            if put(&on, &mut state.atlas) {
                state.did.push(HintTask::Put);
            }
        }
        Mode::Edit => match placing {
            Some(template) => draw(&on, template, reach, &mut state.atlas),
            None => edit(&on, &moving, &still, &mut state.atlas),
        },
        Mode::Measure => {}
    }
    if let Some(space) = space
        && chart::chart(ui, space, look, &mut state.atlas)
    {
        state.did.push(HintTask::Put);
    }
    ui.scope_builder(UiBuilder::new().max_rect(beside), |ui| {
        ScrollArea::vertical().id_salt("atlas").auto_shrink(false).show(ui, |ui| {
            if look.low {
                crate::window::ui::menu::head(ui, words, model, look, state, commands);
            }
            beside_the_paper(ui, model, look, state, commands);
            crate::window::ui::menu::foot(ui, words, look, state);
        });
    });
    if state.atlas.mode != Mode::Edit {
        state.atlas.put_down();
    }
}

/// Carries out an action on the session while the atlas is in front. Save and open act on the world; in edit mode, undo
/// and redo act on edits.
pub fn act(action: SessionAction, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    match action {
        SessionAction::Undo if state.atlas.mode == Mode::Edit => state.atlas.undo(true),
        SessionAction::Redo if state.atlas.mode == Mode::Edit => state.atlas.undo(false),
        SessionAction::Save => commands.push(Command::Session(SessionCommand::SaveWorld)),
        SessionAction::Open => commands.push(Command::Session(SessionCommand::OpenWorld)),
        action => crate::window::ui::menu::act(action, model, state, commands),
    }
}

/// Carries out an action on the robot or on what is selected.
pub fn act_on_thing(action: AtlasAction, atlas: &mut AtlasState) {
    let edits = atlas.mode == Mode::Edit;
    match action {
        AtlasAction::Move(way) => atlas.step(way.steps()),
        AtlasAction::TurnThing { left } => atlas.turn(left),
        AtlasAction::Delete if edits => atlas.delete(),
        AtlasAction::Deselect if edits => atlas.leave(),
        // nothing is selected
        AtlasAction::Delete | AtlasAction::Deselect => {}
    }
}

/// Handles the pointer in put mode: a click puts the robot there, a drag turns it, a click on an offer takes it.
/// Returns whether the robot was put somewhere.
fn put(on: &ScreenSheet, atlas: &mut AtlasState) -> bool {
    let Some(at) = on.held_anywhere() else {
        atlas.pressed = None;
        atlas.forget_wanted();
        return false;
    };
    // where the button went down, however far the pointer went before it was taken for a drag
    let from = *atlas.pressed.get_or_insert(at);
    let way = at - from;
    let turned = way.norm() * on.fit.px_per_metre() > DRAGGED;
    let heading = turned.then(|| motion_lab_core::num::atan2(way.y, way.x));
    let done = on.response.clicked() || on.response.drag_stopped();
    if done && !turned && atlas.take_offer(from, 12.0 / on.fit.px_per_metre()) {
        atlas.pressed = None;
        return true;
    }
    atlas.ask(from, heading, done);
    if done {
        atlas.pressed = None;
    }
    done && atlas.refusal().is_none()
}

/// Handles the pointer while a thing is to be added: a click adds it there, a drag draws it; one that ends off the
/// paper draws nothing.
fn draw(on: &ScreenSheet, template: Template, reach: Option<f64>, atlas: &mut AtlasState) {
    let Some(at) = on.held() else {
        if on.response.drag_stopped() {
            atlas.drawn_from = None;
        }
        return;
    };
    if on.response.clicked() {
        atlas.add(template, at);
    } else if on.response.drag_started() {
        let pressed = on.response.ctx.input(|i| i.pointer.press_origin());
        let from = pressed.map(|p| on.fit.world_from_screen([f64::from(p.x), f64::from(p.y)]));
        atlas.drawn_from = Some(from.unwrap_or(at));
    } else if on.response.drag_stopped()
        && let Some(from) = atlas.drawn_from.take()
    {
        atlas.add_drawn(template, [from, at], reach);
    }
}

/// Handles the pointer in edit mode: a press selects the thing there, a drag moves it or one of its handles.
fn edit(on: &ScreenSheet, moving: &Picture, still: &Picture, atlas: &mut AtlasState) {
    let Some(at) = on.held_anywhere() else {
        if atlas.drag.is_some() {
            // the button came up where no one saw it
            atlas.end_drag();
        }
        return;
    };
    let screen: ScreenPoint = on.fit.screen_from_world(at);
    if on.response.drag_started() || on.response.clicked() {
        let from =
            on.response.ctx.input(|i| i.pointer.press_origin()).map_or(screen, |p| [f64::from(p.x), f64::from(p.y)]);
        let origin = on.fit.world_from_screen(from);
        let handle = atlas.handle_at(origin, 14.0 / on.fit.px_per_metre());
        if handle.is_none() {
            let moves = |thing: &Thing| matches!(thing, Thing::Place(_) | Thing::Robot(_));
            let thing = pick(moving, &on.fit, from, 4.0).and_then(Thing::of).filter(moves);
            let thing = thing.or_else(|| pick(still, &on.fit, from, 5.0).and_then(Thing::of));
            atlas.pick(thing.filter(|thing| !matches!(thing, Thing::Route(_))).map(Thing::name));
        }
        atlas.begin_drag(origin, handle);
    }
    // off the paper a thing stays where it was last
    if on.response.dragged() && on.held().is_some() {
        let snaps = !on.response.ctx.input(|i| i.modifiers.alt);
        atlas.drag_to(at, snaps.then_some(SNAP / on.fit.px_per_metre()));
    }
    if on.response.drag_stopped() || on.response.clicked() {
        atlas.end_drag();
    }
}

fn beside_the_paper(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    ui.horizontal_wrapped(|ui| {
        let present = state.atlas.label();
        let choice =
            ComboBox::from_id_salt("world").selected_text(present.as_str()).show_ui(ui, |ui| worlds(ui, state));
        choice.response.widget_info(|| WidgetInfo {
            current_text_value: Some(present.clone()),
            ..WidgetInfo::labeled(WidgetType::ComboBox, true, "world")
        });
        if LabButton::new("New").show(ui, look).on_hover_text("An empty world within a wall").clicked() {
            state.new_world();
        }
        if LabButton::new("Open").show(ui, look).clicked() {
            commands.push(Command::Session(SessionCommand::OpenWorld));
        }
        if LabButton::new("Save as").show(ui, look).clicked() {
            commands.push(Command::Session(SessionCommand::SaveWorld));
        }
        if LabButton::new("Run this world").show(ui, look).on_hover_text("A new run in the dashboard").clicked() {
            commands.push(Command::Session(SessionCommand::RunWorld));
        }
    });
    ui.add_space(8.0);
    ui.horizontal_wrapped(|ui| {
        for (mode, name) in [(Mode::Put, "Put the robot"), (Mode::Measure, "Measure"), (Mode::Edit, "Edit")] {
            if LabButton::new(name).selected(state.atlas.mode == mode).show(ui, look).clicked() {
                state.atlas.mode = mode;
            }
        }
    });
    ui.checkbox(&mut state.settings.labels, "names");
    match state.atlas.mode {
        Mode::Put => {
            put_panel(ui, state);
            into_the_run(ui, model, look, state, commands);
        }
        Mode::Measure => measure_panel(ui, state),
        Mode::Edit => edit_panel(ui, look, &mut state.atlas),
    }
}

/// Shows the list of worlds: the built-in ones, each as it was left and, where that has edits, as it came; and opened
/// ones that have edits.
fn worlds(ui: &mut Ui, state: &mut UiState) {
    for name in World::built_in_names() {
        let is_its = |kept: &AtlasState| kept.built_in() == Some(name);
        let is_present = is_its(&state.atlas);
        let is_left = is_present || state.shelf.iter().any(is_its);
        let is_there_as_it_came = is_present && !state.atlas.has_history();
        if is_present {
            _ = ui.selectable_label(true, state.atlas.label());
        }
        let shelved: Vec<usize> = (0..state.shelf.len()).filter(|i| is_its(&state.shelf[*i])).collect();
        let chosen = shelved.into_iter().find(|i| ui.selectable_label(false, state.shelf[*i].label()).clicked());
        if let Some(world) = World::built_in(name).filter(|_| !is_there_as_it_came) {
            let words = if is_left { format!("{}, as it came", world.name) } else { world.name.clone() };
            if ui.selectable_label(false, words).clicked() {
                state.open_world(AtlasState::of(world));
            }
        }
        if let Some(i) = chosen {
            state.take_from_shelf(i);
        }
    }
    if state.atlas.built_in().is_none() {
        _ = ui.selectable_label(true, state.atlas.label());
    }
    let opened: Vec<usize> = (0..state.shelf.len()).filter(|i| state.shelf[*i].built_in().is_none()).collect();
    for i in opened {
        if let Some(kept) = state.shelf.get(i)
            && ui.selectable_label(false, kept.label()).clicked()
        {
            state.take_from_shelf(i);
        }
    }
}

fn put_panel(ui: &mut Ui, state: &mut UiState) {
    let atlas = &mut state.atlas;
    let names: Vec<String> = atlas.atlas().robots().iter().map(|r| r.name.clone()).collect();
    if names.is_empty() {
        ui.label("No robot of the lab lives in this world.");
        return;
    }
    for (i, name) in names.iter().enumerate() {
        if names.len() > 1 && ui.radio(atlas.robot == i, name).clicked() {
            atlas.robot = i;
        }
    }
    if let Some(robot) = atlas.atlas().robots().get(atlas.robot) {
        for line in motion_lab_core::picture::readout_lines(&readout(&robot.q.to_string()), 40) {
            ui.label(RichText::new(line).monospace());
        }
    }
}

/// Shows two buttons for the atlas's selected robot. The first puts that robot of the run under way where it stands on
/// the atlas; it is disabled unless the run has the robot in a world of this name. The second begins a run of this
/// world with its robots where they stand.
fn into_the_run(ui: &mut Ui, model: &Dashboard, look: &FrameColours, state: &UiState, commands: &mut Vec<Command>) {
    let atlas = state.atlas.atlas();
    let Some(robot) = atlas.robots().get(state.atlas.robot) else { return };
    ui.add_space(8.0);
    ui.horizontal_wrapped(|ui| {
        PutInRun { world: &atlas.world().name, robot: &robot.name, q: robot.q }.show(ui, model, look, commands);
        let button = LabButton::new("Run from here").show(ui, look);
        if button.on_hover_text("A new run of this world that begins with its robots where they are").clicked() {
            commands.push(Command::Session(SessionCommand::RunFromHere));
        }
    });
}

fn measure_panel(ui: &mut Ui, state: &mut UiState) {
    ui.label("The grid is derived from the world, at any resolution. Point somewhere: the exact distance stands beside the grid's.");
    let mut resolution = state.atlas.resolution;
    let slider = Slider::new(&mut resolution, 0.05..=1.0).logarithmic(true).fixed_decimals(2).suffix(" m").text("cell");
    let typed = NumberInput::new(ui, 0.05..=1.0, TypedKind::Plain);
    let response = ui.add(slider.custom_parser(|text| typed.read(text)).update_while_editing(false));
    response.widget_info(|| WidgetInfo::slider(true, resolution, "cell size in metres"));
    if response.changed() {
        state.atlas.set_resolution(resolution);
    }
    state.refuse(typed.refused(&response));
    if let Some(words) = state.atlas.measured() {
        ui.label(RichText::new(words).monospace());
    }
}
