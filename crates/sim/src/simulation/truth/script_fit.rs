//! Makes a script fit a run whose robots and worlds were changed at tick 0.

use std::collections::{BTreeMap, BTreeSet};

use crate::run::{Event, RobotInput, Script, ScriptError, ScriptProblem};
use crate::tour::TourConfig;

/// Takes out of a script what a run of this configuration could not hold: the events of robots and the changes of
/// worlds, doors and obstacles that are not there any more; and what comes after more shapes than a run may have.
/// Returns why each sort of them went.
pub(super) fn fit(script: &mut Script, config: &TourConfig) -> Vec<ScriptError> {
    let mut refused = Vec::new();
    let names: Vec<&str> = config.robot_names().collect();
    while let Err(error) = script.check_robots(&names) {
        let Some(robot) = error.event.and_then(|i| script.events.get(i)).map(|e| e.robot.clone()) else { break };
        script.events.retain(|event| event.robot != robot);
        refused.push(error);
    }
    while let Err(error) = script.check_worlds(&config.worlds) {
        let Some((i, unfit)) = error.event.and_then(|i| Some((i, script.changes.get(i)?.clone()))) else { break };
        if matches!(error.problem, ScriptProblem::Shapes(_) | ScriptProblem::ChangedShapes) {
            // what comes before it fits, and each change after it takes as much
            script.changes.truncate(i);
            refused.push(error);
            continue;
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Quantized, WorldChange, WorldEvent};
    use motion_lab_core::worlds::{MAX_ITEMS, Obstacle, ObstacleKind, World};

    #[test]
    fn of_more_shapes_than_a_world_may_have_what_fits_stays() {
        let mut lot = World::lot();
        let shapes: usize = lot.obstacles.iter().map(|o| o.pieces.len()).sum::<usize>() + lot.doors.len();
        let piece = lot.obstacles[0].pieces[0].clone();
        let solid = |k| Obstacle::new(format!("solid {k}"), ObstacleKind::Solid, vec![piece.clone()]);
        lot.obstacles.extend((shapes..MAX_ITEMS - 2).map(solid));
        let config = TourConfig { worlds: vec![lot], ..TourConfig::default() };
        let number = |x: f64| Quantized::try_new(x).unwrap();
        let add = |k: u64| WorldEvent {
            tick: k,
            world: "Lot".into(),
            change: WorldChange::Add {
                name: format!("new {k}"),
                points: vec![(number(1.0), number(1.0))],
                radius: number(0.1),
            },
        };
        let mut script = Script::new(vec![], (1..=5).map(add).collect());
        let refused = fit(&mut script, &config);
        assert_eq!(script.changes, [add(1), add(2)], "two more have room");
        let [ScriptError { event: Some(2), problem: ScriptProblem::Shapes(world), .. }] = &refused[..] else {
            panic!("{refused:?}")
        };
        assert_eq!(world, "Lot");
    }
}
