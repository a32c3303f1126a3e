//! The lab: a rail with the widgets, and the one that is in front.

use std::sync::Arc;

use bevy_egui::egui::{CentralPanel, Frame, Margin, Panel, Ui, vec2};

use super::dashboard::{self, drive};
use super::keys::{Action, pressed};
use super::paint::button::button;
use super::{Command, Dashboard, Look, UiState, anatomy, atlas, capture_form, cspace, help, tools};
use crate::manifest::widgets;
use crate::simulation::{History, TransportCommand};

/// Width below which a widget shows one thing at a time, points.
const NARROW: f32 = 720.0;

/// Width of the rail, points.
const RAIL: f32 = 76.0;

/// Index of the atlas on the rail.
const ATLAS: usize = 3;

/// Shows the lab over the whole of `ui`; what is pressed is pushed onto `commands`.
pub fn lab(ui: &mut Ui, model: &Dashboard, history: &History, state: &mut UiState, commands: &mut Vec<Command>) {
    let narrow = ui.max_rect().width() < NARROW;
    let look = Look::of(ui, state);
    let mut style = look.theme.style(narrow);
    if state.settings.reduced_motion {
        style.animation_time = 0.0;
    }
    let style = Arc::new(style);
    if ui.ctx().global_style() != style {
        // hints and lists pop up outside of `ui`
        ui.ctx().set_global_style(Arc::clone(&style));
    }
    ui.set_style(style);
    let nudged = std::mem::take(&mut state.nudging);
    let actions = if state.help || state.capture.open { vec![] } else { pressed(ui, state.armed.is_some(), nudged) };
    for action in actions {
        match action {
            Action::Widget(number) => choose(number, model, state, commands),
            action if state.widget == 0 => dashboard::view::act(action, model, state, commands),
            action if state.widget == ATLAS => atlas::view::act(action, model, state, commands),
            action => tools::act(action, model, state, commands),
        }
    }
    // no fill: the window is cleared to the paper's colour already, and a fill would cost as much as all that is drawn
    let margin = Margin::symmetric(if narrow { 8 } else { 6 }, if narrow { 4 } else { 14 });
    if state.embedded {
        // the page chose the widget
    } else if narrow {
        Panel::top("rail").frame(Frame::NONE.inner_margin(margin)).show_separator_line(false).show(ui, |ui| {
            ui.horizontal(|ui| rail(ui, model, (&look, 40.0), state, commands));
        });
    } else {
        let frame = Frame::NONE.inner_margin(margin);
        Panel::left("rail").exact_size(RAIL).resizable(false).frame(frame).show(ui, |ui| {
            ui.vertical_centered(|ui| rail(ui, model, (&look, 44.0), state, commands));
        });
    }
    if state.widget == 0 {
        if !state.help && !state.capture.open {
            drive::drive(ui, model, state, commands);
        }
        dashboard::view::dashboard(ui, model, history, (narrow, &look), state, commands);
    } else {
        let side = if narrow { 12 } else { 20 };
        CentralPanel::default().frame(Frame::NONE.inner_margin(Margin::symmetric(side, 14))).show(ui, |ui| match state
            .widget
        {
            1 => anatomy::view::anatomy_view(ui, model, (narrow, &look), state, commands),
            2 => cspace::view::cspace_view(ui, model, (narrow, &look), state, commands),
            _ => atlas::view::atlas_view(ui, model, (narrow, &look), state, commands),
        });
    }
    help::help(ui.ctx(), state);
    capture_form::capture_form(ui.ctx(), model, &look, state, commands);
    if state.pointed.is_some() || state.lit.is_some() {
        // the fade goes on without further input
        ui.ctx().request_repaint();
    }
}

/// Shows a button for each widget.
fn rail(
    ui: &mut Ui,
    model: &Dashboard,
    (look, height): (&Look, f32),
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    ui.spacing_mut().button_padding = vec2(4.0, 2.0);
    ui.spacing_mut().interact_size.y = height;
    for (number, widget) in widgets().iter().enumerate() {
        let response = button(ui, widget.short(), RAIL - 12.0, (true, state.widget == number), look);
        if response.on_hover_text(&widget.title).clicked() {
            choose(number, model, state, commands);
        }
    }
}

/// Puts a widget in front and lets go of the robot in hand. The run pauses unless the widget is the dashboard.
fn choose(number: usize, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    if number != 0 && model.playing {
        commands.push(Command::Transport(TransportCommand::Pause));
    }
    drive::let_go(state, commands);
    state.widget = number.min(widgets().len() - 1);
}
