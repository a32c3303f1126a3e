//! The time line: where the run stands, a handle to any tick it has reached, and marks where something happened.

use bevy_egui::egui::{Rect, Sense, Shape, Slider, Stroke, Ui, WidgetInfo, WidgetType, pos2, vec2};

use crate::picture::Role;
use crate::simulation::{Happening, History, TickMark, TransportCommand};
use crate::ui::{Command, Dashboard, Look};

/// Height of the strip of marks, points.
const STRIP: f32 = 10.0;

/// Shows the line over the whole width. Clicking and dragging seek; so do the arrow keys while it has the focus.
pub fn time_line(ui: &mut Ui, model: &Dashboard, history: &History, look: &Look, commands: &mut Vec<Command>) {
    let end = model.frontier.max(model.tick);
    let (strip, _) = ui.allocate_exact_size(vec2(ui.available_width(), STRIP), Sense::hover());
    let mut tick = model.tick;
    ui.spacing_mut().slider_width = ui.available_width();
    let line = Slider::new(&mut tick, 0..=end.max(1)).show_value(false).trailing_fill(true).step_by(1.0);
    let response = ui.add_enabled(end > 0, line);
    response.widget_info(|| WidgetInfo::slider(end > 0, model.tick as f64, "time line, in ticks"));
    // the slider's handle keeps off the ends by its radius
    let radius = response.rect.height() / 2.5;
    let across = Rect::from_x_y_ranges(strip.x_range().shrink(radius), strip.y_range());
    marks(ui, model, history.marks(), across, end, look, commands);
    if response.changed() && tick != model.tick {
        commands.push(Command::from(TransportCommand::Seek(tick.min(end))));
    }
}

/// Shows contacts as crosses and takeovers as diamonds, at least three points apart for each kind. A click on a mark
/// goes to its tick.
fn marks(
    ui: &mut Ui,
    model: &Dashboard,
    marks: &[TickMark],
    strip: Rect,
    end: u64,
    look: &Look,
    commands: &mut Vec<Command>,
) {
    let x = |tick: u64| strip.left() + strip.width() * (tick as f32 / end.max(1) as f32);
    let mut last = [f32::NEG_INFINITY; 2];
    for mark in marks {
        let (kind, role) = match mark.what {
            Happening::Contact => (0, Role::Goal),
            Happening::Takeover => (1, Role::Focus),
        };
        let at = pos2(x(mark.tick), strip.center().y);
        if at.x - last[kind] < 3.0 {
            continue;
        }
        last[kind] = at.x;
        let stroke = Stroke::new(1.5, look.colour(role));
        if mark.what == Happening::Contact {
            ui.painter().line_segment([at - vec2(3.0, 3.0), at + vec2(3.0, 3.0)], stroke);
            ui.painter().line_segment([at + vec2(-3.0, 3.0), at + vec2(3.0, -3.0)], stroke);
        } else {
            let corners = [vec2(0.0, -4.5), vec2(4.5, 0.0), vec2(0.0, 4.5), vec2(-4.5, 0.0)].map(|d| at + d);
            ui.painter().add(Shape::convex_polygon(corners.to_vec(), look.colour(role), Stroke::NONE));
        }
    }
    // one response for all marks, whatever their number
    let response = ui.interact(strip, ui.id().with("marks"), Sense::click());
    response.widget_info(|| {
        let contacts = marks.iter().filter(|m| m.what == Happening::Contact).count();
        let words = format!("{contacts} contacts and {} takeovers so far", marks.len() - contacts);
        WidgetInfo::labeled(WidgetType::Button, true, words)
    });
    let nearest = response.hover_pos().and_then(|pointer| {
        let off = |m: &&TickMark| (x(m.tick) - pointer.x).abs();
        marks.iter().min_by(|a, b| off(a).total_cmp(&off(b))).filter(|m| off(m) < 6.0)
    });
    if let Some(mark) = nearest {
        let name = model.name_of(mark.robot).unwrap_or("a robot");
        let words = match mark.what {
            Happening::Contact => format!("tick {}: {name} touches something", mark.tick),
            Happening::Takeover => format!("tick {}: {name} is taken over", mark.tick),
        };
        if response.clicked() {
            commands.push(Command::from(TransportCommand::Seek(mark.tick)));
        }
        response.on_hover_text(words);
    }
}
