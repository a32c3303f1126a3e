//! Plans, points, rows and parts.

mod files;
mod rows;
mod studies;

use super::*;
use motion_lab_core::worlds::World;
use motion_lab_sim::run::{Event, RobotInput, Script};

fn try_plan(text: &str) -> Result<Study, StudyError> {
    let file = StudyFile::parse("study.ron", text)?;
    let worlds = file.world_names().into_iter().filter_map(|name| Some((name.to_owned(), World::built_in(name)?)));
    let drive = Event { tick: 1, robot: "Hitch".into(), input: RobotInput::Drive(128, 0) };
    let script = Script::new(vec![drive], vec![]);
    let scripts = file.script_names().into_iter().map(|name| (name.to_owned(), script.clone()));
    file.with(&worlds.collect(), &scripts.collect())
}

fn study(text: &str) -> Study {
    try_plan(text).unwrap()
}
