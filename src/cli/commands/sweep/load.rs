//! A study with all it names, from files.

use std::path::Path;

use crate::batch::{Study, StudyError, StudyFile};

use crate::cli::Failure;
use crate::cli::commands::plan::planners::planners;
use crate::cli::support::console::note;
use crate::cli::support::input::{read_text, shown};
use crate::cli::support::words::parse_script;
use crate::cli::support::world_source::{beside, find_world_beside, read_bundle, read_named, read_scenario};

/// The study in a file. Files that it names lie where it says, seen from its own folder.
pub fn study(path: &Path) -> Result<Study, Failure> {
    let refused =
        |error: StudyError| Failure::input(error, "Correct it there. docs/sweeps.md says what a study may hold.");
    let file = StudyFile::parse(&shown(path), &read_text(path)?).map_err(refused)?;
    let place_of = |name: &str| file.place_of(name);
    let worlds = read_named(file.world_names(), place_of, |name| find_world_beside(path, name))?;
    let scripts = read_named(file.script_names(), place_of, |name| {
        let from = beside(path, name);
        read_text(&from).and_then(|text| parse_script(&from, &text))
    })?;
    for name in file.planner_names() {
        let next = "Correct it there. `motion-lab plan --help` says what each does.";
        let refused = |unknown| Failure::input(unknown, next).named_at(&place_of(name));
        planners().named(name).map_err(refused)?;
    }
    let scenarios = read_named(file.scenario_names(), place_of, |name| read_scenario(&beside(path, name)))?;
    let problems = read_named(file.problem_file_names(), place_of, |name| read_bundle(&beside(path, name)))?;
    let file = file.with_scenarios(scenarios).with_problems(problems);
    let study = file.with(&worlds, &scripts).map_err(refused)?;
    study.turns().into_iter().for_each(|turns| note(format!("{}: {turns}", shown(path))));
    Ok(study)
}
