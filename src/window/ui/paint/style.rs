//! The theme in the window: egui's colours and sizes, and the clear colour behind everything.

use std::sync::{Arc, LazyLock};

use bevy_egui::egui::epaint::{FontColorTransferFunction, TextOptions};
use bevy_egui::egui::style::{NumberFormatter, Selection, WidgetVisuals, Widgets};
use bevy_egui::egui::{
    Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Shadow, Stroke, Style, TextStyle, Visuals,
    emath,
};

use motion_lab_core::num::{exp, greater, lesser, ln};
use motion_lab_core::picture::{FACES, Rgb, Role, Theme, true_minus};

/// The linear light of a stored sRGB byte, from 0 to 1.
fn linear(byte: u8) -> f64 {
    let c = f64::from(byte) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { exp(2.4 * ln((c + 0.055) / 1.055)) }
}

/// The sRGB byte that stores a linear light from 0 to 1. A negative light is stored as 0.
fn stored(light: f64) -> u8 {
    let c = if light <= 0.0031308 { 12.92 * greater(light, 0.0) } else { 1.055 * exp(ln(light) / 2.4) - 0.055 };
    (255.0 * c).round() as u8
}

/// Least contrast with the paper of what has faded: that of graphics, and a little for rounding.
const MIN_CONTRAST: f64 = 3.05;

/// Least opacity of what has faded.
const FADED: f64 = 0.3;

/// For each theme the opacity that each role fades to.
static FAINTEST: LazyLock<[[f64; Role::ALL.len()]; 2]> =
    LazyLock::new(|| [Theme::Light, Theme::Dark].map(|theme| Role::ALL.map(|role| fades_to(theme, role))));

/// The relative luminance of a colour, after WCAG 2.
fn luminance([r, g, b]: [u8; 3]) -> f64 {
    0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
}

/// A theme on the screen: its roles as egui's colours, and the look of everything.
pub(crate) trait ScreenTheme {
    /// The opacity that a role fades to while another is lit, from 0 to 1: the least at which it still has a contrast
    /// of 3:1 with the paper. Words, frames and the paper do not fade.
    fn faintest(self, role: Role) -> f64;

    /// The colour of a role on the screen.
    fn colour(self, role: Role) -> Color32;

    /// The colour of a role at an opacity from 0 to 1, made so that on paper it comes out as in an SVG file.
    ///
    /// The window's surface blends in linear light, SVG between the stored bytes. The colour wanted on paper is worked
    /// out first, then the premultiplied colour that blends to it, with the smallest alpha from `opacity` up that can.
    fn tint(self, role: Role, opacity: f64) -> Color32;

    /// The colour of the paper, with which Bevy's cameras clear the window.
    fn clear_colour(self) -> bevy::color::Color;

    /// Type, spacing and colours of everything in the window. `touch` makes controls as large as a fingertip.
    fn style(self, touch: bool) -> Style;
}

impl ScreenTheme for Theme {
    fn faintest(self, role: Role) -> f64 {
        let place = Role::ALL.iter().position(|other| *other == role);
        place.map_or(1.0, |i| FAINTEST[usize::from(self == Theme::Dark)][i])
    }

    fn colour(self, role: Role) -> Color32 {
        let Rgb([r, g, b]) = self.palette().colour(role);
        Color32::from_rgb(r, g, b)
    }

    fn tint(self, role: Role, opacity: f64) -> Color32 {
        if opacity >= 1.0 {
            return self.colour(role);
        }
        let Rgb(paper) = self.palette().colour(Role::Paper);
        let [r, g, b, _] = washed(self, role, opacity).to_array();
        let (paper, wanted) = (paper.map(linear), [r, g, b].map(linear));
        let alpha = (0..3).map(|i| 1.0 - wanted[i] / paper[i]).fold(opacity, greater);
        let [r, g, b] = [0, 1, 2].map(|i| stored(wanted[i] - (1.0 - alpha) * paper[i]));
        Color32::from_rgba_premultiplied(r, g, b, (255.0 * alpha).round() as u8)
    }

    fn clear_colour(self) -> bevy::color::Color {
        let Rgb([r, g, b]) = self.palette().colour(Role::Paper);
        bevy::color::Color::srgb_u8(r, g, b)
    }

    fn style(self, touch: bool) -> Style {
        let sans = |size| FontId::new(size, FontFamily::Proportional);
        let mono = |size| FontId::new(size, FontFamily::Monospace);
        let mut style = Style { visuals: visuals(self), animation_time: 0.12, ..Style::default() };
        style.text_styles = [
            (TextStyle::Small, sans(12.0)),
            (TextStyle::Body, sans(14.0)),
            (TextStyle::Button, sans(14.0)),
            (TextStyle::Heading, sans(18.0)),
            (TextStyle::Monospace, mono(12.0)),
        ]
        .into();
        style.spacing.item_spacing = [8.0, 4.0].into();
        style.spacing.button_padding = [12.0, 4.0].into();
        style.spacing.interact_size.y = if touch { 44.0 } else { 28.0 };
        style.interaction.selectable_labels = false;
        // typed, a hyphen is a minus as well
        style.number_formatter =
            NumberFormatter::new(|value, decimals| true_minus(&emath::format_with_decimals_in_range(value, decimals)));
        style
    }
}

fn fades_to(theme: Theme, role: Role) -> f64 {
    if matches!(role, Role::Paper | Role::Hairline | Role::Text | Role::Muted) {
        return 1.0;
    }
    let Rgb(paper) = theme.palette().colour(Role::Paper);
    let stands_out = |opacity: &f64| {
        let [r, g, b, _] = washed(theme, role, *opacity).to_array();
        let (ink, paper) = (luminance([r, g, b]) + 0.05, luminance(paper) + 0.05);
        greater(ink, paper) >= MIN_CONTRAST * lesser(ink, paper)
    };
    let steps = (0..=64).map(|i| FADED + (1.0 - FADED) * f64::from(i) / 64.0);
    steps.into_iter().find(stands_out).unwrap_or(1.0)
}

