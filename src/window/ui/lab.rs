//! The lab: a rail with the widgets, and the one that is in front.

use std::sync::Arc;

use bevy_egui::egui::{CentralPanel, Frame, Margin, Panel, Ui, Vec2, vec2};

use super::anatomy::in_front::hand_on;
use super::dashboard::{self, hand::drive};
use super::keys::{Action, Situation, pressed};
use super::paint::button::LabButton;
use super::paint::frame;
use super::paint::icon::Icon;
use super::paint::style::ScreenTheme;
use super::time::transport_bar;
use super::{
    Command, Dashboard, FrameColours, Grasp, SessionCommand, UiState, anatomy, atlas, capture_form, cspace, help,
    lesson, menu, plan, tasks_done,
};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::simulation::{History, TransportCommand};

/// Width below which a widget shows one thing at a time, points.
const NARROW: f32 = 720.0;

/// Height below which a window that is wider than high has its words beside the picture, points.
const LOW: f32 = 440.0;

/// The same for a narrow window, and where controls are as large as a fingertip.
const LOW_AND_NARROW: f32 = 600.0;

/// Width of the rail, points.
const RAIL: f32 = 76.0;

/// Shows the lab over the whole of `ui`; what is pressed is pushed onto `commands`.
pub fn lab(ui: &mut Ui, model: &Dashboard, history: &History, state: &mut UiState, commands: &mut Vec<Command>) {
    let size = ui.max_rect().size();
    state.pointer.is_touched |= ui.input(|i| i.any_touches());
    // whatever brought the dashboard to the front, no run waits there
    state.played &= state.widget != Widget::Dashboard;
    let is_cramped = state.pointer.is_touched || size.x < NARROW;
    let low = size.y < if is_cramped { LOW_AND_NARROW } else { LOW } && size.x > size.y;
    let narrow = size.x < NARROW || low;
    state.screen.is_narrow = narrow;
    let look = FrameColours::of(ui, state, narrow, low);
    // where there is no height to spare, controls are as small as a mouse allows
    let mut style = look.theme.style(narrow && !low || state.pointer.is_touched);
    if state.has_reduced_motion() {
        style.animation_time = 0.0;
    }
    let style = Arc::new(style);
    if ui.ctx().global_style() != style {
        // hints and lists pop up outside of `ui`
        ui.ctx().set_global_style(Arc::clone(&style));
    }
    ui.set_style(style);
    // a press is dated by the frame before it, which while nothing moves may be long ago: none is too long for a click
    ui.ctx().options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
    if state.focus.dialog {
        // nothing behind a dialog keeps the focus, and with it the keys
        ui.disable();
    }
    let now = Situation {
        armed: state.hand.armed.is_some(),
        nudged: state.focus.nudged.is_some(),
        atlas: state.widget == Widget::Atlas,
        paper: std::mem::take(&mut state.focus.paper),
        typing: state.focus.typing,
    };
    let actions = if state.is_covered() { vec![] } else { pressed(ui, now) };
    for action in actions {
        carry_out(action, model, state, commands);
    }
    lesson::make_ready(model, state, commands);
    state.focus.nudged = None;
    // a picture in front says anew what of it is pointed at
    state.pointer.over = None;
    if state.widget != Widget::Atlas {
        state.atlas.put_down();
    }
    if state.widget != Widget::Anatomy {
        // Space moves the same robot
        state.anatomy.pressed = None;
    }
    state.focus.grasp = state.focus.next_grasp.take();
    // no fill: the window is cleared to the paper's colour already, and a fill would cost as much as all that is drawn
    let margin = Margin::symmetric(if narrow && !low { 8 } else { 6 }, if narrow { 4 } else { 14 });
    state.screen.fills &= !model.cockpits.is_empty();
    if state.screen.embedded || state.screen.fills && state.widget == Widget::Dashboard {
        // the page chose the widget, or the picture has all the room
    } else if narrow && !low {
        Panel::top("rail").frame(Frame::NONE.inner_margin(margin)).show_separator_line(false).show(ui, |ui| {
            // all of them fit, however narrow the screen
            let gaps = ui.spacing().item_spacing.x * (Widget::ALL.len() - 1) as f32;
            let width = (ui.available_width() - gaps) / Widget::ALL.len() as f32;
            let size = vec2(width.clamp(0.0, RAIL - 12.0), 44.0);
            ui.horizontal(|ui| rail(ui, model, &look, size, state, commands));
        });
    } else {
        let frame = Frame::NONE.inner_margin(margin);
        Panel::left("rail").exact_size(RAIL).resizable(false).frame(frame).show(ui, |ui| {
            ui.vertical_centered(|ui| rail(ui, model, &look, vec2(RAIL - 12.0, 50.0), state, commands));
        });
    }
    let stage = if state.widget == Widget::Dashboard {
        if !state.is_covered() {
            drive::drive(ui, model, state, commands);
        } else if state.hand.tow.is_some() {
            drive::let_go(state, commands);
        }
        dashboard::twins::go_on(model, state, commands);
        dashboard::view::dashboard(ui, model, history, &look, state, commands)
    } else {
        let side = if narrow { 12 } else { 20 };
        if !low {
            frame::sentence(ui, model, side, &look, state);
        }
        let margins = Frame::NONE.inner_margin(Margin::symmetric(side, if low { 6 } else { 14 }));
        let panel = CentralPanel::default().frame(margins).show(ui, |ui| match state.widget {
            Widget::Anatomy => anatomy::view::anatomy_view(ui, model, &look, state, commands),
            Widget::Cspace => cspace::view::cspace_view(ui, model, &look, state, commands),
            Widget::Plan => plan::view::plan_view(ui, model, &look, state, commands),
            Widget::Atlas | Widget::Dashboard => atlas::view::atlas_view(ui, model, &look, state, commands),
        });
        panel.response.rect
    };
    let now = ui.input(|i| i.time);
    tasks_done::tick_off(model, state, commands, now);
    menu::notice(ui.ctx(), stage, &look, state);
    if state.chance.as_mut().is_some_and(|chance| std::mem::take(&mut chance.is_asked)) {
        commands.push(Command::Session(SessionCommand::PlayWayOut));
    }
    help::help(ui.ctx(), state);
    capture_form::capture_form(ui.ctx(), model, &look, state, commands);
    super::closing::closing(ui.ctx(), &look, state, commands);
    frame::focus_ring(ui.ctx(), &look);
    state.focus.typing = ui.ctx().text_edit_focused();
    if state.pointer.pointed.is_some() || state.pointer.lit.is_some() {
        // the fade goes on without further input
        ui.ctx().request_repaint();
    }
}

