//! Query anatomy, behaviour by behaviour.

mod prompts;

use super::*;
use motion_lab_core::geometry::Point2;
use motion_lab_core::picture::Role;
use motion_lab_sim::anatomy::{Anatomy, Tab};

fn anatomy(harness: &Harness<'_, Lab>) -> Anatomy {
    harness.state().app.world().resource::<Interface>().0.anatomy.anatomy.clone()
}

/// The lab with the anatomy in front, on this tab.
fn on(tab: &str) -> Harness<'static, Lab> {
    let mut harness = lab(WIDE);
    click(&mut harness, "Query");
    click(&mut harness, tab);
    harness
}

/// The text copied in the last frame.
fn copied(harness: &Harness<'_, Lab>) -> Option<String> {
    let commands = &harness.output().platform_output.commands;
    commands.iter().find_map(|c| match c {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    })
}

fn press(harness: &mut Harness<'_, Lab>, name: &str) -> Option<String> {
    harness.get_by_label(name).click();
    // the click is seen in one frame and its text is put out in it
    (0..3).find_map(|_| {
        harness.step();
        copied(harness)
    })
}

/// Asserts that the line of the readout that begins with `begins` is on the screen.
fn says(harness: &Harness<'_, Lab>, begins: &str) {
    let lines = anatomy(harness).readout();
    let line = lines.iter().find(|line| line.starts_with(begins)).unwrap_or_else(|| panic!("{begins}: {lines:?}"));
    harness.get_by_label(&line.replace('-', "\u{2212}"));
}

/// Sets a coordinate.
fn set(harness: &mut Harness<'_, Lab>, coordinate: usize, value: f64) {
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.anatomy.anatomy.set_coordinate(coordinate, value);
    harness.run_steps(2);
}

#[test]
fn the_witness_names_its_feature_jumps_and_ties() {
    let mut harness = on("witness");
    harness.get_by_label("b* = (0.500, 1.000) at a corner of the block");
    harness.get_by_label("a* = (0.457, 0.957) on link 2");
    // above the block with the bare arm level: the edge is nearest, not the corner
    let mut features = std::collections::BTreeSet::new();
    for k in 0..60 {
        set(&mut harness, 1, 1.5 + 0.02 * f64::from(k));
        let words = anatomy(&harness).readout();
        features.insert(words.iter().find(|w| w.starts_with("b*")).map(|w| w.split(") ").last().unwrap().to_owned()));
    }
    assert!(features.len() >= 2, "it jumps: {features:?}");
    // between two posts as far to either side
    let world = motion_lab_core::worlds::World::parse(
        "posts.ron",
        "World(version: 1, name: \"Posts\", bounds: (min: (-2, -2), max: (2, 2)), obstacles: [\
         (name: \"left\", shape: Box(min: (-1, 0), max: (-0.5, 1))), (name: \"right\", shape: Box(min: (0.5, 0), max: (1, 1)))])",
    );
    let rusty = Anatomy::choices().into_iter().find(|(n, _)| *n == "Rusty").unwrap().1;
    let (_, q) = motion_lab_core::robots::AnyRobot::of_kind("rusty", &[0.0, 0.5, 0.0]).unwrap();
    let tied = Anatomy::new(world.unwrap(), motion_lab_sim::anatomy::WorldSource::Unsaved, rusty, q).unwrap();
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.anatomy.set(tied.with_tab(Tab::Witness));
    harness.run_steps(2);
    says(&harness, "a tie of 2");
    let words = anatomy(&harness).readout().join("; ");
    assert!(words.contains("on an edge of left") && words.contains("on an edge of right"), "{words}");
}

#[test]
fn the_tip_is_dragged_by_inverse_kinematics_on_its_elbow_side() {
    let mut harness = on("distance");
    let paper = harness.get_by_label_contains("Reach at T2").rect();
    let fit = crate::window::ui::paint::canvas::fit(&anatomy(&harness).backdrop(), paper);
    let at = |p: Point2| {
        let [x, y] = fit.screen_from_world(p);
        pos2(x as f32, y as f32)
    };
    let tip = |h: &Harness<'_, Lab>| anatomy(h).checker().robot().reference(&anatomy(h).q());
    let (from, to) = (tip(&harness), Point2::new(-1.0, 0.75));
    pointer(&mut harness, at(from), Some(true));
    for i in 1..=8 {
        pointer(&mut harness, at(from).lerp(at(to), i as f32 / 8.0), None);
    }
    pointer(&mut harness, at(to), Some(false));
    harness.run_steps(2);
    assert!((tip(&harness) - to).norm() < 0.01, "{}", tip(&harness));
    assert!(
        anatomy(&harness).q().to_string().contains("th2: 1."),
        "the elbow keeps its side: {}",
        anatomy(&harness).q()
    );
    // beyond the annulus the arm is straight
    pointer(&mut harness, at(to), Some(true));
    pointer(&mut harness, at(Point2::new(-2.3, 0.1)), None);
    pointer(&mut harness, at(Point2::new(-2.35, 0.1)), None);
    pointer(&mut harness, at(Point2::new(-2.35, 0.1)), Some(false));
    harness.run_steps(2);
    assert!((tip(&harness).coords.norm() - 2.0).abs() < 1e-6, "clamped: {}", tip(&harness));
}

