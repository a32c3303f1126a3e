//! The configuration space beside the workspace: the same robot as in the anatomy, as a point.

use std::sync::Arc;

use bevy_egui::egui::{Label, Rect, RichText, ScrollArea, TextStyle, TextWrapMode, Ui, pos2, vec2};

use super::torus::torus;
use crate::window::ui::anatomy::in_front::PutInRun;
use crate::window::ui::anatomy::view::{annulus, coordinate, prompts, robot_choice, world_choice};
use crate::window::ui::paint::canvas;
use crate::window::ui::paint::fold::fold;
use crate::window::ui::paint::frame::{formulas, headline, next_hint, rows_of_words};
use crate::window::ui::paint::sheet::{sheet, two_columns};
use crate::window::ui::{Command, Dashboard, FrameColours, UiState};
use motion_lab_core::cspace::overlay_items;
use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::{Picture, Role, readout, readout_lines};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::anatomy::{PromptSeries, Tab, twin_items};
use motion_lab_sim::lens::remember_in;
use motion_lab_sim::manifest::{HintTask, Widget};

/// Radius of the robot's point with its ring, points.
const POINT: f64 = 6.0;

/// Height of the words under two papers that lie one above the other, points.
const UNDER_TWO: f32 = 224.0;

/// Shows the widget.
pub fn cspace_view(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let narrow = look.narrow;
    let words = Widget::Cspace.text();
    if !look.low {
        crate::window::ui::menu::head(ui, words, model, look, state, commands);
    }
    let anatomy = state.anatomy.anatomy.clone();
    if state.cspace.refine(&anatomy) {
        ui.ctx().request_repaint();
    }
    let room = ui.available_rect_before_wrap();
    let text = if look.low {
        0.3 * room.height()
    } else if narrow {
        160.0
    } else {
        140.0
    };
    // one above the other where they are larger so
    let above = room.width().min(0.5 * (room.height() - if narrow { text } else { UNDER_TWO }));
    let beside = (0.5 * (room.width() - 20.0)).min(room.height() - text);
    let is_above = !look.low && above > beside;
    let side = if is_above { above } else { beside };
    let margin = if is_above { 0.5 * (room.width() - side) } else { 0.0 };
    let left = Rect::from_min_size(room.min + vec2(margin, 0.0), vec2(side, side));
    let right = if is_above { left.translate(vec2(0.0, side + 8.0)) } else { left.translate(vec2(side + 20.0, 0.0)) };
    workspace(ui, left, look, state);
    if state.cspace.is_torus && state.cspace.cells.as_ref().is_some_and(|cells| cells.map().slice().wraps()) {
        torus(ui, right, look, state);
    } else {
        space(ui, right, look, state);
    }
    let below = Rect::from_min_max(pos2(room.left(), right.bottom() + 6.0), room.max);
    ui.scope_builder(bevy_egui::egui::UiBuilder::new().max_rect(below), |ui| {
        if narrow {
            ScrollArea::vertical().id_salt("cspace").auto_shrink(false).show(ui, |ui| {
                if look.low {
                    crate::window::ui::menu::head(ui, words, model, look, state, commands);
                }
                readouts(ui, look, state);
                next_hint(ui, words, look, state);
                choices(ui, state);
                PutInRun::of_query(&state.anatomy.anatomy).show(ui, model, look, commands);
                fold(ui, "Guess first", false, |ui| prompts(ui, PromptSeries::Tips, state));
                crate::window::ui::menu::foot(ui, words, look, state);
            });
        } else {
            // each column under its paper
            let width = if is_above { 0.5 * (room.width() - 20.0) } else { side };
            two_columns(ui, width, |ui, i| {
                if i == 0 {
                    readouts(ui, look, state);
                } else {
                    ui.set_max_width(width);
                    prompts(ui, PromptSeries::Tips, state);
                    PutInRun::of_query(&state.anatomy.anatomy).show(ui, model, look, commands);
                }
            });
            choices(ui, state);
        }
    });
}

