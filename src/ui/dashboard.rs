//! The dashboard: the cockpits at once on a wide screen, one at a time on a narrow one.

use std::sync::Arc;

use bevy_egui::egui::{
    Align, CentralPanel, Frame, Layout, Margin, Panel, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind,
    TextStyle, Ui, UiBuilder, Vec2, WidgetInfo, WidgetType, pos2, vec2,
};

use super::drive::drive;
use super::transport_bar::transport_bar;
use super::{Cockpit, Command, Dashboard, Theme, UiState, canvas, readout, readout_lines};
use crate::picture::{Role, ScaleBar};
use crate::run::RobotInput;
use crate::simulation::RobotCommand;

/// Below this width the panes are shown one at a time.
const NARROW: f32 = 720.0;

/// From pane to pane, and from the panes to the window's border, points.
const GAP: f32 = 20.0;

/// The lines of a pane's readout that are kept free, so that panes do not jump when a trailer comes on.
const READOUT_LINES: usize = 3;

/// Shows the dashboard over the whole of `ui`; what is pressed is pushed onto `commands`.
pub fn dashboard(ui: &mut Ui, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let narrow = ui.max_rect().width() < NARROW;
    let style = Arc::new(state.theme.style(narrow));
    if ui.ctx().global_style() != style {
        // hints and lists pop up outside of `ui`
        ui.ctx().set_global_style(Arc::clone(&style));
    }
    ui.set_style(style);
    let paper = Frame::NONE.fill(state.theme.colour(Role::Paper));
    let bar = paper.inner_margin(Margin::symmetric(if narrow { 12 } else { GAP as i8 }, 10));
    let armed = drive(ui, model, state, commands);
    Panel::bottom("transport").frame(bar).show(ui, |ui| transport_bar(ui, model, state, (narrow, armed), commands));
    let margin = Margin::symmetric(if narrow { 12 } else { GAP as i8 }, 14);
    CentralPanel::default().frame(paper.inner_margin(margin)).show(ui, |ui| {
        header(ui);
        ui.add_space(10.0);
        if narrow { one_pane(ui, model, state, commands) } else { all_panes(ui, model, state, commands) }
    });
}

fn header(ui: &mut Ui) {
    ui.label(RichText::new("Dashboard").text_style(TextStyle::Heading));
    ui.label(RichText::new("A position is not a configuration: three robots, three spaces, three types.").weak());
}

fn one_pane(ui: &mut Ui, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (i, cockpit) in model.cockpits.iter().enumerate() {
            if ui.selectable_label(state.pane == i, cockpit.tab()).clicked() {
                state.pane = i;
            }
        }
    });
    ui.add_space(4.0);
    if let Some(cockpit) = model.cockpits.get(state.pane).or(model.cockpits.first()) {
        let rect = ui.available_rect_before_wrap();
        pane(ui, cockpit, rect, state, commands);
    }
}

fn all_panes(ui: &mut Ui, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    let count = model.cockpits.len();
    if count == 0 {
        ui.weak("No world is loaded.");
        return;
    }
    let columns = count.min(3);
    let room = ui.available_rect_before_wrap();
    let width = (room.width() - GAP * (columns as f32 - 1.0)) / columns as f32;
    let mut rows = |ui: &mut Ui, height: f32| {
        for row in model.cockpits.chunks(columns) {
            let (rect, _) = ui.allocate_exact_size(vec2(room.width(), height), Sense::hover());
            for (i, cockpit) in row.iter().enumerate() {
                let left = rect.left() + i as f32 * (width + GAP);
                let rect = Rect::from_min_size(pos2(left, rect.top()), vec2(width, height));
                pane(ui, cockpit, rect, state, commands);
            }
        }
    };
    if count == columns {
        rows(ui, room.height());
    } else {
        // more than three worlds do not fit a screen: only then is there something to scroll
        let height = (width + text_height(ui)).min(room.height());
        ScrollArea::vertical().show(ui, |ui| rows(ui, height));
    }
}

