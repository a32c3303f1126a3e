//! The questions whose answers are guessed first.

use super::*;

#[test]
fn a_prompt_shows_its_scene_once_it_is_answered() {
    let mut harness = on("intersects");
    click(&mut harness, "Guess first");
    let guess = |harness: &mut Harness<'_, Lab>, question: &str, text: &str| {
        assert!(["Show", "Next question"].iter().all(|name| harness.query_by_label(name).is_none()), "hidden");
        harness.get_by_label_contains(question).focus();
        harness.run_steps(2);
        harness.key_combination_modifiers(Modifiers::COMMAND, &[Key::A]);
        harness.step();
        harness.event(Event::Text(text.into()));
        harness.step();
        harness.key_press(Key::Enter);
        harness.run_steps(3);
    };
    // one after the other: what is no number answers nothing
    guess(&mut harness, "the links are given a radius of 3 cm", "no idea");
    guess(&mut harness, "the links are given a radius of 3 cm", "0.03");
    click(&mut harness, "Next question");
    assert!(harness.query_by_label_contains("0.170").is_none());
    guess(&mut harness, "How far from it is the bare arm", "0.2");
    harness.get_by_label_contains("Off by +0.2000 m: it is 0.000000 m. The tip is in the middle of the square");
    click(&mut harness, "Next question");
    guess(&mut harness, "How far from the square", "0.17043");
    harness.get_by_label_contains("Right: 0.170435 m. The nearest point is the square's corner");
    click(&mut harness, "Show");
    assert_eq!(anatomy(&harness).world().name, "Exercise 3");
    says(&harness, "b* = (0.900, 0.900) at a corner of the square");
    for (question, text, answer) in [
        (
            "At which \u{3b8}\u{2082} does the arm first touch the block?",
            "1.4",
            "Off by \u{2212}0.0009 rad: it is 1.4009 rad.",
        ),
        ("How far is Rusty from it?", "0.89 m", "Right: 0.890000 m."),
        ("its trailer \u{3c0}/6", "5", "Right: 5.000000 m. The middle is half the length"),
        ("at which y is the middle of the car's", "6.25", "Right: 6.250000 m."),
        ("way does the car's", "1.571 rad", "Right: 1.5708 rad."),
        ("At which x is the rectangle's middle?", "3.355", "Right: 3.354552 m."),
        ("of the trailer's rectangle", "4.1", "Off by +0.0500 m: it is 4.050000 m."),
        ("way does the trailer's", "0.5236", "Right: 0.5236 rad."),
        ("the links are given a radius of 3 cm", "0", "it is 0.030660 m."),
    ] {
        click(&mut harness, "Next question");
        guess(&mut harness, question, text);
        harness.get_by_label_contains(answer);
    }
    // in Space the arms that reach a tip are counted
    click(&mut harness, "Space");
    click(&mut harness, "Guess first");
    guess(&mut harness, "2 m from the base", "2");
    harness.get_by_label_contains("Off by +1: it is 1. On the circle around the annulus the arm is straight");
    click(&mut harness, "Next question");
    guess(&mut harness, "And 2.5 m from the base?", "0");
    harness.get_by_label_contains("Right: 0. ");
}
