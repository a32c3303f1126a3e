//! The dashboard: the cockpits at once on a wide screen, one at a time on a narrow one.

use bevy_egui::egui::{CentralPanel, Frame, Margin, Panel, Rect, ScrollArea, Sense, Ui, pos2, vec2};

use super::drive;
use super::pane::{self, take_in_hand, text_height};
use super::plots::plots;
use super::transport_bar::{self, transport_bar};
use crate::manifest::Widget;
use crate::simulation::History;
use crate::ui::crowd::pane::{CrowdPane, crowd_pane};
use crate::ui::keys::Action;
use crate::ui::paint::frame;
use crate::ui::{Cockpit, Command, Dashboard, Look, Notice, UiState, tools};

/// Gap between panes, and between the panes and the window's border, points.
const GAP: f32 = 20.0;

/// Width of the panel of plots at the side, points.
const SHEET: f32 = 320.0;

/// Shows the dashboard over what is left of `ui`; what is pressed is pushed onto `commands`. Returns the rectangle of
/// the panes.
pub fn dashboard(
    ui: &mut Ui,
    model: &Dashboard,
    history: &History,
    look: &Look,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) -> Rect {
    let narrow = look.narrow;
    let side = if narrow { 12 } else { GAP as i8 };
    Panel::bottom("transport")
        .frame(Frame::NONE.inner_margin(Margin::symmetric(side, 8)))
        .show(ui, |ui| transport_bar(ui, model, history, look, state, commands));
    if state.settings.plots && !narrow {
        let margin = Margin { left: 12, right: side, top: 14, bottom: 0 };
        Panel::right("sheet")
            .exact_size(SHEET)
            .resizable(false)
            .frame(Frame::NONE.inner_margin(margin))
            .show(ui, |ui| plots(ui, model, history, look, state, commands));
    }
    let panel = CentralPanel::default().frame(Frame::NONE.inner_margin(Margin::symmetric(side, 14))).show(ui, |ui| {
        header(ui, model, look, state, commands);
        ui.add_space(8.0);
        if narrow {
            if state.settings.plots {
                plots(ui, model, history, look, state, commands);
            } else {
                one_pane(ui, &Panes { model, history }, look, state, commands);
            }
        } else {
            all_panes(ui, &Panes { model, history }, look, state, commands);
        }
    });
    panel.response.rect
}

/// Carries out the action of a key while the dashboard is in front.
pub fn act(action: Action, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    match action {
        Action::LetGo => drive::let_go(state, commands),
        Action::Arm(pane) => {
            if let Some(cockpit) = model.cockpits.get(pane) {
                state.settings.world = pane as u32;
                // a narrow screen shows either the plots or a pane
                state.settings.plots &= !state.is_narrow;
                if let Some(crowd) = cockpit.crowd.as_ref().filter(|crowd| state.crowd.picked_in(crowd).is_none()) {
                    state.crowd.pick(crowd, Some(crowd.first));
                }
                take_in_hand(cockpit, state, commands);
            } else {
                let text = format!("the run has no world number {}", pane + 1);
                state.say(Notice { text, is_error: false });
            }
        }
        action => {
            tools::act(action, model, state, commands);
            transport_bar::act(action, model, commands);
        }
    }
}

fn header(ui: &mut Ui, model: &Dashboard, look: &Look, state: &mut UiState, commands: &mut Vec<Command>) {
    let words = Widget::Dashboard.text();
    tools::header(ui, words, model, look, state, commands);
    frame::key_row(ui, words, look, state);
    frame::hints(ui, words, look, state);
}

fn one_pane(ui: &mut Ui, panes: &Panes, look: &Look, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (i, cockpit) in panes.model.cockpits.iter().enumerate() {
            if ui.selectable_label(state.settings.world as usize == i, cockpit.tab()).clicked() {
                state.settings.world = i as u32;
            }
        }
    });
    ui.add_space(4.0);
    if let Some(cockpit) = panes.model.cockpits.get(state.settings.world as usize).or(panes.model.cockpits.first()) {
        let rect = ui.available_rect_before_wrap();
        panes.pane(ui, cockpit, rect, look, state, commands);
    }
}

/// What the panes show.
struct Panes<'a> {
    model: &'a Dashboard,
    history: &'a History,
}

impl Panes<'_> {
    /// Shows a cockpit in `rect`, its robots one by one or as a crowd.
    fn pane(
        &self,
        ui: &mut Ui,
        cockpit: &Cockpit,
        rect: Rect,
        look: &Look,
        state: &mut UiState,
        commands: &mut Vec<Command>,
    ) {
        match &cockpit.crowd {
            Some(crowd) => {
                let shown = CrowdPane { cockpit, crowd, history: self.history, tick: self.model.tick };
                crowd_pane(ui, &shown, rect, look, state, commands);
            }
            None => pane::pane(ui, cockpit, rect, look, state, commands),
        }
    }
}

fn all_panes(ui: &mut Ui, panes: &Panes, look: &Look, state: &mut UiState, commands: &mut Vec<Command>) {
    let count = panes.model.cockpits.len();
    if count == 0 {
        ui.weak("No world is loaded.");
        return;
    }
    let columns = count.min(3);
    let room = ui.available_rect_before_wrap();
    let width = (room.width() - GAP * (columns as f32 - 1.0)) / columns as f32;
    let mut rows = |ui: &mut Ui, height: f32| {
        for row in panes.model.cockpits.chunks(columns) {
            let (rect, _) = ui.allocate_exact_size(vec2(room.width(), height), Sense::hover());
            for (i, cockpit) in row.iter().enumerate() {
                let left = rect.left() + i as f32 * (width + GAP);
                let rect = Rect::from_min_size(pos2(left, rect.top()), vec2(width, height));
                panes.pane(ui, cockpit, rect, look, state, commands);
            }
        }
    };
    if count == columns {
        rows(ui, room.height());
    } else {
        // more than three worlds do not fit a screen: only then is there something to scroll
        let height = (width + text_height(ui, 1)).min(room.height());
        ScrollArea::vertical().show(ui, |ui| rows(ui, height));
    }
}
