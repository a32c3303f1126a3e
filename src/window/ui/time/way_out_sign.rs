//! The last chance to avoid a contact, on the time line: a band that leads to the contact, and a sign that plays.

use bevy_egui::egui::{CursorIcon, Rect, Sense, Shape, Stroke, Ui, WidgetInfo, WidgetType, pos2, vec2};

use crate::window::ui::{FrameColours, ShownChance};
use motion_lab_core::picture::Role;
use motion_lab_sim::run::seconds;

/// Half the width of the sign, points, and of what is pointed at.
const HALF: f32 = 4.5;
const POINTED: f32 = 10.0;

/// Shows the ticks from the last chance to the contact as a band of a lane, with a flag at the last chance; `x` is
/// where a tick is. Returns whether the way out is asked for.
pub fn way_out_sign(ui: &Ui, chance: &ShownChance, lane: Rect, x: impl Fn(u64) -> f32, look: &FrameColours) -> bool {
    let Some(way_out) = &chance.way_out else { return false };
    let (from, to) = (x(way_out.tick), x(chance.contact));
    let band = Rect::from_x_y_ranges(from..=to, lane.center().y - 1.5..=lane.center().y + 1.5);
    ui.painter().rect_filled(band.intersect(lane), 0.0, look.tint(Role::Goal, 0.5));
    if !lane.x_range().contains(from) {
        return false;
    }
    // a triangle that points on, as the sign that plays
    let at = pos2(from, lane.center().y);
    let corners = [vec2(-HALF, -HALF), vec2(HALF, 0.0), vec2(-HALF, HALF)].map(|d| at + d);
    ui.painter().add(Shape::convex_polygon(corners.to_vec(), look.colour(Role::Free), Stroke::NONE));
    let pointed = Rect::from_center_size(at, vec2(POINTED, lane.height()));
    let response = ui.interact(pointed, ui.id().with("way out"), Sense::click());
    let words = format!("play the way out, from {:.2} s on", seconds(way_out.tick));
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, &words));
    response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(words.clone()).clicked()
}
