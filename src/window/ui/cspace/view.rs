//! The configuration space beside the workspace: the same robot as in the anatomy, as a point.

use std::sync::Arc;

use bevy_egui::egui::{Label, Rect, RichText, ScrollArea, TextStyle, TextWrapMode, Ui, pos2, vec2};

use super::chart::{ChartNames, chart, remember};
use crate::window::ui::anatomy::in_front::PutInRun;
use crate::window::ui::anatomy::view::{annulus, coordinate, prompts, robot_choice, world_choice};
use crate::window::ui::paint::fold::fold;
use crate::window::ui::paint::frame::{formulas, headline, rows_of_words};
use crate::window::ui::paint::sheet::{sheet, two_columns};
use crate::window::ui::{Command, Dashboard, FrameColours, UiState};
use motion_lab_core::picture::{Role, readout, readout_lines};
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::anatomy::{PromptSeries, Tab, twin_items};
use motion_lab_sim::manifest::Widget;

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
    chart(ui, right, ChartNames::Shown, look, state);
    let below = Rect::from_min_max(pos2(room.left(), right.bottom() + 6.0), room.max);
    ui.scope_builder(bevy_egui::egui::UiBuilder::new().max_rect(below), |ui| {
        if narrow {
            ScrollArea::vertical().id_salt("cspace").auto_shrink(false).show(ui, |ui| {
                if look.low {
                    crate::window::ui::menu::head(ui, words, model, look, state, commands);
                }
                readouts(ui, look, state);
                choices(ui, state);
                PutInRun::of_query(&state.anatomy.anatomy).show(ui, model, look, commands);
                guess(ui, state);
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
                    PutInRun::of_query(&state.anatomy.anatomy).show(ui, model, look, commands);
                    guess(ui, state);
                }
            });
            choices(ui, state);
        }
    });
}

/// Shows questions about the tips of an arm with two links; of another robot there are none.
fn guess(ui: &mut Ui, state: &mut UiState) {
    if state.anatomy.anatomy.lengths().is_some() {
        fold(ui, "Guess first", false, |ui| prompts(ui, PromptSeries::Tips, state));
    }
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
