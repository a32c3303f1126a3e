//! The ring round the control that has the keys.

use bevy_egui::egui::{Context, Id, LayerId, Order, Stroke, StrokeKind};

use crate::window::ui::FrameColours;
use crate::window::ui::paint::style::ScreenTheme;
use motion_lab_core::picture::Role;

/// The part of the screen from which on something is a picture, which shows by its own frame that it has the keys.
const PICTURE: f32 = 0.08;

/// Rings the control that has the keys, as the page rings its own; a text shows it by its caret.
pub fn focus_ring(ctx: &Context, look: &FrameColours) {
    let Some(id) = ctx.memory(|memory| memory.focused()).filter(|_| !ctx.text_edit_focused()) else { return };
    let Some(control) = ctx.read_response(id) else { return };
    let (rect, screen) = (control.interact_rect, ctx.content_rect());
    if !rect.is_positive() || rect.area() > PICTURE * screen.area() {
        return;
    }
    let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::new("focus ring")));
    let ring = rect.expand(2.0).intersect(screen.shrink(1.0));
    // a role that is lit fades what is in the picture, and not this
    painter.rect_stroke(ring, 3.0, Stroke::new(2.0, look.theme.colour(Role::Focus)), StrokeKind::Inside);
}
