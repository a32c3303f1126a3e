//! The buttons above every widget: theme, keys and capture; on the dashboard also names, plots, undo, save and open.

use bevy_egui::egui::{Align, Align2, Context, Label, Layout, Rect, Ui, vec2};

use super::keys::{Action, hint};
use super::paint::button::LabButton;
use super::paint::frame;
use super::paint::plate::{Place, plate, refusal};
use super::{Command, Dashboard, Look, SessionCommand, UiState, Widget, WidgetText};
use crate::simulation::TransportCommand;

/// Carries out the actions that concern the session, and ignores all others.
pub fn act(action: Action, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let settings = &mut state.settings;
    match action {
        Action::Undo => commands.push(Command::from(TransportCommand::Undo)),
        Action::Redo => commands.push(Command::from(TransportCommand::Redo)),
        Action::Save => commands.push(Command::Session(SessionCommand::Save)),
        Action::Open => commands.push(Command::Session(SessionCommand::Open)),
        Action::Capture => state.ask_for_capture(model),
        Action::Plots => settings.plots = !settings.plots,
        Action::Labels => settings.labels = !settings.labels,
        Action::Scan => settings.scan = !settings.scan,
        Action::Theme => settings.theme = settings.theme.next(),
        Action::Help => state.help = !state.help,
        _ => {}
    }
}

/// Largest width of a notice, points.
const MOST_NOTICE: f32 = 560.0;

/// Smallest width of a title that has buttons beside it, points.
const TITLE: f32 = 300.0;

/// Shows a widget's title, and the buttons beside it: in a menu on a narrow screen.
pub fn header(
    ui: &mut Ui,
    words: &WidgetText,
    model: &Dashboard,
    look: &Look,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let narrow = look.narrow;
    let buttons = if state.widget == Widget::Dashboard { 650.0 } else { 280.0 };
    // without room for the title and the buttons side by side, the buttons go into a menu
    let narrow = narrow || ui.available_width() < buttons + TITLE;
    let room = if narrow { 76.0 } else { buttons };
    ui.horizontal(|ui| {
        ui.vertical(|ui| {
            ui.set_max_width((ui.available_width() - room).max(0.0));
            frame::title(ui, words, look);
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if narrow {
                ui.menu_button("Menu", |ui| tools(ui, model, true, look, state, commands));
            } else {
                ui.spacing_mut().button_padding.x = 10.0;
                tools(ui, model, false, look, state, commands);
            }
        });
    });
}

/// Shows the head of a widget other than the dashboard: title and buttons, colour key and hints.
pub fn head(
    ui: &mut Ui,
    words: &WidgetText,
    model: &Dashboard,
    look: &Look,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let narrow = look.narrow;
    header(ui, words, model, look, state, commands);
    frame::key_row(ui, words, look, state);
    if !narrow {
        frame::hints(ui, words, look, state);
    }
    ui.add_space(6.0);
}

/// Shows the buttons: in a row from right to left, or as a list `in_menu`.
pub fn tools(
    ui: &mut Ui,
    model: &Dashboard,
    in_menu: bool,
    look: &Look,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let theme = format!("{} theme", state.settings.theme.name());
    let mut buttons = vec![
        (theme.as_str(), Action::Theme, true, false),
        ("Keys", Action::Help, true, state.help),
        ("Capture", Action::Capture, true, state.capture.open),
    ];
    // only the dashboard shows the run, so only the dashboard has the buttons that act on it
    if state.widget == Widget::Dashboard {
        buttons.extend([
            ("Names", Action::Labels, true, state.settings.labels),
            ("Plots", Action::Plots, true, state.settings.plots),
            ("Redo", Action::Redo, model.can_redo, false),
            ("Undo", Action::Undo, model.can_undo, false),
            ("Save", Action::Save, true, false),
            ("Open", Action::Open, true, false),
        ]);
    }
    if in_menu {
        buttons.reverse();
    }
    for (label, action, enabled, on) in buttons {
        if LabButton::new(label).enabled(enabled).selected(on).show(ui, look).on_hover_text(hint(action)).clicked() {
            act(action, model, state, commands);
        }
    }
}

/// Shows the work in the background and the last notice of the widget in front, with links to stop the one and dismiss
/// the other. They lie over the foot of the `stage`, so that nothing moves when they come and go.
pub fn notice(ctx: &Context, stage: Rect, look: &Look, state: &mut UiState) {
    if state.working.is_none() && state.notice().is_none() {
        return;
    }
    let width = (stage.width() - 24.0).min(MOST_NOTICE);
    let place = Place { at: stage.center_bottom() - vec2(0.0, 6.0), pivot: Align2::CENTER_BOTTOM, width };
    let put_away = plate(ctx, "notice", place, true, look, |ui| {
        if let Some(working) = &mut state.working {
            frame::rows_of_words(ui, |ui| {
                ui.label(&working.text);
                working.stop |= ui.link("Stop").clicked();
            });
        }
        let Some(notice) = state.notice() else { return false };
        if notice.is_error {
            refusal(ui, &notice.text, look);
        } else {
            ui.add(Label::new(&notice.text).wrap());
        }
        frame::rows_of_words(ui, |ui| ui.link("Dismiss").clicked())
    });
    if state.working.is_some() {
        // the work goes on without further input
        ctx.request_repaint_after_secs(0.2);
    }
    if put_away {
        state.hush();
    }
}
