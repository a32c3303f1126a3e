//! Touch: whether fingers are at work, and words for them.

use bevy_egui::egui::Ui;

/// Whether the lab is used by touch: a finger is on the screen, or controls are as large as a fingertip.
pub fn touched(ui: &Ui) -> bool {
    // not the row's own spacing, which may be that of words
    ui.input(|i| i.any_touches()) || ui.ctx().global_style().spacing.interact_size.y > 40.0
}

/// Words of a mouse and of keys, for fingers those of fingers.
pub fn worded(ui: &Ui, text: &str) -> String {
    if !touched(ui) {
        return text.to_owned();
    }
    [("Click", "Tap"), ("click", "tap"), ("keys or pad", "the pad")]
        .into_iter()
        .fold(text.to_owned(), |text, (mouse, finger)| text.replace(mouse, finger))
}
