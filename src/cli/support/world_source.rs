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
    let path = beside(file, name);
    if World::built_in(name).is_none() && path.exists() { read_world(&path) } else { find_world(name) }
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
    let place_of = |name: &str| file.place_of(name);
    let worlds = read_named(file.world_names(), place_of, |name| find_world_beside(path, name))?;
    let scenarios = read_named(file.scenario_names(), place_of, |name| read_scenario(&beside(path, name)))?;
    Ok(ReadProblems { file, worlds, scenarios })
}

/// What a file names, by the names it gives it. What is wrong with one is said with the place where it is named.
pub fn read_named<'a, T>(
    names: impl IntoIterator<Item = &'a str>,
    place_of: impl Fn(&str) -> String,
    read: impl Fn(&str) -> Result<T, Failure>,
) -> Result<BTreeMap<String, T>, Failure> {
    let one = |name: &str| Ok((name.to_owned(), read(name).map_err(|failure| failure.named_at(&place_of(name)))?));
    names.into_iter().map(one).collect()
}

/// The path of a file that another one names, seen from that one's folder.
pub fn beside(file: &Path, name: &str) -> PathBuf {
    file.parent().unwrap_or(Path::new("")).join(name)
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