#[test]
fn the_swept_tab_shows_free_ends_a_hit_between_and_its_bracket() {
    let mut harness = on("swept");
    harness.get_by_label("start free, end free");
    harness.get_by_label("link 2 hits the block");
    says(&harness, "proven free to s = ");
    says(&harness, "in contact at s = ");
    says(&harness, "between the two at most ");
    let items = anatomy(&harness).overlay().items;
    let role = |id: &str| items.iter().find(|i| i.id == id).map(|i| i.role);
    let steps = anatomy(&harness).sweep().unwrap().certificate.steps().len();
    let outlines = items.iter().filter(|i| i.id.starts_with("step/")).count();
    assert!(steps > 0 && outlines == steps, "the proven steps as outlines: {outlines} of {steps}");
    assert!(items.iter().any(|i| i.id.starts_with("hit/later/")) && role("second/0").is_some());
    assert_eq!(role("second/0"), Some(motion_lab_core::picture::Role::Robot), "the end is free");
    assert_eq!(items.iter().find(|i| i.id.starts_with("hit/")).unwrap().role, motion_lab_core::picture::Role::Goal);
    // the step slider: a step of nothing is free
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, "step of θ₁").rect();
    click_at(&mut harness, slider.left_center() + egui::vec2(0.49 * 180.0, 0.0));
    assert!(anatomy(&harness).step()[0].abs() < 0.15, "{:?}", anatomy(&harness).step());
    says(&harness, "free all the way");
}

#[test]
fn what_is_unresolved_says_why() {
    let mut harness = on("swept");
    // the straight arm turns under a wall that is one ulp above its reach
    let text = format!(
        "World(version: 1, name: \"Lid\", bounds: (min: (-3, -3), max: (3, 3)), walls: [\
         (name: \"the lid\", points: [(-1, {above:?}), (1, {above:?})])])",
        above = f64::from_bits(2.0_f64.to_bits() + 1)
    );
    let world = motion_lab_core::worlds::World::parse("lid.ron", &text).unwrap();
    let bare = Anatomy::choices()[0].1;
    let (_, q) =
        motion_lab_core::robots::AnyRobot::of_kind("reach", &[std::f64::consts::FRAC_PI_2 - 0.4, 0.0]).unwrap();
    let mut lid =
        Anatomy::new(world, motion_lab_sim::anatomy::WorldSource::Unsaved, bare, q).unwrap().with_tab(Tab::Swept);
    lid.set_step(0, 0.8);
    harness.state_mut().app.world_mut().resource_mut::<Interface>().0.anatomy.set(lid);
    harness.run_steps(2);
    harness.get_by_label("unresolved: the gap is below what rounding can tell from contact");
    let items = anatomy(&harness).overlay().items;
    assert!(items.iter().any(|i| i.id == "unresolved" && i.role == motion_lab_core::picture::Role::Unknown));
}

#[test]
fn what_is_shown_is_not_rounded_by_its_sliders() {
    let mut harness = on("distance");
    harness.run_steps(5);
    let (elbow, tip) = (std::f64::consts::FRAC_PI_4, std::f64::consts::FRAC_PI_2);
    assert_eq!(
        anatomy(&harness).q(),
        motion_lab_core::configuration::AnyConfiguration::T2(motion_lab_core::configuration::T2::new(elbow, tip))
    );
    assert!((anatomy(&harness).distance() - (1.5 / 2.0_f64.sqrt() - 1.0)).abs() < 1e-9, "the chapter's number");
    click(&mut harness, "swept");
    harness.run_steps(5);
    assert_eq!(anatomy(&harness).step(), [-tip, 0.0]);
}

