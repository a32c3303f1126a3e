//! Scripts: RON, and tables of comma-separated values.
//!
//! A wrong reader lets through what a script's own check refuses, or writes a script that it reads otherwise.

use super::refusal;
use motion_lab::run::Script;
use motion_lab::tour::TourConfig;

// the program's own, which is in no library
#[path = "../../src/cli/commands/script/table.rs"]
mod table;

/// Reads a script, and a table.
pub fn check(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else { return false };
    let config = TourConfig::default();
    let mut is_read = false;
    match Script::parse("drive.ron", text) {
        Ok(script) => {
            is_read = true;
            written(&script);
            if let Err(error) = script.check_for(&config) {
                refusal::check(&error.located("drive.ron", text), "drive.ron");
            }
        }
        Err(error) => refusal::check(&error, "drive.ron"),
    }
    for config in [None, Some(&config)] {
        match table::script(text, config) {
            Ok((script, turns)) => {
                is_read |= !script.is_empty();
                written(&script);
                turns.iter().for_each(|turn| refusal::check(turn, ""));
                assert!(config.is_none_or(|config| script.check_for(config).is_ok()), "{text:?}");
            }
            Err(error) => refusal::check(&error, ""),
        }
    }
    is_read
}

/// A script that was read passes its own check, and both of its texts read back as it.
fn written(script: &Script) {
    assert_eq!(script.check(), Ok(()));
    for text in [script.to_ron(), script.to_line()] {
        assert_eq!(Script::parse("again", &text).as_ref(), Ok(script), "{text}");
    }
}
