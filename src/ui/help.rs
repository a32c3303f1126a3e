//! The list of keys.

use bevy_egui::egui::{Context, Grid, Id, Key, Modal, Modifiers, RichText, ScrollArea, TextStyle};

use super::UiState;
use super::keys::{BINDINGS, Scope};

/// Shows the list over everything else while it is open. Esc, its button or a click beside it closes it.
pub fn help(ctx: &Context, state: &mut UiState) {
    if !state.help {
        return;
    }
    let modal = Modal::new(Id::new("keys")).show(ctx, |ui| {
        ui.label(RichText::new("Keys").text_style(TextStyle::Heading));
        ui.add_space(6.0);
        ui.spacing_mut().interact_size.y = 0.0;
        let height = 0.8 * ctx.content_rect().height();
        ScrollArea::vertical().max_height(height).show(ui, |ui| {
            for (scope, title) in [
                (Scope::Armed, "With a robot in hand (click its paper)"),
                (Scope::Unarmed, "With none in hand"),
                (Scope::Handle, "With the focus on a dot of an arm (drag it, or click it)"),
                (Scope::Atlas, "In the world atlas"),
                (Scope::Always, "Always"),
            ] {
                ui.label(RichText::new(title).strong());
                Grid::new(title).num_columns(2).spacing([16.0, 1.0]).min_col_width(72.0).show(ui, |ui| {
                    for binding in BINDINGS.iter().filter(|b| b.scope == scope) {
                        ui.label(RichText::new(binding.keys()).monospace());
                        ui.label(binding.words);
                        ui.end_row();
                    }
                });
                ui.add_space(6.0);
            }
            ui.label("Tab goes from one control to the next.");
        });
        ui.checkbox(&mut state.settings.reduced_motion, "Reduced motion: nothing eases on the screen");
        ui.add_space(6.0);
        ui.button("Close").clicked()
    });
    let escape = ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
    if modal.inner || modal.backdrop_response.clicked() || escape {
        state.help = false;
    }
}
