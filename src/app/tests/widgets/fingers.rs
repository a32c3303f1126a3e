//! Presses and fingers.

use super::lessons::ui;
use super::*;

#[test]
fn a_press_is_a_click_however_long_it_took_since_the_last_frame() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Query");
    let tab = harness.get_by_label("swept").rect().center();
    pointer(&mut harness, tab, Some(true));
    // a paused window rests: 3 s pass until its next frame
    harness.run_steps(180);
    pointer(&mut harness, tab, Some(false));
    harness.run_steps(2);
    let shown = &harness.state().app.world().resource::<Interface>().0;
    assert_eq!(shown.anatomy.anatomy.tab, crate::anatomy::Tab::Swept);
}

#[test]
fn what_is_touched_is_as_large_as_a_fingertip_whatever_the_width() {
    let mut harness = lab(WIDE);
    let height = |h: &Harness<'_, Lab>| h.get_by_label("Query").rect().height();
    click(&mut harness, "Query");
    let slim = harness.get_by_label("Copy as Rust").rect().height();
    assert!(slim < 40.0, "{slim}");
    ui(&mut harness, |ui| ui.is_touched = true);
    harness.run_steps(3);
    assert!(harness.get_by_label("Copy as Rust").rect().height() >= 44.0 && height(&harness) >= 44.0);
}

#[test]
fn a_tab_lets_go_of_the_robot_in_hand() {
    let mut harness = lab(PHONE);
    ui(&mut harness, |ui| ui.armed = Some("Rusty".into()));
    harness.run_steps(3);
    click(&mut harness, "Reach");
    let shown = &harness.state().app.world().resource::<Interface>().0;
    assert_eq!((shown.armed.as_deref(), shown.settings.world), (None, 1));
}

#[test]
fn large_controls_leave_the_picture_half_of_a_phone_that_lies_down() {
    // the page is 844 x 390 and scrolls; its canvas is this high
    let mut harness = lab([844.0, 530.0]);
    ui(&mut harness, |ui| ui.is_touched = true);
    harness.run_steps(3);
    let paper = paper(&harness, "Apartment");
    assert!(paper.height() >= 0.5 * 390.0, "{paper}");
}
