//! Presses, fingers, the focus, and what pictures say of a contact and of a space.

use super::layout::fresh;
use super::lessons::ui;
use super::*;
use motion_lab_sim::manifest::Widget;

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
    assert_eq!(shown.anatomy.anatomy.tab, motion_lab_sim::anatomy::Tab::Swept);
}

#[test]
fn what_is_touched_is_as_large_as_a_fingertip_whatever_the_width() {
    let mut harness = lab(WIDE);
    let height = |h: &Harness<'_, Lab>| h.get_by_label("Query").rect().height();
    click(&mut harness, "Query");
    let slim = harness.get_by_label("Copy as Rust").rect().height();
    assert!(slim < 40.0, "{slim}");
    ui(&mut harness, |ui| ui.pointer.is_touched = true);
    harness.run_steps(3);
    assert!(harness.get_by_label("Copy as Rust").rect().height() >= 44.0 && height(&harness) >= 44.0);
}

#[test]
fn a_tab_lets_go_of_the_robot_in_hand() {
    let mut harness = lab(PHONE);
    ui(&mut harness, |ui| ui.hand.armed = Some("Rusty".into()));
    harness.run_steps(3);
    click(&mut harness, "Reach");
    let shown = &harness.state().app.world().resource::<Interface>().0;
    assert_eq!((shown.hand.armed.as_deref(), shown.settings.world), (None, 1));
}

#[test]
fn large_controls_leave_the_picture_half_of_a_phone_that_lies_down() {
    // the page is 844 x 390 and scrolls; its canvas is this high
    let mut harness = lab([844.0, 530.0]);
    ui(&mut harness, |ui| ui.pointer.is_touched = true);
    harness.run_steps(3);
    let paper = paper(&harness, "Apartment");
    assert!(paper.height() >= 0.5 * 390.0, "{paper}");
}

/// A finger that is put down, moves and is lifted.
fn swipe(harness: &mut Harness<'_, Lab>, from: Pos2, by: egui::Vec2) {
    let touch = |harness: &mut Harness<'_, Lab>, phase, pos: Pos2, pressed: Option<bool>| {
        let (device_id, id) = (egui::TouchDeviceId(1), egui::TouchId(1));
        harness.event(Event::Touch { device_id, id, phase, pos, force: None });
        pointer(harness, pos, pressed);
    };
    touch(harness, egui::TouchPhase::Start, from, Some(true));
    (1..=8).for_each(|i| touch(harness, egui::TouchPhase::Move, from + by * (i as f32 / 8.0), None));
    touch(harness, egui::TouchPhase::End, from + by, Some(false));
    harness.run_steps(3);
}

#[test]
fn a_finger_seeks_by_a_tap_or_sideways_and_not_on_its_way_up_or_down() {
    let mut harness = lab(PHONE);
    harness.run_steps(200);
    pause(&mut harness);
    let tick = |harness: &Harness<'_, Lab>| harness.state().transport().tick;
    let line = harness.get_by_label("time line, in ticks").rect();
    let (end, middle) = (tick(&harness), line.center());
    assert!(end > 60, "{end}");
    swipe(&mut harness, middle, egui::vec2(4.0, -120.0));
    assert_eq!(tick(&harness), end, "upright");
    swipe(&mut harness, middle, egui::vec2(-60.0, 10.0));
    let sideways = tick(&harness);
    assert!(sideways < end / 2 && sideways > 0, "{sideways} of {end}");
    swipe(&mut harness, middle, egui::Vec2::ZERO);
    assert!(tick(&harness).abs_diff(end / 2) < end / 10, "{} of {end}", tick(&harness));
}

#[test]
fn a_swipe_over_a_world_brings_the_one_beside_it_to_the_front() {
    let mut harness = lab(PHONE);
    pause(&mut harness);
    let world = |harness: &Harness<'_, Lab>| interface(harness).settings.world;
    // the corridor, with no robot and no door near
    let at = |harness: &Harness<'_, Lab>, name: &str| {
        let paper = paper(harness, name);
        paper.min + egui::vec2(0.55, 0.53) * paper.size()
    };
    let from = at(&harness, "Apartment");
    swipe(&mut harness, from, egui::vec2(120.0, 10.0));
    assert_eq!(world(&harness), 0, "there is none before the first");
    swipe(&mut harness, from, egui::vec2(-40.0, -120.0));
    assert_eq!(world(&harness), 0, "upright it scrolls");
    swipe(&mut harness, from, egui::vec2(-160.0, 10.0));
    assert_eq!(world(&harness), 1, "one swipe, one world");
    let from = at(&harness, "Workbench") + egui::vec2(100.0, 120.0);
    swipe(&mut harness, from, egui::vec2(-120.0, 0.0));
    assert_eq!(world(&harness), 2);
    let from = at(&harness, "Lot") + egui::vec2(0.0, -60.0);
    swipe(&mut harness, from, egui::vec2(120.0, 0.0));
    assert_eq!(world(&harness), 1);
    // what drags something swipes nothing
    ui(&mut harness, |ui| ui.settings.world = 0);
    harness.run_steps(3);
    for across in [120.0, -120.0] {
        let body = harness.get_by_label("Rusty: its body, to be dragged").rect().center();
        swipe(&mut harness, body, egui::vec2(across, 0.0));
    }
    assert_eq!(world(&harness), 0);
}