/// Carries out the action of a key, each by the part that it concerns.
fn carry_out(action: Action, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let is_dashboard = state.widget == Widget::Dashboard;
    match action {
        Action::Time(action) => match state.widget {
            Widget::Dashboard => transport_bar::act(action, model, commands),
            Widget::Plan => plan::controls::act(action, &mut state.plan),
            // nothing there moves through time
            Widget::Anatomy | Widget::Cspace | Widget::Atlas => {}
        },
        Action::Session(action) => match state.widget {
            Widget::Atlas => atlas::view::act(action, model, state, commands),
            Widget::Plan => plan::view::act(action, model, state, commands),
            Widget::Dashboard | Widget::Anatomy | Widget::Cspace => menu::act(action, model, state, commands),
        },
        Action::Hand(action) if is_dashboard => dashboard::view::take(action, model, state, commands),
        Action::Camera(action) if is_dashboard => dashboard::view::turn_to(action, model, state),
        Action::Hand(_) | Action::Camera(_) => {}
        Action::Atlas(action) => atlas::view::act_on_thing(action, &mut state.atlas),
        // whoever has the robot in hand reads these keys
        Action::Held(_) => {}
        Action::Widget(widget) => choose(widget, model, state, commands),
    }
}

/// Shows a button of this size for each widget.
fn rail(
    ui: &mut Ui,
    model: &Dashboard,
    look: &FrameColours,
    size: Vec2,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    ui.spacing_mut().button_padding = vec2(4.0, 2.0);
    ui.spacing_mut().interact_size.y = size.y;
    for widget in Widget::ALL {
        let words = widget.text();
        let button = LabButton::new(words.short()).over_words(Icon::of(widget)).width(size.x);
        let button = button.selected(state.widget == widget);
        if button.show(ui, look).on_hover_text(&words.title).clicked() {
            choose(widget, model, state, commands);
        }
    }
}

/// Puts a widget in front, with the robot that was in front, and lets go of the robot in hand. A run waits while the
/// dashboard is not in front, and then plays on if it did before.
fn choose(widget: Widget, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    if widget == Widget::Dashboard {
        if std::mem::take(&mut state.played) && !model.playing {
            commands.push(Command::from(TransportCommand::Play));
        }
    } else if model.playing {
        state.played = true;
        commands.push(Command::from(TransportCommand::Pause));
    }
    hand_on(widget, model, state);
    drive::let_go(state, commands);
    state.focus.next_grasp = Some(Grasp::Leave);
    state.widget = widget;
}
