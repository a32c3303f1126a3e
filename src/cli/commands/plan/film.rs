//! The film of a planner's growth: workspace and configuration space side by side, iteration after iteration.

use std::path::Path;

use motion_lab::capture::{Captured, Paper, slides};
use motion_lab::picture::{Dash, Drawing, Glyph, Item, Line, Role, footprint};
use motion_lab::random::Seed;

use super::attempt::Rejected;
use super::drawing::of_workspace;
use super::named::PlannerName;
use super::space::Space;
use super::task::Task;
use crate::cli::Failure;
use crate::cli::support::paper::not_written;
use crate::cli::support::progress::Progress;
use crate::cli::support::target::Target;

/// The greatest number of pictures.
const PICTURES: u64 = 72;

/// The time that the film takes, hundredths of a second; with few iterations each is shown for half a second.
const TIME: u64 = 600;

/// Plans once more, `iterations` long, and writes a picture after every iteration, or after every few of many.
pub fn write(
    task: &Task,
    name: PlannerName,
    seed: u64,
    iterations: u64,
    paper: &Paper,
    output: &Path,
) -> Result<(), Failure> {
    let target = Target::file(output)?;
    let Ok(mut attempt) = task.attempt(name, Seed(seed))? else { return Ok(()) };
    let pictures = iterations.clamp(1, PICTURES);
    let progress = Progress::of(pictures, "pictures");
    let space = Space::of(task);
    let (mut done, mut captures, mut edges) = (0, Vec::new(), 0);
    for picture in 1..=pictures {
        let until = picture * iterations / pictures;
        while done < until && attempt.step() {
            done += 1;
        }
        done = until;
        let effort = attempt.effort();
        // an edge that was rejected is shown in the picture after which it was asked about
        let is_new = effort.edges - effort.free > edges;
        edges = effort.edges - effort.free;
        let rejected = attempt.rejected().filter(|_| is_new && picture < pictures);
        let more = rejected.iter().flat_map(in_workspace).collect();
        let mut captured: Captured = of_workspace(task, name, seed, attempt.as_ref(), more);
        captured.figure.panels[0].heading = format!("workspace, {}", name.name());
        captured.figure.panels.push(space.panel(attempt.as_ref(), rejected.as_ref()));
        captures.push(captured);
        progress.at(picture);
    }
    drop(progress);
    let hundredths = (TIME / pictures).clamp(4, 50) as u16;
    slides(&captures, hundredths, paper, target.path()).map_err(|error| not_written(target.path(), error))?;
    target.wrote();
    Ok(())
}

/// A rejected motion, dashed, with the robot in contact and the nearest points there.
fn in_workspace(rejected: &Rejected) -> Vec<Item> {
    let way = Drawing::Polyline(rejected.way.clone());
    let line = Line::solid(1.2).dashed(Dash::Dashed);
    let mut items = vec![Item::new("rejected", "a rejected edge", Role::Goal, way).stroked(line)];
    items.extend(footprint("rejected/at", "where it is in contact", &rejected.at, Role::Goal, 0.2));
    if let Some(witness) = &rejected.witness {
        let between = Drawing::segment(witness.on_robot, witness.on_obstacle);
        items.push(Item::new("rejected/witness", "the witness", Role::Witness, between).stroked(Line::solid(1.5)));
        let dot = Drawing::Mark { at: witness.on_obstacle, glyph: Glyph::Dot, radius_px: 3.5 };
        items.push(Item::new("rejected/point", "the witness on the obstacle", Role::Witness, dot));
    }
    items
}
