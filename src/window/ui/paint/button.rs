//! `LabButton`, a button in the lab's style.

use bevy_egui::egui::{Align2, Button, Response, RichText, Stroke, TextStyle, Ui, WidgetInfo, WidgetType, vec2};

use super::icon::Icon;
use crate::window::ui::FrameColours;
use motion_lab_core::picture::Role;

/// Width of a button with a sign for a mouse, points.
pub const SIGN: f32 = 36.0;

/// Width of a button with a sign, points: for a finger it is as wide as it is high.
pub fn sign_width(ui: &Ui) -> f32 {
    let height = ui.spacing().interact_size.y;
    if height > 40.0 { height } else { SIGN }
}

/// A button in the lab's style: enabled and no toggle unless said otherwise.
#[derive(Clone, Copy, Debug)]
pub struct LabButton<'a> {
    label: &'a str,
    icon: Option<Icon>,
    has_words: bool,
    width: f32,
    enabled: bool,
    selected: Option<bool>,
    keys: &'a str,
    spoken: &'a str,
}

impl<'a> LabButton<'a> {
    /// A button with this label, which is also its accessible name.
    pub fn new(label: &'a str) -> Self {
        LabButton {
            label,
            icon: None,
            has_words: false,
            width: 0.0,
            enabled: true,
            selected: None,
            keys: "",
            spoken: label,
        }
    }

    /// Shows this sign in place of the label, which stays the accessible name.
    pub fn icon(self, icon: Icon) -> Self {
        LabButton { icon: Some(icon), ..self }
    }

    /// Shows this sign, and the label small under it.
    pub fn over_words(self, icon: Icon) -> Self {
        LabButton { icon: Some(icon), has_words: true, ..self }
    }

    /// Makes the button at least this wide, points.
    pub fn width(self, width: f32) -> Self {
        LabButton { width, ..self }
    }

    /// Sets whether the button can be pressed. A disabled button is drawn in faint ink.
    pub fn enabled(self, enabled: bool) -> Self {
        LabButton { enabled, ..self }
    }

    /// Makes it a toggle or a choice, marked when what it chooses is chosen.
    pub fn selected(self, selected: bool) -> Self {
        LabButton { selected: Some(selected), ..self }
    }

    /// Shows the keys that do the same at its right end.
    pub fn keys(self, keys: &'a str) -> Self {
        LabButton { keys, ..self }
    }

    /// Gives it a fuller accessible name, where words beside it say the rest of it.
    pub fn spoken(self, spoken: &'a str) -> Self {
        LabButton { spoken, ..self }
    }

    /// Shows the button.
    pub fn show(self, ui: &mut Ui, look: &FrameColours) -> Response {
        let height = ui.spacing().interact_size.y;
        let least = if self.has_words { 0.0 } else { sign_width(ui) };
        let width = if self.icon.is_some() { self.width.max(least) } else { self.width };
        let size = vec2(width, height);
        let text = RichText::new(if self.icon.is_some() { "" } else { self.label });
        let text = if self.enabled { text } else { text.color(look.tint(Role::Muted, 0.5)) };
        let mut button = Button::new(text).min_size(size);
        if let Some(selected) = self.selected {
            button = button.selected(selected);
        }
        if !self.enabled {
            button = button.stroke(Stroke::new(1.0, look.colour(Role::Hairline)));
        }
        if !self.keys.is_empty() {
            button = button.shortcut_text(self.keys);
        }
        let response = ui.add_enabled(self.enabled, button);
        if self.icon.is_some() || !self.keys.is_empty() || self.spoken != self.label {
            // its label alone is its name
            response.widget_info(|| WidgetInfo {
                selected: self.selected,
                ..WidgetInfo::labeled(WidgetType::Button, self.enabled, self.spoken)
            });
        }
        if let Some(icon) = self.icon {
            let colour = if self.enabled { look.colour(Role::Text) } else { look.tint(Role::Muted, 0.5) };
            let (sign, words) = response.rect.split_top_bottom_at_fraction(if self.has_words { 0.56 } else { 1.0 });
            icon.paint(ui.painter(), sign, Stroke::new(1.5, colour));
            if self.has_words {
                let font = TextStyle::Small.resolve(ui.style());
                ui.painter().text(words.center_top(), Align2::CENTER_TOP, self.label, font, colour);
            }
        }
        response
    }
}
