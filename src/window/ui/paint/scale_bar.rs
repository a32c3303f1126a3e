//! The scale bar of a picture in metres.

use bevy_egui::egui::{Align2, Color32, Painter, Pos2, Rect, RichText, Sense, Stroke, TextStyle, Ui, Vec2, pos2, vec2};

use crate::window::ui::FrameColours;
use motion_lab_core::picture::{Role, ScaleBar};

/// Greatest length of a bar, points.
const LONGEST: f64 = 80.0;

/// Height of the marks at its ends, points.
const HIGH: f32 = 7.0;

/// Shows a bar of a round number of metres with its length.
pub fn scale_bar(ui: &mut Ui, px_per_metre: f64, look: &FrameColours) {
    let bar = ScaleBar::new(px_per_metre, LONGEST);
    let (rect, _) = ui.allocate_exact_size(Vec2::new(bar.length_px as f32, HIGH), Sense::hover());
    paint(ui.painter(), rect, look);
    ui.label(RichText::new(bar.label).small().color(look.colour(Role::Muted)));
}

/// Paints such a bar with its length on a picture, from its lower left end at `corner` on, on a plate of paper.
pub fn bar_at(ui: &Ui, painter: &Painter, corner: Pos2, px_per_metre: f64, look: &FrameColours) {
    let bar = ScaleBar::new(px_per_metre, LONGEST);
    let rect = Rect::from_min_size(pos2(corner.x, corner.y - HIGH), vec2(bar.length_px as f32, HIGH));
    let galley = painter.layout_no_wrap(bar.label, TextStyle::Small.resolve(ui.style()), look.colour(Role::Muted));
    let words = Align2::LEFT_CENTER.anchor_size(rect.right_center() + vec2(6.0, 0.0), galley.size());
    painter.rect_filled(rect.union(words).expand2(vec2(4.0, 1.0)), 0.0, look.tint(Role::Paper, 0.85));
    paint(painter, rect, look);
    painter.galley(words.min, galley, Color32::PLACEHOLDER);
}

fn paint(painter: &Painter, rect: Rect, look: &FrameColours) {
    let stroke = Stroke::new(1.0, look.colour(Role::Muted));
    let rect = rect.translate(vec2(-0.5, 0.0));
    painter.hline(rect.x_range(), rect.center().y, stroke);
    painter.vline(rect.left(), rect.y_range(), stroke);
    painter.vline(rect.right(), rect.y_range(), stroke);
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::{Context, RawInput, Shape};

    use super::*;
    use motion_lab_core::picture::Theme;

    #[test]
    fn a_bar_on_a_picture_stands_on_paper() {
        let mut output = Context::default().run_ui(RawInput::default(), |ui| {
            bar_at(ui, ui.painter(), pos2(50.0, 80.0), 40.0, &FrameColours::from(Theme::Light));
        });
        output.textures_delta.clear();
        let shapes: Vec<Shape> = output.shapes.into_iter().map(|clipped| clipped.shape).collect();
        let plate = shapes.iter().position(|shape| matches!(shape, Shape::Rect(_))).unwrap();
        let words = shapes.iter().position(|shape| matches!(shape, Shape::Text(_))).unwrap();
        assert!(plate < words, "the plate is below");
        let under = shapes[plate].visual_bounding_rect();
        for shape in &shapes[plate + 1..] {
            assert!(under.contains_rect(shape.visual_bounding_rect().shrink(0.5)), "{shape:?} is off {under}");
        }
        // at 40 points a metre the longest round number within 80 points is 2 m
        let long = shapes.iter().filter(|shape| matches!(shape, Shape::LineSegment { .. }));
        let width = long.map(|line| line.visual_bounding_rect().width()).fold(0.0, f32::max);
        assert!((width - 80.0).abs() < 2.0, "{width}");
    }
}
