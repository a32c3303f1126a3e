//! Moving the arm: drags, nudges, numbers, the null space.

use super::*;

#[test]
fn dragging_the_elbow_keeps_theta2_and_dragging_the_tip_turns_joint_2_alone() {
    let mut harness = lab(WIDE);
    let held = |q: &Coordinates, i: usize| (q[i] * 1e5).round();
    bring(&mut harness, "Reach");
    drag(&mut harness, "Reach: elbow, θ₁ in radians", [-0.6, 0.9]);
    let first = harness.state().robot(1);
    let bearing = motion_lab_core::num::atan2(0.9, -0.6);
    assert!(first.manual && (first.coordinates[0] - bearing).abs() < 0.01, "{:?}", first.coordinates);
    harness.run_steps(20);
    assert_eq!(harness.state().robot(1).coordinates, first.coordinates, "it stays where it was put");
    drag(&mut harness, "Reach: elbow, θ₁ in radians", [0.3, -1.0]);
    let second = harness.state().robot(1);
    assert_eq!(held(&second.coordinates, 1), held(&first.coordinates, 1), "theta2 is kept");
    let radius = |r: &RobotView| r.tip.map(|t| t.coords.norm());
    assert!((radius(&second).unwrap() - radius(&first).unwrap()).abs() < 1e-5, "a circle about the base");
    // the tip goes on its circle about the elbow, as near to the pointer as that comes: the elbow stays where it is
    let (s, c) = motion_lab_core::num::sin_cos(second.coordinates[0]);
    let elbow = motion_lab_core::geometry::Point2::new(c, s);
    for wish in [[1.5, 0.5], [1.8, 1.8]] {
        drag(&mut harness, "Reach: tip, θ₂ in radians", wish);
        let third = harness.state().robot(1);
        assert_eq!(held(&third.coordinates, 0), held(&second.coordinates, 0), "theta1 is kept");
        let (link, away) = (third.tip.unwrap() - elbow, motion_lab_core::geometry::Point2::from(wish) - elbow);
        assert!((link.norm() - 1.0).abs() < 1e-5, "{link:?}");
        assert!((link - away.normalize()).norm() < 0.02, "{link:?} toward {away:?}");
        assert!(held(&third.coordinates, 1) != held(&second.coordinates, 1));
    }
    click(&mut harness, "Undo");
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
    harness.get_by_label("Reach: tip, θ₂ in radians").focus();
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
    // finely where Shift was held with the key, if it is let go within the frame
    let finely = |pressed| {
        let (physical_key, repeat, modifiers) = (None, false, Modifiers::SHIFT);
        Event::Key { key: Key::ArrowRight, physical_key, pressed, repeat, modifiers }
    };
    [true, false].into_iter().for_each(|pressed| harness.event(finely(pressed)));
    harness.run_steps(2);
    click(&mut harness, "Step");
    let fine = harness.state().robot(1).coordinates;
    assert!((fine[1] - nudged[1] + 0.002).abs() < 1e-5, "{nudged:?} {fine:?}");
    harness.get_by_label("Reach: θ₁").focus();
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
    // a dragged tip turns its own joint alone
    let before = harness.state().robot(1);
    let to = before.tip.unwrap() * 0.9;
    drag(&mut harness, "Reach: tip, θ₃ in radians", [to.x, to.y]);
    click(&mut harness, "Step");
    let after = harness.state().robot(1);
    let turned = [0, 1, 2].map(|joint| (after.coordinates[joint] - before.coordinates[joint]).abs());
    assert!(turned[0] < 1e-5 && turned[1] < 1e-5 && turned[2] > 0.01, "{turned:?}");
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

/// Puts the paused arm at these angles.
fn put(harness: &mut Harness<'_, Lab>, angles: [f64; 2]) {
    let to = angles.map(|v| motion_lab_sim::run::Quantized::try_new(v).unwrap()).to_vec();
    let command = motion_lab_sim::simulation::RobotCommand { robot: "Reach".into(), input: RobotInput::MoveTo(to) };
    harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
    harness.run_steps(3);
    click(harness, "Step");
}

/// The events of the script that move the arm.
fn moves(harness: &Harness<'_, Lab>) -> Vec<u64> {
    let events = harness.state().script().events.iter();
    events.filter(|e| matches!(e.input, RobotInput::MoveTo(_))).map(|e| e.tick).collect()
}

#[test]
fn the_arm_goes_to_its_other_elbow_where_the_way_is_free() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    // links of one length: the other elbow is (th1 + th2, -th2), past the straight arm
    put(&mut harness, [-0.5, 0.3]);
    let (before, events) = (harness.state().robot(1), moves(&harness).len());
    click(&mut harness, "One tip, two elbows");
    assert!(!interface(&harness).settings.done.iter().any(|task| task == "TwoElbows"), "it is on its way");
    harness.run_steps(40);
    let after = harness.state().robot(1);
    assert!((after.coordinates[0] + 0.2).abs() < 1e-4 && (after.coordinates[1] + 0.3).abs() < 1e-4, "{after:?}");
    assert!((after.tip.unwrap() - before.tip.unwrap()).norm() < 1e-4, "one tip");
    assert_eq!(after.contacts, before.contacts);
    // 0.6 rad, and the rounding of inputs, at most 0.1 rad a tick, a target in each: input like any other
    let ticks = moves(&harness).split_off(events);
    assert!((6..=7).contains(&ticks.len()), "{ticks:?}");
    assert!(ticks.windows(2).all(|pair| pair[1] == pair[0] + 1), "{ticks:?}");
    assert!(interface(&harness).settings.done.iter().any(|task| task == "TwoElbows"));
    assert!(!interface(&harness).settings.done.iter().any(|task| task == "MoveArm"), "nobody dragged it");
    assert_eq!(harness.state().transport().playback, Playback::Paused, "as it was before");
    click(&mut harness, "Undo");
    assert_eq!(harness.state().robot(1).coordinates, before.coordinates, "one thing to undo");
}

