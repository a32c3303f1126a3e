//! Makes a script fit a run whose robots and worlds were changed at tick 0.

use std::collections::{BTreeMap, BTreeSet};

use crate::run::{Event, RobotInput, Script, ScriptError};
use crate::tour::TourConfig;

/// Takes out of a script what a run of this configuration could not hold: the events of robots and the changes of
/// worlds, doors and obstacles that are not there any more. Returns why each sort of them went.
pub(super) fn fit(script: &mut Script, config: &TourConfig) -> Vec<ScriptError> {
    let mut refused = Vec::new();
    let names: Vec<&str> = config.robot_names().collect();
    while let Err(error) = script.check_robots(&names) {
        let Some(robot) = error.event.and_then(|i| script.events.get(i)).map(|e| e.robot.clone()) else { break };
        script.events.retain(|event| event.robot != robot);
        refused.push(error);
    }
    while let Err(error) = script.check_worlds(&config.worlds) {
        let Some(unfit) = error.event.and_then(|i| script.changes.get(i)).cloned() else { break };
        let is_same = |c: &crate::run::WorldEvent| c.world == unfit.world && c.change.name() == unfit.change.name();
        script.changes.retain(|change| !is_same(change));
        refused.push(error);
    }
    script.version = Script::version_of(&script.changes);
    refused
}

/// Makes robots be driven by these inputs from the start on, by their ids, whatever else the script does with them
/// before tick 1.
pub(super) fn begin_with(script: &mut Script, config: &TourConfig, inputs: BTreeMap<usize, Vec<RobotInput>>) {
    let names: Vec<&str> = config.robot_names().collect();
    let driven: BTreeSet<&str> = inputs.keys().map(|&id| names[id]).collect();
    let is_at_start = |event: &Event| event.tick <= 1;
    let drives =
        |input: &RobotInput| matches!(input, RobotInput::Drive(..) | RobotInput::MoveTo(_) | RobotInput::Release);
    let is_replaced = |e: &Event| is_at_start(e) && drives(&e.input) && driven.contains(e.robot.as_str());
    script.events.retain(|event| !is_replaced(event));
    let end = script.events.partition_point(is_at_start);
    let all = inputs.into_iter().flat_map(|(id, inputs)| inputs.into_iter().map(move |input| (id, input)));
    let event = |(id, input): (usize, RobotInput)| Event { tick: 1, robot: names[id].to_owned(), input };
    script.events.splice(end..end, all.map(event));
}