/// The height of what stands under a pane's paper.
fn text_height(ui: &Ui) -> f32 {
    let line = |style| ui.text_style_height(&style);
    8.0 + line(TextStyle::Body) + (line(TextStyle::Monospace) + 3.0) * (READOUT_LINES as f32 + 1.0)
}

/// One cockpit: its paper, as square as fits, and name, readout and contact count under it.
fn pane(ui: &mut Ui, cockpit: &Cockpit, rect: Rect, state: &mut UiState, commands: &mut Vec<Command>) {
    let theme = state.theme;
    let texts = text_height(ui) * cockpit.robots.len().clamp(1, 3) as f32;
    let height = (rect.height() - texts).min(rect.width()).max(60.0);
    let paper = Rect::from_min_size(rect.min, vec2(rect.width(), height));
    let response = ui.allocate_rect(paper, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Image, true, cockpit.described()));
    let fit = canvas::fit(&cockpit.world, paper);
    let painter = ui.painter_at(paper.expand(1.0));
    canvas::paint_still(&painter, &cockpit.world, &fit, theme);
    canvas::paint(&painter, &cockpit.robots_picture(), &fit, theme);
    let driven = cockpit.robots.iter().find(|r| r.drivable).map(|r| r.name.as_str());
    if response.clicked() {
        state.armed = driven.filter(|name| state.armed.as_deref() != Some(name)).map(str::to_owned);
    }
    let armed = driven.is_some() && state.armed.as_deref() == driven;
    let (width, role) = if armed { (2.0, Role::Focus) } else { (1.0, Role::Hairline) };
    painter.rect_stroke(paper, 0.0, Stroke::new(width, theme.colour(role)), StrokeKind::Inside);
    if driven.is_some() {
        let hint = if armed { "Arrow keys drive, Esc lets go" } else { "Click to drive" };
        response.on_hover_text_at_pointer(hint);
    }
    let below = Rect::from_min_max(pos2(rect.left(), paper.bottom() + 8.0), rect.max);
    let mut ui = ui.new_child(UiBuilder::new().max_rect(below).layout(Layout::top_down(Align::Min)));
    ui.spacing_mut().interact_size.y = 0.0; // no row of words is as high as a button
    ui.horizontal(|ui| {
        ui.label(cockpit.heading());
        if armed {
            ui.label(RichText::new("arrows drive, Esc lets go").color(theme.colour(Role::Focus)));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| scale_bar(ui, fit.px_per_metre(), theme));
    });
    for robot in &cockpit.robots {
        for line in readout_lines(&readout(&robot.readout)) {
            ui.label(RichText::new(line).monospace());
        }
        ui.horizontal(|ui| {
            let driver = if robot.manual { "  driven by hand" } else { "" };
            ui.label(RichText::new(format!("contacts: {}{driver}", robot.contacts)).monospace().weak());
            let mut press = |words: &str, input| {
                if ui.link(words).clicked() {
                    commands.push(Command::Robot(RobotCommand { robot: robot.name.clone(), input }));
                }
            };
            match robot.trailer {
                Some(true) => press("take the trailer off", RobotInput::SetTrailer(false)),
                Some(false) => press("put a trailer on", RobotInput::SetTrailer(true)),
                None => {}
            }
            if robot.manual {
                press("resume tour", RobotInput::Release);
            }
        });
    }
}

fn scale_bar(ui: &mut Ui, px_per_metre: f64, theme: Theme) {
    let bar = ScaleBar::new(px_per_metre, 80.0);
    let (rect, _) = ui.allocate_exact_size(Vec2::new(bar.length_px as f32, 7.0), Sense::hover());
    let stroke = Stroke::new(1.0, theme.colour(Role::Muted));
    let rect = rect.translate(vec2(-0.5, 0.0));
    ui.painter().hline(rect.x_range(), rect.center().y, stroke);
    ui.painter().vline(rect.left(), rect.y_range(), stroke);
    ui.painter().vline(rect.right(), rect.y_range(), stroke);
    ui.label(RichText::new(bar.label).small().weak());
}

#[cfg(test)]
mod tests;
