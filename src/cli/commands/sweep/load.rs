//! A plan with all it names, from files.

use std::collections::BTreeMap;
use std::path::Path;

use motion_lab::sweep::{PlanFile, SweepPlan, SweepPlanError};

use crate::cli::Failure;
use crate::cli::support::input::{read_text, shown};
use crate::cli::support::words::parse_script;
use crate::cli::support::world_source::find_world_beside;

/// The plan in a file. Files that it names lie where it says, seen from its own folder.
pub fn plan(path: &Path) -> Result<SweepPlan, Failure> {
    let refused =
        |error: SweepPlanError| Failure::input(error, "Correct it there. docs/sweeps.md says what a plan may hold.");
    let file = PlanFile::parse(&shown(path), &read_text(path)?).map_err(refused)?;
    let mut worlds = BTreeMap::new();
    for name in file.world_names() {
        worlds.insert(name.to_owned(), find_world_beside(path, name)?);
    }
    let mut scripts = BTreeMap::new();
    for name in file.script_names() {
        let script = path.parent().unwrap_or(Path::new("")).join(name);
        scripts.insert(name.to_owned(), parse_script(&script, &read_text(&script)?)?);
    }
    file.with(&worlds, &scripts).map_err(refused)
}
