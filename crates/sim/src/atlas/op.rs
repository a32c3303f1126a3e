//! `Op`, a change of a world.

use std::collections::BTreeSet;

use super::numbers::{NumberVisitor, setting};
use super::outline::tidy;
use super::residents::stand;
use super::{EditError, EditShape, Number, numbers, residents};
use motion_lab_core::configuration::Kinds;
use motion_lab_core::geometry::{Aabb, Point2, Pose2, Vector2};
use motion_lab_core::num::atan2;
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

/// The list of a world that holds a thing, and its place there.
#[derive(Clone, Copy)]
enum ThingIndex {
    Obstacle(usize),
    Door(usize),
    Place(usize),
    Mark(usize),
    Robot(usize),
}

fn find(world: &World, name: &str) -> Option<ThingIndex> {
    let at = |mut names: Box<dyn Iterator<Item = &str> + '_>| names.position(|n| n == name);
    at(Box::new(world.obstacles.iter().map(|o| o.name.as_str())))
        .map(ThingIndex::Obstacle)
        .or_else(|| at(Box::new(world.doors.iter().map(|d| d.name.as_str()))).map(ThingIndex::Door))
        .or_else(|| at(Box::new(world.places.iter().map(|p| p.name.as_str()))).map(ThingIndex::Place))
        .or_else(|| at(Box::new(world.marks.iter().map(|m| m.name.as_str()))).map(ThingIndex::Mark))
        .or_else(|| at(Box::new(world.robots.iter().map(|r| r.name.as_str()))).map(ThingIndex::Robot))
}

/// The names of everything in the world.
pub(super) fn all_names(world: &World) -> BTreeSet<&str> {
    let obstacles = world.obstacles.iter().map(|o| o.name.as_str()).chain(world.doors.iter().map(|d| d.name.as_str()));
    let painted = world.places.iter().map(|p| p.name.as_str()).chain(world.marks.iter().map(|m| m.name.as_str()));
    obstacles.chain(painted).chain(world.robots.iter().map(|r| r.name.as_str())).collect()
}

/// The shape of the wall, obstacle or mark of this name.
pub(super) fn shape_of(world: &World, name: &str) -> Option<EditShape> {
    shape_at(world, find(world, name)?)
}

fn shape_at(world: &World, at: ThingIndex) -> Option<EditShape> {
    match at {
        ThingIndex::Obstacle(i) => Some(EditShape::of(&world.obstacles[i])),
        ThingIndex::Mark(i) => Some(EditShape::Mark(world.marks[i].points.clone())),
        ThingIndex::Door(_) | ThingIndex::Place(_) | ThingIndex::Robot(_) => None,
    }
}

/// Gives an obstacle another shape, or a mark another line.
fn reshape(world: &mut World, at: ThingIndex, name: &str, shape: &EditShape) -> Result<(), EditError> {
    match (at, shape) {
        (ThingIndex::Mark(i), EditShape::Mark(points)) => world.marks[i].points.clone_from(points),
        (ThingIndex::Obstacle(i), shape) if !matches!(shape, EditShape::Mark(_)) => {
            world.obstacles[i] = shape.obstacle(name)?;
        }
        _ => return Err(EditError::NoShape(name.to_owned())),
    }
    Ok(())
}

/// Visits the numbers of a thing.
fn visit(
    world: &mut World,
    at: ThingIndex,
    name: &str,
    kinds: &Kinds,
    visit: &mut NumberVisitor<'_>,
) -> Result<(), EditError> {
    match at {
        ThingIndex::Obstacle(_) | ThingIndex::Mark(_) => {
            if let Some(was) = shape_at(world, at) {
                let mut shape = was.clone();
                numbers::of_shape(&mut shape, visit);
                if shape != was {
                    reshape(world, at, name, &shape)?;
                }
            }
        }
        ThingIndex::Door(i) => numbers::of_door(&mut world.doors[i], visit),
        ThingIndex::Place(i) => numbers::pose(&mut world.places[i].pose, visit),
        ThingIndex::Robot(i) => numbers::of_robot(&mut world.robots[i], kinds, visit),
    }
    Ok(())
}

/// The numbers of the thing of this name, in order. Only the thing is copied, however much else the world holds.
pub(super) fn numbers_of(world: &World, name: &str, kinds: &Kinds) -> Vec<Number> {
    let Some(at) = find(world, name) else { return Vec::new() };
    match at {
        ThingIndex::Obstacle(_) | ThingIndex::Mark(_) => {
            shape_at(world, at).map_or_else(Vec::new, |shape| shape.numbers())
        }
        ThingIndex::Door(i) => numbers::listed(|visit| numbers::of_door(&mut world.doors[i].clone(), visit)),
        ThingIndex::Place(i) => numbers::listed(|visit| numbers::pose(&mut world.places[i].pose.clone(), visit)),
        ThingIndex::Robot(i) => numbers::listed(|visit| numbers::of_robot(&mut world.robots[i].clone(), kinds, visit)),
    }
}