#[test]
fn as_fast_as_possible_the_arm_goes_to_its_other_elbow_tick_by_tick() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    put(&mut harness, [-0.5, 0.3]);
    let (tick, events) = (harness.state().transport().tick, moves(&harness).len());
    let transport = |harness: &mut Harness<'_, Lab>, playback| {
        let mut transport = harness.state_mut().app.world_mut().resource_mut::<Transport>();
        (transport.speed, transport.playback) = (f64::INFINITY, playback);
    };
    transport(&mut harness, Playback::Paused);
    click(&mut harness, "One tip, two elbows");
    harness.run_steps(20);
    let after = harness.state().robot(1);
    assert!((after.coordinates[0] + 0.2).abs() < 1e-4 && (after.coordinates[1] + 0.3).abs() < 1e-4, "{after:?}");
    let (ticks, now) = (moves(&harness).split_off(events), harness.state().transport());
    // 0.6 rad at 0.1 rad a tick
    assert!((6..=7).contains(&ticks.len()) && now.tick == tick + ticks.len() as u64, "{ticks:?} {tick} {now:?}");
    assert_eq!(now.playback, Playback::Paused);
    // a run that played plays on
    put(&mut harness, [-0.5, 0.3]);
    let button = harness.get_by_label("One tip, two elbows").rect().center();
    pointer(&mut harness, button, Some(true));
    transport(&mut harness, Playback::Playing);
    let before = harness.state().transport().tick;
    pointer(&mut harness, button, Some(false));
    harness.run_steps(20);
    let now = harness.state().transport();
    assert!(now.playback == Playback::Playing && now.tick > before + 20, "{before} {now:?}");
}

#[test]
fn what_blocks_the_way_to_the_other_elbow_is_named_and_the_arm_stays() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    // halfway the arm is straight and points across the post
    put(&mut harness, [1.85, 1.4]);
    let before = harness.state().robot(1);
    harness.get_by_label("the ghost has the same tip: send the arm there");
    click(&mut harness, "One tip, two elbows");
    harness.get_by_label_contains("the straight way hits the post at s = 0.");
    assert!(interface(&harness).settings.done.iter().any(|task| task == "TwoElbows"));
    let task = motion_lab_sim::manifest::Lesson::of("two_elbows").unwrap();
    assert!(task.text().contains("or see what blocks it"), "which is the task, too");
    click(&mut harness, "Play");
    harness.run_steps(20);
    harness.get_by_label_contains("the straight way hits the post at s = 0.");
    let after = harness.state().robot(1);
    assert_eq!((&after.coordinates, after.contacts), (&before.coordinates, before.contacts), "it stays");
    // what was said of it goes with the first input, also in a pause
    pause(&mut harness);
    let to = [1.0, 1.0].map(|v| motion_lab_sim::run::Quantized::try_new(v).unwrap()).to_vec();
    let command = motion_lab_sim::simulation::RobotCommand { robot: "Reach".into(), input: RobotInput::MoveTo(to) };
    harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
    harness.run_steps(4);
    assert!(harness.query_by_label_contains("the straight way hits the post").is_none());
    // moved by somebody else, the arm is not the one that this was said of
    drag(&mut harness, "Reach: elbow, θ₁ in radians", [0.3, -1.0]);
    assert!(harness.query_by_label_contains("the straight way").is_none());
}

