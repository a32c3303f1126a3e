//! Numbers of a recipe with fewer digits.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::sync::Arc;

use super::starts::in_contact_at_start;
use super::without::as_from_a_file;
use crate::run::{Quantized, Recipe, RobotInput, WorldChange};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::geometry::{Point2, Pose2, Shape, ShapeError};
use motion_lab_core::num::wrap;
use motion_lab_core::worlds::{Obstacle, Resident, SourceShape};

/// The numbers of decimals that are tried, the fewest first; -2 is a multiple of a hundred, 6 the micrometre that is
/// nearly the unit of scripts.
pub(super) const DECIMALS: RangeInclusive<i32> = -2..=6;

/// A thing of a recipe whose numbers are rounded together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rounded {
    /// The channels or the coordinates of an input.
    Event(usize),
    /// The coordinates of a change.
    Change(usize),
    /// The start of a robot, by world and robot.
    Start(usize, usize),
    /// The shapes of an obstacle, by world and obstacle.
    Obstacle(usize, usize),
    /// The ends of a door, by world and door.
    Door(usize, usize),
}

/// The recipe with the numbers of these things rounded to this number of decimals. `None` where they then make no
/// world, or where a robot would start in contact that does not now.
pub(super) fn rounded(recipe: &Recipe, things: &BTreeSet<Rounded>, decimals: i32) -> Option<Recipe> {
    let mut left = recipe.clone();
    let mut shaped = BTreeSet::new();
    for thing in things {
        match *thing {
            Rounded::Event(i) => round_input(&mut left.script.events.get_mut(i)?.input, decimals)?,
            Rounded::Change(i) => round_change(&mut left.script.changes.get_mut(i)?.change, decimals)?,
            Rounded::Start(w, r) => {
                let robot = Arc::make_mut(&mut left.config).worlds.get_mut(w)?.robots.get_mut(r)?;
                robot.start = round_start(robot, decimals);
            }
            Rounded::Obstacle(w, o) => {
                let obstacle = Arc::make_mut(&mut left.config).worlds.get_mut(w)?.obstacles.get_mut(o)?;
                *obstacle = round_obstacle(obstacle, decimals)?;
                shaped.insert(w);
            }
            Rounded::Door(w, d) => {
                let door = Arc::make_mut(&mut left.config).worlds.get_mut(w)?.doors.get_mut(d)?;
                (door.a, door.b) = (point(door.a, decimals), point(door.b, decimals));
                Shape::try_segment(door.a, door.b).ok()?;
            }
        }
    }
    for w in shaped {
        let world = Arc::make_mut(&mut left.config).worlds.get_mut(w)?;
        *world = as_from_a_file(world)?;
    }
    let is_input = |thing: &Rounded| matches!(thing, Rounded::Event(_) | Rounded::Change(_));
    let stands_clear = || in_contact_at_start(&left).is_subset(&in_contact_at_start(recipe));
    (things.iter().all(is_input) || stands_clear()).then_some(left)
}

/// The things of a recipe that this number of decimals changes; only those of the script where worlds stay as they are.
pub(super) fn roundable(recipe: &Recipe, decimals: i32, keeps_worlds: bool) -> Vec<Rounded> {
    let (config, script) = (&recipe.config, &recipe.script);
    let mut things: Vec<Rounded> = (0..script.events.len()).map(Rounded::Event).collect();
    things.extend((0..script.changes.len()).map(Rounded::Change));
    for (w, world) in config.worlds.iter().enumerate().filter(|_| !keeps_worlds) {
        things.extend((0..world.robots.len()).map(|r| Rounded::Start(w, r)));
        things.extend((0..world.obstacles.len()).map(|o| Rounded::Obstacle(w, o)));
        things.extend((0..world.doors.len()).map(|d| Rounded::Door(w, d)));
    }
    things.retain(|thing| is_changed(recipe, *thing, decimals));
    things
}

