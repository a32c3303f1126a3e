//! Captures of a plan.

use super::Captured;
use crate::cspace::{CellMap, cspace_picture};
use crate::manifest::Widget;
use crate::picture::{Figure, Panel, world};
use crate::planning::Effort;
use crate::plans::{Drawn, PathLengths, PlannerName, Task, space_items, workspace_items};
use crate::random::Seed;
use crate::robots::AnyRobot;

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
    /// The length and the clearance of its path, if it has one.
    pub lengths: Option<PathLengths>,
    /// The slice of the configuration space beside the workspace, if it is shown.
    pub cells: Option<&'a CellMap>,
}

/// The workspace with the growth, the path and the robot along it, and beside it the configuration space.
pub fn plan(sheet: &PlanSheet<'_>) -> Captured {
    let PlanSheet { task, planner, seed, drawn, effort, lengths, cells } = *sheet;
    let mut readout = vec![format!("{} iterations, {} edges asked", effort.iterations, effort.edges)];
    let found = if let Some(PathLengths { length, clearance }) = lengths {
        let clearance = proven(clearance);
        readout.push(format!("length {length:.3} {}, clearance {clearance} m", unit(&task.robot)));
        format!("a path whose clearance is proven to be at least {clearance} m")
    } else {
        readout.push("no path".to_owned());
        "no path was found".to_owned()
    };
    let workspace = world(&task.world).with(workspace_items(&task.robot, drawn));
    let mut panels = vec![Panel { picture: workspace, heading: planner.title().to_owned(), readout }];
    if let Some(map) = cells {
        let picture = cspace_picture(map, &Default::default()).with(space_items(map.slice(), drawn));
        let readout = vec![map.slice().described()];
        panels.push(Panel { picture, heading: "configuration space".to_owned(), readout });
    }
    let notes = vec![
        ("Planner", planner.id().to_owned()),
        ("Seed", seed.to_string()),
        ("Robot", task.name.clone()),
        ("World", format!("{} {:032x}", task.world.name, task.world.content_hash())),
    ];
    let figure = Figure {
        title: format!("A path for {} in the world {}", task.name, task.world.name),
        description: format!("{} at seed {seed}: {found}.", planner.title()),
        panels,
        caption: vec![Widget::Plan.text().misconception.clone()],
    };
    Captured { figure, notes }
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

/// The unit in which a robot's paths are measured.
pub fn unit(robot: &AnyRobot) -> &'static str {
    if matches!(robot, AnyRobot::Reach(_) | AnyRobot::Reach3(_)) { "rad" } else { "m" }
}

#[cfg(test)]
mod tests {
    use super::proven;

    #[test]
    fn a_clearance_is_never_shown_larger_than_it_is_proven_nor_as_none() {
        for (clearance, shown) in
            [(0.25, "0.2500"), (0.00996, "0.0099"), (1.98e-5, "0.00001"), (4e-9, "0.000000004"), (f64::INFINITY, "inf")]
        {
            assert_eq!(proven(clearance), shown);
        }
    }
}
