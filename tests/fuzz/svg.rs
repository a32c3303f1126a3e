//! Drawings.
//!
//! A wrong reader makes a world of a drawing that its own file cannot hold, or goes on for ever in what repeats itself.

use super::{refusal, standing};
use motion_lab::worlds::import::{SvgOptions, svg};

/// Reads a drawing.
pub fn check(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else { return false };
    match svg("hall.svg", text, "hall", SvgOptions::default()) {
        Ok(imported) => {
            imported.notes.iter().for_each(|note| refusal::check(note, ""));
            standing::check(&imported.world);
            true
        }
        Err(error) => {
            refusal::check(&error, "hall.svg");
            false
        }
    }
}
