//! `LabButton`, a button in the lab's style.

use bevy_egui::egui::{Button, Response, RichText, Stroke, Ui, vec2};

use crate::picture::Role;
use crate::ui::Look;

/// A button in the lab's style: enabled and not selected unless said otherwise.
#[derive(Clone, Copy, Debug)]
pub struct LabButton<'a> {
    label: &'a str,
    width: f32,
    enabled: bool,
    selected: bool,
}

impl<'a> LabButton<'a> {
    /// A button with this label, which is also its accessible name.
    pub fn new(label: &'a str) -> Self {
        LabButton { label, width: 0.0, enabled: true, selected: false }
    }

    /// Makes the button at least this wide, points.
    pub fn width(self, width: f32) -> Self {
        LabButton { width, ..self }
    }

    /// Whether it can be pressed. A disabled button is drawn in faint ink.
    pub fn enabled(self, enabled: bool) -> Self {
        LabButton { enabled, ..self }
    }

    /// Whether it is marked: what it chooses is chosen.
    pub fn selected(self, selected: bool) -> Self {
        LabButton { selected, ..self }
    }

    /// Shows the button.
    pub fn show(self, ui: &mut Ui, look: &Look) -> Response {
        let text = RichText::new(self.label);
        let size = vec2(self.width, ui.spacing().interact_size.y);
        let button = |text| Button::new(text).min_size(size).selected(self.selected);
        if self.enabled {
            ui.add(button(text))
        } else {
            let faint = button(text.color(look.tint(Role::Muted, 0.5)));
            ui.add_enabled(false, faint.stroke(Stroke::new(1.0, look.colour(Role::Hairline))))
        }
    }
}
