//! Moving through time: scrubbing, seeds, loops, speeds, frame rates.

mod why;

use super::screen::{keys, wheel};
use super::*;

#[test]
fn scrubbing_back_and_driving_on_forgets_what_came_later() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(40);
    harness.key_up(Key::ArrowUp);
    harness.step();
    harness.key_press(Key::Escape);
    harness.run_steps(20);
    pause(&mut harness);
    let end = harness.state().transport();
    let there = harness.state().app.world().resource::<LatestFrame>().frame().clone();
    harness.key_press(Key::Home);
    harness.run_steps(2);
    assert_eq!(harness.state().transport().tick, 0);
    assert_eq!(harness.state().transport().frontier, end.frontier, "scrubbing forgets nothing");
    harness.key_press(Key::End);
    harness.run_steps(2);
    assert_eq!(*harness.state().app.world().resource::<LatestFrame>().frame(), there, "the same bits");
    // to the middle by the time line itself
    let line = harness.get_by_label("time line, in ticks").rect();
    click_at(&mut harness, line.center());
    let middle = harness.state().transport().tick;
    assert!(middle.abs_diff(end.frontier / 2) <= 1, "{middle} of {}", end.frontier);
    click(&mut harness, "Continue from here");
    assert_eq!(harness.state().transport().frontier, middle);
    assert!(harness.state().script().events.iter().all(|e| e.tick <= middle));
    click(&mut harness, "Undo");
    assert_eq!(harness.state().transport().frontier, end.frontier);
    assert_eq!(harness.state().transport().tick, middle);
    // driving from the past continues from there too
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowDown);
    harness.run_steps(10);
    assert!(harness.state().transport().frontier < end.frontier);
    assert_eq!(harness.state().transport().playback, Playback::Playing, "who drives sees it move");
    // 20 ticks are a second
    let said = format!("What came after {:.2} s is dropped. Undo brings it back.", middle as f64 / 20.0);
    assert_eq!(interface(&harness).notice().unwrap().text, said);
}

#[test]
fn what_a_robot_touches_is_marked_as_long_as_the_robot_is_red() {
    let mut harness = lab(WIDE);
    bring(&mut harness, "Reach");
    while !harness.state().robot(1).in_contact {
        harness.step();
    }
    pause(&mut harness);
    let named = |harness: &Harness<'_, Lab>| {
        let names: Vec<String> =
            motion_lab_core::worlds::World::workbench().obstacles.iter().map(|o| o.name.clone()).collect();
        super::safe::words(harness).iter().any(|(text, ..)| names.contains(text))
    };
    assert!(harness.state().robot(1).in_contact && named(&harness));
    // as fast as possible the red of the arm changes less often than its contact
    let flash = interface_mut(&mut harness).flashes.get_mut("Reach").unwrap();
    (flash.red, flash.since) = (false, 1e9);
    harness.run_steps(2);
    assert!(!named(&harness), "the arm is not red");
}

#[test]
fn what_is_typed_into_the_clicked_seed_takes_the_place_of_the_old_one() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let field = harness.get_by_label("seed").rect().center();
    click_at(&mut harness, field);
    harness.event(Event::Text("7".into()));
    harness.step();
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().transport().seed.0, 7);
}

#[test]
fn a_seed_is_typed_and_typed_back() {
    let mut harness = lab(WIDE);
    harness.run_steps(100);
    pause(&mut harness);
    let tick = harness.state().transport().tick;
    let before = harness.state().app.world().resource::<LatestFrame>().frame().clone();
    let seed = |harness: &mut Harness<'_, Lab>, seed: &str| {
        harness.get_by_label("seed").focus();
        harness.run_steps(2);
        harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
        harness.step();
        harness.event(Event::Text(seed.into()));
        harness.step();
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        for _ in 0..tick {
            harness.key_press(Key::ArrowRight);
            harness.step();
        }
        harness.run_steps(2);
        harness.state().app.world().resource::<LatestFrame>().frame().clone()
    };
    let other = seed(&mut harness, "77");
    assert_eq!(harness.state().transport().seed.0, 77);
    assert_eq!(other.tick, tick);
    for (a, b) in other.robots.iter().zip(&before.robots) {
        assert!(a.configuration.iter().zip(&b.configuration).all(|(a, b)| a != b), "every coordinate is another");
    }
    assert_eq!(seed(&mut harness, "2005"), before, "typed back, each is restored");
}

