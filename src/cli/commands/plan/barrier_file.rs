//! `BarrierFile`, the proof that there is no path as JSON.

use motion_lab_core::collision::Scene;
use motion_lab_core::cspace::{BarrierAxis, BarrierCell};
use motion_lab_sim::export::JsonNumber;
use motion_lab_sim::plans::{PlanAttempt, Task};
use serde::Serialize;

use crate::cli::commands::query::{Dimensions, ObstacleShapes};
use crate::cli::support::output::write_file;
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure};

/// The version of the format. Readers refuse versions that they don't know.
const VERSION: u32 = 1;

/// Blocked cells that part a start from a goal, with all that another program needs to check them by its own geometry,
/// as `tests/peers/barrier.py` does.
///
/// A cell is all configurations within `half` of `middle` in each coordinate, its sides too. At its middle `part` is
/// deeper in a shape of `obstacle` than any of its points moves within the cell.
#[derive(Debug, Serialize)]
pub struct BarrierFile {
    version: u32,
    kind: &'static str,
    program: &'static str,
    /// The bounds, and the shapes that the cells name, each larger by `clearance`.
    world: ObstacleShapes,
    /// A rover is larger by `tube`.
    robot: Dimensions,
    tube: JsonNumber,
    clearance: JsonNumber,
    axes: Vec<AxisEntry>,
    start: Vec<JsonNumber>,
    goal: Vec<JsonNumber>,
    cells: Vec<CellEntry>,
}

/// A coordinate; one that wraps is an angle, and any other ends at the world's bounds.
#[derive(Debug, Serialize)]
struct AxisEntry {
    name: String,
    wraps: bool,
}

/// A cell and what blocks it.
#[derive(Debug, Serialize)]
struct CellEntry {
    middle: Vec<JsonNumber>,
    half: Vec<JsonNumber>,
    /// The number of the robot's part, from 0.
    part: usize,
    /// The number of the obstacle in the world, and its name.
    obstacle: u32,
    name: String,
    /// How far the part must move at least to be free of the obstacle, metres.
    depth: JsonNumber,
    /// How far a point of the part moves within the cell at most, metres; less than the depth.
    bound: JsonNumber,
}

impl BarrierFile {
    /// The barrier that the cells of an attempt hold; `None` where they hold none.
    pub fn of(task: &Task, attempt: &dyn PlanAttempt) -> Option<Self> {
        let (barrier, checker) = attempt.barrier()?;
        let (scene, robot) = (checker.scene(), checker.robot());
        let is_named = |id| barrier.cells.iter().any(|cell| cell.blocking.obstacle == id);
        Some(BarrierFile {
            version: VERSION,
            kind: "barrier",
            program: concat!("motion-lab ", env!("CARGO_PKG_VERSION")),
            world: ObstacleShapes::numbered(&task.world.name, scene, is_named),
            robot: Dimensions::of(robot),
            tube: JsonNumber(if task.planned() == task.robot { 0.0 } else { task.tube }),
            clearance: JsonNumber(task.clearance.unwrap_or(0.0)),
            axes: barrier.axes.iter().map(AxisEntry::of).collect(),
            start: numbers(&barrier.start),
            goal: numbers(&barrier.goal),
            cells: barrier.cells.iter().map(|cell| CellEntry::of(scene, cell)).collect(),
        })
    }

    /// Writes the barrier to its target, as one line of JSON, and says what it proves.
    pub fn write(&self, target: Target, data: &mut Data) -> Result<(), Failure> {
        let mut text = serde_json::to_string(self).map_err(Failure::internal)?;
        text.push('\n');
        write_file(&target, text.as_bytes())?;
        let cells = counted(self.cells.len() as u64, "cell");
        target.finish_with(&format!(": {cells} part the start from the goal"), data)
    }
}

impl AxisEntry {
    fn of(axis: &BarrierAxis) -> Self {
        AxisEntry { name: axis.name.clone(), wraps: axis.wraps }
    }
}

impl CellEntry {
    fn of(scene: &Scene, cell: &BarrierCell) -> Self {
        let blocking = cell.blocking;
        CellEntry {
            middle: numbers(&cell.middle),
            half: numbers(&cell.half),
            part: blocking.part,
            obstacle: blocking.obstacle.0,
            name: scene.obstacle_name(blocking.obstacle).unwrap_or_default().to_owned(),
            depth: JsonNumber(blocking.depth),
            bound: JsonNumber(blocking.bound),
        }
    }
}

fn numbers(coordinates: &[f64]) -> Vec<JsonNumber> {
    coordinates.iter().copied().map(JsonNumber).collect()
}
