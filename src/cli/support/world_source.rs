//! A world named on the command line: a built-in one, or a file.

use std::path::{Path, PathBuf};

use motion_lab_core::names::did_you_mean;
use motion_lab_core::worlds::{World, turns};
use motion_lab_import::Scenario;

use super::console::note;
use super::input::{MAX_TEXT, MAX_WORLD, is_dash, read_text_of, shown};
use crate::cli::Failure;

/// The world that `name` names: the built-in one of that name, else the file at that path.
pub fn find_world(name: &str) -> Result<World, Failure> {
    let unknown = match World::named(name) {
        Ok(world) => return Ok(world),
        Err(unknown) => unknown,
    };
    let path = PathBuf::from(name);
    if !path.exists() && !is_dash(&path) {
        return Err(Failure::input(
            format!("{name}: no built-in world has this name, and there is no such file"),
            format!(
                "{}The built-in worlds are {}; anything else is the path of a world file.",
                did_you_mean(&unknown.name, unknown.meant()),
                built_in_list()
            ),
        ));
    }
    read_world(&path)
}

/// The world that a file names: the built-in one, else a file seen from that file's own folder, else one at that path.
pub fn find_world_beside(file: &Path, name: &str) -> Result<World, Failure> {
    let beside = file.parent().unwrap_or(Path::new("")).join(name);
    if World::built_in(name).is_none() && beside.exists() { read_world(&beside) } else { find_world(name) }
}

/// The world in a file.
pub fn read_world(path: &Path) -> Result<World, Failure> {
    let text = read_text_of(path, MAX_WORLD)?;
    for turns in turns(&text) {
        note(format!("{}: {turns}", shown(path)));
    }
    World::parse(&shown(path), &text).map_err(|error| {
        Failure::input(error, "Correct it there. `motion-lab world show apartment` prints a world file to go by.")
    })
}

/// The scenario in a file: problems on a map of the MovingAI benchmarks.
pub fn read_scenario(path: &Path) -> Result<Scenario, Failure> {
    let text = read_text_of(path, MAX_TEXT)?;
    let next = "Correct it there. `motion-lab world import` makes the world of its map.";
    Scenario::parse(&shown(path), &text).map_err(|error| Failure::input(error, next))
}

/// The names of the built-in worlds, for messages.
pub fn built_in_list() -> String {
    World::built_in_names().join(", ")
}
