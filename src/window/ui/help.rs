//! The list of keys.

use bevy_egui::egui::{Context, Grid, Id, Key, Modal, Modifiers, RichText, ScrollArea, TextStyle};

use super::UiState;
use super::keys::{BINDINGS, Scope};

/// Width of the column of keys, points: that of the longest, so that all lists are aligned.
const KEYS: f32 = 92.0;

/// What the pointer does besides clicks.
const POINTER: [(&str, &str); 5] = [
    ("drag a body", "tow the rover or the car by its own commands"),
    ("Alt+drag", "put it elsewhere, not driven; Ctrl+drag does too"),
    ("wheel, pinch", "magnify the world, or show more of it"),
    ("drag", "move a world that is magnified"),
    ("double click", "show the whole of it"),
];

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
                Grid::new(title).num_columns(2).spacing([16.0, 1.0]).min_col_width(KEYS).show(ui, |ui| {
                    for binding in BINDINGS.iter().filter(|b| b.scope == scope) {
                        ui.label(RichText::new(binding.keys()).monospace());
                        ui.label(binding.words);
                        ui.end_row();
                    }
                });
                ui.add_space(6.0);
            }
            ui.label(RichText::new("With the pointer on a world of the dashboard").strong());
            Grid::new("pointer").num_columns(2).spacing([16.0, 1.0]).min_col_width(KEYS).show(ui, |ui| {
                for (how, words) in POINTER {
                    ui.label(RichText::new(how).monospace());
                    ui.label(words);
                    ui.end_row();
                }
            });
            ui.add_space(6.0);
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
