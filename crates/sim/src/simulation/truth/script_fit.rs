//! Makes a script fit a run whose robots and worlds were changed at tick 0.

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

/// Puts inputs that hold from the start at the beginning of a script. One that the script begins with already, of the
/// same robot and kind, is replaced.
pub(super) fn begin_with(script: &mut Script, inputs: Vec<(String, RobotInput)>) {
    for (robot, input) in inputs.into_iter().rev() {
        let first = script.events.iter_mut().take_while(|e| e.tick <= 1).find(|e| e.robot == robot);
        match first {
            Some(event) if event.input.kind() == input.kind() => event.input = input,
            _ => script.events.insert(0, Event { tick: 1, robot, input }),
        }
    }
}
