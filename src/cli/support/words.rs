//! Counts in words, and scripts: how many changes of worlds one has, and why one does not fit a run.

use std::path::Path;

use motion_lab::run::{Script, ScriptError, ScriptProblem};
use motion_lab::tour::TourConfig;

use super::input::shown;
use crate::cli::Failure;

/// The failure of a script that does not fit a run of this configuration, with what there is instead.
pub fn unfit(error: ScriptError, config: &TourConfig) -> Failure {
    let next = match &error.problem {
        ScriptProblem::Robot(_) => {
            format!("The robots there are {}.", config.robot_names().collect::<Vec<_>>().join(", "))
        }
        ScriptProblem::World(_) => {
            format!("The worlds are {}.", config.worlds.iter().map(|w| w.name.as_str()).collect::<Vec<_>>().join(", "))
        }
        _ => "Correct the script there.".into(),
    };
    Failure::input(error, next)
}

/// The script in this text of the file `path`.
pub fn parse_script(path: &Path, text: &str) -> Result<Script, Failure> {
    Script::parse(&shown(path), text).map_err(|error| match path.extension() {
        Some(extension) if extension == "csv" => {
            let next = format!("A table is no script; make one of it: motion-lab script convert {}", path.display());
            Failure::input(error, next)
        }
        _ => Failure::input(error, "Correct the script there; `motion-lab script --help` has the form of each input."),
    })
}

/// `1 event`, `3 events`: a count with what it counts.
pub fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

/// `, 2 changes of worlds`; nothing where there are none.
pub fn changes_in_words(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => ", 1 change of worlds".into(),
        n => format!(", {n} changes of worlds"),
    }
}

/// Whether there are none, so that JSON leaves them out.
pub fn none(count: &usize) -> bool {
    *count == 0
}
