//! Touch: whether fingers are at work, and words for them.

use bevy_egui::egui::{Id, Ui};

/// Whether the lab is used by touch: a finger is on the screen, or controls are as large as a fingertip.
pub fn touched(ui: &Ui) -> bool {
    // not the row's own spacing, which may be that of words
    ui.input(|i| i.any_touches()) || ui.ctx().global_style().spacing.interact_size.y > 40.0
}

/// Whether two fingers are on the screen or were since the first came down: then the one that is left drags nothing.
pub fn pinched(ui: &Ui) -> bool {
    let (is_pinched, is_down) = ui.input(|i| (i.multi_touch().is_some(), i.pointer.any_down()));
    ui.data_mut(|data| {
        let on = data.get_temp_mut_or_default::<bool>(Id::new("a pinch is on"));
        *on = is_down && (is_pinched || *on);
        *on
    })
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
