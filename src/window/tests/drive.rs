//! Driving the rover and the car, by keys and by the pad.

mod arm;
mod bodies;
mod tow;

use super::*;

#[test]
fn a_pane_is_taken_in_hand_by_keyboard_alone_and_driven() {
    let mut harness = lab(WIDE);
    let pane = harness
        .get_all_by_role(egui::accesskit::Role::Button)
        .find(|n| n.accesskit_node().label().is_some_and(|label| label.starts_with("Apartment")));
    pane.expect("the pane").focus();
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(4);
    harness.key_up(Key::ArrowUp);
    harness.run_steps(2);
    assert_eq!(harness.state().script().events.first().map(|e| &e.input), Some(&RobotInput::Drive(128, 0)));
}

#[test]
fn shift_drives_a_quarter_as_fast() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.event(Event::ModifiersChanged(Modifiers::SHIFT));
    harness.key_down(Key::ArrowUp);
    harness.run_steps(2);
    harness.key_down(Key::ArrowLeft);
    harness.run_steps(2);
    harness.key_up(Key::ArrowUp);
    harness.key_up(Key::ArrowLeft);
    harness.run_steps(2);
    let inputs: Vec<RobotInput> = harness.state().script().events.iter().map(|event| event.input.clone()).collect();
    assert_eq!(inputs, [RobotInput::Drive(32, 0), RobotInput::Drive(32, 32), RobotInput::Drive(0, 0)]);
}

#[test]
fn a_stick_drives_the_robot_in_hand_and_rests_when_it_is_let_go() {
    let mut harness = lab(WIDE);
    let push = |harness: &mut Harness<'_, Lab>, channels| {
        harness.state_mut().app.world_mut().resource_mut::<Interface>().0.hand.stick = channels;
        harness.run_steps(3);
    };
    push(&mut harness, (100, 0));
    assert!(harness.state().script().events.is_empty(), "no robot is in hand");
    push(&mut harness, (0, 0));
    arm_rusty(&mut harness);
    push(&mut harness, (100, -20));
    // keys stand above it
    harness.key_down(Key::ArrowUp);
    harness.run_steps(2);
    harness.key_up(Key::ArrowUp);
    harness.run_steps(2);
    push(&mut harness, (0, 0));
    let inputs: Vec<RobotInput> = harness.state().script().events.iter().map(|event| event.input.clone()).collect();
    let driven = [(100, -20), (128, 0), (100, -20), (0, 0)].map(|(ahead, left)| RobotInput::Drive(ahead, left));
    assert_eq!(inputs, driven);
}

#[test]
fn rusty_is_driven_into_a_wall_and_stops_a_radius_short_of_it() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    assert!(!harness.state().robot(0).manual, "taking in hand is no input");
    harness.key_down(Key::ArrowUp);
    harness.run_steps(600);
    let rusty = harness.state().robot(0);
    assert!(rusty.manual && rusty.in_contact);
    let trail = harness.state().app.world().resource::<History>().at(harness.state().transport().tick, 0).cloned();
    let clearance = trail.expect("noted").clearance;
    assert!((1e-5..=1e-4).contains(&clearance), "{clearance}");
    assert_eq!(rusty.footprint.parts()[0].placed().radius(), 0.11);
    // it is not said to be at a distance that reads as none, but held before what is named on the paper
    let words = || super::safe::words(&harness).into_iter().map(|(text, ..)| text);
    let held = words().find(|text| text.starts_with("held ")).expect("it says so");
    let (mm, name) = held["held ".len()..].split_once("\u{a0}mm before ").expect("a distance and a name");
    assert!((mm.parse::<f64>().unwrap() - 1e3 * clearance).abs() <= 0.0051, "{held}: {clearance}");
    assert!(words().any(|text| text == name), "{held}");
    assert!(!words().any(|text| text.starts_with("clearance: ")));
    // backing away is free again
    harness.key_up(Key::ArrowUp);
    harness.key_down(Key::ArrowDown);
    harness.run_steps(40);
    assert!(!harness.state().robot(0).in_contact);
    harness.get_by_label_contains("clearance: ");
    harness.key_up(Key::ArrowDown);
    harness.step();
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(harness.state().app.world().resource::<Interface>().0.hand.armed, None);
    assert!(harness.state().robot(0).manual, "letting go is not giving back");
    click(&mut harness, "resume tour");
    harness.run_steps(4);
    assert!(!harness.state().robot(0).manual);
}

#[test]
fn a_car_that_only_steers_does_not_slide_sideways() {
    let mut harness = lab(WIDE);
    harness.key_press(Key::Num3);
    harness.run_steps(2);
    harness.key_down(Key::ArrowLeft);
    harness.run_steps(10);
    let before = harness.state().robot(2).coordinates;
    harness.run_steps(40);
    assert_eq!(harness.state().robot(2).coordinates, before, "steering alone moves nothing");
    assert_eq!(harness.state().robot(2).channels, [0, 128]);
}

