//! The question whether to close the window although edits of worlds are in no file.

use bevy_egui::egui::{Context, Id, Key, Modal, Modifiers, RichText, TextStyle};

use super::paint::button::LabButton;
use super::{Closing, Command, FrameColours, SessionCommand, UiState};
use motion_lab_sim::manifest::Widget;

/// Shows the question over everything else. Escape and a click beside it keep the window open; so does saving one of
/// the worlds, which asks for a file.
pub fn closing(ctx: &Context, look: &FrameColours, state: &mut UiState, commands: &mut Vec<Command>) {
    if state.closing != Some(Closing::Asking) {
        return;
    }
    let modal = Modal::new(Id::new("closing")).show(ctx, |ui| {
        ui.set_max_width((ctx.content_rect().width() - 48.0).clamp(40.0, 400.0));
        ui.label(RichText::new("Close without saving?").text_style(TextStyle::Heading));
        ui.add_space(6.0);
        ui.label("Edits of these worlds are in no file and would be lost:");
        let mut saved = None;
        for world in state.unsaved() {
            ui.horizontal(|ui| {
                if LabButton::new(&format!("Save {world}")).show(ui, look).clicked() {
                    saved = Some(world);
                }
            });
        }
        ui.add_space(8.0);
        ui.horizontal_wrapped(|ui| {
            let stays = LabButton::new("Keep the window").show(ui, look).clicked();
            (stays, LabButton::new("Close and lose the edits").show(ui, look).clicked(), saved)
        })
        .inner
    });
    let (stays, closes, saved) = modal.inner;
    if let Some(world) = saved {
        if let Some(kept) = state.shelf.iter().position(|kept| kept.is_unsaved() && kept.label() == world)
            && !(state.atlas.is_unsaved() && state.atlas.label() == world)
        {
            state.take_from_shelf(kept);
        }
        (state.closing, state.widget) = (None, Widget::Atlas);
        commands.push(Command::Session(SessionCommand::SaveWorld));
    }
    let escape = ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
    if closes {
        state.closing = Some(Closing::Agreed);
    } else if stays || escape || modal.backdrop_response.clicked() {
        state.closing = None;
    }
}
