//! The transport bar: the time line, play and pause, steps, loop, reset, re-roll, the speed, the seed, the time.

use bevy_egui::egui::text::CCursorRange;
use bevy_egui::egui::{
    Align, Align2, ComboBox, Key, Layout, RichText, TextEdit, TextStyle, Ui, WidgetInfo, WidgetType, pos2, vec2,
};

use super::time_line::TimeLine;
use crate::window::ui::keys::{TimeAction, hint};
use crate::window::ui::paint::button::{LabButton, SIGN, sign_width};
use crate::window::ui::paint::fold::form;
use crate::window::ui::paint::icon::Icon;
use crate::window::ui::paint::plate::{PlateAnchor, plate, refusal};
use crate::window::ui::{Command, Dashboard, FrameColours, SeedDraft, SessionCommand, UiState};
use motion_lab_core::picture::Role;
use motion_lab_core::random::Seed;
use motion_lab_sim::run::DT;
use motion_lab_sim::simulation::{History, TransportCommand};

/// Width that the time takes at the end of its row, and the least that a reason beside the seed has, points.
const TIME_ROOM: f32 = 170.0;
const REASON: f32 = 226.0;

/// The speeds to choose from, simulated seconds per second of the clock.
const SPEEDS: [(f64, &str); 11] = [
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
    (f64::INFINITY, "as fast as possible"),
];

/// Carries out an action that moves the run.
pub fn act(action: TimeAction, model: &Dashboard, commands: &mut Vec<Command>) {
    if action == TimeAction::Why {
        commands.push(Command::Session(SessionCommand::Why));
        return;
    }
    let at = SPEEDS.iter().position(|(speed, _)| *speed == model.speed);
    let speed = |at: Option<usize>| SPEEDS.get(at?).map(|(speed, _)| TransportCommand::SetSpeed(*speed));
    let command = match action {
        TimeAction::PlayPause if model.playing => Some(TransportCommand::Pause),
        TimeAction::PlayPause => Some(TransportCommand::Play),
        TimeAction::StepBack => Some(TransportCommand::StepBack),
        TimeAction::Step => Some(TransportCommand::Step),
        TimeAction::Start => Some(TransportCommand::Seek(0)),
        TimeAction::End => Some(TransportCommand::Seek(model.frontier)),
        TimeAction::NextContact => model.next_contact.map(TransportCommand::Seek),
        TimeAction::Loop => Some(TransportCommand::SetLooping(!model.looping)),
        TimeAction::Slower => speed(at.and_then(|i| i.checked_sub(1))),
        TimeAction::Faster => speed(at.map(|i| i + 1)),
        TimeAction::Continue => (model.tick < model.frontier).then_some(TransportCommand::ContinueFromHere),
        TimeAction::Reset => Some(TransportCommand::Reset),
        TimeAction::ReRoll => Some(TransportCommand::ReRoll),
        TimeAction::Why => None,
    };
    commands.extend(command.map(Command::from));
}

/// Width below which the bar takes two rows and a menu, points, and how many signs it holds else.
const ONE_ROW: f32 = 1020.0;
const GROUPED: f32 = 8.0;

/// Width of the note beside the time, points.
const NOTE: f32 = 180.0;

/// Width of the menu beside the signs of a narrow screen, points; of the time alone, and of seed, time and tick.
const MENU: f32 = 60.0;
const TIME: f32 = 60.0;
const SEED_AND_TIME: f32 = 270.0;

/// Shows the time line and the bar under it, on a `narrow` screen in more rows.
pub fn transport_bar(
    ui: &mut Ui,
    model: &Dashboard,
    history: &History,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let narrow = look.narrow;
    let top = ui.available_rect_before_wrap().top();
    let wheel = !state.screen.embedded;
    let line = TimeLine { model, history, look, wheel, chance: state.chance.as_ref() };
    line.show(ui, &mut state.span, commands);
    ui.spacing_mut().item_spacing.x = if narrow { 5.0 } else { 6.0 };
    if look.low {
        // a low window has no room for two rows
        ui.horizontal(|ui| {
            essential(ui, model, look, (SEED_AND_TIME, false), state, commands);
            seed_and_time(ui, model, look, top, state, commands);
        });
    } else if narrow {
        ui.horizontal(|ui| {
            essential(ui, model, look, (TIME, true), state, commands);
            time(ui, model, look);
        });
    } else if ui.available_width() < ONE_ROW + GROUPED * (sign_width(ui) - SIGN) {
        ui.horizontal(|ui| essential(ui, model, look, (0.0, false), state, commands));
        ui.horizontal(|ui| seed_and_time(ui, model, look, top, state, commands));
    } else {
        ui.horizontal(|ui| {
            for group in GROUPS {
                buttons(ui, model, look, group, commands);
                ui.add_space(4.0);
            }
            for (label, action) in &MORE[2..] {
                button(ui, model, (LabButton::new(label), *action), look, commands);
            }
            ui.add_space(4.0);
            speed_choice(ui, model, commands);
            seed_and_time(ui, model, look, top, state, commands);
        });
    }
}

