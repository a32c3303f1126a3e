//! The transport bar: the time line, play and pause, steps, reset, re-roll, the speed, the seed, the time.

use bevy_egui::egui::{Align, Button, ComboBox, Key, Layout, Modifiers, RichText, TextEdit, Ui, vec2};

use super::time_line::time_line;
use super::{Command, Dashboard, UiState};
use crate::random::Seed;
use crate::run::DT;
use crate::simulation::TransportCommand;

/// The speeds to choose from, simulated seconds per second of the clock.
const SPEEDS: [(f64, &str); 10] = [
    (0.125, "1/8 x"),
    (0.25, "1/4 x"),
    (0.5, "1/2 x"),
    (1.0, "1 x"),
    (2.0, "2 x"),
    (4.0, "4 x"),
    (8.0, "8 x"),
    (16.0, "16 x"),
    (32.0, "32 x"),
    (64.0, "64 x"),
];

/// The keys that move the run while nothing has the focus.
const KEYS: [(Key, TransportCommand); 3] = [
    (Key::ArrowLeft, TransportCommand::StepBack),
    (Key::ArrowRight, TransportCommand::Step),
    (Key::Home, TransportCommand::Seek(0)),
];

/// Shows the time line and the bar under it, on a `narrow` screen in more rows. While a robot is `armed` the arrow keys are its.
pub fn transport_bar(
    ui: &mut Ui,
    model: &Dashboard,
    state: &mut UiState,
    (narrow, armed): (bool, bool),
    commands: &mut Vec<Command>,
) {
    // a focused button, field or line keeps its own keys
    let free = ui.memory(|m| m.focused().is_none());
    let pressed = |key| free && ui.input_mut(|i| i.consume_key(Modifiers::NONE, key));
    let space = pressed(Key::Space);
    for (key, command) in KEYS {
        if !armed && pressed(key) {
            commands.push(Command::Transport(command));
        }
    }
    time_line(ui, model, commands);
    ui.horizontal(|ui| {
        play_and_step(ui, model, space, commands);
        if !narrow {
            speed_choice(ui, model, commands);
            seed_and_time(ui, model, state, commands);
        }
    });
    if narrow {
        ui.horizontal(|ui| seed_and_time(ui, model, state, commands));
    }
}

fn play_and_step(ui: &mut Ui, model: &Dashboard, space: bool, commands: &mut Vec<Command>) {
    let height = ui.spacing().interact_size.y;
    let (label, command) =
        if model.playing { ("Pause", TransportCommand::Pause) } else { ("Play", TransportCommand::Play) };
    let play = ui.add(Button::new(label).min_size(vec2(64.0, height))).on_hover_text("Space");
    if play.clicked() || space {
        commands.push(Command::Transport(command));
    }
    for (label, hint, command) in [
        ("Back", "One tick back, and pause: left arrow", TransportCommand::StepBack),
        ("Step", "One tick, and pause: right arrow", TransportCommand::Step),
        ("Reset", "Back to the start, same seed, no input", TransportCommand::Reset),
        ("Re-roll", "A new run from another seed", TransportCommand::ReRoll),
    ] {
        if ui.button(label).on_hover_text(hint).clicked() {
            commands.push(Command::Transport(command));
        }
    }
}

/// How fast it plays.
fn speed_choice(ui: &mut Ui, model: &Dashboard, commands: &mut Vec<Command>) {
    let name = |speed: f64| SPEEDS.iter().find(|(s, _)| *s == speed).map_or("other", |(_, name)| name);
    let choice =
        ComboBox::from_id_salt("speed").width(72.0).height(400.0).selected_text(name(model.speed)).show_ui(ui, |ui| {
            for (speed, name) in SPEEDS {
                if ui.selectable_label(speed == model.speed, name).clicked() {
                    commands.push(Command::Transport(TransportCommand::SetSpeed(speed)));
                }
            }
        });
    choice.response.on_hover_text("Simulated seconds per second");
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
