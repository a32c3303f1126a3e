//! Studies of sweeps, RON.
//!
//! A wrong reader counts other runs than it makes, or makes of a study's line another study.

use std::collections::BTreeMap;

use super::refusal;
use motion_lab::batch::{Study, StudyFile};
use motion_lab::worlds::World;

/// Most robots of a generated warehouse.
pub const MAX_ROBOTS: u64 = 200;

/// Reads a study, and makes its first and its last run. A generated warehouse is left out where it is large: it takes
/// longer than an input may.
pub fn check(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else { return false };
    let file = match StudyFile::parse("study.ron", text) {
        Ok(file) => file,
        Err(error) => {
            refusal::check(&error, "study.ron");
            return false;
        }
    };
    let named = file.world_names().into_iter().chain(file.script_names()).chain(file.planner_names());
    for name in named.chain(file.scenario_names()) {
        refusal::check(&file.place_of(name), "study.ron");
    }
    if robots_of_warehouse(text) > MAX_ROBOTS {
        return false;
    }
    let worlds: BTreeMap<String, World> =
        file.world_names().into_iter().filter_map(|name| Some((name.to_owned(), World::built_in(name)?))).collect();
    match file.with(&worlds, &BTreeMap::new()) {
        Ok(study) => {
            same(&study);
            true
        }
        Err(error) => {
            refusal::check(&error, "study.ron");
            false
        }
    }
}

/// The largest number in a text that generates a warehouse, 0 in any other: an upper bound of its robots.
pub fn robots_of_warehouse(text: &str) -> u64 {
    let digits = text.split(|c: char| !c.is_ascii_digit()).filter(|digits| !digits.is_empty());
    let largest = digits.map(|digits| digits.parse().unwrap_or(u64::MAX)).max().unwrap_or(0);
    // a study's line names all its fields
    if text.replace("\"warehouse\":null", "").contains("warehouse") { largest } else { 0 }
}

/// A study's line is that of the study it makes, whose runs are the same.
pub fn same(study: &Study) {
    let again = Study::of_line(study.line()).unwrap_or_else(|reason| panic!("{reason}\n{}", study.line()));
    assert_eq!((again.line(), again.runs(), again.heading()), (study.line(), study.runs(), study.heading()));
    assert!(study.runs() > 0);
    for row in [0, study.runs() - 1] {
        assert_eq!(format!("{:?}", again.setup(row)), format!("{:?}", study.setup(row)));
    }
    study.turns().iter().for_each(|turn| refusal::check(turn, ""));
}