/// Shows the signs of a narrow screen for which there is room beside its menu and what else is in the row, `beside`
/// points wide. The menu has all the rest, and the seed if asked for.
fn essential(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    (beside, has_seed): (f32, bool),
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let (sign, gap) = (sign_width(ui), ui.spacing().item_spacing.x);
    let room = ui.available_width() - beside - MENU - (PLAY_WIDTH - sign);
    let count = (room / (sign + gap)).max(2.0) as usize;
    let (seen, hidden) = ESSENTIAL.split_at(count.min(ESSENTIAL.len()));
    buttons(ui, model, look, seen, commands);
    form(ui, "More", |ui| {
        let before = commands.len();
        for (label, action) in hidden.iter().map(|(label, _, action)| (*label, *action)).chain(MORE) {
            button(ui, model, (LabButton::new(label), action), look, commands);
        }
        if commands.len() > before {
            ui.close();
        }
        speed_choice(ui, model, commands);
        if has_seed {
            seed(ui, model, look, None, state, commands);
        }
    });
}

/// A button with its name and its sign.
type Signed = (&'static str, Icon, TimeAction);

const START: Signed = ("To the start", Icon::ToStart, TimeAction::Start);
const BACK: Signed = ("Back", Icon::Back, TimeAction::StepBack);
const PLAY: Signed = ("Play", Icon::Play, TimeAction::PlayPause);
const STEP: Signed = ("Step", Icon::Step, TimeAction::Step);
const NEXT: Signed = ("Next contact", Icon::NextContact, TimeAction::NextContact);
const LOOP: Signed = ("Loop", Icon::Loop, TimeAction::Loop);
const RESET: Signed = ("Reset", Icon::Reset, TimeAction::Reset);
const RE_ROLL: Signed = ("Re-roll", Icon::Die, TimeAction::ReRoll);

/// The signs of a wide screen, group after group.
const GROUPS: [&[Signed]; 2] = [&[START, BACK, PLAY, STEP, NEXT, LOOP], &[RESET, RE_ROLL]];

/// The signs that a narrow screen shows at once. It keeps the others, as words, in a menu.
const ESSENTIAL: [Signed; 6] = [BACK, PLAY, STEP, NEXT, RESET, RE_ROLL];
const MORE: [(&str, TimeAction); 4] = [
    ("To the start", TimeAction::Start),
    ("Loop", TimeAction::Loop),
    ("Why?", TimeAction::Why),
    ("Continue from here", TimeAction::Continue),
];

fn buttons(ui: &mut Ui, model: &Dashboard, look: &FrameColours, signs: &[Signed], commands: &mut Vec<Command>) {
    for &(label, icon, action) in signs {
        let shown = match action {
            TimeAction::PlayPause if model.playing => LabButton::new("Pause").icon(Icon::Pause).width(PLAY_WIDTH),
            TimeAction::PlayPause => LabButton::new(label).icon(icon).width(PLAY_WIDTH),
            _ => LabButton::new(label).icon(icon),
        };
        button(ui, model, (shown, action), look, commands);
    }
}

/// Width of the button that plays, points.
const PLAY_WIDTH: f32 = 56.0;

fn button(
    ui: &mut Ui,
    model: &Dashboard,
    (shown, action): (LabButton<'_>, TimeAction),
    look: &FrameColours,
    commands: &mut Vec<Command>,
) {
    let shown = match action {
        TimeAction::NextContact => shown.enabled(model.next_contact.is_some()),
        TimeAction::Continue => shown.enabled(model.tick < model.frontier),
        TimeAction::Why => shown.enabled(model.has_contact),
        TimeAction::Loop => shown.selected(model.looping),
        _ => shown,
    };
    // there is nothing to go on from at the end: the button keeps its place
    let is_seen = action != TimeAction::Continue || model.tick < model.frontier;
    let response = ui.scope(|ui| {
        if !is_seen {
            ui.set_invisible();
        }
        shown.show(ui, look)
    });
    if response.inner.on_hover_text(hint(action)).clicked() {
        act(action, model, commands);
    }
}

/// Shows the choice of speed.
fn speed_choice(ui: &mut Ui, model: &Dashboard, commands: &mut Vec<Command>) {
    let name = |speed: f64| SPEEDS.iter().find(|(s, _)| *s == speed).map_or("other", |(_, name)| name);
    let selected = if model.speed.is_infinite() { "fastest" } else { name(model.speed) };
    let choice = ComboBox::from_id_salt("speed").width(64.0).height(440.0).selected_text(selected).show_ui(ui, |ui| {
        for (speed, name) in SPEEDS {
            if ui.selectable_label(speed == model.speed, name).clicked() {
                commands.push(Command::from(TransportCommand::SetSpeed(speed)));
            }
        }
    });
    choice.response.widget_info(|| WidgetInfo {
        current_text_value: Some(selected.into()),
        ..WidgetInfo::labeled(WidgetType::ComboBox, true, "speed")
    });
    choice.response.on_hover_text(format!(
        "Simulated seconds per second: {}, {}",
        hint(TimeAction::Slower),
        hint(TimeAction::Faster)
    ));
}

/// Shows the seed, and at the right end the time. `top` is where the time line begins.
fn seed_and_time(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    top: f32,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    seed(ui, model, look, Some(top), state, commands);
    time(ui, model, look);
}

/// Shows the seed, and asks for a new one that is entered. Why a text is none stands beside the field or over `top`, in
/// a column without one under the field.
fn seed(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    top: Option<f32>,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    let mut show = |ui: &mut Ui| seed_field(ui, model, top, look, state);
    let entered = if top.is_some() { show(ui) } else { ui.horizontal(show).inner };
    if let Some(draft) = state.seed.as_ref().filter(|draft| top.is_none() && draft.is_refused) {
        refusal(ui, &no_seed(&draft.text), look);
    }
    commands.extend(entered.map(|seed| Command::from(TransportCommand::SetSeed(seed))));
}

/// Shows the time at the right end, where there is room with the tick and a note.
fn time(ui: &mut Ui, model: &Dashboard, look: &FrameColours) {
    let is_short = ui.available_width() < 170.0;
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let seconds = DT * model.tick as f64;
        let time = if is_short { format!("{seconds:.2} s") } else { format!("{seconds:7.2} s  tick {:5}", model.tick) };
        ui.label(RichText::new(time).monospace());
        // without room for both, the note is left out
        if let Some(behind) = model.behind.as_ref().filter(|_| ui.available_width() > NOTE) {
            ui.add_space(12.0);
            ui.label(RichText::new(behind).small().color(look.colour(Role::Text)));
        }
    });
}

