//! The transport bar: play and pause, step, reset, re-roll, the seed, the time.

use bevy_egui::egui::{Align, Button, Key, Layout, Modifiers, RichText, TextEdit, Ui, vec2};

use super::{Command, Dashboard, UiState};
use crate::random::Seed;
use crate::run::DT;
use crate::simulation::TransportCommand;

/// Shows the bar.
pub fn transport_bar(ui: &mut Ui, model: &Dashboard, state: &mut UiState, narrow: bool, commands: &mut Vec<Command>) {
    // a focused button or field keeps its space bar
    let nothing_focused = ui.memory(|m| m.focused().is_none());
    let space = nothing_focused && ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Space));
    let height = ui.spacing().interact_size.y;
    ui.horizontal(|ui| {
        let (label, command) =
            if model.playing { ("Pause", TransportCommand::Pause) } else { ("Play", TransportCommand::Play) };
        let play = ui.add(Button::new(label).min_size(vec2(72.0, height))).on_hover_text("Space");
        if play.clicked() || space {
            commands.push(Command::Transport(command));
        }
        for (label, hint, command) in [
            ("Step", "One tick, and pause", TransportCommand::Step),
            ("Reset", "Back to the start, same seed", TransportCommand::Reset),
            ("Re-roll", "A new run from another seed", TransportCommand::ReRoll),
        ] {
            if ui.button(label).on_hover_text(hint).clicked() {
                commands.push(Command::Transport(command));
            }
        }
        if !narrow {
            seed_and_time(ui, model, state, commands);
        }
    });
    if narrow {
        ui.horizontal(|ui| seed_and_time(ui, model, state, commands));
    }
}

/// The seed, and at the right end the time and the paper.
fn seed_and_time(ui: &mut Ui, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    if let Some(seed) = seed_field(ui, model.seed, state) {
        commands.push(Command::Transport(TransportCommand::SetSeed(seed)));
    }
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        theme_button(ui, state);
        let time = format!("{:7.2} s  tick {:5}", DT * model.tick as f64, model.tick);
        ui.label(RichText::new(time).monospace());
    });
}

/// The seed as an editable field: a new one is taken when Enter is pressed; what is no seed is put back.
fn seed_field(ui: &mut Ui, seed: Seed, state: &mut UiState) -> Option<Seed> {
    let label = ui.label("seed");
    let mut text = state.seed_text.take().unwrap_or_else(|| seed.0.to_string());
    let field = TextEdit::singleline(&mut text).desired_width(72.0).font(bevy_egui::egui::TextStyle::Monospace);
    let field = field.vertical_align(Align::Center).min_size(vec2(0.0, ui.spacing().interact_size.y));
    let response = ui.add(field).labelled_by(label.id);
    if response.has_focus() {
        state.seed_text = Some(text);
        return None;
    }
    let entered = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    text.trim().parse().ok().map(Seed).filter(|new| entered && *new != seed)
}

fn theme_button(ui: &mut Ui, state: &mut UiState) {
    let other = state.theme.toggled();
    if ui.button(format!("{other:?}")).on_hover_text("Light or dark paper").clicked() {
        state.theme = other;
    }
}
