//! The dashboard: the stage with its cockpits, the plots beside it, and the transport bar under both.

use bevy_egui::egui::{CentralPanel, Frame, Margin, Panel, Rect, Ui};

use super::hand::drive;
use super::in_hand::{chosen, take_in_hand};
use super::plots::plots;
use super::stage::{self, GAP, Stage};
use crate::window::ui::keys::{CameraAction, HandAction};
use crate::window::ui::paint::camera::{Camera, STEP};
use crate::window::ui::paint::frame;
use crate::window::ui::time::transport_bar::transport_bar;
use crate::window::ui::{Command, Dashboard, FrameColours, Notice, UiState, menu};
use motion_lab_sim::manifest::Widget;
use motion_lab_sim::simulation::History;

/// Width of the panel of plots at the side, points.
const SHEET: f32 = 320.0;

/// Gap between the row of title and buttons and what is under it, points.
const UNDER_HEAD: i8 = 4;

/// Shows the dashboard over what is left of `ui`; what is pressed is pushed onto `commands`. Returns the rectangle of
/// the panes.
pub fn dashboard(
    ui: &mut Ui,
    model: &Dashboard,
    history: &History,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) -> Rect {
    if let Some((name, goal)) = &mut state.goal
        && let Some((_, car)) = model.robot(name)
    {
        goal.watch(car, model.tick, history);
    }
    let narrow = look.narrow;
    let side = if narrow { 12 } else { GAP as i8 };
    let above = if look.low { 6 } else { 14 };
    Panel::bottom("transport")
        .frame(Frame::NONE.inner_margin(Margin::symmetric(side, if look.low { 4 } else { 8 })))
        .show(ui, |ui| transport_bar(ui, model, history, look, state, commands));
    let has_head = !narrow && !state.screen.fills;
    if has_head {
        // over the plots too, which move none of its buttons when they come and go
        let margin = Margin { left: side, right: side, top: above, bottom: 0 };
        Panel::top("head")
            .frame(Frame::NONE.inner_margin(margin))
            .show_separator_line(false)
            .show(ui, |ui| menu::header(ui, Widget::Dashboard.text(), model, look, state, commands));
    }
    if state.settings.plots && has_head {
        let margin = Margin { left: 12, right: side, top: UNDER_HEAD, bottom: 0 };
        Panel::right("sheet")
            .exact_size(SHEET)
            .resizable(false)
            .frame(Frame::NONE.inner_margin(margin))
            .show(ui, |ui| plots(ui, model, history, look, state, commands));
    }
    if !look.low && !state.screen.fills {
        frame::sentence(ui, model, side, look, state);
    }
    let margin = Margin { top: if has_head { UNDER_HEAD } else { above }, ..Margin::symmetric(side, above) };
    let panel = CentralPanel::default().frame(Frame::NONE.inner_margin(margin)).show(ui, |ui| {
        let has_plots = narrow && state.settings.plots && !state.screen.fills;
        let has_crowd = model.cockpits.iter().any(|cockpit| cockpit.crowd.is_some());
        // in a low room the head stands beside the picture
        let is_beside = look.low && !has_plots && !has_crowd && !model.cockpits.is_empty();
        if narrow && !state.screen.fills && !is_beside {
            stage::header(ui, model, look, state, commands);
            ui.add_space(8.0);
        }
        if has_plots {
            plots(ui, model, history, look, state, commands);
        } else {
            Stage { model, history, look }.show(ui, state, commands);
        }
    });
    panel.response.rect
}

/// Carries out an action on the view of the world in front.
pub fn turn_to(action: CameraAction, model: &Dashboard, state: &mut UiState) {
    let Some((_, cockpit)) = stage::front(&model.cockpits, state) else { return };
    let camera = state.cameras.entry(cockpit.world.name.clone()).or_default();
    match action {
        CameraAction::Magnify => camera.magnify(STEP, &cockpit.world.bounds),
        CameraAction::ShowMore => camera.magnify(1.0 / STEP, &cockpit.world.bounds),
        CameraAction::Fit => *camera = Camera::default(),
    }
}

/// Takes a pane's robot in hand, or lets go.
pub fn take(action: HandAction, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let pane = match action {
        HandAction::LetGo => return drive::let_go(state, commands),
        HandAction::Arm(pane) => pane,
    };
    let Some(cockpit) = model.cockpits.get(pane) else {
        let text = format!("the run has no world number {}", pane + 1);
        return state.say(Notice { text, is_error: false });
    };
    state.settings.world = pane as u32;
    // a narrow screen shows either the plots or a pane
    state.settings.plots &= !state.screen.is_narrow;
    if let Some(crowd) = cockpit.crowd.as_ref().filter(|crowd| state.crowd.picked_in(crowd).is_none()) {
        state.crowd.pick(crowd, Some(crowd.first));
    }
    take_in_hand(cockpit, chosen(cockpit, state), state, commands);
}
