//! `LabButton`, a button in the lab's style.

use bevy_egui::egui::{Button, Response, RichText, Stroke, Ui, WidgetInfo, WidgetType, vec2};

use super::icon::Icon;
use crate::picture::Role;
use crate::ui::Look;

/// Width of a button with a sign, points.
const SIGN: f32 = 36.0;

/// A button in the lab's style: enabled and no toggle unless said otherwise.
#[derive(Clone, Copy, Debug)]
pub struct LabButton<'a> {
    label: &'a str,
    icon: Option<Icon>,
    width: f32,
    enabled: bool,
    selected: Option<bool>,
}

impl<'a> LabButton<'a> {
    /// A button with this label, which is also its accessible name.
    pub fn new(label: &'a str) -> Self {
        LabButton { label, icon: None, width: 0.0, enabled: true, selected: None }
    }

    /// Shows this sign in place of the label, which stays the accessible name.
    pub fn icon(self, icon: Icon) -> Self {
        LabButton { icon: Some(icon), ..self }
    }

    /// Makes the button at least this wide, points.
    pub fn width(self, width: f32) -> Self {
        LabButton { width, ..self }
    }

    /// Whether it can be pressed. A disabled button is drawn in faint ink.
    pub fn enabled(self, enabled: bool) -> Self {
        LabButton { enabled, ..self }
    }

    /// Makes it a toggle or a choice, marked when what it chooses is chosen.
    pub fn selected(self, selected: bool) -> Self {
        LabButton { selected: Some(selected), ..self }
    }

    /// Shows the button.
    pub fn show(self, ui: &mut Ui, look: &Look) -> Response {
        let width = if self.icon.is_some() { self.width.max(SIGN) } else { self.width };
        let size = vec2(width, ui.spacing().interact_size.y);
        let text = RichText::new(if self.icon.is_some() { "" } else { self.label });
        let text = if self.enabled { text } else { text.color(look.tint(Role::Muted, 0.5)) };
        let mut button = Button::new(text).min_size(size);
        if let Some(selected) = self.selected {
            button = button.selected(selected);
        }
        if !self.enabled {
            button = button.stroke(Stroke::new(1.0, look.colour(Role::Hairline)));
        }
        let response = ui.add_enabled(self.enabled, button);
        if let Some(icon) = self.icon {
            let info = || WidgetInfo {
                selected: self.selected,
                ..WidgetInfo::labeled(WidgetType::Button, self.enabled, self.label)
            };
            response.widget_info(info);
            let colour = if self.enabled { look.colour(Role::Text) } else { look.tint(Role::Muted, 0.5) };
            icon.paint(ui.painter(), response.rect, Stroke::new(1.5, colour));
        }
        response
    }
}
