//! What has the keys is seen to have them.

use super::*;
use crate::window::ui::paint::style::ScreenTheme;
use motion_lab_core::picture::Role;

/// The boxes that are ringed in the colour of the focus.
fn ringed(harness: &Harness<'_, Lab>) -> Vec<egui::Rect> {
    let colour = harness.state().app.world().resource::<Interface>().0.theme().colour(Role::Focus);
    let boxes = harness.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
        egui::Shape::Rect(shape) if shape.stroke.color == colour && shape.stroke.width > 1.5 => Some(shape.rect),
        _ => None,
    });
    boxes.collect()
}

#[test]
fn a_control_that_has_the_keys_is_ringed_and_no_other() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    assert_eq!(ringed(&harness), [], "a click takes no keys");
    for name in ["swept", "Copy as Rust", "colour key: obstacle"] {
        harness.get_by_label(name).focus();
        harness.run_steps(3);
        let rect = harness.get_by_label(name).rect();
        let rings = ringed(&harness);
        let is_about = |ring: &&egui::Rect| ring.contains_rect(rect) && ring.area() < 1.6 * rect.area() + 200.0;
        assert_eq!((rings.len(), rings.iter().filter(is_about).count()), (1, 1), "{name} at {rect:?}: {rings:?}");
    }
    harness.key_press(egui::Key::Tab);
    harness.run_steps(3);
    assert_eq!(ringed(&harness).len(), 1, "it goes along");
}