/// Shows the seed as an editable field and returns a new one when Enter is pressed. Text that is no seed stays for
/// mending until it is a seed; Escape, a press beside the field and another run put the present seed back. The reason
/// stands beside the field, in a low row over `top`, so that it covers nothing of the time line.
fn seed_field(
    ui: &mut Ui,
    model: &Dashboard,
    top: Option<f32>,
    look: &FrameColours,
    state: &mut UiState,
) -> Option<Seed> {
    let label = ui.label("seed");
    let is_of_run = |draft: &SeedDraft| draft.of == model.seed && draft.frontier <= model.frontier;
    let draft = state.seed.take().filter(is_of_run);
    let was_refused = draft.as_ref().is_some_and(|draft| draft.is_refused);
    let mut text = draft.map_or_else(|| model.seed.0.to_string(), |draft| draft.text);
    let field = TextEdit::singleline(&mut text).desired_width(56.0).font(TextStyle::Monospace);
    let field = field.vertical_align(Align::Center).min_size(vec2(0.0, ui.spacing().interact_size.y));
    let mut output = field.show(ui);
    let response = output.response.response.labelled_by(label.id);
    if response.gained_focus() && !was_refused {
        // what is typed takes the place of what stands there; what was refused is mended
        output.state.cursor.set_char_range(Some(CCursorRange::select_all(&output.galley)));
        output.state.store(ui.ctx(), response.id);
    }
    let typed: Option<Seed> = text.trim().parse().map(Seed).ok();
    let entered = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    let is_left = ui.input(|i| i.key_pressed(Key::Escape) || i.pointer.any_pressed() && !response.contains_pointer());
    let is_refused = typed.is_none() && (was_refused || entered) && !is_left;
    if let Some(top) = top.filter(|_| is_refused) {
        let beside = response.rect.right_center() + vec2(2.0, 0.0);
        let width = ui.max_rect().right() - beside.x - TIME_ROOM;
        let place = if width >= REASON {
            PlateAnchor { at: beside, pivot: Align2::LEFT_CENTER, width }
        } else {
            PlateAnchor { at: pos2(label.rect.left(), top - 4.0), pivot: Align2::LEFT_BOTTOM, width: 340.0 }
        };
        plate(ui.ctx(), "seed", place, false, look, |ui| refusal(ui, &no_seed(&text), look));
    }
    if is_refused || response.has_focus() {
        state.seed = Some(SeedDraft { text, of: model.seed, frontier: model.frontier, is_refused });
    }
    typed.filter(|new| entered && *new != model.seed)
}

/// Why a text is no seed.
fn no_seed(text: &str) -> String {
    format!("{}: a seed is a whole number from 0 to {}", text.trim(), u64::MAX)
}
