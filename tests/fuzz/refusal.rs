//! What every refusal must be.

use std::fmt::Display;

/// Longest refusal, characters: what is quoted of a file must be cut, or a terminal is flooded.
const LONGEST: usize = 2000;

/// Checks that a refusal begins with `name`, that of its file, says more, and is one line of bounded length: a line
/// break of a file would begin a line that the file has written, not the lab.
pub fn check(refusal: &impl Display, name: &str) {
    let text = refusal.to_string();
    let said = text.strip_prefix(name).unwrap_or_else(|| panic!("it does not name {name:?}: {text:?}"));
    assert!(said.trim_matches([':', ' ']).len() > 2, "it says nothing: {text:?}");
    assert!(!text.contains(['\n', '\r']), "several lines: {text:?}");
    assert!(text.chars().count() <= LONGEST, "{} characters: {:.300}", text.chars().count(), text);
}