#[test]
fn a_text_that_is_no_seed_goes_by_escape_a_press_beside_it_or_another_run_and_covers_no_time() {
    for size in [WIDE, [800.0, 600.0]] {
        let mut harness = lab(size);
        harness.run_steps(40);
        pause(&mut harness);
        let reason = "a whole number from 0 to";
        let lines = ["time line, in ticks", "takeovers so far"];
        let beside = paper(&harness, "Apartment").left_top() + egui::vec2(20.0, 60.0);
        for way in ["Escape", "a press", "R"] {
            harness.get_by_label("seed").focus();
            harness.run_steps(2);
            harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
            harness.step();
            harness.event(Event::Text("hello".into()));
            harness.step();
            harness.key_press(Key::Enter);
            harness.run_steps(4);
            let said = harness.get_by_label_contains(reason).rect();
            for line in lines {
                let line = harness.get_by_label_contains(line).rect();
                assert!(!said.intersects(line), "{size:?}: {said} on {line}");
            }
            assert_eq!(harness.get_by_label("seed").value().as_deref(), Some("hello"));
            match way {
                "Escape" => harness.key_press(Key::Escape),
                "R" => harness.key_press(Key::R),
                _ => click_at(&mut harness, beside),
            }
            harness.run_steps(4);
            assert!(harness.query_by_label_contains(reason).is_none(), "{size:?}: {way}");
            assert_eq!(harness.get_by_label("seed").value().as_deref(), Some("2005"), "{size:?}: {way}");
        }
        assert_eq!(harness.state().transport().frontier, 0, "R began it anew");
    }
}

#[test]
fn loops_speeds_and_contacts() {
    let mut harness = lab(WIDE);
    harness.run_steps(200);
    pause(&mut harness);
    let frontier = harness.state().transport().frontier;
    click(&mut harness, "Loop");
    click(&mut harness, "Play");
    harness.run_steps(60);
    let transport = harness.state().transport();
    assert!(transport.looping && transport.frontier == frontier && transport.tick < frontier, "{transport:?}");
    pause(&mut harness);
    let next =
        harness.state().app.world().resource::<ShownDashboard>().0.next_contact.expect("the arm meets obstacles");
    click(&mut harness, "Next contact");
    assert_eq!(harness.state().transport().tick, next);
    assert!(view(harness.state().app.world()).iter().any(|r| r.in_contact));
    for _ in 0..20 {
        harness.key_press(Key::Period);
        harness.run_steps(2);
    }
    assert!(harness.state().transport().speed.is_infinite());
    click(&mut harness, "Loop");
    harness.key_press(Key::End);
    harness.run_steps(2);
    click(&mut harness, "Play");
    harness.run_steps(10);
    let gone = harness.state().transport().tick - frontier;
    assert!(gone >= 10, "at least a tick a frame, where normal speed makes half of one: {gone} in ten frames");
}

/// The frames of the first 200 ticks of a run with input, played at this frame rate, with stalls of 5 s or without.
fn played(frames_per_second: u32, stall: bool) -> Vec<motion_lab_sim::run::Frame> {
    let mut app = app(Duration::from_secs_f64(1.0 / f64::from(frames_per_second)));
    app.update();
    let config = app.world().resource::<RunConfig>().config().clone();
    let event = |tick, robot: &str, input| motion_lab_sim::run::Event { tick, robot: robot.into(), input };
    let events = vec![
        event(10, "Rusty", RobotInput::Drive(128, 0)),
        event(40, "Hitch", RobotInput::SetTrailer(true)),
        event(60, "Hitch", RobotInput::Drive(-100, 50)),
        event(90, "Rusty", RobotInput::Release),
    ];
    let script = Script { events, ..Script::empty() };
    let world = app.world_mut();
    motion_lab_sim::simulation::start_run(world, config, (motion_lab_sim::tour::BOOK_SEED, script)).unwrap();
    world.resource_mut::<Transport>().playback = Playback::Playing;
    let mut stalls = 0;
    while app.world().resource::<Transport>().tick() < 200 {
        if stall && app.world().resource::<Transport>().tick() > 50 && stalls < 5 {
            stalls += 1;
            let usual = Duration::from_secs_f64(1.0 / f64::from(frames_per_second));
            app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs(5)));
            app.update();
            app.insert_resource(TimeUpdateStrategy::ManualDuration(usual));
        }
        app.update();
    }
    assert_eq!(stalls, if stall { 5 } else { 0 });
    let world = app.world_mut();
    (1..=200)
        .map(|tick| {
            motion_lab_sim::simulation::seek(world, tick).unwrap();
            world.resource::<LatestFrame>().frame().clone()
        })
        .collect()
}