/// The colour of a role laid over the paper at an opacity from 0 to 1: opaque.
fn washed(theme: Theme, role: Role, opacity: f64) -> Color32 {
    let (Rgb(paper), Rgb(ink)) = (theme.palette().colour(Role::Paper), theme.palette().colour(role));
    let mix = |i: usize| (f64::from(paper[i]) + opacity * (f64::from(ink[i]) - f64::from(paper[i]))).round() as u8;
    Color32::from_rgb(mix(0), mix(1), mix(2))
}

fn visuals(theme: Theme) -> Visuals {
    let paper = theme.colour(Role::Paper);
    let base = match theme {
        Theme::Light => Visuals::light(),
        Theme::Dark => Visuals::dark(),
    };
    let widget = |fill: Color32, edge: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, edge),
        corner_radius: CornerRadius::same(3),
        fg_stroke: Stroke::new(1.0, theme.colour(Role::Text)),
        expansion: 0.0,
    };
    // edges of controls keep a contrast of 3:1, as graphics must; a decorative frame may be fainter
    let edge = theme.colour(Role::Muted);
    Visuals {
        widgets: Widgets {
            noninteractive: widget(paper, theme.colour(Role::Hairline)),
            // only its filling makes a slider's rail visible
            inactive: WidgetVisuals { bg_fill: washed(theme, Role::Text, 0.12), ..widget(paper, edge) },
            hovered: widget(washed(theme, Role::Text, 0.06), theme.colour(Role::Text)),
            active: widget(washed(theme, Role::Text, 0.14), theme.colour(Role::Text)),
            open: widget(washed(theme, Role::Text, 0.06), edge),
        },
        selection: Selection {
            bg_fill: washed(theme, Role::Focus, 0.35),
            stroke: Stroke::new(1.0, theme.colour(Role::Text)),
        },
        weak_text_color: Some(theme.colour(Role::Muted)),
        hyperlink_color: theme.colour(Role::Robot),
        faint_bg_color: washed(theme, Role::Text, 0.03),
        extreme_bg_color: paper,
        text_edit_bg_color: Some(paper),
        code_bg_color: washed(theme, Role::Text, 0.05),
        warn_fg_color: theme.colour(Role::Text),
        // red is contact, and nothing else
        error_fg_color: theme.colour(Role::Text),
        window_fill: paper,
        window_stroke: Stroke::new(1.0, theme.colour(Role::Hairline)),
        window_shadow: Shadow::NONE,
        popup_shadow: Shadow::NONE,
        panel_fill: paper,
        // the window's surface blends in linear light, in which half a coverage of dark ink is a light grey: with
        // 1 - (1 - c)^2 letters come out as dark as blended between the stored bytes
        text_options: TextOptions {
            color_transfer_function: FontColorTransferFunction::TwoCoverageMinusCoverageSq,
            ..base.text_options
        },
        // disabled controls have fainter ink: a fade would be blended in linear light and come out grey
        disabled_alpha: 1.0,
        ..base
    }
}

/// The faces: the lab's own, each a fallback for signs that another lacks. Where egui has faces of its own (not on
/// the web), they come last.
pub(crate) fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    for (name, letters) in FACES {
        fonts.font_data.insert(name.into(), Arc::new(FontData::from_static(letters)));
    }
    for (family, order) in [(FontFamily::Proportional, [0, 2, 1]), (FontFamily::Monospace, [1, 2, 0])] {
        fonts.families.entry(family).or_default().splice(0..0, order.map(|face| FACES[face].0.into()));
    }
    fonts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_as_dark_as_blended_between_stored_bytes() {
        let function = Theme::Light.style(false).visuals.text_options.color_transfer_function;
        let Rgb(paper) = Theme::Light.palette().colour(Role::Paper);
        for role in [Role::Text, Role::Muted, Role::Focus] {
            let Rgb(ink) = Theme::Light.palette().colour(role);
            for coverage in [0.25_f32, 0.5, 0.75] {
                let alpha = f64::from(function.alpha_from_coverage(coverage));
                for (ink, paper) in ink.into_iter().zip(paper) {
                    let shown = stored(linear(paper) + alpha * (linear(ink) - linear(paper)));
                    let wanted = f64::from(paper) + f64::from(coverage) * (f64::from(ink) - f64::from(paper));
                    let off = f64::from(shown) - wanted;
                    assert!(off.abs() <= 25.0, "{role:?} at {coverage}: {shown} instead of {wanted}");
                }
            }
        }
    }

    #[test]
    fn a_tint_blends_on_paper_to_what_svg_shows() {
        for theme in [Theme::Light, Theme::Dark] {
            let Rgb(paper) = theme.palette().colour(Role::Paper);
            for role in [Role::Robot, Role::Obstacle, Role::Goal, Role::Sensor, Role::Paper] {
                for opacity in [0.0, 0.12, 0.45, 0.85] {
                    let [r, g, b, a] = theme.tint(role, opacity).to_array();
                    let wanted = washed(theme, role, opacity).to_array();
                    for (i, premultiplied) in [r, g, b].into_iter().enumerate() {
                        let light = linear(premultiplied) + (1.0 - f64::from(a) / 255.0) * linear(paper[i]);
                        let off = i32::from(stored(light)) - i32::from(wanted[i]);
                        assert!(off.abs() <= 6, "{theme:?} {role:?} {opacity}: {off} in channel {i}");
                    }
                    assert!(f64::from(a) >= 254.0 * opacity);
                }
            }
        }
    }
}