/// Whether rounding changes a thing, and gives one.
fn is_changed(recipe: &Recipe, thing: Rounded, decimals: i32) -> bool {
    let (worlds, script) = (&recipe.config.worlds, &recipe.script);
    let changed = match thing {
        Rounded::Event(i) => script.events.get(i).map(|event| {
            let mut input = event.input.clone();
            round_input(&mut input, decimals).is_some() && input != event.input
        }),
        Rounded::Change(i) => script.changes.get(i).map(|event| {
            let mut change = event.change.clone();
            round_change(&mut change, decimals).is_some() && change != event.change
        }),
        Rounded::Start(w, r) => {
            worlds.get(w).and_then(|world| world.robots.get(r)).map(|robot| robot.start != round_start(robot, decimals))
        }
        Rounded::Obstacle(w, o) => worlds.get(w).and_then(|world| world.obstacles.get(o)).map(|obstacle| {
            let rounded = round_obstacle(obstacle, decimals);
            rounded.is_some_and(|rounded| rounded != *obstacle)
        }),
        Rounded::Door(w, d) => worlds.get(w).and_then(|world| world.doors.get(d)).map(|door| {
            let (a, b) = (point(door.a, decimals), point(door.b, decimals));
            Shape::try_segment(a, b).is_ok() && (a, b) != (door.a, door.b)
        }),
    };
    changed.unwrap_or(false)
}

/// The number rounded to this number of decimals, never `-0.0`.
fn to(x: f64, decimals: i32) -> f64 {
    rounded_by(f64::round, x, decimals)
}

/// The angle rounded to this number of decimals: towards 0 where it would be more than half a turn, which a world file
/// does not hold.
fn angle_to(x: f64, decimals: i32) -> f64 {
    let nearest = to(x, decimals);
    if wrap(nearest) == nearest { nearest } else { rounded_by(f64::trunc, x, decimals) }
}

fn rounded_by(round: fn(f64) -> f64, x: f64, decimals: i32) -> f64 {
    // powers of ten of these sizes are exact
    let scale = (0..decimals.unsigned_abs()).fold(1.0, |scale, _| scale * 10.0);
    let rounded = if decimals < 0 { round(x / scale) * scale } else { round(x * scale) / scale };
    rounded + 0.0
}

/// The start of a robot with its coordinates rounded; those of kinds that are not the lab's have no angles.
fn round_start(robot: &Resident, decimals: i32) -> Vec<f64> {
    let lengths = RobotKind::of(&robot.kind).map_or(usize::MAX, |kind| kind.lengths);
    let round = |(i, x): (usize, &f64)| if i < lengths { to(*x, decimals) } else { angle_to(*x, decimals) };
    robot.start.iter().enumerate().map(round).collect()
}

fn point(p: Point2, decimals: i32) -> Point2 {
    p.map(|x| to(x, decimals))
}

fn quantized(x: &mut Quantized, decimals: i32) -> Option<()> {
    *x = Quantized::try_new(to(x.value(), decimals))?;
    Some(())
}

fn round_input(input: &mut RobotInput, decimals: i32) -> Option<()> {
    match input {
        RobotInput::Drive(a, b) => [a, b].into_iter().for_each(|c| *c = to(f64::from(*c), decimals) as i16),
        RobotInput::MoveTo(q) | RobotInput::Teleport(q) => q.iter_mut().try_for_each(|x| quantized(x, decimals))?,
        RobotInput::SetTrailer(_) | RobotInput::Release => {}
    }
    Some(())
}

fn round_change(change: &mut WorldChange, decimals: i32) -> Option<()> {
    match change {
        WorldChange::Close(_) | WorldChange::Open(_) | WorldChange::Remove(_) => Some(()),
        WorldChange::Move { to: (x, y, theta), .. } => {
            [x, y, theta].into_iter().try_for_each(|c| quantized(c, decimals))
        }
        WorldChange::Add { points, radius, .. } => {
            let points = points.iter_mut().flat_map(|(x, y)| [x, y]);
            points.chain([radius]).try_for_each(|c| quantized(c, decimals))
        }
    }
}

