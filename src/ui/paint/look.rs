//! `Look`, the theme of a frame: while one role is lit, the others fade.

use bevy_egui::egui::{Color32, Id, Ui};

use crate::picture::{Role, Theme};
use crate::ui::UiState;

/// Opacity of a role while another is fully lit, from 0 to 1.
const FADED: f64 = 0.3;

/// Duration of a fade, seconds.
const FADE_SECONDS: f32 = 0.12;

/// The colours of this frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// The theme.
    pub theme: Theme,
    /// Whether the screen is so narrow that a widget shows one thing at a time.
    pub narrow: bool,
    lit: Option<Role>,
    /// How far the others have faded, from 0 to 1.
    strength: f64,
}

impl From<Theme> for Look {
    fn from(theme: Theme) -> Self {
        Look { theme, narrow: false, lit: None, strength: 0.0 }
    }
}

impl Look {
    /// The look of this frame, which lights the role that was pointed at in the last one.
    pub fn of(ui: &Ui, state: &mut UiState, narrow: bool) -> Self {
        let pointed = state.pointed.take().or(state.page_lit);
        if pointed != state.lit && pointed.is_some() {
            state.lit = pointed;
        }
        let id = Id::new("lit role");
        let seconds = if state.settings.reduced_motion { 0.0 } else { FADE_SECONDS };
        let strength = ui.ctx().animate_bool_with_time(id, pointed.is_some(), seconds);
        if strength == 0.0 && pointed.is_none() {
            state.lit = None;
        }
        Look { theme: state.theme(), narrow, lit: state.lit, strength: f64::from(strength) }
    }

    /// The opacity of a role, from 0 to 1.
    fn left(&self, role: Role) -> f64 {
        let stays = matches!(role, Role::Paper | Role::Hairline) || self.lit.is_none_or(|lit| lit == role);
        if stays { 1.0 } else { 1.0 - self.strength * (1.0 - FADED) }
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

    #[test]
    fn one_role_is_lit_and_all_others_stand_back() {
        for theme in [Theme::Light, Theme::Dark] {
            let look = Look { theme, narrow: false, lit: Some(Role::Robot), strength: 1.0 };
            assert_eq!(look.colour(Role::Robot), theme.colour(Role::Robot));
            assert_eq!(look.colour(Role::Paper), theme.colour(Role::Paper));
            for role in [Role::Obstacle, Role::Goal, Role::Sensor, Role::Text, Role::Muted, Role::Focus] {
                assert_eq!(look.colour(role), theme.tint(role, FADED), "{role:?}");
                assert_eq!(Look::from(theme).colour(role), theme.colour(role));
            }
        }
    }
}
