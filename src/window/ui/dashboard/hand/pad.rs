//! The pad on the screen: drives the robot in hand by a fingertip or the mouse.

use bevy_egui::egui::{CursorIcon, Id, Rect, Sense, Stroke, Ui, Vec2, WidgetInfo, WidgetType, pos2, vec2};

use crate::window::ui::{FrameColours, UiState};
use motion_lab_core::picture::Role;
use motion_lab_core::robots::CHANNEL_UNITS;

/// Diameter, points.
const SIZE: f32 = 104.0;
/// Distance from what stands beside it, points.
const GAP: f32 = 10.0;
/// Offset along an axis below which that channel is 0, as a fraction of the radius.
const DEAD: f32 = 0.12;

/// The channels for a pointer off the middle by `(right, up)`, in units of the radius: up is forward, left turns left.
pub fn channels(right: f32, up: f32) -> (i16, i16) {
    let channel = |part: f32| {
        let part = if part.abs() < DEAD { 0.0 } else { part.clamp(-1.0, 1.0) };
        (part * CHANNEL_UNITS as f32).round() as i16
    };
    (channel(up), channel(-right))
}

/// The place of the pad in the lower right corner of a paper.
pub fn corner(paper: Rect) -> Rect {
    Rect::from_min_max(paper.max - Vec2::splat(SIZE + GAP), paper.max - Vec2::splat(GAP))
}

/// The place of the pad at the right end of a room, and what is left of the room; `None` if that would be too narrow.
pub fn at_right_of(room: Rect) -> Option<(Rect, Rect)> {
    let (rest, right) = room.split_left_right_at_x(room.right() - SIZE - GAP);
    let centre = pos2(right.right() - 0.5 * SIZE, right.center().y);
    let is_roomy = room.height() >= SIZE && rest.width() >= 1.5 * SIZE;
    is_roomy.then(|| (Rect::from_center_size(centre, Vec2::splat(SIZE)), rest))
}

/// Shows the pad. Its channels are left in the state, where `drive` takes them. Returns whether it is pressed.
pub fn pad(ui: &mut Ui, robot: &str, rect: Rect, look: &FrameColours, state: &mut UiState) -> bool {
    let centre = rect.center();
    let response = ui.interact(rect, Id::new((robot, "pad")), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(WidgetType::Other, true, format!("{robot}: pad, up drives forward")));
    let radius = 0.5 * SIZE;
    let held = response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on());
    let off = held.map_or(Vec2::ZERO, |at| (at - centre) / radius);
    state.hand.pad = channels(off.x, -off.y);
    let painter = ui.painter_at(rect.expand(2.0));
    painter.circle(centre, radius, look.tint(Role::Paper, 0.35), Stroke::new(1.5, look.colour(Role::Focus)));
    for (x, y) in [(0.0, -1.0), (0.0, 1.0), (-1.0, 0.0), (1.0, 0.0)] {
        let out = vec2(x, y);
        let side = vec2(-y, x) * 7.0;
        let tip = centre + out * (radius - 8.0);
        let back = tip - out * 8.0;
        painter.line(vec![back + side, tip, back - side], Stroke::new(1.5, look.colour(Role::Focus)));
    }
    let at = centre + vec2(off.x, off.y).clamp(Vec2::splat(-1.0), Vec2::splat(1.0)) * (radius - 14.0);
    painter.circle_filled(at, 12.0, look.tint(Role::Focus, if held.is_some() { 1.0 } else { 0.5 }));
    response.on_hover_cursor(CursorIcon::Grab);
    held.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_is_forward_and_left_turns_left() {
        assert_eq!(channels(0.0, 1.0), (128, 0));
        assert_eq!(channels(-1.0, 0.0), (0, 128));
        assert_eq!(channels(0.5, -0.5), (-64, -64));
        assert_eq!(channels(0.1, -0.1), (0, 0), "a finger at rest does nothing");
        assert_eq!(channels(9.0, 9.0), (128, -128));
    }
}