fn round_obstacle(obstacle: &Obstacle, decimals: i32) -> Option<Obstacle> {
    let mut rounded = Obstacle::new(&obstacle.name, obstacle.kind, Vec::new());
    for shape in obstacle.written() {
        match shape {
            SourceShape::Outline(points) => {
                let points: Vec<Point2> = points.iter().map(|p| point(*p, decimals)).collect();
                rounded.add_polygon(&points).ok()?;
            }
            SourceShape::Piece((pose, shape)) => {
                let pose = Pose2::new(to(pose.x, decimals), to(pose.y, decimals), angle_to(pose.theta, decimals));
                rounded.pieces.push((pose, round_shape(shape, decimals).ok()?));
            }
        }
    }
    Some(rounded)
}

fn round_shape(shape: &Shape, decimals: i32) -> Result<Shape, ShapeError> {
    let (p, r) = (|q: &Point2| point(*q, decimals), |radius: &f64| to(*radius, decimals));
    let all = |points: &[Point2]| points.iter().map(p).collect::<Vec<_>>();
    match shape {
        Shape::Disc { radius } => Shape::try_disc(r(radius)),
        Shape::Segment { a, b } => Shape::try_segment(p(a), p(b)),
        Shape::Capsule { a, b, radius } => Shape::try_capsule(p(a), p(b), r(radius)),
        Shape::Rectangle { min, max } => Shape::try_rectangle(p(min), p(max)),
        Shape::Polygon(polygon) => Shape::try_polygon(&all(polygon.vertices())),
        Shape::Hull { vertices, radius } => Shape::try_rounded(&all(vertices), r(radius)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_to_decimals_and_stay_so() {
        let x = -123.456_789;
        for (decimals, expected) in
            [(-2, -100.0), (-1, -120.0), (0, -123.0), (1, -123.5), (2, -123.46), (5, -123.456_79)]
        {
            assert_eq!(to(x, decimals), expected);
            assert_eq!(to(expected, decimals), expected);
        }
        assert!(to(-0.3, 0).is_sign_positive() && to(-0.3, 0) == 0.0);
        for (decimals, expected) in [(-1, 0.0), (0, 3.0), (2, 314.0 / 1e2), (3, 3_141.0 / 1e3), (4, 31_415.0 / 1e4)] {
            for angle in [expected, std::f64::consts::PI] {
                assert_eq!((angle_to(angle, decimals), angle_to(-angle, decimals)), (expected, -expected));
            }
        }
    }

    #[test]
    fn the_parts_of_inputs_and_shapes_are_rounded_together_or_not_at_all() {
        let q = |values: [f64; 2]| values.map(|x| Quantized::try_new(x).unwrap()).to_vec();
        let mut input = RobotInput::Teleport(q([1.26, -0.04]));
        round_input(&mut input, 1).unwrap();
        assert_eq!(input, RobotInput::Teleport(q([1.3, 0.0])));
        let mut drive = RobotInput::Drive(127, -44);
        round_input(&mut drive, -1).unwrap();
        assert_eq!(drive, RobotInput::Drive(130, -40), "which a script's check refuses");
        round_input(&mut drive, -2).unwrap();
        assert_eq!(drive, RobotInput::Drive(100, 0));
        let (a, b) = (Point2::new(0.26, 0.0), Point2::new(0.31, 0.0));
        let line = Shape::Segment { a, b };
        assert_eq!(round_shape(&line, 2), Ok(line.clone()));
        assert!(round_shape(&line, 0).is_err() && round_shape(&line, 1).is_err(), "it would be a point");
        assert!(round_shape(&Shape::Disc { radius: 0.04 }, 1).is_err());
    }
}
