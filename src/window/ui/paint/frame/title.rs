//! A widget's title, the misconception it removes, and its colour key.

use bevy_egui::egui::{
    Color32, FontId, Label, RichText, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, WidgetType, vec2,
};

use crate::window::ui::paint::style::ScreenTheme;
use crate::window::ui::{FrameColours, UiState};
use motion_lab_core::picture::Role;
use motion_lab_sim::manifest::{Widget, WidgetText};

/// Shows the title. It does not fade when a role is lit.
pub fn name(ui: &mut Ui, widget: &WidgetText, look: &FrameColours) {
    let heading =
        ui.label(RichText::new(&widget.title).text_style(TextStyle::Heading).color(look.theme.colour(Role::Text)));
    // the widget's description, for screen readers
    heading.widget_info(|| {
        WidgetInfo::labeled(WidgetType::Label, true, format!("{}. {}", widget.title, widget.description))
    });
}

/// Shows the title and beside it the colour key, under it where there is no room.
pub fn name_and_key(ui: &mut Ui, widget: &WidgetText, look: &FrameColours, state: &mut UiState) {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Heading) + 2.0;
        ui.horizontal_wrapped(|ui| {
            name(ui, widget, look);
            ui.add_space(12.0);
            key(ui, widget, look, state);
        });
    });
}

/// Shows the misconception that a widget removes.
pub fn misconception(ui: &mut Ui, widget: &WidgetText, look: &FrameColours) {
    ui.add(Label::new(RichText::new(&widget.misconception).color(look.theme.colour(Role::Muted))).wrap());
}

/// Shows the number that matters, large.
pub fn headline(ui: &mut Ui, words: &str, colour: Color32) {
    ui.add(Label::new(RichText::new(words).text_style(TextStyle::Heading).color(colour)).wrap());
}

/// Shows the colour key in a row of its own.
pub fn key_row(ui: &mut Ui, widget: &WidgetText, look: &FrameColours, state: &mut UiState) {
    ui.add_space(2.0);
    rows_of_words(ui, |ui| key(ui, widget, look, state));
}

/// Lays out rows that wrap and are as high as their words, not as buttons.
pub fn rows_of_words<R>(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Body) + 2.0;
        ui.horizontal_wrapped(add).inner
    })
    .inner
}

/// Shows the colour key. Pointing at an entry, or stepping to it by Tab, lights its role.
fn key(ui: &mut Ui, widget: &WidgetText, look: &FrameColours, state: &mut UiState) {
    ui.spacing_mut().item_spacing.x = 12.0;
    let has_two_links = state.anatomy.anatomy.lengths().is_some();
    for entry in widget.key.iter().filter(|entry| has_two_links || !entry.arm) {
        let role = entry.role();
        let share = state.cspace.share(role).filter(|_| state.widget == Widget::Cspace && !look.narrow);
        let words = share.map_or_else(|| entry.text.clone(), |share| format!("{} {share}", entry.text));
        let text = ui.painter().layout_no_wrap(words.clone(), small(ui), look.colour(Role::Text));
        let size = vec2(text.size().x + 16.0, text.size().y + 4.0);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("colour key: {words}")));
        swatch(ui, role, rect.left_center() + vec2(5.0, 0.0), look);
        ui.painter().galley(rect.left_center() + vec2(16.0, -0.5 * text.size().y), text, look.colour(Role::Text));
        points_at(state, &response, role);
    }
}

/// Paints a role's sample as the pictures draw it, so that not only colour tells roles apart.
fn swatch(ui: &Ui, role: Role, at: bevy_egui::egui::Pos2, look: &FrameColours) {
    let (painter, colour) = (ui.painter(), look.colour(role));
    let line = Stroke::new(1.5, colour);
    let square = bevy_egui::egui::Rect::from_center_size(at, Vec2::splat(9.0));
    match role {
        Role::Obstacle => {
            painter.rect(square, 0.0, look.tint(role, 0.12), line, StrokeKind::Inside);
            for offset in [-3.0, 0.0, 3.0] {
                let d = 4.5 - f32::abs(offset);
                let c = at + vec2(offset, offset) * 0.5;
                painter.line_segment([c + vec2(-d, d) * 0.7, c + vec2(d, -d) * 0.7], Stroke::new(1.0, colour));
            }
        }
        Role::Sensor => {
            for dy in [-4.0, 0.0, 4.0] {
                painter.line_segment([at - vec2(5.0, 0.0), at + vec2(4.0, dy)], Stroke::new(1.0, colour));
                painter.circle_filled(at + vec2(4.0, dy), 1.2, colour);
            }
        }
        Role::Free => drop(painter.rect(square, 0.0, look.tint(role, 0.3), line, StrokeKind::Inside)),
        Role::Unknown => {
            for x in [-3.0, 0.0, 3.0] {
                for y in [-3.0, 0.0, 3.0] {
                    painter.circle_filled(at + vec2(x, y), 0.9, colour);
                }
            }
        }
        Role::Focus => drop(painter.rect_stroke(square, 0.0, Stroke::new(2.0, colour), StrokeKind::Inside)),
        Role::Goal => {
            // a contact is a ring in one picture, a cross in another
            painter.circle_stroke(at, 5.0, Stroke::new(1.2, colour));
            painter.line_segment([at - vec2(2.2, 2.2), at + vec2(2.2, 2.2)], line);
            painter.line_segment([at + vec2(-2.2, 2.2), at + vec2(2.2, -2.2)], line);
        }
        Role::Path | Role::Witness => drop(painter.line_segment([at - vec2(5.0, 0.0), at + vec2(5.0, 0.0)], line)),
        _ => drop(painter.circle_filled(at, 4.5, colour)),
    }
}

/// Lights a role in the next frame if something of it is pointed at or has the focus.
pub fn points_at(state: &mut UiState, response: &bevy_egui::egui::Response, role: Role) {
    if response.hovered() && rests(response) || response.has_focus() {
        state.pointer.pointed = Some(role);
    }
}

/// Whether the pointer has come to rest. Things that it only passes over light nothing.
pub fn rests(response: &bevy_egui::egui::Response) -> bool {
    const REST_SECONDS: f32 = 0.3;
    let still = response.ctx.input(|i| i.pointer.time_since_last_movement());
    if still < REST_SECONDS {
        response.ctx.request_repaint_after_secs(REST_SECONDS - still);
    }
    still >= REST_SECONDS
}

pub(super) fn small(ui: &Ui) -> FontId {
    TextStyle::Small.resolve(ui.style())
}

/// Height of a row of a list, points: for a mouse, or for a finger where controls are that high.
pub fn row_height(ui: &Ui) -> f32 {
    if ui.spacing().interact_size.y > 40.0 { 44.0 } else { 22.0 }
}
