//! What comes to the robots with the next tick, and where inputs put them.

use std::ops::RangeInclusive;

use bevy::prelude::*;

use crate::window::ui::{CockpitRobot, Interface, ShownClearance, TRAIL, footprint_at, joints, turned};
use motion_lab_core::collision::{Collision as _, Scene};
use motion_lab_core::configuration::{AnyConfiguration, Coordinates};
use motion_lab_core::geometry::Point2;
use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::anatomy::held_before;
use motion_lab_sim::run::{Event, Quantized, RobotInput, Script, WorldChange};
use motion_lab_sim::simulation::{PendingInput, Playback, RobotView, Roster, Transport, WorldScene};

/// A configuration as a pane says it.
pub struct Said {
    /// As its type prints it.
    pub readout: String,
    /// The same with every digit.
    pub in_full: String,
    /// The tip of an arm.
    pub tip: Option<Point2>,
    /// The footprint's distance from the obstacles.
    pub clearance: Option<ShownClearance>,
}

/// The world that a robot is in, as it meets it.
pub fn scene_of<'w>(world: &'w World, robot: &RobotView) -> Option<&'w Scene> {
    let inhabited = *world.resource::<Roster>().worlds().get(robot.world as usize)?;
    Some(&world.get::<WorldScene>(inhabited)?.0)
}

/// How near a robot is to what its motion of this tick met, if its clearance, metres, is known.
pub fn clearance(world: &World, robot: &RobotView, metres: f64) -> ShownClearance {
    let scene = scene_of(world, robot).filter(|_| robot.in_contact);
    let held_before = scene.and_then(|scene| held_before(scene, &robot.footprint)).map(str::to_owned);
    ShownClearance { metres, held_before }
}

/// One of the lab's robots at these coordinates.
pub fn next(world: &World, robot: &RobotView, to: &[f64]) -> Option<Said> {
    let there = footprint_at(&robot.kind, robot.model, to);
    let clearance = scene_of(world, robot).zip(there).map(|(scene, there)| scene.distance(&there));
    let clearance = clearance.map(|metres| ShownClearance { metres, held_before: None });
    let (in_full, q) = match AnyRobot::of_kind(&robot.kind, to)?.1 {
        AnyConfiguration::T2(q) => (format!("{q:?}"), q.to_string()),
        AnyConfiguration::T3(q) => (format!("{q:?}"), q.to_string()),
        AnyConfiguration::Pose(q) => (format!("{q:?}"), q.to_string()),
        AnyConfiguration::Hitch(q) => (format!("{q:?}"), q.to_string()),
    };
    let tip = robot.tip.and_then(|_| joints(&turned(&robot.footprint, to)).last().copied());
    Some(Said { readout: q, in_full, tip, clearance })
}

/// The inputs that are asked for by the next tick. What is due then as a run is gone through again, or as a path is
/// played, nobody asks for: it is the run's.
fn asked(world: &World) -> &[Event] {
    let (transport, pending) = (world.resource::<Transport>(), world.resource::<PendingInput>());
    let (next, events) = (transport.tick() + 1, &pending.script().events);
    let has_more = transport.frontier() >= next || events.last().is_some_and(|event| event.tick > next + 1);
    let is_own = has_more || world.resource::<Interface>().0.plan.plays_alone(events);
    if is_own { &[] } else { pending.due(next) }
}

/// Whether the run is paused with a change of a world due at the next tick, or an input to one of its robots asked for.
pub fn waits(world: &World, name: &str, robots: &[CockpitRobot]) -> bool {
    let transport = world.resource::<Transport>();
    let (tick, playback) = (transport.tick(), transport.playback);
    let is_here = |event: &Event| robots.iter().any(|robot| robot.name == event.robot);
    let is_due = || world.resource::<PendingInput>().due_changes(tick + 1).iter().any(|change| change.world == name);
    playback == Playback::Paused && (asked(world).iter().any(is_here) || is_due())
}

/// The doors of a world that open or close with the next tick of a paused run.
pub fn doors(world: &World, name: &str) -> Vec<(String, bool)> {
    let transport = world.resource::<Transport>();
    let (tick, playback) = (transport.tick(), transport.playback);
    let due = world.resource::<PendingInput>().due_changes(tick + 1).iter();
    let due = due.filter(|change| playback == Playback::Paused && change.world == name);
    let doors = due.filter_map(|change| match &change.change {
        WorldChange::Open(door) => Some((door.clone(), true)),
        WorldChange::Close(door) => Some((door.clone(), false)),
        _ => None,
    });
    doors.collect()
}

