//! Numbers that are typed: as parts of pi, out of range, and none at all.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

use super::*;
use motion_lab_core::configuration::Configuration;

/// Types a text in place of what stands in the field that has the focus, and stays in it.
fn type_there(harness: &mut Harness<'_, Lab>, text: &str) {
    harness.run_steps(2);
    harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
    harness.step();
    harness.event(Event::Text(text.into()));
    harness.run_steps(2);
}

/// Presses a key, and lets what it enters be entered.
fn press(harness: &mut Harness<'_, Lab>, key: Key) {
    harness.key_press(key);
    harness.run_steps(4);
}

/// Types a text into the number of Query's first angle, and stays in it.
fn type_angle(harness: &mut Harness<'_, Lab>, text: &str) {
    let slider = harness.get_by_role_and_label(egui::accesskit::Role::Slider, "θ₁").rect();
    click_at(harness, slider.left_center() + egui::vec2(220.0, 0.0));
    type_there(harness, text);
}

fn angle(harness: &Harness<'_, Lab>) -> f64 {
    interface(harness).anatomy.anatomy.q().coordinates()[0]
}

#[test]
fn an_angle_is_typed_as_a_part_of_pi_and_beyond_half_a_turn_it_is_the_same_angle_within() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    for (text, expected) in [
        ("\u{2212}\u{3c0}/2", -FRAC_PI_2),
        ("3*pi/4", 3.0 * FRAC_PI_4),
        ("2/3", 2.0 / 3.0),
        ("pi/4", FRAC_PI_4),
        ("4", 4.0 - TAU),
    ] {
        let before = angle(&harness);
        type_angle(&mut harness, text);
        assert_eq!(angle(&harness), before, "{text}: not while it is typed");
        press(&mut harness, Key::Enter);
        assert_eq!(angle(&harness), expected, "{text}");
        assert!(interface(&harness).notice().is_none(), "{text}");
    }
}

#[test]
fn a_text_that_is_no_number_is_said_once_when_the_field_is_left_and_changes_nothing() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Query");
    let said = "\u{201c}2abc\u{201d} is no number. Write 0.7854, pi/4 or 45deg.";
    for by_press in [false, true] {
        type_angle(&mut harness, "2abc");
        assert!(harness.query_by_label(said).is_none(), "not while it is typed");
        if by_press {
            click(&mut harness, "distance");
        } else {
            press(&mut harness, Key::Enter);
        }
        harness.get_by_label(said);
        assert_eq!(angle(&harness), FRAC_PI_4);
        click(&mut harness, "Dismiss");
        assert!(harness.query_by_label(said).is_none(), "once");
    }
    // Escape takes back what was typed, and there is nothing to say
    for text in ["1.5", "2abc"] {
        type_angle(&mut harness, text);
        press(&mut harness, Key::Escape);
        assert_eq!((angle(&harness), interface(&harness).notice().is_none()), (FRAC_PI_4, true), "{text}");
    }
}

#[test]
fn a_length_out_of_its_range_is_the_nearest_in_it_and_that_is_said() {
    let mut harness = lab(WIDE);
    front(&mut harness, "Space");
    // an arm of the lab has links of 0.1 to 1.5 m
    for (text, length, said) in [
        ("1e9", 1.5, "\u{201c}1e9\u{201d} is more than the largest, 1.5."),
        ("0", 0.1, "\u{201c}0\u{201d} is less than the least, 0.1."),
    ] {
        harness.get_by_label_contains("length of link 2").focus();
        type_there(&mut harness, text);
        press(&mut harness, Key::Enter);
        assert_eq!(interface(&harness).anatomy.anatomy.lengths(), Some([1.0, length]));
        harness.get_by_label(said);
    }
}

#[test]
fn a_joint_of_the_arm_is_sent_to_a_part_of_pi() {
    let mut harness = lab(WIDE);
    pause(&mut harness);
    bring(&mut harness, "Reach");
    // three quarters of a turn are a quarter the other way
    for (text, expected) in [("pi/4", FRAC_PI_4), ("3\u{3c0}/2", -FRAC_PI_2)] {
        harness.get_by_label("Reach: θ₁").focus();
        type_there(&mut harness, text);
        press(&mut harness, Key::Enter);
        click(&mut harness, "Step");
        let joint = harness.state().robot(1).coordinates[0];
        assert!((joint - expected).abs() < 1e-6, "{text}: {joint}");
    }
}