#[test]
fn the_trailer_goes_on_and_a_goal_is_set_for_it() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Hitch");
    click(&mut harness, "put a trailer on");
    click(&mut harness, "Step");
    assert_eq!(harness.state().robot(2).coordinates.len(), 4);
    click(&mut harness, "goal: one metre to the left");
    harness.get_by_label("goal: off by 1.00 m, 0.00 rad; 0 reversals");
    harness.get_by_label_contains("straight back takes the car 0.89 m aside");
    click(&mut harness, "drop the goal");
    assert!(harness.query_by_label("drop the goal").is_none());
    click(&mut harness, "take the trailer off");
    click(&mut harness, "Step");
    assert_eq!(harness.state().robot(2).coordinates.len(), 3);
}

#[test]
fn where_there_is_no_room_for_a_trailer_it_is_said() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Hitch");
    // the rear axle 1.2 m or 2.5 m from the west curb, facing away from it: the trailer would stand across the curb
    for x in [1.2, 2.5] {
        let to = [x, 2.5, 0.0].map(|v| motion_lab_sim::run::Quantized::try_new(v).unwrap()).to_vec();
        let command =
            motion_lab_sim::simulation::RobotCommand { robot: "Hitch".into(), input: RobotInput::Teleport(to) };
        harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
        harness.run_steps(3);
        harness.get_by_label("comes with the next tick");
        click(&mut harness, "Step");
        assert!((harness.state().robot(2).coordinates[0] - x).abs() < 1e-6, "{:?}", harness.state().robot(2));
        click(&mut harness, "put a trailer on");
        harness.get_by_label("no room for a trailer: would overlap the west curb");
        assert!(harness.query_by_label("comes with the next tick").is_none(), "nothing is asked of the run");
        click(&mut harness, "Dismiss");
    }
}

#[test]
fn one_thing_is_said_at_the_pointer_and_what_a_robot_in_hand_says_covers_nothing() {
    const CLICK: &str = "Click to drive Rusty, drag to tow it, Alt-drag to put it elsewhere";
    let mut harness = lab(WIDE);
    pause(&mut harness);
    let paper = paper(&harness, "Apartment");
    // the bookcase at the lower right, and the floor of the corridor
    for (share, said) in [([0.97, 0.9], "E's bookcase"), ([0.5, 0.52], CLICK)] {
        let at = paper.min + egui::vec2(share[0] * paper.width(), share[1] * paper.height());
        pointer(&mut harness, at, None);
        harness.run_steps(80);
        let tips = ["E's bookcase", CLICK];
        let words = super::safe::words(&harness);
        let shown: Vec<&str> = tips.into_iter().filter(|tip| words.iter().any(|(text, ..)| text == tip)).collect();
        assert_eq!(shown, [said]);
    }
    arm_rusty(&mut harness);
    let place = super::safe::read_whole(&harness, "arrows drive, Esc lets go");
    let world = &motion_lab_core::worlds::World::apartment();
    let fit = crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(world), paper);
    let [min, max] = [place.left_bottom(), place.right_top()].map(|p| fit.world_from_screen([p.x.into(), p.y.into()]));
    let shape = motion_lab_core::geometry::Shape::Rectangle { min, max };
    let part = motion_lab_core::geometry::Part::new(motion_lab_core::geometry::Pose2::IDENTITY, shape);
    let scene = motion_lab_core::collision::Scene::of_world(world);
    assert!(paper.contains_rect(place));
    assert!(
        !motion_lab_core::collision::Collision::intersects(&scene, &motion_lab_core::geometry::Footprint::new([part])),
        "{place}"
    );
}

#[test]
fn links_keep_their_places_while_the_run_plays() {
    for size in [WIDE, [1000.0, 700.0], PHONE] {
        let mut harness = lab(size);
        for (world, last) in [(2, "nearest points"), (0, "close door E")] {
            interface_mut(&mut harness).settings.world = world;
            harness.run_steps(10);
            let at = |harness: &Harness<'_, Lab>| harness.get_by_label(last).rect().min;
            let before = at(&harness);
            // the tour comes where there is no room for a trailer, and where there is
            let mut rooms = std::collections::BTreeSet::new();
            for _ in 0..40 {
                harness.run_steps(10);
                let shown = &harness.state().app.world().resource::<ShownDashboard>().0;
                rooms.insert(shown.cockpits[2].robots[0].no_room.is_some());
                assert_eq!(at(&harness), before, "{world} at {size:?}");
            }
            assert_eq!(rooms.len(), 2, "the test sees both");
            let input = RobotInput::Drive(64, 0);
            let robot = ["Rusty", "Reach", "Hitch"][world as usize].to_owned();
            let command = motion_lab_sim::simulation::RobotCommand { robot, input };
            harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
            harness.run_steps(6);
            assert!(harness.state().robot(world as usize).manual);
            assert_eq!(at(&harness), before, "driven by hand, {world} at {size:?}");
        }
    }
}