/// The coordinates that an input asks of a robot by the next tick.
pub fn target(world: &World, robot: &RobotView) -> Option<Coordinates> {
    asked(world).iter().rev().filter(|e| e.robot == robot.name).find_map(|e| match &e.input {
        RobotInput::MoveTo(to) | RobotInput::Teleport(to) => Some(to.iter().map(|c| c.value()).collect()),
        _ => None,
    })
}

/// The tick by which an input put a robot somewhere last, as far back as its trail goes; 0 without one.
pub fn put(world: &World, robot: &RobotView) -> u64 {
    put_by(world.resource::<PendingInput>().script(), &robot.name, world.resource::<Transport>().tick())
}

fn put_by(script: &Script, robot: &str, tick: u64) -> u64 {
    let events = script.events[..script.events.partition_point(|e| e.tick <= tick)].iter().rev();
    let is_put = |e: &&Event| e.robot == robot && matches!(e.input, RobotInput::Teleport(_));
    events.take_while(|e| e.tick + TRAIL >= tick).find(is_put).map_or(0, |e| e.tick)
}

/// Whether an input has put a robot somewhere since its exercise began, which no wheel does; not where it begins.
pub fn put_since_goal(world: &World, robot: &RobotView) -> bool {
    let goal = world.resource::<Interface>().0.goal.as_ref().filter(|(name, _)| *name == robot.name);
    let Some((_, goal)) = goal else { return false };
    let begins = goal.is_put.then_some(&goal.start[..]);
    let script = world.resource::<PendingInput>().script();
    goal.tick.is_some_and(|from| put_since(script, &robot.name, from..=world.resource::<Transport>().tick(), begins))
}

/// Whether an input of these ticks puts a robot somewhere. One of the first tick counts where the exercise begins with
/// the robot put at `begins`, and the input puts it elsewhere.
fn put_since(script: &Script, robot: &str, ticks: RangeInclusive<u64>, begins: Option<&[f64]>) -> bool {
    let events = script.events[..script.events.partition_point(|e| e.tick <= *ticks.end())].iter().rev();
    let elsewhere = |to: &[Quantized]| {
        begins.is_some_and(|start| !to.iter().map(|c| Some(*c)).eq(start.iter().map(|c| Quantized::try_new(*c))))
    };
    events.take_while(|e| e.tick >= *ticks.start()).any(|e| match &e.input {
        RobotInput::Teleport(to) if e.robot == robot => e.tick > *ticks.start() || elsewhere(to),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_car_that_was_put_since_its_exercise_began_was_put_however_long_ago() {
        let quantized = |x: f64| vec![Quantized::try_new(x).unwrap()];
        let put =
            |tick, robot: &str, x| Event { tick, robot: robot.to_owned(), input: RobotInput::Teleport(quantized(x)) };
        let script =
            Script { events: vec![put(5, "Car", 1.0), put(5, "Car", 2.0), put(9, "Van", 1.0)], ..Script::empty() };
        let since = |ticks, begins: Option<&[f64]>| put_since(&script, "Car", ticks, begins);
        assert!(since(4..=5, None) && since(4..=5000, None), "no tick is too long ago");
        assert!(!since(4..=4, None) && !since(6..=5000, None), "before it, and after it");
        assert!(!since(5..=5000, None), "as the goal is set, where the car stands counts");
        assert!(since(5..=5, Some(&[1.0])), "put back to 1, then lifted to 2 in the same tick");
        let back = Script { events: vec![put(5, "Car", 1.0)], ..Script::empty() };
        assert!(!put_since(&back, "Car", 5..=9, Some(&[1.0])), "put back to where it begins");
    }

    #[test]
    fn a_robot_was_put_by_its_own_last_input_up_to_now() {
        let event = |tick, robot: &str, input| Event { tick, robot: robot.to_owned(), input };
        let to = || RobotInput::Teleport(Vec::new());
        let events = vec![
            event(3, "Rusty", to()),
            event(5, "Rusty", to()),
            event(6, "Hitch", to()),
            event(7, "Rusty", RobotInput::Drive(1, 0)),
            event(9, "Rusty", to()),
        ];
        let script = Script { events, ..Script::empty() };
        let at = |tick| put_by(&script, "Rusty", tick);
        assert_eq!([2, 3, 4, 8, 9].map(at), [0, 3, 3, 5, 9]);
        assert_eq!(put_by(&script, "Reach", 20), 0);
        assert_eq!([209, 210].map(at), [9, 0], "ten seconds of 20 ticks later it does not matter");
    }
}
