//! Tasks are ticked off by what they ask for, and by nothing that only resembles it.

use super::*;
use motion_lab_sim::manifest::Widget;

fn has_done(harness: &Harness<'_, Lab>, task: &str) -> bool {
    interface(harness).settings.done.iter().any(|done| done == task)
}

/// The lab with the editor of the Apartment in front.
fn editing() -> Harness<'static, Lab> {
    let mut harness = lab(WIDE);
    click(&mut harness, "Atlas");
    click(&mut harness, "Edit");
    harness
}

#[test]
fn a_wall_is_taken_away_by_deleting_a_wall_and_not_a_table() {
    let mut harness = editing();
    for (place, is_wall) in [([6.0, 6.75], false), ([4.0, 6.0], true)] {
        let thing = at(&harness, place);
        click_at(&mut harness, thing);
        click(&mut harness, "Delete");
        assert!(!has_done(&harness, "EditWorld"), "it is not run yet");
        click(&mut harness, "Run this world");
        assert_eq!(has_done(&harness, "EditWorld"), is_wall, "{place:?}");
        click(&mut harness, "Atlas");
    }
}

#[test]
fn a_wall_that_is_taken_away_and_put_back_is_not_taken_away() {
    let mut harness = editing();
    let wall = at(&harness, [4.0, 6.0]);
    click_at(&mut harness, wall);
    click(&mut harness, "Delete");
    click(&mut harness, "Undo");
    click(&mut harness, "Run this world");
    assert!(!has_done(&harness, "EditWorld"));
}

#[test]
fn a_wall_is_looked_up_by_picking_it_and_not_by_adding_one() {
    let mut harness = editing();
    click(&mut harness, "Add wall");
    let free = at(&harness, [2.0, 4.0]);
    click_at(&mut harness, free);
    let name = atlas(&harness).selected.expect("the wall that was added");
    let kind = atlas(&harness).world().obstacle(&name).expect("a wall").kind;
    assert_eq!(kind, motion_lab_core::worlds::ObstacleKind::Wall);
    assert!(!has_done(&harness, "PickWall"));
    let wall = at(&harness, [4.0, 6.0]);
    click_at(&mut harness, wall);
    assert!(has_done(&harness, "PickWall"));
}

#[test]
fn a_drag_through_contact_touches_nothing_and_one_that_ends_there_does() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Query");
    click(&mut harness, "distance");
    let sheet = harness.get_by_label_contains("Reach at T2").rect();
    let fit = crate::window::ui::paint::canvas::fit(interface(&harness).anatomy.backdrop(), sheet);
    let [from, to] = [[0.0, std::f64::consts::SQRT_2], [0.7, 1.2]].map(|[x, y]| {
        let [x, y] = fit.screen_from_world(motion_lab_core::geometry::Point2::new(x, y));
        pos2(x as f32, y as f32)
    });
    // the tip begins at (0, sqrt 2), 0.0607 m from the block, and (0.7, 1.2) is within the block
    let distance = |harness: &Harness<'_, Lab>| interface(harness).anatomy.anatomy.distance();
    pointer(&mut harness, from, Some(true));
    (1..=8).for_each(|i| pointer(&mut harness, from.lerp(to, i as f32 / 8.0), None));
    assert_eq!(distance(&harness), 0.0);
    (1..=8).for_each(|i| pointer(&mut harness, to.lerp(from, i as f32 / 8.0), None));
    pointer(&mut harness, from, Some(false));
    harness.run_steps(2);
    assert!(distance(&harness) > 0.05 && !has_done(&harness, "Touch"), "{}", distance(&harness));
    pointer(&mut harness, from, Some(true));
    (1..=8).for_each(|i| pointer(&mut harness, from.lerp(to, i as f32 / 8.0), None));
    pointer(&mut harness, to, Some(false));
    harness.run_steps(2);
    assert!(distance(&harness) == 0.0 && has_done(&harness, "Touch"));
}

#[test]
fn what_moves_in_another_widget_after_a_press_on_its_button_is_no_task_of_query() {
    let mut harness = lab(WIDE);
    click(&mut harness, "Query");
    click(&mut harness, "distance");
    let press = |harness: &mut Harness<'_, Lab>, name: &str| {
        let at = harness.get_by_label(name).rect().center();
        click_at(harness, at);
    };
    press(&mut harness, "Space");
    // the second link goes up through the block
    interface_mut(&mut harness).anatomy.anatomy.set_coordinate(1, 0.5);
    harness.run_steps(2);
    assert_eq!(interface(&harness).anatomy.anatomy.distance(), 0.0);
    press(&mut harness, "Query");
    assert!(!has_done(&harness, "Touch"));
}

#[test]
fn the_hints_of_each_widget_are_put_away_by_themselves() {
    let mut harness = lab(WIDE);
    interface_mut(&mut harness).settings = crate::window::ui::Settings::default();
    harness.run_steps(2);
    click(&mut harness, "Got it");
    let are_away = |harness: &Harness<'_, Lab>, widget: Widget| {
        let [first, last] = [widget.text().hints.first(), widget.text().hints.last()].map(|hint| &hint.unwrap().text);
        let shown = [first, last].map(|text| harness.query_by_label(text).is_some());
        assert_eq!(shown[0], shown[1], "all of them or none");
        // where there is no task, the misconception stands
        assert_eq!(harness.query_by_label(&widget.text().misconception).is_some(), !shown[0], "{widget:?}");
        !shown[0]
    };
    assert!(are_away(&harness, Widget::Dashboard));
    for widget in [Widget::Anatomy, Widget::Cspace, Widget::Atlas] {
        click(&mut harness, widget.text().short());
        assert!(!are_away(&harness, widget), "{widget:?}");
    }
    click(&mut harness, "Got it");
    click(&mut harness, "Query");
    assert!(!are_away(&harness, Widget::Anatomy));
    click(&mut harness, "Atlas");
    assert!(are_away(&harness, Widget::Atlas));
}

#[test]
fn the_sentence_asks_for_what_can_be_done_here_and_now() {
    let mut harness = lab(WIDE);
    interface_mut(&mut harness).settings = crate::window::ui::Settings::default();
    click(&mut harness, "Atlas");
    harness.run_steps(2);
    // the sentence is as wide as its words, a dot is not
    let is_said = |harness: &Harness<'_, Lab>, text: &str| harness.get_by_label(text).rect().width() > 100.0;
    let (put, pick) = ("Click to put the robot there, and drag to turn it.", "Which wall is a list? Edit: click one,");
    let pick = Widget::Atlas.text().hints.iter().find(|hint| hint.text.starts_with(pick)).map(|hint| &*hint.text);
    let pick = pick.expect("a task of the editor");
    assert!(is_said(&harness, put) && !is_said(&harness, pick));
    click(&mut harness, "Edit");
    harness.run_steps(2);
    assert!(is_said(&harness, pick) && !is_said(&harness, put), "what a click does now");
    click(&mut harness, "Got it");
    harness.run_steps(2);
    assert!(harness.query_by_label(pick).is_none());
    click(&mut harness, "Tasks");
    harness.run_steps(2);
    assert!(is_said(&harness, pick), "they come back");
    // a world without a robot has no task that needs one, and says so
    click(&mut harness, "New");
    click(&mut harness, "Run this world");
    harness.run_steps(6);
    let tasks: Vec<bool> =
        Widget::Dashboard.text().hints.iter().map(|hint| harness.query_by_label(&hint.text).is_some()).collect();
    assert_eq!(tasks, [false, false, false, false, false, false, true], "to begin it anew is possible");
    harness.get_by_label("No robot lives here. Edit in the Atlas adds one.");
}
