//! `Op`, a change of a world.

use std::collections::BTreeSet;

use super::numbers::setting;
use super::thing::EditedThing;
use super::{EditError, EditShape, numbers};
use motion_lab_core::configuration::Kinds;
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Vector2};
use motion_lab_core::worlds::{Door, Mark, Place, Resident, World};

/// A change of a world.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// Add a wall, an obstacle or a painted mark.
    Add {
        /// Its name.
        name: String,
        /// Its shape.
        shape: EditShape,
    },
    /// Add a place.
    AddPlace {
        /// Its name.
        name: String,
        /// Its pose.
        pose: Pose2,
    },
    /// Add a door, closed at the start.
    AddDoor {
        /// Its name.
        name: String,
        /// Its two ends, the hinge first.
        ends: [Point2; 2],
    },
    /// Add a robot.
    AddRobot(Resident),
    /// Move anything that has a name, its coordinates rounded to a nanometre. An arm moves with its base. Robots of
    /// kinds that the editor does not [know](super::Editor::knowing) are refused, and moves to where a run would refuse
    /// to start one that has footprints.
    Move {
        /// Its name.
        name: String,
        /// The displacement, metres.
        by: Vector2,
    },
    /// Drag one of a thing's [handles](super::Editor::handles).
    Drag {
        /// Its name.
        name: String,
        /// The handle's number.
        handle: usize,
        /// The point it is dragged to.
        to: Point2,
    },
    /// Give a wall or an obstacle another shape, or a mark another line.
    Reshape {
        /// Its name.
        name: String,
        /// The shape.
        shape: EditShape,
    },
    /// Move or turn a place, or a robot whose start is a pose. A trailer turns with its car.
    SetPose {
        /// Its name.
        name: String,
        /// Its pose.
        pose: Pose2,
    },
    /// Set one of a thing's [numbers](super::Editor::numbers).
    SetNumber {
        /// Its name.
        name: String,
        /// Which of its numbers, from 0.
        number: usize,
        /// The new value, metres or radians.
        to: f64,
    },
    /// Open a door, or close it, at the start.
    SetOpen {
        /// Its name.
        name: String,
        /// Whether it is open.
        open: bool,
    },
    /// Set one of the numbers of the part of the plane that the world [shows](super::Editor::bounds).
    SetBounds {
        /// Which of its numbers, from 0.
        number: usize,
        /// The new value, metres.
        to: f64,
    },
    /// Rename the world.
    RenameWorld(String),
    /// Rename anything in it.
    Rename {
        /// Its name.
        name: String,
        /// Its new name.
        to: String,
    },
    /// Remove anything that has a name.
    Delete {
        /// Its name.
        name: String,
    },
}

/// The names of everything in the world.
pub(super) fn all_names(world: &World) -> BTreeSet<&str> {
    let obstacles = world.obstacles.iter().map(|o| o.name.as_str()).chain(world.doors.iter().map(|d| d.name.as_str()));
    let painted = world.places.iter().map(|p| p.name.as_str()).chain(world.marks.iter().map(|m| m.name.as_str()));
    obstacles.chain(painted).chain(world.robots.iter().map(|r| r.name.as_str())).collect()
}

/// The world after a change, not checked yet.
pub(super) fn changed(world: &World, op: &Op, kinds: &Kinds) -> Result<World, EditError> {
    let mut world = world.clone();
    match op {
        Op::Add { name, shape: EditShape::Mark(points) } => {
            world.marks.push(Mark { name: name.clone(), points: points.clone() });
        }
        Op::Add { name, shape } => world.obstacles.push(shape.obstacle(name)?),
        Op::AddPlace { name, pose } => world.places.push(Place { name: name.clone(), pose: *pose }),
        Op::AddDoor { name, ends: [a, b] } => {
            world.doors.push(Door { name: name.clone(), a: *a, b: *b, open: false });
        }
        Op::AddRobot(robot) => world.robots.push(robot.clone()),
        Op::Move { name, by } => EditedThing::find(&mut world, name)?.move_by(*by, kinds)?,
        Op::Drag { name, handle, to } => EditedThing::find(&mut world, name)?.drag(*handle, *to, kinds)?,
        Op::Reshape { name, shape } => EditedThing::find(&mut world, name)?.reshape(shape)?,
        Op::SetPose { name, pose } => EditedThing::find(&mut world, name)?.set_pose(pose, kinds)?,
        Op::SetNumber { name, number, to } => {
            let mut thing = EditedThing::find(&mut world, name)?;
            let mut seen = Ok(());
            let is_known = setting(*number, *to, |set| seen = thing.visit(kinds, set));
            seen?;
            if !is_known {
                return Err(EditError::NoNumber(name.clone(), *number));
            }
        }
        Op::SetOpen { name, open } => match EditedThing::find(&mut world, name)? {
            EditedThing::Door(door) => door.open = *open,
            _ => return Err(EditError::NoDoor(name.clone())),
        },
        Op::SetBounds { number, to } => {
            let Aabb { min, max } = &mut world.bounds;
            if !setting(*number, *to, |set| numbers::sides(min, max, set)) {
                return Err(EditError::NoNumber(world.name, *number));
            }
        }
        Op::RenameWorld(to) => to.clone_into(&mut world.name),
        Op::Rename { name, to } => to.clone_into(EditedThing::find(&mut world, name)?.name_mut()),
        Op::Delete { name } => {
            EditedThing::find(&mut world, name)?;
            world.obstacles.retain(|thing| thing.name != *name);
            world.doors.retain(|thing| thing.name != *name);
            world.places.retain(|thing| thing.name != *name);
            world.marks.retain(|thing| thing.name != *name);
            world.robots.retain(|thing| thing.name != *name);
        }
    }
    Ok(world)
}
