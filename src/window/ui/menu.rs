//! The menu above every widget: capture, keys and theme; on the dashboard also open, save, undo, plots and names.

use bevy_egui::egui::{Align, Align2, Context, Id, Label, Layout, Rect, Ui, vec2};

use super::keys::{SessionAction, hint, keys_of};
use super::paint::button::LabButton;
use super::paint::icon::Icon;
use super::paint::plate::{PlateAnchor, plate, refusal};
use super::paint::{fold, frame};
use super::{Command, Dashboard, FrameColours, Notice, SessionCommand, UiState};
use motion_lab_sim::manifest::{ThemeChoice, Widget, WidgetText};
use motion_lab_sim::simulation::TransportCommand;

/// Carries out an action on the session.
pub fn act(action: SessionAction, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let in_dashboard = state.widget == Widget::Dashboard;
    let settings = &mut state.settings;
    match action {
        SessionAction::Undo => {
            commands.push(Command::from(TransportCommand::Undo));
            if model.can_undo {
                state.say(Notice { text: "Undone. Redo brings it back.".to_owned(), is_error: false });
            }
        }
        SessionAction::Redo => {
            commands.push(Command::from(TransportCommand::Redo));
            state.dismiss_notice();
        }
        SessionAction::Save => commands.push(Command::Session(SessionCommand::Save)),
        SessionAction::Open => commands.push(Command::Session(SessionCommand::Open)),
        SessionAction::Capture => state.ask_for_capture(model),
        // neither plots nor hints are seen beside a picture that fills the window
        SessionAction::Plots => {
            settings.plots = in_dashboard && std::mem::take(&mut state.screen.fills) || !settings.plots
        }
        SessionAction::Labels => settings.labels = !settings.labels,
        SessionAction::Scan => settings.scan = !settings.scan,
        SessionAction::Nearest => settings.nearest = !settings.nearest,
        SessionAction::Hints if in_dashboard && std::mem::take(&mut state.screen.fills) => {
            settings.show_hints(state.widget)
        }
        SessionAction::Hints => settings.toggle_hints(state.widget),
        SessionAction::Fill => state.screen.fills = in_dashboard && !state.screen.fills,
        SessionAction::Theme => settings.theme = settings.theme.next(),
        SessionAction::Help => state.help = !state.help,
    }
}

/// Largest width of a notice, points.
const MAX_NOTICE: f32 = 520.0;

/// Shows a widget's title, and at the right end its menu; on the dashboard with undo, redo and the plots beside it. On
/// an upright narrow screen, where the picture comes first, the title is its name alone.
pub fn header(
    ui: &mut Ui,
    words: &WidgetText,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    // without room for the title and the buttons side by side, the menu holds them all
    let is_small = look.narrow || ui.available_width() < 480.0;
    let beside: &[Tool] = if is_small || state.widget != Widget::Dashboard { &[] } else { &[PLOTS, REDO, UNDO] };
    let room = 90.0 + 60.0 * beside.len() as f32;
    ui.horizontal(|ui| {
        ui.vertical(|ui| {
            ui.set_max_width((ui.available_width() - room).max(0.0));
            if look.narrow {
                frame::name(ui, words, look);
            } else {
                frame::name_and_key(ui, words, look, state);
            }
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            fold::menu(ui, "Menu", |ui| menu(ui, model, beside, look, state, commands));
            for tool in beside {
                show(ui, tool, model, look, state, commands);
            }
        });
    });
}

/// Shows the menu with everything in it.
pub fn menu_button(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    fold::menu(ui, "Menu", |ui| menu(ui, model, &[], look, state, commands));
}

/// Shows the head of a widget other than the dashboard: title, colour key and buttons, in a low room also the
/// sentence. On an upright narrow screen the key stands under the picture with [`foot`].
pub fn head(
    ui: &mut Ui,
    words: &WidgetText,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    header(ui, words, model, look, state, commands);
    if look.low {
        frame::sentence_in_rows(ui, model, look, state);
        frame::key_row(ui, words, look, state);
    }
    ui.add_space(6.0);
}

/// Shows at the end of a narrow screen's words what [`head`] leaves out there.
pub fn foot(ui: &mut Ui, words: &WidgetText, look: &FrameColours, state: &mut UiState) {
    if look.narrow {
        ui.add_space(10.0);
        frame::misconception(ui, words, look);
    }
    if look.narrow && !look.low {
        frame::key_row(ui, words, look, state);
    }
}

/// A button above a widget.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Tool {
    label: &'static str,
    icon: Option<Icon>,
    action: SessionAction,
    /// Whether it shows its key: in the menu, where all have words.
    has_keys: bool,
}

const fn worded(label: &'static str, action: SessionAction) -> Tool {
    Tool { label, icon: None, action, has_keys: false }
}

const UNDO: Tool = Tool { icon: Some(Icon::Undo), ..worded("Undo", SessionAction::Undo) };
const REDO: Tool = Tool { icon: Some(Icon::Redo), ..worded("Redo", SessionAction::Redo) };
const CAPTURE: Tool = worded("Capture", SessionAction::Capture);
const HINTS: Tool = worded("Hints", SessionAction::Hints);
const KEYS: Tool = worded("Keys", SessionAction::Help);
const PLOTS: Tool = worded("Plots", SessionAction::Plots);

/// What acts on the run. Only the dashboard shows it, so only the dashboard has them.
const OF_THE_RUN: [Tool; 7] = [
    worded("Open", SessionAction::Open),
    worded("Save", SessionAction::Save),
    UNDO,
    REDO,
    PLOTS,
    worded("Names", SessionAction::Labels),
    worded("Fill the window", SessionAction::Fill),
];

