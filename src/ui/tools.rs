//! What is done to the session: open and save runs, undo, what is shown.

use bevy_egui::egui::{RichText, TextStyle, Ui};

use super::button::button;
use super::keys::{Action, hint};
use super::{Command, Dashboard, Look, SessionCommand, UiState};
use crate::simulation::TransportCommand;

/// Does what a key or a button asks for, as far as it is the session's.
pub fn act(action: Action, state: &mut UiState, commands: &mut Vec<Command>) {
    let settings = &mut state.settings;
    match action {
        Action::Undo => commands.push(Command::Transport(TransportCommand::Undo)),
        Action::Redo => commands.push(Command::Transport(TransportCommand::Redo)),
        Action::Save => commands.push(Command::Session(SessionCommand::Save)),
        Action::Open => commands.push(Command::Session(SessionCommand::Open)),
        Action::Plots => settings.plots = !settings.plots,
        Action::Labels => settings.labels = !settings.labels,
        Action::Scan => settings.scan = !settings.scan,
        Action::Theme => settings.theme = settings.theme.next(),
        Action::Help => state.help = !state.help,
        _ => {}
    }
}

/// Shows the buttons: in a row from right to left, or as a list `in_menu`.
pub fn tools(
    ui: &mut Ui,
    model: &Dashboard,
    (in_menu, look): (bool, &Look),
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let theme = format!("{} theme", state.settings.theme.name());
    let mut buttons = [
        (theme.as_str(), Action::Theme, true, false),
        ("Keys", Action::Help, true, state.help),
        ("Names", Action::Labels, true, state.settings.labels),
        ("Plots", Action::Plots, true, state.settings.plots),
        ("Redo", Action::Redo, model.can_redo, false),
        ("Undo", Action::Undo, model.can_undo, false),
        ("Save", Action::Save, true, false),
        ("Open", Action::Open, true, false),
    ];
    if in_menu {
        buttons.reverse();
    }
    for (label, action, enabled, on) in buttons {
        if button(ui, label, 0.0, (enabled, on), look).on_hover_text(hint(action)).clicked() {
            act(action, state, commands);
        }
    }
}

/// What is said of the last file, with a way to put it away.
pub fn notice(ui: &mut Ui, state: &mut UiState) {
    let Some(notice) = &state.notice else { return };
    let colour = if notice.is_error { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
    let text = RichText::new(&notice.text).color(colour);
    let put_away = ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Body);
        ui.label(text);
        ui.link("Dismiss").clicked()
    });
    if put_away.inner {
        state.notice = None;
    }
}
