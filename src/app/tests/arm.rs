//! Moving the arm: drags, nudges, numbers, the null space.

use super::*;

#[test]
fn dragging_the_elbow_keeps_theta2_and_dragging_the_tip_keeps_theta1() {
    let mut harness = lab(WIDE);
    let held = |q: &Coordinates, i: usize| (q[i] * 1e5).round();
    bring(&mut harness, "Reach");
    drag(&mut harness, "Reach: elbow, theta1 in radians", [-0.6, 0.9]);
    let first = harness.state().robot(1);
    let bearing = crate::num::atan2(0.9, -0.6);
    assert!(first.manual && (first.coordinates[0] - bearing).abs() < 0.01, "{:?}", first.coordinates);
    harness.run_steps(20);
    assert_eq!(harness.state().robot(1).coordinates, first.coordinates, "it stays where it was put");
    drag(&mut harness, "Reach: elbow, theta1 in radians", [0.3, -1.0]);
    let second = harness.state().robot(1);
    assert_eq!(held(&second.coordinates, 1), held(&first.coordinates, 1), "theta2 is kept");
    let radius = |r: &RobotView| r.tip.map(|t| t.coords.norm());
    assert!((radius(&second).unwrap() - radius(&first).unwrap()).abs() < 1e-5, "a circle about the base");
    drag(&mut harness, "Reach: tip, theta2 in radians", [1.5, 0.5]);
    let third = harness.state().robot(1);
    assert_eq!(held(&third.coordinates, 0), held(&second.coordinates, 0), "theta1 is kept");
    assert_ne!(held(&third.coordinates, 1), held(&second.coordinates, 1));
    // each drag is one thing to undo
    let moves = |lab: &Lab| lab.script().events.len();
    let all = moves(harness.state());
    click(&mut harness, "Undo");
    assert_eq!(harness.state().robot(1).coordinates, second.coordinates);
    click(&mut harness, "Undo");
    assert_eq!(harness.state().robot(1).coordinates, first.coordinates);
    click(&mut harness, "Undo");
    assert!(!harness.state().robot(1).manual && moves(harness.state()) == 0);
    (0..3).for_each(|_| click(&mut harness, "Redo"));
    assert_eq!(moves(harness.state()), all);
}

#[test]
fn a_focused_handle_is_nudged_and_numbers_are_typed() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    let before = harness.state().robot(1).coordinates;
    harness.get_by_label("Reach: tip, theta2 in radians").focus();
    harness.run_steps(2);
    let tick = harness.state().transport().tick;
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(3);
    assert_eq!(harness.state().transport().tick, tick, "the key is the handle's, and paused no tick runs");
    assert_eq!(harness.state().robot(1).coordinates, before);
    assert!(
        harness.state().script().events.iter().any(|e| matches!(e.input, RobotInput::MoveTo(_))),
        "it is on its way"
    );
    // every other key is still what it was
    for playback in [Playback::Playing, Playback::Paused] {
        harness.key_press(Key::Space);
        harness.run_steps(3);
        assert_eq!(harness.state().transport().playback, playback);
    }
    let nudged = harness.state().robot(1).coordinates;
    assert!((nudged[1] - before[1] - 0.02).abs() < 1e-5 && (nudged[0] - before[0]).abs() < 1e-5);
    harness.get_by_label("Reach: theta1").focus();
    harness.run_steps(2);
    harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
    harness.step();
    harness.event(Event::Text("-1.25".into()));
    harness.step();
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    click(&mut harness, "Step");
    assert!((harness.state().robot(1).coordinates[0] + 1.25).abs() < 1e-6);
}

#[test]
fn an_arm_of_three_links_walks_while_its_tip_stays() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    click(&mut harness, "three links");
    let robot = harness.state().robot(1);
    assert_eq!((robot.kind.as_str(), robot.coordinates.len()), ("reach3", 3));
    let tip = robot.tip.unwrap();
    let slider = harness.get_by_label("tip kept:").rect();
    let mut at = Vec::new();
    for part in [0.1, 0.3, 0.6, 0.9] {
        click_at(&mut harness, slider.left_center() + egui::vec2(part * slider.width(), 0.0));
        harness.run_steps(2);
        click(&mut harness, "Step");
        let robot = harness.state().robot(1);
        assert!((robot.tip.unwrap() - tip).norm() < 1e-5, "the tip stays, to the rounding of the targets");
        at.push(robot.coordinates[0]);
    }
    assert!(at.windows(2).all(|w| w[1] > w[0] + 0.05), "theta1 walks: {at:?}");
    click(&mut harness, "Undo");
    click(&mut harness, "two links");
    assert_eq!(harness.state().robot(1).coordinates.len(), 2);
}

#[test]
fn the_point_on_the_torus_is_dragged_and_the_arm_follows() {
    let mut harness = lab(WIDE);
    harness.run_steps(10);
    pause(&mut harness);
    assert!(harness.query_by_label_contains("Configuration of Rusty").is_some(), "a rover is a point as well");
    bring(&mut harness, "Reach");
    harness.run_steps(5);
    let point = "Reach: its configuration as a point, to be dragged";
    for (along, across) in [(egui::vec2(14.0, 0.0), 0), (egui::vec2(0.0, -14.0), 1)] {
        let before = harness.state().robot(1).coordinates;
        let from = harness.get_by_label(point).rect().center();
        pointer(&mut harness, from, Some(true));
        (1..=5).for_each(|i| pointer(&mut harness, from + along * (i as f32 / 5.0), None));
        harness.run_steps(2);
        pointer(&mut harness, from + along, Some(false));
        click(&mut harness, "Step");
        let after = harness.state().robot(1).coordinates;
        // right is theta1 and up theta2; both grow
        assert!(after[across] > before[across] + 0.1, "{before:?} {after:?}");
        assert!((after[1 - across] - before[1 - across]).abs() < 0.02, "{before:?} {after:?}");
        let now = harness.get_by_label(point).rect().center();
        assert!((now - from - along).length() < 1.5, "the point is where it was let go");
    }
}