fn menu(
    ui: &mut Ui,
    model: &Dashboard,
    elsewhere: &[Tool],
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let of_the_run: &[Tool] = if state.widget == Widget::Dashboard { &OF_THE_RUN } else { &[] };
    let all = of_the_run.iter().filter(|tool| !elsewhere.contains(tool)).copied();
    for tool in all.chain([CAPTURE, HINTS, KEYS]) {
        show(ui, &Tool { icon: None, has_keys: true, ..tool }, model, look, state, commands);
    }
    if state.widget == Widget::Dashboard {
        let back = LabButton::new("The three robots").show(ui, look);
        if back.on_hover_text("A new run of Rusty, Reach and Hitch in their worlds").clicked() {
            commands.push(Command::Session(SessionCommand::ThreeRobots));
        }
    }
    super::capture_form::copy(ui, look, &state.capture.order, commands);
    super::recent_menu::recent_menu(ui, &state.recent, look, commands);
    ui.separator();
    for theme in ThemeChoice::ALL {
        let label = format!("{} theme", theme.name());
        if LabButton::new(&label).selected(state.settings.theme == theme).show(ui, look).clicked() {
            state.settings.theme = theme;
        }
    }
}

fn show(
    ui: &mut Ui,
    tool: &Tool,
    model: &Dashboard,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let Tool { label, icon, action, has_keys } = *tool;
    let keys = if has_keys { keys_of(action) } else { String::new() };
    let button = LabButton::new(label).keys(&keys);
    let button = icon.map_or(button, |icon| button.icon(icon));
    let button = match action {
        SessionAction::Undo => button.enabled(model.can_undo),
        SessionAction::Redo => button.enabled(model.can_redo),
        SessionAction::Plots => button.selected(state.settings.plots),
        SessionAction::Labels => button.selected(state.settings.labels),
        SessionAction::Hints => button.selected(!state.settings.are_hints_away(state.widget)),
        _ => button,
    };
    if button.show(ui, look).on_hover_text(hint(action)).clicked() {
        act(action, model, state, commands);
    }
}

/// The key of the last notice shown and of the time from which on it stands.
fn since() -> Id {
    Id::new("notice since")
}

/// How long a notice that reports no error stays, seconds.
const STAYS: f64 = 6.0;

/// Whether a notice has stood for long enough to have been read. It stays while the pointer is on it.
fn is_read(ui: &Ui, notice: &Notice) -> bool {
    let (now, id) = (ui.input(|i| i.time), since());
    let kept: Option<(String, f64)> = ui.data(|data| data.get_temp(id));
    let is_held = ui.ui_contains_pointer();
    let since = kept.filter(|(text, _)| *text == notice.text && !is_held).map_or(now, |(_, since)| since);
    let left = since + STAYS - now;
    ui.data_mut(|data| data.insert_temp(id, (notice.text.clone(), since)));
    ui.ctx().request_repaint_after_secs((left as f32).max(0.1));
    left <= 0.0
}

/// Says what is known of the contact that was asked about, with links to play the way out and to put it away.
fn chance(ui: &mut Ui, state: &mut UiState) {
    let Some(shown) = &mut state.chance else { return };
    ui.add(Label::new(&shown.text).wrap());
    let put_away = frame::rows_of_words(ui, |ui| {
        shown.is_asked |= shown.way_out.is_some() && ui.link("Play the way out").clicked();
        ui.link("Put away").clicked()
    });
    if put_away {
        state.chance = None;
    }
}

/// Shows the work in the background and the last notice of the widget in front, with links to stop the one and dismiss
/// the other; over the run, also the offer of the run before. They lie over the foot of the `stage`, so that nothing
/// moves when they come and go, and at its right, where a wide screen has a picture and no links.
pub fn notice(ctx: &Context, stage: Rect, look: &FrameColours, state: &mut UiState) {
    let offers = state.widget == Widget::Dashboard && state.offer.is_some();
    if state.notice().is_none_or(|notice| notice.is_error) {
        // the same words said anew stand as long again
        ctx.data_mut(|data| data.remove_temp::<(String, f64)>(since()));
    }
    let has_chance = state.widget == Widget::Dashboard && state.chance.is_some();
    if state.working.is_none() && state.notice().is_none() && !offers && !has_chance {
        return;
    }
    let width = (stage.width() - 24.0).min(MAX_NOTICE);
    let place = PlateAnchor { at: stage.right_bottom() - vec2(12.0, 6.0), pivot: Align2::RIGHT_BOTTOM, width };
    let put_away = plate(ctx, "notice", place, true, look, |ui| {
        if let Some(working) = &mut state.working {
            frame::rows_of_words(ui, |ui| {
                ui.label(&working.text);
                working.stop |= ui.link("Stop").clicked();
            });
        }
        if let Some(offer) = state.offer.as_mut().filter(|_| offers) {
            ui.add(Label::new(&offer.text).wrap());
            frame::rows_of_words(ui, |ui| {
                if ui.link("Bring it back").clicked() {
                    offer.answer = Some(true);
                }
                if ui.link("Forget it").clicked() {
                    offer.answer = Some(false);
                }
            });
        }
        if has_chance {
            chance(ui, state);
        }
        let Some(notice) = state.notice() else { return false };
        let is_read = !notice.is_error && is_read(ui, notice);
        if notice.is_error {
            refusal(ui, &notice.text, look);
        } else {
            ui.add(Label::new(&notice.text).wrap());
        }
        frame::rows_of_words(ui, |ui| ui.link("Dismiss").clicked()) || is_read
    });
    if state.working.is_some() {
        // the work goes on without further input
        ctx.request_repaint_after_secs(0.2);
    }
    if put_away {
        state.dismiss_notice();
    }
}