#[test]
fn a_way_that_is_refused_leaves_the_run_as_it_is() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    put(&mut harness, [1.85, 1.4]);
    click(&mut harness, "Play");
    harness.run_steps(20);
    pause(&mut harness);
    (0..3).for_each(|_| click(&mut harness, "Back"));
    let run = |harness: &Harness<'_, Lab>| {
        let shown = &harness.state().app.world().resource::<ShownDashboard>().0;
        (shown.frontier, harness.state().script().clone())
    };
    let before = run(&harness);
    click(&mut harness, "One tip, two elbows");
    harness.get_by_label_contains("the straight way hits the post at s = 0.");
    harness.run_steps(10);
    assert_eq!(run(&harness), before, "what came later is still there");
}

#[test]
fn a_tip_that_was_out_of_reach_bends_back_to_its_side() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    for bend in [1.0, -1.0] {
        put(&mut harness, [-0.6, bend]);
        let from = harness.get_by_label("Reach: tip, θ₂ in radians").rect().center();
        let base = paper(&harness, "Workbench").center();
        pointer(&mut harness, from, Some(true));
        for far in [1.1, 1.2, 1.3, 1.2, 1.1, 1.0] {
            pointer(&mut harness, base + (from - base) * far, None);
            harness.run_steps(2);
        }
        pointer(&mut harness, from, Some(false));
        click(&mut harness, "Step");
        let q = harness.state().robot(1).coordinates;
        assert!((q[0] + 0.6).abs() < 0.05 && (q[1] - bend).abs() < 0.05, "{bend}: {q:?}");
    }
}

#[test]
fn a_straight_arm_has_no_other_elbow() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    put(&mut harness, [-0.3, 0.0]);
    harness.get_by_label("straight or folded: no other arm has this tip");
    let events = moves(&harness).len();
    click(&mut harness, "One tip, two elbows");
    assert_eq!(moves(&harness).len(), events, "nothing to go to");
}

#[test]
fn a_way_ends_where_time_or_another_hand_takes_the_arm_elsewhere() {
    for taken in ["Back", "number"] {
        let mut harness = lab(WIDE);
        pause(&mut harness);
        bring(&mut harness, "Reach");
        put(&mut harness, [-0.5, 0.3]);
        click(&mut harness, "One tip, two elbows");
        harness.run_steps(2);
        pause(&mut harness);
        assert!(interface(&harness).twin.is_some(), "on its way");
        if taken == "number" {
            put(&mut harness, [-1.0, 0.5]);
        } else {
            (0..2).for_each(|_| click(&mut harness, taken));
        }
        let events = moves(&harness).len();
        click(&mut harness, "Play");
        harness.run_steps(20);
        assert!(interface(&harness).twin.is_none() && moves(&harness).len() == events, "{taken}");
    }
}

#[test]
fn an_arm_that_waits_for_a_tick_with_a_drag_is_not_sent_to_the_other_elbow() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    drag(&mut harness, "Reach: tip, \u{3b8}\u{2082} in radians", [1.2, 0.6]);
    let moves = harness.state().script().events.clone();
    assert!(!moves.is_empty());
    harness.get_by_label_contains("the drag waits for the next tick: step or play first");
    harness.get_by_label("One tip, two elbows").click();
    harness.run_steps(4);
    assert_eq!(harness.state().script().events, moves, "the drag is kept");
    click(&mut harness, "Step");
    assert!(harness.query_by_label_contains("the drag waits for the next tick: step or play first").is_none());
}
