//! The scale bar under a picture in metres.

use bevy_egui::egui::{RichText, Sense, Stroke, Ui, Vec2, vec2};

use crate::picture::{Role, ScaleBar};
use crate::ui::Look;

/// Shows a bar of a round number of metres with its length.
pub fn scale_bar(ui: &mut Ui, px_per_metre: f64, look: &Look) {
    let bar = ScaleBar::new(px_per_metre, 80.0);
    let (rect, _) = ui.allocate_exact_size(Vec2::new(bar.length_px as f32, 7.0), Sense::hover());
    let stroke = Stroke::new(1.0, look.colour(Role::Muted));
    let rect = rect.translate(vec2(-0.5, 0.0));
    ui.painter().hline(rect.x_range(), rect.center().y, stroke);
    ui.painter().vline(rect.left(), rect.y_range(), stroke);
    ui.painter().vline(rect.right(), rect.y_range(), stroke);
    ui.label(RichText::new(bar.label).small().color(look.colour(Role::Muted)));
}