#[test]
fn frame_rates_and_stalls_change_no_bit_of_a_run() {
    let smooth = played(60, false);
    for (rate, stall) in [(20, false), (144, false), (60, true), (7, true)] {
        assert_eq!(played(rate, stall), smooth, "{rate} frames a second, stall: {stall}");
    }
}

#[test]
fn each_robot_has_a_lane_and_a_click_goes_to_what_happened_to_it() {
    let mut harness = lab(WIDE);
    harness.run_steps(400);
    pause(&mut harness);
    let end = harness.state().transport().frontier;
    let history = harness.state().app.world().resource::<History>();
    let of = |robot| history.marks().iter().filter(move |mark| mark.robot == robot).map(|mark| mark.tick);
    let contact = of(1).next().expect("the arm meets obstacles");
    assert!(of(0).all(|tick| tick.abs_diff(contact) > 10), "the rover met nothing then");
    let lanes = harness.get_by_label_contains("takeovers so far").rect();
    let x = lanes.left() + lanes.width() * contact as f32 / end as f32;
    // four points beside the mark: a click on the arm's lane means it, one on the rover's the time
    for (lane, tick) in [(1.0, contact), (0.0, contact + (4.0 * end as f32 / lanes.width()).round() as u64)] {
        let at = egui::pos2(x + 4.0, lanes.top() + (lane + 0.5) * lanes.height() / 3.0);
        click_at(&mut harness, at);
        let found = harness.state().transport().tick;
        assert!(found == tick || lane == 0.0 && found.abs_diff(tick) <= 1 && found != contact, "{found}, not {tick}");
    }
}

#[test]
fn the_transport_bar_fits_the_narrowest_phone() {
    let mut harness = lab([320.0, 640.0]);
    for name in ["Pause", "Step", "More"] {
        let rect = harness.get_by_label(name).rect();
        assert!(rect.right() <= 320.0 - 12.0 && rect.left() >= 12.0, "{name}: {rect:?}");
    }
    harness.get_by_label("More").click();
    harness.run_steps(3);
    click(&mut harness, "Re-roll");
    assert_ne!(harness.state().transport().seed, motion_lab_sim::tour::BOOK_SEED);
    // the seed is typed in the menu, which stays meanwhile
    let mut harness = lab(PHONE);
    harness.get_by_label("More").click();
    harness.run_steps(3);
    let field = harness.get_by_role_and_label(egui::accesskit::Role::TextInput, "seed");
    let at = field.rect().center();
    click_at(&mut harness, at);
    harness.event(Event::Key {
        key: Key::A,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::COMMAND,
    });
    harness.event(Event::Text("11".into()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().transport().seed, motion_lab_core::random::Seed(11));
    for name in ["Back", "Pause", "Step", "Next contact", "More"] {
        let rect = lab(PHONE).get_by_label(name).rect();
        assert!(rect.width() >= 44.0 && rect.height() >= 44.0, "{name}: {rect:?}");
    }
}

#[test]
fn the_wheel_keeps_the_time_under_the_pointer_wherever_the_paused_run_stands() {
    for share in [0.2, 0.5, 0.8] {
        let mut harness = lab(WIDE);
        keys(&mut harness, Key::Period, 6);
        harness.run_steps(120);
        pause(&mut harness);
        let end = harness.state().transport().tick;
        assert!(end > 500, "{end}");
        let lanes = harness.get_by_label_contains(" so far: a click goes to one").rect();
        let at = pos2(lanes.left() + share * lanes.width(), lanes.center().y);
        let under = f64::from(share) * end as f64;
        // near and nearer, and half the way back
        for points in [240.0, 240.0, -240.0] {
            wheel(&mut harness, at, points);
            let span = interface(&harness).span.part.unwrap();
            let now = span.from as f64 + f64::from(share) * (span.to - span.from) as f64;
            assert!((now - under).abs() < 2.0, "{under} of {end} was under the pointer, {now} is: {span:?}");
        }
        assert!(!interface(&harness).span.part.unwrap().holds(end), "the run stands beside it");
        assert_eq!(harness.state().transport().tick, end, "the wheel goes nowhere");
        // the arrow keys go on from where the run stands, and show it
        harness.get_by_label("time line, in ticks").focus();
        keys(&mut harness, Key::ArrowLeft, 1);
        assert_eq!(harness.state().transport().tick, end - 1);
        assert!(interface(&harness).span.part.unwrap().holds(end - 1));
    }
}
