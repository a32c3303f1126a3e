//! World files, RON.
//!
//! A wrong reader takes what its own writer writes otherwise, lets numbers through that no shape may have, or overflows
//! the stack on what is nested.

use super::{refusal, standing};
use motion_lab::worlds::{World, comments, turns};

/// Reads a world file; files that are not UTF-8 are refused before.
pub fn check(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else { return false };
    comments(text);
    let read = World::parse("yard.ron", text);
    let recorded = World::parse_recorded("yard.ron", text);
    match &read {
        Ok(world) => {
            assert_eq!(recorded.as_ref(), Ok(world), "what a file may hold, a log may");
            turns(text).iter().for_each(|turn| refusal::check(turn, ""));
            standing::check(world);
            assert_eq!(World::parse("again", &world.to_ron()).as_ref(), Ok(world));
        }
        Err(error) => {
            refusal::check(error, "yard.ron");
            let lines = text.split('\n').count();
            assert!((1..=lines).contains(&error.line) && error.column > 0, "{error}: {lines} lines");
        }
    }
    if let Ok(world) = recorded {
        standing::check(&world);
    }
    read.is_ok()
}
