//! The scale bar of a picture in metres.

use bevy_egui::egui::{Align2, Painter, Pos2, Rect, RichText, Sense, Stroke, TextStyle, Ui, Vec2, pos2, vec2};

use crate::picture::{Role, ScaleBar};
use crate::ui::Look;

/// Greatest length of a bar, points.
const LONGEST: f64 = 80.0;

/// Height of the marks at its ends, points.
const HIGH: f32 = 7.0;

/// Shows a bar of a round number of metres with its length.
pub fn scale_bar(ui: &mut Ui, px_per_metre: f64, look: &Look) {
    let bar = ScaleBar::new(px_per_metre, LONGEST);
    let (rect, _) = ui.allocate_exact_size(Vec2::new(bar.length_px as f32, HIGH), Sense::hover());
    paint(ui.painter(), rect, look);
    ui.label(RichText::new(bar.label).small().color(look.colour(Role::Muted)));
}

/// Paints such a bar with its length on a picture, from its lower left end at `corner` on.
pub fn bar_at(ui: &Ui, painter: &Painter, corner: Pos2, px_per_metre: f64, look: &Look) {
    let bar = ScaleBar::new(px_per_metre, LONGEST);
    let rect = Rect::from_min_size(pos2(corner.x, corner.y - HIGH), vec2(bar.length_px as f32, HIGH));
    paint(painter, rect, look);
    let (at, font) = (rect.right_center() + vec2(6.0, 0.0), TextStyle::Small.resolve(ui.style()));
    painter.text(at, Align2::LEFT_CENTER, bar.label, font, look.colour(Role::Muted));
}

fn paint(painter: &Painter, rect: Rect, look: &Look) {
    let stroke = Stroke::new(1.0, look.colour(Role::Muted));
    let rect = rect.translate(vec2(-0.5, 0.0));
    painter.hline(rect.x_range(), rect.center().y, stroke);
    painter.vline(rect.left(), rect.y_range(), stroke);
    painter.vline(rect.right(), rect.y_range(), stroke);
}
