//! What a command line names by a file: a world, which may be a built-in one too, a scenario, problems.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use motion_lab_core::names::did_you_mean;
use motion_lab_core::worlds::{World, turns};
use motion_lab_import::Scenario;

use super::console::note;
use super::input::{MAX_TEXT, MAX_WORLD, is_dash, read_text_of, shown};
use crate::batch::{ProblemBundle, ProblemFile, ProblemFileError, ProblemSet};
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

/// The problems in a file. Files that it names lie where it says, seen from its own folder.
pub fn read_problems(path: &Path) -> Result<ProblemSet, Failure> {
    let ReadProblems { file, worlds, scenarios } = read(path)?;
    file.with(&worlds, &scenarios).map_err(refused)
}

/// A problem file with what it names, which is checked.
pub fn read_bundle(path: &Path) -> Result<ProblemBundle, Failure> {
    let ReadProblems { file, worlds, scenarios } = read(path)?;
    file.with(&worlds, &scenarios).map_err(refused)?;
    Ok(file.bundle(&worlds, &scenarios))
}

/// A problem file, and the files that it names.
struct ReadProblems {
    file: ProblemFile,
    worlds: BTreeMap<String, World>,
    scenarios: BTreeMap<String, Scenario>,
}

fn refused(error: ProblemFileError) -> Failure {
    Failure::input(error, "Correct it there. docs/formats.md says what a problem file may hold.")
}

fn read(path: &Path) -> Result<ReadProblems, Failure> {
    let file = ProblemFile::parse(&shown(path), &read_text_of(path, MAX_TEXT)?).map_err(refused)?;
    let named_at = |name: &str, failure: Failure| failure.named_at(&file.place_of(name));
    let mut worlds = BTreeMap::new();
    for name in file.world_names() {
        let world = find_world_beside(path, name).map_err(|failure| named_at(name, failure))?;
        worlds.insert(name.to_owned(), world);
    }
    let mut scenarios = BTreeMap::new();
    for name in file.scenario_names() {
        let scenario = read_scenario(&path.parent().unwrap_or(Path::new("")).join(name));
        scenarios.insert(name.to_owned(), scenario.map_err(|failure| named_at(name, failure))?);
    }
    Ok(ReadProblems { file, worlds, scenarios })
}

/// The problems of one robot, if it is named, of which there is at least one.
pub fn of_robot(problems: ProblemSet, robot: Option<&str>, path: &Path) -> Result<ProblemSet, Failure> {
    let Some(robot) = robot else { return Ok(problems) };
    let kinds = problems.kinds().into_iter().map(|kind| kind.name);
    let there = problems.robots().into_iter().chain(kinds).collect::<Vec<_>>().join(", ");
    let own = problems.of_robot(robot);
    if own.is_empty() {
        let reason = format!("{}: no problem is for {robot:?}", shown(path));
        return Err(Failure::usage(reason, format!("Change --robot; its problems are for {there}.")));
    }
    Ok(own)
}

/// The names of the built-in worlds, for messages.
pub fn built_in_list() -> String {
    World::built_in_names().join(", ")
}
