//! The question whether to close the window although edits of worlds are in no file.

use bevy_egui::egui::{Context, Id, Key, Modal, Modifiers, RichText, TextStyle};

use super::paint::button::LabButton;
use super::{Closing, Look, UiState};

/// Shows the question over everything else. Escape and a click beside it keep the window open.
pub fn closing(ctx: &Context, look: &Look, state: &mut UiState) {
    if state.closing != Some(Closing::Asking) {
        return;
    }
    let modal = Modal::new(Id::new("closing")).show(ctx, |ui| {
        ui.set_max_width((ctx.content_rect().width() - 48.0).clamp(40.0, 400.0));
        ui.label(RichText::new("Close without saving?").text_style(TextStyle::Heading));
        ui.add_space(6.0);
        ui.label("Edits of these worlds are in no file and would be lost:");
        for world in state.unsaved() {
            ui.label(RichText::new(world).strong());
        }
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            let stays = LabButton::new("Keep the window").show(ui, look).clicked();
            (stays, LabButton::new("Close and lose the edits").show(ui, look).clicked())
        })
        .inner
    });
    let (stays, closes) = modal.inner;
    let escape = ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
    if closes {
        state.closing = Some(Closing::Agreed);
    } else if stays || escape || modal.backdrop_response.clicked() {
        state.closing = None;
    }
}
