//! Buttons, enabled or not.

use bevy_egui::egui::{Button, Response, RichText, Stroke, Ui, vec2};

use crate::picture::Role;
use crate::ui::Look;

/// Shows a button at least `width` points wide, marked while `on`. A disabled button is drawn in faint ink.
pub fn button(ui: &mut Ui, label: &str, width: f32, (enabled, on): (bool, bool), look: &Look) -> Response {
    let text = RichText::new(label);
    let button = |text| Button::new(text).min_size(vec2(width, ui.spacing().interact_size.y)).selected(on);
    if enabled {
        ui.add(button(text))
    } else {
        let faint = button(text.color(look.tint(Role::Muted, 0.5)));
        ui.add_enabled(false, faint.stroke(Stroke::new(1.0, look.colour(Role::Hairline))))
    }
}
