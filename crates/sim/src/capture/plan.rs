//! Captures of a plan.

use super::Captured;
use crate::manifest::Widget;
use crate::plans::{Drawn, JudgedPath, PathLengths, PlannerName, Task, space_items, workspace_items};
use motion_lab_core::cspace::{CellMap, cspace_picture};
use motion_lab_core::picture::{Figure, Panel, world};
use motion_lab_core::planning::Effort;
use motion_lab_core::random::Seed;
use motion_lab_core::robots::AnyRobot;

/// What came of a plan.
#[derive(Clone, Copy, Debug)]
pub enum PlanOutcome<'a> {
    /// Nothing yet.
    Growing,
    /// A path of the planner's; proven where the task's checker proves.
    Path(PathLengths),
    /// No path: the planner has ended.
    None,
    /// What is drawn is that of a file of this name, whoever planned it, with what the exact scene says of it; nothing
    /// where nothing was judged.
    File(&'a str, Option<&'a JudgedPath>),
}

/// A plan to be captured.
#[derive(Clone, Copy, Debug)]
pub struct PlanSheet<'a> {
    /// What is planned.
    pub task: &'a Task,
    /// Who plans it.
    pub planner: PlannerName,
    /// The seed of its samples.
    pub seed: Seed,
    /// What there is to draw.
    pub drawn: &'a Drawn,
    /// What the planner has done.
    pub effort: Effort,
    /// What came of it.
    pub found: PlanOutcome<'a>,
    /// The slice of the configuration space beside the workspace, if it is shown.
    pub cells: Option<&'a CellMap>,
}

/// The workspace with the growth, the path and the robot along it, and beside it the configuration space.
pub fn plan(sheet: &PlanSheet<'_>) -> Captured {
    let PlanSheet { task, planner, seed, drawn, effort, found, cells } = *sheet;
    let mut readout = vec![format!("{} iterations, {} edges asked", effort.iterations, effort.edges)];
    let by = format!("{} at seed {seed}", planner.title());
    let description = match found {
        PlanOutcome::Path(PathLengths { length, .. }) if !task.checker.proves() => {
            let caller = task.checker.id();
            readout.push(format!("length {length:.3} {}, called free by {caller}, not proven", unit(&task.robot)));
            format!("{by}: a path that {caller} calls free. Nothing of it is proven.")
        }
        PlanOutcome::Path(PathLengths { length, clearance }) => {
            let clearance = proven(clearance);
            readout.push(format!("length {length:.3} {}, clearance {clearance} m", unit(&task.robot)));
            format!("{by}: a path whose clearance is proven to be at least {clearance} m.")
        }
        PlanOutcome::None => match &drawn.barrier {
            Some(barrier) => {
                readout.push(format!("no path: {} cells proven blocked part the two", barrier.cells.len()));
                format!("{by}: there is no path. The cells that part the start from the goal are proven blocked.")
            }
            None => {
                readout.push("no path".to_owned());
                format!("{by}: no path was found.")
            }
        },
        PlanOutcome::Growing => {
            readout.push("no path yet".to_owned());
            format!("{by}: no path so far.")
        }
        PlanOutcome::File(_, judged) => {
            let judged = judged_words(judged);
            readout = vec![judged.clone()];
            format!("A path from a file. {judged}.")
        }
    };
    let rounds = drawn.sensed.iter().flat_map(|sensed| &sensed.leave_points).enumerate();
    readout.extend(rounds.map(|(i, point)| format!("round {}: {point}", i + 1)));
    let (heading, source) = match found {
        PlanOutcome::File(name, _) => (name, vec![("File", name.to_owned())]),
        _ => (planner.title(), vec![("Planner", planner.id().to_owned()), ("Seed", seed.to_string())]),
    };
    let workspace = world(&task.world).with(workspace_items(&task.robot, drawn));
    let mut panels = vec![Panel { picture: workspace, heading: heading.to_owned(), readout }];
    if let Some(map) = cells {
        let picture = cspace_picture(map, &Default::default()).with(space_items(map.slice(), drawn));
        let readout = vec![map.slice().described()];
        panels.push(Panel { picture, heading: "configuration space".to_owned(), readout });
    }
    let world = format!("{} {:032x}", task.world.name, task.world.content_hash());
    let notes = source.into_iter().chain([("Robot", task.name.clone()), ("World", world)]).collect();
    let figure = Figure {
        title: format!("A path for {} in the world {}", task.name, task.world.name),
        description,
        panels,
        caption: vec![Widget::Plan.text().misconception.clone()],
    };
    Captured { figure, notes }
}

/// What the exact scene says of a path of a file, in words; of a file of which nothing was judged, that it says so.
pub fn judged_words(judged: Option<&JudgedPath>) -> String {
    match judged.map(|judged| &judged.proof) {
        Some(Ok(clearance)) => format!("Proven free, with a clearance of at least {} m", proven(*clearance)),
        Some(Err(reason)) => format!("It fails: {reason}"),
        None => "Drawn as it says; nothing of it is proven here".to_owned(),
    }
}

/// A proven clearance in metres, in words: rounded down, so that no more is claimed than is proven, with the digits
/// that show that it is above 0.
pub fn proven(clearance: f64) -> String {
    let (mut digits, mut scale) = (4, 1e4);
    while clearance * scale < 1.0 && digits < 12 {
        (digits, scale) = (digits + 1, 10.0 * scale);
    }
    format!("{:.digits$}", (clearance * scale).floor() / scale)
}

/// What a length says that no path undercuts, in this unit: rounded down, so that no more is claimed than is so.
pub fn bounded(bound: f64, unit: &str) -> String {
    format!("no path is shorter than {:.4} {unit}", (bound * 1e4).floor() / 1e4)
}

/// How near a path comes to the best that there may be, by a length that none undercuts: in whole per cent, rounded up;
/// nothing where it is within one.
pub fn within_best(length: f64, bound: f64) -> Option<String> {
    let more = (100.0 * (length / bound - 1.0)).ceil();
    (more > 1.0 && more.is_finite()).then(|| format!("within {more} % of the best"))
}

/// The unit in which a robot's paths are measured.
pub fn unit(robot: &AnyRobot) -> &'static str {
    if matches!(robot, AnyRobot::Reach(_) | AnyRobot::Reach3(_)) { "rad" } else { "m" }
}

#[cfg(test)]
mod tests {
    use super::{bounded, proven, within_best};

    #[test]
    fn a_bound_is_never_shown_larger_than_it_is() {
        assert_eq!(bounded(3.81189, "m"), "no path is shorter than 3.8118 m");
        assert_eq!(bounded(0.99999, "rad"), "no path is shorter than 0.9999 rad");
        assert_eq!(bounded(3.8118, "m"), "no path is shorter than 3.8118 m");
    }

    #[test]
    fn nearness_to_the_best_is_rounded_up() {
        assert_eq!(within_best(1.111, 1.0).unwrap(), "within 12 % of the best");
        assert_eq!(within_best(2.0, 1.0).unwrap(), "within 100 % of the best");
        for (length, bound) in [(1.0, 1.0), (1.009, 1.0), (1.0, 0.0), (1.0, f64::INFINITY)] {
            assert_eq!(within_best(length, bound), None, "{length} {bound}");
        }
    }

    #[test]
    fn a_clearance_is_never_shown_larger_than_it_is_proven_nor_as_none() {
        for (clearance, shown) in
            [(0.25, "0.2500"), (0.00996, "0.0099"), (1.98e-5, "0.00001"), (4e-9, "0.000000004"), (f64::INFINITY, "inf")]
        {
            assert_eq!(proven(clearance), shown);
        }
    }
}