/// Shows the configuration, and how much of the space is known.
fn readouts(ui: &mut Ui, look: &FrameColours, state: &mut UiState) {
    ui.horizontal_wrapped(|ui| {
        let anatomy = &state.anatomy.anatomy;
        let role = if anatomy.intersects() { Role::Goal } else { Role::Text };
        headline(ui, &anatomy.clearance(), look.colour(role));
        // as a whole in the next row where this one has no room
        let figure = TextStyle::Monospace.resolve(ui.style());
        let width = ui.ctx().fonts_mut(|f| f.glyph_width(&figure, '0'));
        for line in readout_lines(&readout(&anatomy.q().to_string()), (ui.max_rect().width() / width) as usize) {
            ui.add(Label::new(RichText::new(line).monospace()).extend());
        }
    });
    if let Some(cells) = &state.cspace.cells {
        let p = cells.map().progress();
        let muted = |text: String| RichText::new(text).monospace().color(look.colour(Role::Muted));
        // a row ends between two of them, never within one
        if look.narrow {
            rows_of_words(ui, |ui| {
                ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
                ui.spacing_mut().item_spacing = vec2(14.0, 0.0);
                for entry in &Widget::Cspace.text().key {
                    let share = state.cspace.share(entry.role());
                    share.into_iter().for_each(|share| _ = ui.label(muted(format!("{} {share}", entry.text))));
                }
            });
        }
        let of = ui.label(muted(cells.map().slice().described()));
        of.on_hover_text(format!("{} cells judged", p.judged));
    }
    if matches!(state.anatomy.anatomy.checker().robot(), AnyRobot::Reach(_)) {
        formulas(ui, "annulus", look, state);
    }
}

/// Shows the choices, and sliders for the coordinates that the slice holds.
fn choices(ui: &mut Ui, state: &mut UiState) {
    ui.horizontal_wrapped(|ui| {
        robot_choice(ui, state);
        world_choice(ui, state);
        annulus(ui, state);
        let mut line = state.anatomy.anatomy.tab == Tab::Swept;
        if ui.checkbox(&mut line, "Query's motion").changed() {
            state.anatomy.anatomy.tab = if line { Tab::Swept } else { Tab::Distance };
        }
        if state.cspace.cells.as_ref().is_some_and(|cells| cells.map().slice().wraps()) {
            ui.checkbox(&mut state.cspace.is_torus, "as a torus");
        }
        // the coordinates that the slice holds
        ui.spacing_mut().slider_width = 180.0;
        let held: Vec<(usize, String)> =
            state.cspace.cells.as_ref().map_or_else(Vec::new, |cells| cells.map().slice().held());
        for (index, name) in held {
            coordinate(ui, state, index, &name);
        }
    });
}

/// Shows the workspace, where the robot can be dragged.
fn workspace(ui: &mut Ui, paper: Rect, look: &FrameColours, state: &mut UiState) {
    let still = Arc::clone(state.anatomy.backdrop());
    let anatomy = &state.anatomy.anatomy;
    let overlay = anatomy.overlay().with(twin_items(anatomy.checker().robot(), &anatomy.q()));
    let spoken = format!("workspace. {}", state.anatomy.anatomy.described());
    let on = sheet(ui, paper, spoken, &still, &overlay, look);
    if let Some(to) = on.held().filter(|_| on.response.dragged() || on.response.clicked()) {
        state.anatomy.anatomy.drag(to);
        remember(state);
    }
}

/// Shows the configuration space, where the robot's point can be dragged.
fn space(ui: &mut Ui, paper: Rect, look: &FrameColours, state: &mut UiState) {
    let Some(cells) = &state.cspace.cells else { return };
    let anatomy = &state.anatomy.anatomy;
    let (slice, still) = (cells.map().slice().clone(), Arc::clone(cells.picture()));
    let overlay = anatomy.in_space(state.cspace.trace.clone());
    let fit = canvas::fit(&still, paper);
    let regions = cells.names_off(Point2::from(slice.point(&anatomy.q())), &fit);
    let moving = Picture::new(still.name.clone(), still.bounds).with(regions).with(overlay_items(&slice, &overlay));
    let names: Vec<&str> = cells.regions().iter().map(|region| region.name.as_str()).collect();
    let blocked = if names.is_empty() { String::new() } else { format!(". Blocked regions: {}", names.join(", ")) };
    let spoken = format!("configuration space. The robot is the point {}{blocked}", anatomy.q());
    let on = sheet(ui, paper, spoken, &still, &moving, look);
    // on a torus the way beyond an edge goes on at the opposite one, however far
    let held = if slice.wraps() { on.held_anywhere() } else { on.held() };
    // who presses among the figures at the axes means no point
    let from = ui.input(|i| i.pointer.press_origin());
    let from = from.map(|p| on.fit.world_from_screen([f64::from(p.x), f64::from(p.y)])).or(held);
    let is_on_chart = from.is_some_and(|p| cells.is_on_chart(p, POINT / on.fit.px_per_metre()));
    let is_meant = is_on_chart && (on.response.dragged() || on.response.clicked());
    if let Some((q, is_over_edge)) = held.filter(|_| is_meant).map(|to| cells.configuration_at(to)) {
        // a point of the slice is a configuration of the robot
        if state.anatomy.anatomy.set_q(q).is_ok() {
            remember(state);
            state.did.push(HintTask::MovePoint);
            state.did.extend(is_over_edge.then_some(HintTask::OverEdge));
        }
    }
}

fn remember(state: &mut UiState) {
    remember_in(&mut state.cspace.trace, state.anatomy.anatomy.q());
}
