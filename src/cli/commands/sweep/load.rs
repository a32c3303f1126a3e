//! A study with all it names, from files.

use std::collections::BTreeMap;
use std::path::Path;

use crate::batch::{Study, StudyError, StudyFile};

use crate::cli::Failure;
use crate::cli::commands::plan::planners::planners;
use crate::cli::support::console::note;
use crate::cli::support::input::{read_text, shown};
use crate::cli::support::words::parse_script;
use crate::cli::support::world_source::{find_world_beside, read_bundle, read_scenario};

/// The study in a file. Files that it names lie where it says, seen from its own folder.
pub fn study(path: &Path) -> Result<Study, Failure> {
    let refused =
        |error: StudyError| Failure::input(error, "Correct it there. docs/sweeps.md says what a study may hold.");
    let file = StudyFile::parse(&shown(path), &read_text(path)?).map_err(refused)?;
    let named_at = |name: &str, failure: Failure| failure.named_at(&file.place_of(name));
    let mut worlds = BTreeMap::new();
    for name in file.world_names() {
        let world = find_world_beside(path, name).map_err(|failure| named_at(name, failure))?;
        worlds.insert(name.to_owned(), world);
    }
    let mut scripts = BTreeMap::new();
    for name in file.script_names() {
        let from = path.parent().unwrap_or(Path::new("")).join(name);
        let script = read_text(&from).and_then(|text| parse_script(&from, &text));
        scripts.insert(name.to_owned(), script.map_err(|failure| named_at(name, failure))?);
    }
    for name in file.planner_names() {
        let next = "Correct it there. `motion-lab plan --help` says what each does.";
        planners().named(name).map_err(|unknown| named_at(name, Failure::input(unknown, next)))?;
    }
    let mut scenarios = BTreeMap::new();
    for name in file.scenario_names() {
        let scenario = read_scenario(&path.parent().unwrap_or(Path::new("")).join(name));
        scenarios.insert(name.to_owned(), scenario.map_err(|failure| named_at(name, failure))?);
    }
    let mut problems = BTreeMap::new();
    for name in file.problem_file_names() {
        let bundle = read_bundle(&path.parent().unwrap_or(Path::new("")).join(name));
        problems.insert(name.to_owned(), bundle.map_err(|failure| named_at(name, failure))?);
    }
    let file = file.with_scenarios(scenarios).with_problems(problems);
    let study = file.with(&worlds, &scripts).map_err(refused)?;
    study.turns().into_iter().for_each(|turns| note(format!("{}: {turns}", shown(path))));
    Ok(study)
}
