//! Plates: words that lie over what is in front and move nothing of it; and refusals, which have a mark of their own.

use bevy_egui::egui::{
    Align2, Area, Context, Frame, Id, Label, Margin, Order, Pos2, RichText, Sense, Stroke, Ui, vec2,
};

use crate::window::ui::FrameColours;
use crate::window::ui::paint::style::ScreenTheme;
use motion_lab_core::picture::Role;

/// Where a plate lies.
#[derive(Clone, Copy, Debug)]
pub struct PlateAnchor {
    /// The point that it is anchored at.
    pub at: Pos2,
    /// The corner or edge of the plate that lies there.
    pub pivot: Align2,
    /// Its largest width, points.
    pub width: f32,
}

/// Shows a plate, always within the screen. Only one with a control in it `takes` the pointer: others lie over what
/// can be clicked.
pub fn plate<R>(
    ctx: &Context,
    name: &str,
    place: PlateAnchor,
    takes: bool,
    look: &FrameColours,
    add: impl FnOnce(&mut Ui) -> R,
) -> R {
    let (width, margin) = (place.width.max(40.0), Margin::symmetric(8, 4));
    let area = Area::new(Id::new(("plate", name))).order(Order::Middle).pivot(place.pivot).fixed_pos(place.at);
    // words are read at once
    let area = area.fade_in(false);
    let frame = Frame::NONE.fill(look.theme.colour(Role::Paper)).inner_margin(margin).corner_radius(3);
    let edge = Stroke::new(1.0, look.theme.colour(Role::Muted));
    let shown = area.interactable(takes).show(ctx, |ui| {
        ui.set_max_width(width);
        frame.stroke(edge).show(ui, add).inner
    });
    shown.inner
}

/// Shows why something was refused, in whole: a ring with a stroke, and the words in the text's colour. Red is kept for
/// contact.
pub fn refusal(ui: &mut Ui, words: &str, look: &FrameColours) {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        mark(ui, look);
        let text = RichText::new(words).color(look.theme.colour(Role::Text));
        ui.add(Label::new(text).wrap());
    });
}

/// The mark of a refusal.
fn mark(ui: &mut Ui, look: &FrameColours) {
    let (rect, _) = ui.allocate_exact_size(vec2(14.0, 16.0), Sense::hover());
    let stroke = Stroke::new(1.5, look.theme.colour(Role::Text));
    let (at, painter) = (rect.center(), ui.painter());
    painter.circle_stroke(at, 6.0, stroke);
    painter.line_segment([at - vec2(0.0, 3.5), at + vec2(0.0, 0.5)], stroke);
    painter.circle_filled(at + vec2(0.0, 3.0), 1.0, stroke.color);
}
