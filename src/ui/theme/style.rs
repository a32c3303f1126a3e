//! The theme in the window: egui's colours and sizes, and the clear colour behind everything.

use bevy_egui::egui::style::{Selection, WidgetVisuals, Widgets};
use bevy_egui::egui::{Color32, CornerRadius, FontFamily, FontId, Shadow, Stroke, Style, TextStyle, Visuals};

use super::Theme;
use crate::picture::{Rgb, Role};

impl Theme {
    /// The colour of a role on the screen.
    pub fn colour(self, role: Role) -> Color32 {
        let Rgb([r, g, b]) = self.palette().colour(role);
        Color32::from_rgb(r, g, b)
    }

    /// The colour of a role at an opacity from 0 to 1.
    pub fn tint(self, role: Role, opacity: f64) -> Color32 {
        self.colour(role).gamma_multiply(opacity as f32)
    }

    /// The colour of a role laid over the paper at an opacity from 0 to 1: opaque.
    fn washed(self, role: Role, opacity: f64) -> Color32 {
        let (Rgb(paper), Rgb(ink)) = (self.palette().colour(Role::Paper), self.palette().colour(role));
        let mix = |i: usize| (f64::from(paper[i]) + opacity * (f64::from(ink[i]) - f64::from(paper[i]))).round() as u8;
        Color32::from_rgb(mix(0), mix(1), mix(2))
    }

    /// The paper as Bevy's cameras clear the window with it.
    pub fn clear_colour(self) -> bevy::color::Color {
        let Rgb([r, g, b]) = self.palette().colour(Role::Paper);
        bevy::color::Color::srgb_u8(r, g, b)
    }

    /// Type, spacing and colours of everything in the window. `touch` makes what is pressed as large as a fingertip.
    pub fn style(self, touch: bool) -> Style {
        let sans = |size| FontId::new(size, FontFamily::Proportional);
        let mono = |size| FontId::new(size, FontFamily::Monospace);
        let mut style = Style { visuals: self.visuals(), animation_time: 0.12, ..Style::default() };
        style.text_styles = [
            (TextStyle::Small, sans(11.0)),
            (TextStyle::Body, sans(13.0)),
            (TextStyle::Button, sans(13.0)),
            (TextStyle::Heading, sans(18.0)),
            (TextStyle::Monospace, mono(11.0)),
        ]
        .into();
        style.spacing.item_spacing = [8.0, 4.0].into();
        style.spacing.button_padding = [12.0, 4.0].into();
        style.spacing.interact_size.y = if touch { 44.0 } else { 28.0 };
        style.interaction.selectable_labels = false;
        style
    }

    fn visuals(self) -> Visuals {
        let paper = self.colour(Role::Paper);
        let base = match self {
            Theme::Light => Visuals::light(),
            Theme::Dark => Visuals::dark(),
        };
        let widget = |fill: Color32, edge: Color32| WidgetVisuals {
            bg_fill: fill,
            weak_bg_fill: fill,
            bg_stroke: Stroke::new(1.0, edge),
            corner_radius: CornerRadius::same(3),
            fg_stroke: Stroke::new(1.0, self.colour(Role::Text)),
            expansion: 0.0,
        };
        // edges of what can be pressed are graphics and keep 3:1; a frame that only decorates may be fainter
        let edge = self.colour(Role::Muted);
        Visuals {
            widgets: Widgets {
                noninteractive: widget(paper, self.colour(Role::Hairline)),
                inactive: widget(paper, edge),
                hovered: widget(self.washed(Role::Text, 0.06), self.colour(Role::Text)),
                active: widget(self.washed(Role::Text, 0.14), self.colour(Role::Text)),
                open: widget(self.washed(Role::Text, 0.06), edge),
            },
            selection: Selection {
                bg_fill: self.washed(Role::Focus, 0.35),
                stroke: Stroke::new(1.0, self.colour(Role::Text)),
            },
            weak_text_color: Some(self.colour(Role::Muted)),
            hyperlink_color: self.colour(Role::Robot),
            faint_bg_color: self.washed(Role::Text, 0.03),
            extreme_bg_color: paper,
            text_edit_bg_color: Some(paper),
            code_bg_color: self.washed(Role::Text, 0.05),
            warn_fg_color: self.colour(Role::Text),
            error_fg_color: self.colour(Role::Goal),
            window_fill: paper,
            window_stroke: Stroke::new(1.0, self.colour(Role::Hairline)),
            window_shadow: Shadow::NONE,
            popup_shadow: Shadow::NONE,
            panel_fill: paper,
            ..base
        }
    }
}
