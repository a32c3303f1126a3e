//! `FrameColours`, the theme of a frame: while one role is lit, the others fade.

use bevy_egui::egui::{Color32, Id, Ui};

use crate::window::ui::UiState;
use crate::window::ui::paint::style::ScreenTheme;
use motion_lab_core::picture::{Role, Theme};

/// Duration of a fade, seconds.
const FADE_SECONDS: f32 = 0.12;

/// The colours of this frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameColours {
    /// The theme.
    pub theme: Theme,
    /// Whether the screen is so narrow that a widget shows one thing at a time.
    pub narrow: bool,
    /// Whether the room is low and wide, so that words stand beside the picture. Such a room counts as narrow too.
    pub low: bool,
    lit: Option<Role>,
    /// How far the others have faded, from 0 to 1.
    strength: f64,
}

impl From<Theme> for FrameColours {
    fn from(theme: Theme) -> Self {
        FrameColours { theme, narrow: false, low: false, lit: None, strength: 0.0 }
    }
}

impl FrameColours {
    /// The look of this frame, which lights the role that was pointed at in the last one.
    ///
    /// While a robot is in hand, a drag or a refusal is on, or a dialog is open, nothing is lit and nothing fades.
    pub fn of(ui: &Ui, state: &mut UiState, narrow: bool, low: bool) -> Self {
        let is_busy = state.is_busy() || ui.ctx().dragged_id().is_some();
        // what a page lit in one widget stays dark in the next
        if state.pointer.page_lit.is_some_and(|(widget, _)| widget != state.widget) {
            state.pointer.page_lit = None;
        }
        let page_lit = state.pointer.page_lit.map(|(_, role)| role);
        let pointed = state.pointer.pointed.take().or(page_lit).filter(|_| !is_busy);
        if pointed != state.pointer.lit && pointed.is_some() {
            state.pointer.lit = pointed;
        }
        let id = Id::new("lit role");
        let seconds = if state.has_reduced_motion() || is_busy { 0.0 } else { FADE_SECONDS };
        let strength = ui.ctx().animate_bool_with_time(id, pointed.is_some(), seconds);
        if is_busy || strength == 0.0 && pointed.is_none() {
            state.pointer.lit = None;
        }
        FrameColours { theme: state.theme(), narrow, low, lit: state.pointer.lit, strength: f64::from(strength) }
    }

    /// The opacity of a role, from 0 to 1.
    fn left(&self, role: Role) -> f64 {
        let stays = self.lit.is_none_or(|lit| lit == role);
        if stays { 1.0 } else { 1.0 - self.strength * (1.0 - self.theme.faintest(role)) }
    }

    /// The colour of a role.
    pub fn colour(&self, role: Role) -> Color32 {
        self.tint(role, 1.0)
    }

    /// The colour of a role at an opacity from 0 to 1.
    pub fn tint(&self, role: Role, opacity: f64) -> Color32 {
        self.theme.tint(role, opacity * self.left(role))
    }

    /// The key by which still pictures are kept: they are painted again only when it changes.
    pub fn key(&self) -> (Theme, Option<Role>, u32) {
        (self.theme, self.lit, (self.strength * 64.0) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::num::{exp, ln};

    #[test]
    fn one_role_is_lit_and_all_others_stand_back() {
        for theme in [Theme::Light, Theme::Dark] {
            let look = FrameColours { theme, narrow: false, low: false, lit: Some(Role::Robot), strength: 1.0 };
            assert_eq!(look.colour(Role::Robot), theme.colour(Role::Robot));
            assert_eq!(look.colour(Role::Paper), theme.colour(Role::Paper));
            for role in [Role::Obstacle, Role::Goal, Role::Sensor, Role::Focus] {
                assert_ne!(look.colour(role), theme.colour(role), "{role:?}");
                assert_eq!(FrameColours::from(theme).colour(role), theme.colour(role));
            }
            for role in [Role::Text, Role::Muted] {
                assert_eq!(look.colour(role), theme.colour(role), "words are read at any time");
            }
        }
    }
    /// The relative luminance of WCAG 2, of a colour of the screen laid over the paper in linear light.
    fn luminance(colour: Color32, paper: Color32) -> f64 {
        let light = |byte: u8| {
            let c = f64::from(byte) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { exp(2.4 * ln((c + 0.055) / 1.055)) }
        };
        let ([r, g, b, a], under) = (colour.to_array(), paper.to_array());
        let seen = |ink: u8, i: usize| light(ink) + (1.0 - f64::from(a) / 255.0) * light(under[i]);
        0.2126 * seen(r, 0) + 0.7152 * seen(g, 1) + 0.0722 * seen(b, 2)
    }

    #[test]
    fn what_has_faded_still_stands_out_from_the_paper() {
        for theme in [Theme::Light, Theme::Dark] {
            let paper = theme.colour(Role::Paper);
            let ground = luminance(paper, paper) + 0.05;
            for lit in [Role::Robot, Role::Obstacle] {
                let look = FrameColours { theme, narrow: false, low: false, lit: Some(lit), strength: 1.0 };
                for role in Role::ALL.into_iter().filter(|r| !matches!(r, Role::Paper | Role::Hairline)) {
                    let ink = luminance(look.colour(role), paper) + 0.05;
                    let contrast = if ink > ground { ink / ground } else { ground / ink };
                    assert!(contrast >= 3.0, "{theme:?}: {role:?} at {contrast:.2} to 1");
                }
            }
        }
    }
}
