//! A finger's swipe over a world, which brings the world beside it to the front.

use bevy_egui::egui::{Id, Rect, Ui};

use crate::window::ui::paint::touch::pinched;

/// Least way of a swipe, points, and how many times longer than high it is.
const MIN_SWIPE: f32 = 60.0;
const FLAT: f32 = 2.0;

/// The way to the world that a finger asks for by a swipe over `paper`: 1 for the next one, to the left, and -1 for the
/// one before; 0 for none. A swipe counts once, and only where the finger drags nothing.
pub fn swiped(ui: &Ui, paper: Rect) -> i32 {
    let (touches, origin, at) = ui.input(|i| (i.any_touches(), i.pointer.press_origin(), i.pointer.latest_pos()));
    let done = Id::new("a swipe is done");
    let Some((from, to)) = origin.zip(at).filter(|_| touches) else {
        ui.data_mut(|data| data.remove_temp::<bool>(done));
        return 0;
    };
    let by = to - from;
    let is_swipe = by.x.abs() >= MIN_SWIPE && by.x.abs() >= FLAT * by.y.abs();
    let is_free = ui.ctx().dragged_id().is_none() && !pinched(ui);
    if !is_swipe || !is_free || !paper.contains(from) || ui.data(|data| data.get_temp(done).unwrap_or(false)) {
        return 0;
    }
    ui.data_mut(|data| data.insert_temp(done, true));
    if by.x < 0.0 { 1 } else { -1 }
}
