//! How many words stand on a screen.

use super::*;

/// The words of a frame that are seen; numbers, signs and formulas aside.
fn words_on(harness: &Harness<'_, Lab>) -> usize {
    let seen = crate::window::tests::safe::words(harness);
    let texts = seen.iter().filter(|(_, _, shown)| shown.is_positive()).map(|(text, ..)| text);
    let is_word =
        |word: &&str| word.chars().count() > 1 && word.chars().all(|c| c.is_alphabetic() || ".,:;?'".contains(c));
    texts.flat_map(|text| text.split_whitespace()).filter(is_word).count()
}

/// No screen gains words. The lab is to come down to 40, and to 60 in Plan and the Atlas: these are the numbers of
/// words that each has today, with its hints put away. The tour goes on meanwhile, so a word may come and go.
#[test]
fn no_screen_gains_words() {
    for (widget, most) in [("Drive", 62), ("Query", 66), ("Space", 70), ("Atlas", 60), ("Plan", 59)] {
        let mut harness = lab(WIDE);
        click(&mut harness, widget);
        harness.run_steps(6);
        let words = words_on(&harness);
        // fewer than half would be a count that has lost its words
        assert!(words <= most && 2 * words > most, "{widget}: {words} words");
    }
}
