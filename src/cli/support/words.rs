//! Counts in words, and scripts: how many changes of worlds one has, and why one does not fit a run.

use std::fmt::Display;
use std::path::Path;

use motion_lab_core::names::did_you_mean;
use motion_lab_core::worlds::World;
use motion_lab_sim::run::{Script, ScriptError, ScriptProblem};
use motion_lab_sim::tour::TourConfig;

use super::input::shown;
use crate::cli::Failure;

/// The failure of a script that does not fit a run of this configuration, with what there is instead.
pub fn unfit(error: ScriptError, config: &TourConfig) -> Failure {
    let worlds = || config.worlds.iter().map(|world| world.name.as_str());
    let next = match &error.problem {
        ScriptProblem::Robot(name) => {
            let robots: Vec<&str> = config.robot_names().collect();
            format!("{}The robots there are {}.", did_you_mean(name, robots.iter().copied()), robots.join(", "))
        }
        ScriptProblem::World(name) => {
            format!("{}The worlds are {}.", did_you_mean(name, worlds()), worlds().collect::<Vec<_>>().join(", "))
        }
        ScriptProblem::Door { world, name } => {
            let doors: Vec<&str> =
                within(config, world).flat_map(|w| &w.doors).map(|door| door.name.as_str()).collect();
            let there = if doors.is_empty() { "none".to_owned() } else { doors.join(", ") };
            format!("{}The doors there are {there}.", did_you_mean(name, doors))
        }
        ScriptProblem::Obstacle { world, name } => {
            let obstacles = within(config, world).flat_map(|w| &w.obstacles).map(|obstacle| obstacle.name.as_str());
            format!("{}Correct the script there.", did_you_mean(name, obstacles))
        }
        _ => "Correct the script there.".into(),
    };
    Failure::input(error, next)
}

/// The worlds of this name.
fn within<'a>(config: &'a TourConfig, name: &'a str) -> impl Iterator<Item = &'a World> {
    config.worlds.iter().filter(move |world| world.name == name)
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
pub fn counted(count: impl Display, what: &str) -> String {
    let count = count.to_string();
    if count == "1" { format!("1 {what}") } else { format!("{count} {what}s") }
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
