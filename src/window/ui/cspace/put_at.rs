//! Puts a robot on wheels where it was dragged to, as an input of the run.

use crate::window::ui::{Cockpit, CockpitRobot, Command, LinkedState};
use motion_lab_core::collision::{Collision, footprint_distance};
use motion_lab_core::configuration::Coordinates;
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::num::{greater, lesser};
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_sim::run::{Quantized, RobotInput, check_target};
use motion_lab_sim::simulation::RobotCommand;

/// The coordinates that a robot has by the next tick, as far as they are asked for; else those that it has.
pub fn to_come(robot: &CockpitRobot) -> &Coordinates {
    robot.target.as_ref().unwrap_or(&robot.coordinates)
}

/// The footprint of a robot at [`to_come`].
pub fn footprint_to_come(robot: &CockpitRobot) -> Footprint {
    let asked = robot.target.as_ref().and_then(|to| footprint_at(&robot.kind, robot.model, to));
    asked.unwrap_or_else(|| robot.footprint.clone())
}

/// The footprint of a robot of one of the lab's kinds at these coordinates, with its own sizes.
pub fn footprint_at(kind: &str, model: Option<AnyRobot>, to: &[f64]) -> Option<Footprint> {
    let (_, q) = AnyRobot::of_kind(kind, to)?;
    Some(model?.fitted(&q).footprint(&q))
}

/// The other robots of a cockpit that a robot would touch with this footprint.
pub fn robots_in_the_way<'a>(
    cockpit: &'a Cockpit,
    robot: &CockpitRobot,
    there: &Footprint,
) -> impl Iterator<Item = &'a CockpitRobot> {
    let others = cockpit.robots.iter().filter(move |other| other.id != robot.id);
    others.filter(move |other| footprint_distance(there, &footprint_to_come(other)) == 0.0)
}

/// Whether a robot can be put elsewhere by hand: one of the lab's on wheels.
pub fn is_placeable(robot: &CockpitRobot) -> bool {
    !robot.is_arm && robot.model.is_some() && AnyRobot::of_kind(&robot.kind, &robot.coordinates).is_some()
}

/// Asks that a robot's reference point be here by the next tick, or at the nearest point of the world's bounds, its
/// headings as they are. Returns what [`put`] returns.
pub fn put_at(
    cockpit: &Cockpit,
    robot: &CockpitRobot,
    to: Point2,
    linked: &LinkedState,
    commands: &mut Vec<Command>,
) -> Option<Footprint> {
    let (min, max) = (cockpit.world.bounds.min, cockpit.world.bounds.max);
    let mut there = to_come(robot).clone();
    if let [x, y, ..] = &mut there[..] {
        *x = greater(min.x, lesser(max.x, to.x));
        *y = greater(min.y, lesser(max.y, to.y));
    }
    put(cockpit, robot, &there, linked, commands)
}

/// Asks that a robot turn to this heading by the next tick, radians, where it is. Returns what [`put`] returns.
pub fn turn_to(
    cockpit: &Cockpit,
    robot: &CockpitRobot,
    heading: f64,
    linked: &LinkedState,
    commands: &mut Vec<Command>,
) -> Option<Footprint> {
    let mut there = to_come(robot).clone();
    if let Some(theta) = there.get_mut(2) {
        *theta = heading;
    }
    put(cockpit, robot, &there, linked, commands)
}

/// Asks that a robot have these coordinates by the next tick. Where it would overlap or touch an obstacle or another
/// robot, be outside its world, or fold beyond its limits, it asks nothing, and returns the robot's footprint there.
/// Asks nothing for what is no configuration of one of the lab's robots.
fn put(
    cockpit: &Cockpit,
    robot: &CockpitRobot,
    there: &[f64],
    linked: &LinkedState,
    commands: &mut Vec<Command>,
) -> Option<Footprint> {
    let quantized: Vec<Quantized> = there.iter().map(|c| Quantized::try_new(*c)).collect::<Option<_>>()?;
    let rounded: Vec<f64> = quantized.iter().map(|c| c.value()).collect();
    let q = AnyRobot::of_kind(&robot.kind, &rounded)?.1;
    let model = robot.model?.fitted(&q);
    model.check(&q).ok()?;
    let footprint = model.footprint(&q);
    let is_taken = robots_in_the_way(cockpit, robot, &footprint).next().is_some();
    let is_outside = model.position(&q).is_some_and(|at| check_target(at, &cockpit.world.bounds).is_err());
    if is_taken || is_outside || !model.is_within_limits(&q) || linked.scene_of(&cockpit.atlas).intersects(&footprint) {
        return Some(footprint);
    }
    if rounded[..] != to_come(robot)[..] {
        let input = RobotInput::Teleport(quantized);
        commands.push(Command::from(RobotCommand { robot: robot.name.clone(), input }));
    }
    None
}