/// The world after a change, not checked yet.
pub(super) fn changed(world: &World, op: &Op, kinds: &Kinds) -> Result<World, EditError> {
    let mut world = world.clone();
    let found = |world: &World, name: &str| find(world, name).ok_or_else(|| EditError::NoSuchName(name.to_owned()));
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
        Op::Move { name, by } => match found(&world, name)? {
            ThingIndex::Obstacle(i) => {
                let moved = EditShape::of(&world.obstacles[i]).moved(*by);
                reshape(&mut world, ThingIndex::Obstacle(i), name, &moved)?;
            }
            ThingIndex::Door(i) => {
                let door = &mut world.doors[i];
                (door.a, door.b) = ((door.a + by).map(tidy), (door.b + by).map(tidy));
            }
            ThingIndex::Place(i) => {
                let pose = &mut world.places[i].pose;
                (pose.x, pose.y) = (tidy(pose.x + by.x), tidy(pose.y + by.y));
            }
            ThingIndex::Mark(i) => world.marks[i].points.iter_mut().for_each(|p| *p = (*p + by).map(tidy)),
            ThingIndex::Robot(i) => residents::move_by(&mut world.robots[i], *by, kinds)?,
        },
        Op::Drag { name, handle, to } => {
            let at = found(&world, name)?;
            if let ThingIndex::Place(i) = at {
                let pose = &mut world.places[i].pose;
                if *handle == 0 {
                    (pose.x, pose.y) = (to.x, to.y);
                } else {
                    pose.theta = atan2(to.y - pose.y, to.x - pose.x);
                }
            } else if let ThingIndex::Door(i) = at {
                let door = &mut world.doors[i];
                match handle {
                    0 => door.a = *to,
                    1 => door.b = *to,
                    _ => {}
                }
            } else if let ThingIndex::Robot(i) = at {
                let robot = &mut world.robots[i];
                let from = stand(robot, kinds).ok_or_else(|| EditError::NoShape(name.clone()))?.at();
                match handle {
                    0 => residents::put(robot, *to, None, kinds)?,
                    1 => residents::put(robot, from, Some(atan2(to.y - from.y, to.x - from.x)), kinds)?,
                    _ => {}
                }
            } else {
                let shape = shape_at(&world, at).ok_or_else(|| EditError::NoShape(name.to_owned()))?;
                reshape(&mut world, at, name, &shape.with_handle(*handle, *to))?;
            }
        }
        Op::Reshape { name, shape } => {
            let at = found(&world, name)?;
            reshape(&mut world, at, name, shape)?;
        }
        Op::SetPose { name, pose } => match found(&world, name)? {
            ThingIndex::Place(i) => world.places[i].pose = *pose,
            ThingIndex::Robot(i) => residents::put(&mut world.robots[i], pose.position(), Some(pose.theta), kinds)?,
            _ => return Err(EditError::NoShape(name.clone())),
        },
        Op::SetNumber { name, number, to } => {
            let at = found(&world, name)?;
            let mut seen = Ok(());
            let known = setting(*number, *to, |set| seen = visit(&mut world, at, name, kinds, set));
            seen?;
            if !known {
                return Err(EditError::NoNumber(name.clone(), *number));
            }
        }
        Op::SetOpen { name, open } => match found(&world, name)? {
            ThingIndex::Door(i) => world.doors[i].open = *open,
            _ => return Err(EditError::NoDoor(name.clone())),
        },
        Op::SetBounds { number, to } => {
            let Aabb { min, max } = &mut world.bounds;
            if !setting(*number, *to, |set| numbers::sides(min, max, set)) {
                return Err(EditError::NoNumber(world.name, *number));
            }
        }
        Op::RenameWorld(to) => to.clone_into(&mut world.name),
        Op::Rename { name, to } => {
            let slot = match found(&world, name)? {
                ThingIndex::Obstacle(i) => &mut world.obstacles[i].name,
                ThingIndex::Door(i) => &mut world.doors[i].name,
                ThingIndex::Place(i) => &mut world.places[i].name,
                ThingIndex::Mark(i) => &mut world.marks[i].name,
                ThingIndex::Robot(i) => &mut world.robots[i].name,
            };
            to.clone_into(slot);
        }
        Op::Delete { name } => match found(&world, name)? {
            ThingIndex::Obstacle(i) => drop(world.obstacles.remove(i)),
            ThingIndex::Door(i) => drop(world.doors.remove(i)),
            ThingIndex::Place(i) => drop(world.places.remove(i)),
            ThingIndex::Mark(i) => drop(world.marks.remove(i)),
            ThingIndex::Robot(i) => drop(world.robots.remove(i)),
        },
    }
    Ok(world)
}