#[test]
fn the_pad_drives_like_the_keys() {
    let mut harness = lab(PHONE);
    arm_rusty(&mut harness);
    let pad = harness.get_by_label("Rusty: pad, up drives forward").rect();
    pointer(&mut harness, pad.center_top() + egui::vec2(0.0, 1.0), Some(true));
    harness.run_steps(6);
    let channels = harness.state().robot(0).channels;
    assert!(channels[0] > 120 && channels[1] == 0, "{channels:?}");
    pointer(&mut harness, pad.center_top(), Some(false));
    harness.run_steps(6);
    assert_eq!(harness.state().robot(0).channels, [0, 0]);
}

#[test]
fn on_a_phone_the_pad_covers_nothing_and_takes_its_robot_in_hand() {
    let mut harness = lab(PHONE);
    let pad = harness.get_by_label("Rusty: pad, up drives forward").rect();
    let room = paper(&harness, "Apartment");
    let inset = harness.get_by_label_contains("Configuration of Rusty").rect();
    assert!(!pad.intersects(room) && !pad.intersects(inset) && pad.right() <= PHONE[0], "{pad} {room} {inset}");
    pointer(&mut harness, pad.center_top() + egui::vec2(0.0, 1.0), Some(true));
    harness.run_steps(6);
    assert_eq!(interface(&harness).hand.armed.as_deref(), Some("Rusty"));
    assert!(harness.state().robot(0).channels[0] > 120);
    assert_eq!(harness.get_by_label("Rusty: pad, up drives forward").rect(), pad, "it stays where it is");
    pointer(&mut harness, pad.center_top(), Some(false));
    harness.run_steps(6);
    assert_eq!(harness.state().robot(0).channels, [0, 0]);
    // an arm has none
    click(&mut harness, "Reach");
    assert!(harness.query_by_label_contains("pad, up drives").is_none());
}

#[test]
fn a_cockpit_comes_to_the_front_and_the_robot_in_hand_is_let_go() {
    let mut harness = lab(WIDE);
    arm_rusty(&mut harness);
    harness.key_down(Key::ArrowUp);
    harness.run_steps(10);
    assert_ne!(harness.state().robot(0).channels, [0, 0]);
    bring(&mut harness, "Hitch");
    harness.key_up(Key::ArrowUp);
    harness.run_steps(4);
    let armed = |h: &Harness<'_, Lab>| h.state().app.world().resource::<Interface>().0.hand.armed.clone();
    assert_eq!((armed(&harness), harness.state().robot(0).channels), (None, [0, 0]), "it does not drive on");
    assert!(paper(&harness, "Lot").width() > 500.0);
    // its key takes it in hand where it stands, at the front or not
    harness.key_press(Key::Num1);
    harness.run_steps(4);
    assert_eq!(armed(&harness).as_deref(), Some("Rusty"));
    assert!(paper(&harness, "Apartment").width() > 500.0);
}

/// A solution of exercise 4, found by a search over such scripts with the equations of car and trailer.
const ONE_METRE_LEFT: &str = include_str!("../../../examples/exercises/one_metre_left.ron");

/// For how many ticks which channels are held.
fn held() -> Vec<(u64, [i16; 2])> {
    let script = motion_lab_sim::run::Script::parse("one_metre_left.ron", ONE_METRE_LEFT).unwrap();
    let drives = script.events.iter().filter_map(|event| match event.input {
        RobotInput::Drive(ahead, left) => Some((event.tick, [ahead, left])),
        _ => None,
    });
    let drives: Vec<(u64, [i16; 2])> = drives.collect();
    drives.windows(2).map(|pair| (pair[1].0 - pair[0].0, pair[0].1)).collect()
}