#[test]
fn the_focus_stays_with_its_world_where_panes_change_places() {
    let mut harness = lab(WIDE);
    let focused = |h: &Harness<'_, Lab>| {
        let has = |node: &egui_kittest::Node<'_>| node.accesskit_node().is_focused();
        h.get_all_by_role(egui::accesskit::Role::Button).filter(has).find_map(|node| node.accesskit_node().label())
    };
    harness.get_by_label_contains("Bring Reach").focus();
    harness.run_steps(2);
    let is_reach = |label: Option<String>| label.is_some_and(|label| label.starts_with("Bring Reach"));
    assert!(is_reach(focused(&harness)));
    // with the car in front the rover is the first of the small ones, and the arm the second
    ui(&mut harness, |ui| ui.settings.world = 2);
    harness.run_steps(3);
    assert!(is_reach(focused(&harness)), "{:?}", focused(&harness));
}

#[test]
fn a_wall_that_holds_the_robot_bears_its_name() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(600);
    let at = harness.state().robot(0).footprint;
    let scene = motion_lab_core::collision::Scene::apartment();
    use motion_lab_core::collision::Collision;
    let wall = scene.obstacle_name(scene.witness(&at).unwrap().obstacle).unwrap();
    crate::window::tests::safe::read_whole(&harness, wall);
}

#[test]
fn space_names_its_regions_and_bends_to_a_torus_that_turns() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    harness.run_steps(60);
    harness.get_by_label_contains("Blocked regions: the shelf");
    click(&mut harness, "as a torus");
    let sheet = harness.get_by_label_contains("configuration space as a torus").rect();
    let turned = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.cspace.turned;
    let before = turned(&harness);
    pointer(&mut harness, sheet.center(), Some(true));
    (1..=8).for_each(|i| pointer(&mut harness, sheet.center() + egui::vec2(10.0 * i as f32, 0.0), None));
    pointer(&mut harness, sheet.center() + egui::vec2(80.0, 0.0), Some(false));
    let [about, tilt] = turned(&harness);
    assert!(about - before[0] > 0.5 && tilt == before[1], "{about} {tilt}");
}

#[test]
fn what_was_copied_is_said() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Query");
    for (button, said) in [("Copy as Rust", "copied: a program"), ("Copy as command", "copied: a command")] {
        assert!(harness.query_by_label_contains(said).is_none());
        click(&mut harness, button);
        harness.run_steps(2);
        harness.get_by_label_contains(said);
    }
}

/// A task as it is said where there is no mouse.
fn for_fingers(text: &str) -> String {
    let known = [
        ("Click to put the robot there, and drag to turn it.", "Tap to put the robot there, and drag to turn it."),
        (
            "Which wall is a list? Edit: click one, and read its points.",
            "Which wall is a list? Edit: tap one, and read its points.",
        ),
    ];
    known.into_iter().find(|(mouse, _)| *mouse == text).map_or(text, |(_, finger)| finger).to_owned()
}

#[test]
fn each_widget_on_a_phone_offers_its_next_task_below_the_picture() {
    for widget in [Widget::Anatomy, Widget::Cspace, Widget::Atlas, Widget::Plan] {
        let mut harness = fresh(PHONE, widget);
        let hints = &widget.text().hints;
        let offered = |harness: &Harness<'_, Lab>| -> Vec<usize> {
            (0..hints.len()).filter(|i| harness.query_by_label(&for_fingers(&hints[*i].text)).is_some()).collect()
        };
        assert_eq!(offered(&harness), [0], "{widget:?}");
        assert!(
            harness.get_by_label(&for_fingers(&hints[0].text)).rect().top() > 0.45 * PHONE[1],
            "{widget:?}: below the picture"
        );
        ui(&mut harness, |ui| ui.settings.tick_off(hints[0].task));
        harness.run_steps(3);
        assert_eq!(offered(&harness), [1], "{widget:?}");
        harness.get_by_label(&for_fingers(&hints[1].text)).scroll_to_me();
        harness.run_steps(20);
        click(&mut harness, &for_fingers(&hints[1].text));
        let begun = harness.state().app.world().resource::<Interface>().0.lesson.as_ref().map(|of| of.lesson.task);
        assert_eq!(begun, Some(hints[1].task), "{widget:?}");
        ui(&mut harness, |ui| ui.lesson = None);
        harness.run_steps(3);
        harness.get_by_label("Got it").scroll_to_me();
        harness.run_steps(20);
        click(&mut harness, "Got it");
        assert_eq!(offered(&harness), [0; 0], "{widget:?}: put away");
        click(&mut harness, "Menu");
        click(&mut harness, "Hints");
        assert_eq!(offered(&harness), [1], "{widget:?}: brought back");
    }
}
