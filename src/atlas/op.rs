//! `Op`, a change of a world.

use std::collections::BTreeSet;

use super::EditShape;
use super::outline::tidy;
use crate::configuration::{Kinds, RobotKind, Sizes};
use crate::geometry::{Point2, Pose2, Vector2};
use crate::num::atan2;
use crate::worlds::{Mark, OutlineError, Place, Resident, World, WorldError};

/// A change of a world.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
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
    /// Move anything that has a name, its coordinates rounded to a nanometre. Arms whose sizes the world does not say
    /// are refused, because their start holds no base. So are robots of kinds that the editor does not
    /// [know](super::Editor::knowing), and moves to where a run would refuse to start one that has footprints.
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
    /// Move or turn a place.
    SetPose {
        /// Its name.
        name: String,
        /// Its pose.
        pose: Pose2,
    },
    /// Rename anything.
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

/// Why a change is refused. The world stays as it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// Nothing has this name.
    #[error("nothing here is called {0:?}")]
    NoSuchName(String),
    /// The thing can't be changed in this way.
    #[error("{0:?} has no shape to change")]
    NoShape(String),
    /// The robot's start would be no configuration of its kind.
    #[error("{0:?} can't start there")]
    NoConfiguration(String),
    /// An invalid outline of a polygon.
    #[error("polygon: {0}")]
    Outline(#[from] OutlineError),
    /// The world would be refused as a file.
    #[error("{0}")]
    World(#[from] WorldError),
}

/// The list of a world that holds a thing, and its place there.
#[derive(Clone, Copy)]
enum Found {
    Obstacle(usize),
    Door(usize),
    Place(usize),
    Mark(usize),
    Robot(usize),
}

fn find(world: &World, name: &str) -> Option<Found> {
    let at = |mut names: Box<dyn Iterator<Item = &str> + '_>| names.position(|n| n == name);
    at(Box::new(world.obstacles.iter().map(|o| o.name.as_str())))
        .map(Found::Obstacle)
        .or_else(|| at(Box::new(world.doors.iter().map(|d| d.name.as_str()))).map(Found::Door))
        .or_else(|| at(Box::new(world.places.iter().map(|p| p.name.as_str()))).map(Found::Place))
        .or_else(|| at(Box::new(world.marks.iter().map(|m| m.name.as_str()))).map(Found::Mark))
        .or_else(|| at(Box::new(world.robots.iter().map(|r| r.name.as_str()))).map(Found::Robot))
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

fn shape_at(world: &World, at: Found) -> Option<EditShape> {
    match at {
        Found::Obstacle(i) => Some(EditShape::of(&world.obstacles[i])),
        Found::Mark(i) => Some(EditShape::Mark(world.marks[i].points.clone())),
        Found::Door(_) | Found::Place(_) | Found::Robot(_) => None,
    }
}

/// Gives an obstacle another shape, or a mark another line.
fn reshape(world: &mut World, at: Found, name: &str, shape: &EditShape) -> Result<(), EditError> {
    match (at, shape) {
        (Found::Mark(i), EditShape::Mark(points)) => world.marks[i].points.clone_from(points),
        (Found::Obstacle(i), shape) if !matches!(shape, EditShape::Mark(_)) => {
            world.obstacles[i] = shape.obstacle(name)?;
        }
        _ => return Err(EditError::NoShape(name.to_owned())),
    }
    Ok(())
}

/// Moves a robot's start: an arm by the base that its sizes say, any other by the place that its start begins with.
fn move_robot(robot: &mut Resident, by: Vector2, kinds: &Kinds) -> Result<(), EditError> {
    if let Some(Sizes::Arm(arm)) = &mut robot.sizes {
        arm.base = (arm.base + by).map(tidy);
        return Ok(());
    }
    let has_place = kinds.of(&robot.kind).is_some_and(RobotKind::has_place);
    let stood = kinds.footprint(&robot.kind, &robot.start).is_some();
    let (true, [x, y, ..]) = (has_place, &mut robot.start[..]) else {
        return Err(EditError::NoShape(robot.name.clone()));
    };
    (*x, *y) = (tidy(*x + by.x), tidy(*y + by.y));
    if stood && kinds.footprint(&robot.kind, &robot.start).is_none() {
        return Err(EditError::NoConfiguration(robot.name.clone()));
    }
    Ok(())
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
        Op::Move { name, by } => match found(&world, name)? {
            Found::Obstacle(i) => {
                let moved = EditShape::of(&world.obstacles[i]).moved(*by);
                reshape(&mut world, Found::Obstacle(i), name, &moved)?;
            }
            Found::Door(i) => {
                let door = &mut world.doors[i];
                (door.a, door.b) = ((door.a + by).map(tidy), (door.b + by).map(tidy));
            }
            Found::Place(i) => {
                let pose = &mut world.places[i].pose;
                (pose.x, pose.y) = (tidy(pose.x + by.x), tidy(pose.y + by.y));
            }
            Found::Mark(i) => world.marks[i].points.iter_mut().for_each(|p| *p = (*p + by).map(tidy)),
            Found::Robot(i) => move_robot(&mut world.robots[i], *by, kinds)?,
        },
        Op::Drag { name, handle, to } => {
            let at = found(&world, name)?;
            if let Found::Place(i) = at {
                let pose = &mut world.places[i].pose;
                if *handle == 0 {
                    (pose.x, pose.y) = (to.x, to.y);
                } else {
                    pose.theta = atan2(to.y - pose.y, to.x - pose.x);
                }
            } else if let Found::Door(i) = at {
                let door = &mut world.doors[i];
                match handle {
                    0 => door.a = *to,
                    1 => door.b = *to,
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
            Found::Place(i) => world.places[i].pose = *pose,
            _ => return Err(EditError::NoShape(name.clone())),
        },
        Op::Rename { name, to } => {
            let slot = match found(&world, name)? {
                Found::Obstacle(i) => &mut world.obstacles[i].name,
                Found::Door(i) => &mut world.doors[i].name,
                Found::Place(i) => &mut world.places[i].name,
                Found::Mark(i) => &mut world.marks[i].name,
                Found::Robot(i) => &mut world.robots[i].name,
            };
            to.clone_into(slot);
        }
        Op::Delete { name } => match found(&world, name)? {
            Found::Obstacle(i) => drop(world.obstacles.remove(i)),
            Found::Door(i) => drop(world.doors.remove(i)),
            Found::Place(i) => drop(world.places.remove(i)),
            Found::Mark(i) => drop(world.marks.remove(i)),
            Found::Robot(i) => drop(world.robots.remove(i)),
        },
    }
    Ok(world)
}