#[test]
fn one_metre_to_the_left_is_driven_scored_and_tried_again() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Hitch");
    let input = |harness: &mut Harness<'_, Lab>, input: RobotInput| {
        let command = motion_lab_sim::simulation::RobotCommand { robot: "Hitch".into(), input };
        harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
    };
    let tick = |harness: &mut Harness<'_, Lab>| {
        harness
            .state_mut()
            .app
            .world_mut()
            .write_message(RunCommand::from(motion_lab_sim::simulation::TransportCommand::Step));
        harness.step();
    };
    // in the aisle, where the car begins
    input(&mut harness, RobotInput::SetTrailer(true));
    let start = [6.5, 2.5, 0.0, 0.0].map(|v| motion_lab_sim::run::Quantized::try_new(v).unwrap()).to_vec();
    tick(&mut harness);
    input(&mut harness, RobotInput::Teleport(start));
    tick(&mut harness);
    harness.run_steps(3);
    let contacts = harness.state().robot(2).contacts;
    click(&mut harness, "goal: one metre to the left");
    for (ticks, [ahead, left]) in held() {
        assert!(harness.query_by_label_contains("Reached").is_none());
        input(&mut harness, RobotInput::Drive(ahead, left));
        (0..ticks).for_each(|_| tick(&mut harness));
    }
    harness.run_steps(3);
    let car = harness.state().robot(2);
    let [x, y, _, psi] = car.coordinates[..] else { panic!("a trailer: {car:?}") };
    assert!(motion_lab_core::num::hypot(x - 6.5, y - 3.5) < 0.05 && psi.abs() < 0.05, "{car:?}");
    assert_eq!(car.contacts, contacts);
    let goal = interface(&harness).goal.clone().unwrap().1;
    let score = goal.score.unwrap();
    // at 0.075 m a tick
    assert!(
        score.reversals == 1 && score.seconds <= 6.75 && (score.metres - 1.5 * score.seconds).abs() < 0.1,
        "{score:?}"
    );
    harness.get_by_label_contains("Reached: one metre to the left in 6.");
    // again from where it began
    click(&mut harness, "again");
    assert!(harness.query_by_label_contains("Reached").is_none());
    tick(&mut harness);
    harness.run_steps(3);
    assert_eq!(harness.state().robot(2).coordinates[..], [6.5, 2.5, 0.0, 0.0]);
    harness.get_by_label("goal: off by 1.00 m, 0.00 rad; 0 reversals");
    // lifted there by its body it is not driven there, by whatever it drives afterwards
    let body = harness.get_by_label("Hitch: its body, to be dragged").rect().center();
    let lot = motion_lab_core::worlds::World::lot();
    let fit = crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(&lot), paper(&harness, "Lot"));
    let there = body - egui::vec2(0.0, fit.px_per_metre() as f32);
    alt(&mut harness, true);
    pointer(&mut harness, body, Some(true));
    (1..=10).for_each(|i| pointer(&mut harness, body.lerp(there, i as f32 / 10.0), None));
    alt(&mut harness, false);
    let says_put =
        |harness: &Harness<'_, Lab>| super::safe::words(harness).iter().any(|(text, ..)| text == "put, not driven");
    assert!(says_put(&harness), "while it is lifted");
    pointer(&mut harness, there, Some(false));
    tick(&mut harness);
    harness.run_steps(3);
    assert!(!says_put(&harness));
    let car = harness.state().robot(2);
    assert!(motion_lab_core::num::hypot(car.coordinates[0] - 6.5, car.coordinates[1] - 3.5) < 0.05, "{car:?}");
    harness.get_by_label("goal: the car was put, and not driven, since; \"again\" begins anew");
    (0..250).for_each(|_| tick(&mut harness));
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("Reached").is_none());
    // undone, it stands where it was
    click(&mut harness, "Undo");
    harness.get_by_label("goal: off by 1.00 m, 0.00 rad; 0 reversals");
}

#[test]
fn a_car_turned_about_is_a_ghost_that_its_wheels_do_not_lead_to() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Hitch");
    let events = harness.state().script().events.len();
    let put = |harness: &mut Harness<'_, Lab>, x: f64| {
        let to = [x, 2.5, 0.0].map(|v| motion_lab_sim::run::Quantized::try_new(v).unwrap()).to_vec();
        let command =
            motion_lab_sim::simulation::RobotCommand { robot: "Hitch".into(), input: RobotInput::Teleport(to) };
        harness.state_mut().app.world_mut().write_message(RunCommand::from(command));
        harness.run_steps(3);
        click(harness, "Step");
    };
    put(&mut harness, 6.5);
    assert!(harness.query_by_label_contains("its wheels can't turn it on the spot").is_none(), "on demand");
    click(&mut harness, "One place, two headings");
    harness.get_by_label_contains("free there too; its wheels can't turn it on the spot");
    // 1.5 m from the west curb there is no room for it, the other way about
    put(&mut harness, 1.5);
    harness.get_by_label_contains("there it overlaps the west curb; its wheels can't turn it on the spot");
    assert!(interface(&harness).settings.done.iter().any(|task| task == "TwoHeadings"));
    click(&mut harness, "One place, two headings");
    assert!(harness.query_by_label_contains("its wheels can't turn it on the spot").is_none());
    assert_eq!(harness.state().script().events.len(), events + 2, "it is no input");
}
