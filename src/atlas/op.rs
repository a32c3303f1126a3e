//! `Op`, a change of a world.

use super::EditShape;
use crate::geometry::{Point2, Pose2, Vector2};
use crate::worlds::{OutlineError, Place, World, WorldError};

/// A change of a world.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// Add a wall or an obstacle.
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
        /// Where it is.
        pose: Pose2,
    },
    /// Move anything that has a name: an arm's base stays, as its start says nothing of it.
    Move {
        /// Its name.
        name: String,
        /// How far.
        by: Vector2,
    },
    /// Drag one of a wall's or obstacle's [handles](EditShape::handles).
    Drag {
        /// Its name.
        name: String,
        /// The handle's number.
        handle: usize,
        /// Where it goes.
        to: Point2,
    },
    /// Give a wall or obstacle another shape.
    Reshape {
        /// Its name.
        name: String,
        /// The shape.
        shape: EditShape,
    },
    /// Put a place elsewhere, or turn it.
    SetPose {
        /// Its name.
        name: String,
        /// Where it is.
        pose: Pose2,
    },
    /// Give anything another name.
    Rename {
        /// Its name.
        name: String,
        /// Its new name.
        to: String,
    },
    /// Take anything out.
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
    /// It can't be changed in this way.
    #[error("{0:?} has no shape to change")]
    NoShape(String),
    /// A polygon whose outline is none.
    #[error("polygon: {0}")]
    Outline(#[from] OutlineError),
    /// The world would be refused as a file.
    #[error("{0}")]
    World(#[from] WorldError),
}

/// Which list of a world has a thing, and where.
#[derive(Clone, Copy)]
enum Found {
    Obstacle(usize),
    Place(usize),
    Mark(usize),
    Robot(usize),
}

fn find(world: &World, name: &str) -> Option<Found> {
    let at = |mut names: Box<dyn Iterator<Item = &str> + '_>| names.position(|n| n == name);
    at(Box::new(world.obstacles.iter().map(|o| o.name.as_str())))
        .map(Found::Obstacle)
        .or_else(|| at(Box::new(world.places.iter().map(|p| p.name.as_str()))).map(Found::Place))
        .or_else(|| at(Box::new(world.marks.iter().map(|m| m.name.as_str()))).map(Found::Mark))
        .or_else(|| at(Box::new(world.robots.iter().map(|r| r.name.as_str()))).map(Found::Robot))
}

/// Whether anything has this name.
pub(super) fn is_taken(world: &World, name: &str) -> bool {
    find(world, name).is_some()
}

/// The world after a change, not checked yet.
pub(super) fn changed(world: &World, op: &Op) -> Result<World, EditError> {
    let mut world = world.clone();
    let found = |world: &World, name: &str| find(world, name).ok_or_else(|| EditError::NoSuchName(name.to_owned()));
    let obstacle = |world: &World, name: &str| match found(world, name)? {
        Found::Obstacle(i) => Ok(i),
        _ => Err(EditError::NoShape(name.to_owned())),
    };
    match op {
        Op::Add { name, shape } => world.obstacles.push(shape.obstacle(name)?),
        Op::AddPlace { name, pose } => world.places.push(Place { name: name.clone(), pose: *pose }),
        Op::Move { name, by } => match found(&world, name)? {
            Found::Obstacle(i) => {
                world.obstacles[i] = EditShape::of(&world.obstacles[i]).moved(*by).obstacle(name)?;
            }
            Found::Place(i) => {
                let pose = &mut world.places[i].pose;
                (pose.x, pose.y) = (pose.x + by.x, pose.y + by.y);
            }
            Found::Mark(i) => world.marks[i].points.iter_mut().for_each(|p| *p += *by),
            Found::Robot(i) => {
                let robot = &mut world.robots[i];
                if let ("rusty" | "hitch", [x, y, ..]) = (robot.kind.as_str(), &mut robot.start[..]) {
                    (*x, *y) = (*x + by.x, *y + by.y);
                } else {
                    return Err(EditError::NoShape(name.clone()));
                }
            }
        },
        Op::Drag { name, handle, to } => {
            let i = obstacle(&world, name)?;
            world.obstacles[i] = EditShape::of(&world.obstacles[i]).with_handle(*handle, *to).obstacle(name)?;
        }
        Op::Reshape { name, shape } => {
            let i = obstacle(&world, name)?;
            world.obstacles[i] = shape.obstacle(name)?;
        }
        Op::SetPose { name, pose } => match found(&world, name)? {
            Found::Place(i) => world.places[i].pose = *pose,
            _ => return Err(EditError::NoShape(name.clone())),
        },
        Op::Rename { name, to } => {
            let slot = match found(&world, name)? {
                Found::Obstacle(i) => &mut world.obstacles[i].name,
                Found::Place(i) => &mut world.places[i].name,
                Found::Mark(i) => &mut world.marks[i].name,
                Found::Robot(i) => &mut world.robots[i].name,
            };
            to.clone_into(slot);
        }
        Op::Delete { name } => match found(&world, name)? {
            Found::Obstacle(i) => drop(world.obstacles.remove(i)),
            Found::Place(i) => drop(world.places.remove(i)),
            Found::Mark(i) => drop(world.marks.remove(i)),
            Found::Robot(i) => drop(world.robots.remove(i)),
        },
    }
    Ok(world)
}