#[test]
fn code_and_command_are_copied() {
    let mut harness = on("distance");
    let rust = press(&mut harness, "Copy as Rust").expect("code");
    assert_eq!(rust, anatomy(&harness).copy_as_rust());
    assert!(rust.contains("fn main") && rust.contains("0.0606601717"), "{rust}");
    let command = press(&mut harness, "Copy as command").expect("a command");
    assert_eq!(Some(command), anatomy(&harness).copy_as_command());
}

#[test]
fn links_of_unequal_lengths_leave_a_hole_that_the_tip_cannot_enter() {
    let mut harness = on("distance");
    click(&mut harness, "Any robot, any world");
    harness.run_steps(20);
    let enter = |harness: &mut Harness<'_, Lab>, link: &str, text: &str| {
        harness.get_by_label(link).focus();
        harness.run_steps(2);
        harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
        harness.step();
        harness.event(Event::Text(text.into()));
        harness.step();
        harness.key_press(Key::Enter);
        harness.run_steps(3);
    };
    enter(&mut harness, "length of link 2", "0.4");
    assert_eq!(anatomy(&harness).lengths(), Some([1.0, 0.4]));
    let ids: Vec<String> = anatomy(&harness).picture().items.iter().map(|item| item.id.clone()).collect();
    assert!(ids.contains(&"annulus/inner circle".to_owned()), "{ids:?}");
    // dragged towards the base, the tip stops at the inner circle
    let sheet = harness.get_by_label_contains("Reach at T2").rect();
    let at = |harness: &Harness<'_, Lab>, p: Point2| {
        let [x, y] =
            crate::window::ui::paint::canvas::fit(interface(harness).anatomy.backdrop(), sheet).screen_from_world(p);
        pos2(x as f32, y as f32)
    };
    let tip = |harness: &Harness<'_, Lab>| anatomy(harness).checker().robot().reference(&anatomy(harness).q());
    let (from, to) = (at(&harness, tip(&harness)), at(&harness, Point2::new(0.1, 0.1)));
    pointer(&mut harness, from, Some(true));
    (1..=8).for_each(|i| pointer(&mut harness, from.lerp(to, i as f32 / 8.0), None));
    pointer(&mut harness, to, Some(false));
    harness.run_steps(2);
    assert!((tip(&harness).coords.norm() - 0.6).abs() < 1e-9, "{}", tip(&harness));
    // no longer and no shorter than an arm of the lab may be
    enter(&mut harness, "length of link 1", "9");
    assert_eq!(anatomy(&harness).lengths(), Some([1.5, 0.4]));
}

#[test]
fn a_term_lights_what_the_picture_draws_of_it_and_a_part_of_the_picture_its_terms() {
    let mut harness = on("witness");
    let spoken =
        "The witnesses are a point a* of the robot and a point b* of the obstacles as far apart as the distance says.";
    harness.get_by_label(spoken);
    let lit = |h: &Harness<'_, Lab>| interface(h).pointer.lit;
    assert_eq!(lit(&harness), None);
    // by keyboard
    use Role::{Obstacle, Robot, Witness};
    for (term, role) in [("R(q)", Robot), ("O", Obstacle), ("a*", Robot), ("b*", Obstacle), ("dist", Witness)] {
        harness.get_by_label(&format!("{term}: {}", role.name())).focus();
        harness.run_steps(3);
        assert_eq!(lit(&harness), Some(role), "{term}");
    }
    // by the pointer, where it rests
    let at = harness.get_by_label("O: obstacle").rect().center();
    pointer(&mut harness, at, None);
    harness.run_steps(20);
    assert_eq!(lit(&harness), Some(Role::Obstacle));
    // on the block, the square from (0.5, 1) to (1, 1.5), the obstacles' terms are underlined, and on bare paper none
    let paper = harness.get_by_label(&anatomy(&harness).described()).rect();
    let fit = crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(anatomy(&harness).world()), paper);
    for ([x, y], over) in [([0.75, 1.25], Some(Role::Obstacle)), ([-2.0, 2.0], None)] {
        let [x, y] = fit.screen_from_world(Point2::new(x, y));
        pointer(&mut harness, pos2(x as f32, y as f32), None);
        harness.run_steps(2);
        assert_eq!(interface(&harness).pointer.over, over);
    }
}

