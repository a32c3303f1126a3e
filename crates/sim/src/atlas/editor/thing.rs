//! `EditedThing`, a named thing of a world while it is changed.

use super::numbers::{self, NumberVisitor};
use super::outline::tidy;
use super::residents::{self, stand};
use super::{EditError, EditShape, Number};
use motion_lab_core::configuration::Kinds;
use motion_lab_core::geometry::{Point2, Pose2, Vector2};
use motion_lab_core::num::atan2;
use motion_lab_core::worlds::{Door, Mark, Obstacle, Place, Resident, World};

/// A named thing of a world, to be changed. A route has no editor.
pub(super) enum EditedThing<'w> {
    Obstacle(&'w mut Obstacle),
    Door(&'w mut Door),
    Place(&'w mut Place),
    Mark(&'w mut Mark),
    Robot(&'w mut Resident),
}

impl<'w> EditedThing<'w> {
    /// The thing of this name.
    ///
    /// # Errors
    /// [`EditError::NoSuchName`].
    pub(super) fn find(world: &'w mut World, name: &str) -> Result<Self, EditError> {
        let World { obstacles, doors, places, marks, robots, .. } = world;
        let obstacle = obstacles.iter_mut().find(|thing| thing.name == name).map(EditedThing::Obstacle);
        obstacle
            .or_else(|| doors.iter_mut().find(|thing| thing.name == name).map(EditedThing::Door))
            .or_else(|| places.iter_mut().find(|thing| thing.name == name).map(EditedThing::Place))
            .or_else(|| marks.iter_mut().find(|thing| thing.name == name).map(EditedThing::Mark))
            .or_else(|| robots.iter_mut().find(|thing| thing.name == name).map(EditedThing::Robot))
            .ok_or_else(|| EditError::NoSuchName(name.to_owned()))
    }

    pub(super) fn name_mut(self) -> &'w mut String {
        match self {
            EditedThing::Obstacle(obstacle) => &mut obstacle.name,
            EditedThing::Door(door) => &mut door.name,
            EditedThing::Place(place) => &mut place.name,
            EditedThing::Mark(mark) => &mut mark.name,
            EditedThing::Robot(robot) => &mut robot.name,
        }
    }

    fn name(&self) -> String {
        match self {
            EditedThing::Obstacle(obstacle) => obstacle.name.clone(),
            EditedThing::Door(door) => door.name.clone(),
            EditedThing::Place(place) => place.name.clone(),
            EditedThing::Mark(mark) => mark.name.clone(),
            EditedThing::Robot(robot) => robot.name.clone(),
        }
    }

    /// The shape of an obstacle, or the line of a mark; `None` for the others.
    fn shape(&self) -> Option<EditShape> {
        match self {
            EditedThing::Obstacle(obstacle) => Some(EditShape::of(obstacle)),
            EditedThing::Mark(mark) => Some(EditShape::Mark(mark.points.clone())),
            EditedThing::Door(_) | EditedThing::Place(_) | EditedThing::Robot(_) => None,
        }
    }

    /// Gives an obstacle another shape, or a mark another line.
    pub(super) fn reshape(&mut self, shape: &EditShape) -> Result<(), EditError> {
        match (self, shape) {
            (EditedThing::Mark(mark), EditShape::Mark(points)) => mark.points.clone_from(points),
            (EditedThing::Obstacle(obstacle), shape) if !matches!(shape, EditShape::Mark(_)) => {
                **obstacle = shape.obstacle(&obstacle.name)?;
            }
            (thing, _) => return Err(EditError::NoShape(thing.name())),
        }
        Ok(())
    }

    /// Moves it, its coordinates rounded to a nanometre.
    pub(super) fn move_by(mut self, by: Vector2, kinds: &Kinds) -> Result<(), EditError> {
        match &mut self {
            EditedThing::Obstacle(obstacle) => {
                let moved = EditShape::of(obstacle).moved(by);
                return self.reshape(&moved);
            }
            EditedThing::Door(door) => (door.a, door.b) = ((door.a + by).map(tidy), (door.b + by).map(tidy)),
            EditedThing::Place(Place { pose, .. }) => (pose.x, pose.y) = (tidy(pose.x + by.x), tidy(pose.y + by.y)),
            EditedThing::Mark(mark) => mark.points.iter_mut().for_each(|p| *p = (*p + by).map(tidy)),
            EditedThing::Robot(robot) => residents::move_by(robot, by, kinds)?,
        }
        Ok(())
    }

    /// Drags one of its handles to a point.
    pub(super) fn drag(mut self, handle: usize, to: Point2, kinds: &Kinds) -> Result<(), EditError> {
        match (&mut self, handle) {
            (EditedThing::Place(Place { pose, .. }), 0) => (pose.x, pose.y) = (to.x, to.y),
            (EditedThing::Place(Place { pose, .. }), _) => pose.theta = atan2(to.y - pose.y, to.x - pose.x),
            (EditedThing::Door(door), 0) => door.a = to,
            (EditedThing::Door(door), 1) => door.b = to,
            (EditedThing::Door(_), _) => {}
            (EditedThing::Robot(robot), _) => {
                let from = stand(robot, kinds).ok_or_else(|| EditError::NoShape(robot.name.clone()))?.at();
                match handle {
                    0 => residents::put(robot, to, None, kinds)?,
                    1 => residents::put(robot, from, Some(atan2(to.y - from.y, to.x - from.x)), kinds)?,
                    _ => {}
                }
            }
            (EditedThing::Obstacle(_) | EditedThing::Mark(_), _) => {
                let shape = self.shape().ok_or_else(|| EditError::NoShape(self.name()))?;
                self.reshape(&shape.with_handle(handle, to))?;
            }
        }
        Ok(())
    }

    /// Moves and turns a place, or a robot whose start is a pose.
    pub(super) fn set_pose(self, to: &Pose2, kinds: &Kinds) -> Result<(), EditError> {
        match self {
            EditedThing::Place(place) => place.pose = *to,
            EditedThing::Robot(robot) => residents::put(robot, to.position(), Some(to.theta), kinds)?,
            other => return Err(EditError::NoShape(other.name())),
        }
        Ok(())
    }

    /// Visits its numbers, each of which may be changed.
    pub(super) fn visit(&mut self, kinds: &Kinds, visit: &mut NumberVisitor<'_>) -> Result<(), EditError> {
        match self {
            EditedThing::Obstacle(_) | EditedThing::Mark(_) => {
                if let Some(was) = self.shape() {
                    let mut shape = was.clone();
                    numbers::of_shape(&mut shape, visit);
                    if shape != was {
                        self.reshape(&shape)?;
                    }
                }
            }
            EditedThing::Door(door) => numbers::of_door(door, visit),
            EditedThing::Place(place) => numbers::pose(&mut place.pose, visit),
            EditedThing::Robot(robot) => numbers::of_robot(robot, kinds, visit),
        }
        Ok(())
    }
}

/// A copy of the thing of this name in a list.
fn copy<T: Clone>(things: &[T], named: impl Fn(&T) -> bool) -> Option<T> {
    things.iter().find(|thing| named(thing)).cloned()
}

/// What `ask` says of a copy of the thing of this name; `None` where there is none. Only the thing is copied, however
/// much else the world holds.
fn asked<T>(world: &World, name: &str, ask: impl FnOnce(EditedThing<'_>) -> T) -> Option<T> {
    if let Some(mut obstacle) = copy(&world.obstacles, |thing| thing.name == name) {
        return Some(ask(EditedThing::Obstacle(&mut obstacle)));
    }
    if let Some(mut door) = copy(&world.doors, |thing| thing.name == name) {
        return Some(ask(EditedThing::Door(&mut door)));
    }
    if let Some(mut place) = copy(&world.places, |thing| thing.name == name) {
        return Some(ask(EditedThing::Place(&mut place)));
    }
    if let Some(mut mark) = copy(&world.marks, |thing| thing.name == name) {
        return Some(ask(EditedThing::Mark(&mut mark)));
    }
    copy(&world.robots, |thing| thing.name == name).map(|mut robot| ask(EditedThing::Robot(&mut robot)))
}

/// The shape of the wall, obstacle or mark of this name.
pub(super) fn shape_of(world: &World, name: &str) -> Option<EditShape> {
    asked(world, name, |thing| thing.shape())?
}

/// The numbers of the thing of this name, in order.
pub(super) fn numbers_of(world: &World, name: &str, kinds: &Kinds) -> Vec<Number> {
    let numbers = |mut thing: EditedThing<'_>| numbers::listed(|visit| _ = thing.visit(kinds, visit));
    asked(world, name, numbers).unwrap_or_default()
}
