//! The picture of a path and of what its planner has grown.

use std::path::Path;

use motion_lab::capture::{Captured, Form, Paper};
use motion_lab::picture::{Drawing, Figure, Item, Line, Panel, Role, footprint, trace, world};

use super::answer::{proven, unit};
use super::attempt::Attempt;
use super::named::PlannerName;
use super::task::Task;
use crate::cli::Failure;
use crate::cli::support::paper::write_picture;
use crate::cli::support::target::Target;

/// Draws the workspace with the growth, the path and the robot along it, and writes it as SVG, or as PNG by its name.
pub fn write(
    task: &Task,
    planner: PlannerName,
    seed: u64,
    attempt: &dyn Attempt,
    paper: &Paper,
    output: &Path,
) -> Result<(), Failure> {
    let target = Target::file(output)?;
    let form = if Form::of(output) == Some(Form::Png) { Form::Png } else { Form::Svg };
    let captured = of_workspace(task, planner, seed, attempt, Vec::new());
    write_picture(&captured, paper, form, target.path())?;
    target.wrote();
    Ok(())
}

/// The workspace with the growth, the path and the robot along it, and more over what has grown.
pub fn of_workspace(task: &Task, planner: PlannerName, seed: u64, attempt: &dyn Attempt, more: Vec<Item>) -> Captured {
    let (way, planner) = (attempt.way(), planner.name());
    let ways = attempt.ways();
    let effort = attempt.effort();
    let mut items = Vec::new();
    let grown = Drawing::Region { pieces: Vec::new(), outline: ways };
    items.push(Item::new("growth", "what the planner has grown", Role::Muted, grown).stroked(Line::solid(0.6)));
    items.extend(more);
    for (i, place) in attempt.places().iter().enumerate() {
        items.extend(footprint(&format!("place/{i}"), "on the way", place, Role::Path, 0.12));
    }
    let [start, goal] = attempt.ends();
    items.extend(footprint("goal", "the goal", &goal, Role::Goal, 0.4));
    items.extend(footprint("start", "the start", &start, Role::Robot, 0.85));
    let mut readout = vec![format!("{} iterations, {} edges asked", effort.iterations, effort.edges)];
    let found = if way.is_empty() {
        readout.push("no path".into());
        "no path was found".to_owned()
    } else {
        items.push(trace("path", "the path", &way));
        let (length, clearance) = (attempt.length(), attempt.clearance());
        let clearance = proven(clearance);
        readout.push(format!("length {length:.3} {}, clearance {clearance} m", unit(&task.robot)));
        format!("a path whose clearance is proven to be at least {clearance} m")
    };
    let title = format!("A path for {} in the world {}", task.name, task.world.name);
    let description = format!("{planner} at seed {seed}: {found}.");
    let panel = Panel { picture: world(&task.world).with(items), heading: planner.clone(), readout };
    let notes = vec![
        ("Planner", planner),
        ("Seed", seed.to_string()),
        ("Robot", task.name.clone()),
        ("World", format!("{} {:032x}", task.world.name, task.world.content_hash())),
    ];
    Captured { figure: Figure { title, description, panels: vec![panel], caption: Vec::new() }, notes }
}