#[test]
fn nothing_is_pointed_at_once_another_widget_is_in_front() {
    let mut harness = on("witness");
    let paper = harness.get_by_label(&anatomy(&harness).described()).rect();
    let fit = crate::window::ui::paint::canvas::fit(&motion_lab_core::picture::world(anatomy(&harness).world()), paper);
    let [x, y] = fit.screen_from_world(Point2::new(0.75, 1.25));
    pointer(&mut harness, pos2(x as f32, y as f32), None);
    harness.run_steps(2);
    assert_eq!(interface(&harness).pointer.over, Some(Role::Obstacle));
    for (widget, over) in [(Key::Num1, None), (Key::Num2, Some(Role::Obstacle)), (Key::Num3, None)] {
        harness.key_press_modifiers(Modifiers::COMMAND, widget);
        harness.run_steps(3);
        assert_eq!(interface(&harness).pointer.over, over, "{widget:?}");
    }
    // nor when the pointer has left the window
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num2);
    harness.run_steps(3);
    harness.event(Event::PointerGone);
    harness.run_steps(3);
    assert_eq!(interface(&harness).pointer.over, None);
}

#[test]
fn each_tab_has_its_formula_and_each_robot_its_own() {
    let mut harness = on("swept");
    harness.get_by_label_contains("meets no obstacle at any moment");
    click(&mut harness, "intersects");
    harness.get_by_label_contains("The set that the robot covers");
    assert!(harness.query_by_label_contains("meets no obstacle at any moment").is_none());
    click(&mut harness, "Drive");
    harness.get_by_label_contains("It rolls the way it faces with speed v, and turns with rate omega.");
    bring(&mut harness, "Reach");
    harness.get_by_label_contains("The tip, by forward kinematics");
    // a joint's angle has its number as a subscript
    assert!(harness.query_all_by_label("\u{3b8}\u{2081}: robot").next().is_some());
    assert!(harness.query_all_by_label("\u{3b8}1: robot").next().is_none());
}

#[test]
fn what_matters_is_larger_than_its_details() {
    let far = |widget: &str, answer: &str, harness: Harness<'_, Lab>| {
        let height = harness.get_by_label(answer).rect().height();
        // a line of body text is 16 points high at most
        assert!(height > 19.0, "{widget}: {height}");
    };
    for (tab, answer) in [
        ("intersects", "intersects: false"),
        ("distance", "distance: 0.0607 m"),
        ("witness", "|a* \u{2212} b*| = 0.0607 m"),
        ("swept", "hits the block at s = 0.0903"),
    ] {
        far(tab, answer, on(tab));
    }
    let mut harness = lab(WIDE);
    click(&mut harness, "Space");
    far("Space", "free, 0.0607 m", harness);
}

#[test]
fn angles_and_minus_signs_have_one_spelling_and_typed_another() {
    for widget in ["Query", "Space", "Plan"] {
        let mut harness = on("swept");
        click(&mut harness, widget);
        set(&mut harness, 0, -1.0);
        harness.run_steps(4);
        for (text, ..) in super::safe::words(&harness).into_iter().filter(|(text, ..)| !text.starts_with("T2 {")) {
            let is_number = |pair: &[char]| pair[0] == '-' && pair[1].is_ascii_digit();
            let letters: Vec<char> = text.chars().collect();
            assert!(!letters.windows(2).any(is_number) && !text.contains("th1"), "{widget}: {text}");
        }
    }
    let mut harness = on("distance");
    for (typed, shown) in [("-0.5", "\u{2212}0.5000"), ("\u{2212}0.25", "\u{2212}0.2500")] {
        let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, "θ₁").rect();
        click_at(&mut harness, slider.left_center() + egui::vec2(220.0, 0.0));
        harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
        harness.step();
        harness.event(Event::Text(typed.into()));
        harness.step();
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert!(super::safe::words(&harness).iter().any(|(text, ..)| text == shown), "{typed}");
    }
}

#[test]
fn another_verdict_moves_no_slider_and_no_button() {
    let mut harness = on("swept");
    harness.run_steps(3);
    let places = |h: &Harness<'_, Lab>| {
        let slider = h.get_by_role_and_label(egui::accesskit::Role::Slider, "step of \u{3b8}\u{2081}").rect();
        // the slider's rectangle ends with its number
        [slider, h.get_by_label("Copy as Rust").rect(), h.get_by_label("Reset").rect()].map(|rect| rect.left_top())
    };
    let before = places(&harness);
    interface_mut(&mut harness).anatomy.anatomy.set_step(0, 0.0);
    harness.run_steps(3);
    says(&harness, "free all the way");
    assert_eq!(places(&harness), before, "a click meant for one finds it");
}
