//! `PendingInput`, the run's script as it grows, and the system that applies the events of a tick.

use std::sync::Arc;

use bevy::prelude::*;

use super::world_crowds::others_now;
use crate::run::{ChangedWorlds, Event, RobotInput, Script, ScriptError, WorldChange, WorldEvent};
use crate::simulation::obstacles::change::{self, RefusedChanges};
use crate::simulation::{Refusals, RefusedEvent, RefusedInput, ResidesIn, RobotId, RobotOps, Roster, Transport};
use crate::tour::TourConfig;

/// An input to a robot from its driver, sent as a [`RunCommand`](crate::simulation::RunCommand). It applies before the
/// next tick's step.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotCommand {
    /// The robot's name.
    pub robot: String,
    /// The input.
    pub input: RobotInput,
}

/// All input of the run, past and to come, in order of its ticks. A recorder records it and a replay fills it.
#[derive(Resource, Clone, Debug)]
pub struct PendingInput {
    script: Script,
    /// The tick of the last captured live input. While input is captured for it, events at the next tick are
    /// releases put off from it.
    captured: Option<u64>,
    checked: CheckedChanges,
}

/// The first changes of the script, which were checked: one at its end is checked without them.
#[derive(Clone, Debug, Default)]
struct CheckedChanges {
    count: usize,
    /// The run's configuration, whose worlds they change.
    config: Option<Arc<TourConfig>>,
    /// The worlds as they leave them.
    worlds: ChangedWorlds,
}

impl PartialEq for PendingInput {
    fn eq(&self, other: &Self) -> bool {
        (&self.script, self.captured) == (&other.script, other.captured)
    }
}

impl Default for PendingInput {
    fn default() -> Self {
        PendingInput::new(Script::empty())
    }
}

impl PendingInput {
    /// The input of this script; events of one tick stay in their order.
    pub fn new(mut script: Script) -> Self {
        script.events.sort_by_key(|e| e.tick);
        script.changes.sort_by_key(|c| c.tick);
        PendingInput { script, captured: None, checked: CheckedChanges::default() }
    }

    /// The script.
    pub fn script(&self) -> &Script {
        &self.script
    }

    /// The events stamped with `tick`, in order.
    pub fn due(&self, tick: u64) -> &[Event] {
        let events = &self.script.events;
        let from = events.partition_point(|e| e.tick < tick);
        let to = events.partition_point(|e| e.tick <= tick);
        &events[from..to]
    }

    /// The changes of worlds stamped with `tick`, in order.
    pub fn due_changes(&self, tick: u64) -> &[WorldEvent] {
        let changes = &self.script.changes;
        let from = changes.partition_point(|c| c.tick < tick);
        let to = changes.partition_point(|c| c.tick <= tick);
        &changes[from..to]
    }

    /// Forgets every event and every change after `tick`.
    pub fn truncate_after(&mut self, tick: u64) {
        self.script.truncate_after(tick);
        self.captured = None;
        self.check_again_from(self.script.changes.len());
    }

    /// Forgets what is known of the changes from this number on, if there is anything.
    fn check_again_from(&mut self, number: usize) {
        if number < self.checked.count {
            self.checked = CheckedChanges::default();
        }
    }

    /// Whether a change at this tick would be the script's last.
    pub(crate) fn is_last(&self, tick: u64) -> bool {
        self.script.changes.last().is_none_or(|last| last.tick <= tick)
    }

    /// Checks a change that would be the script's last in a run of this configuration. What it takes does not grow with
    /// the script: the changes before it are checked once.
    ///
    /// # Errors
    /// [`ScriptError`] for a change that the script can't have.
    pub(crate) fn check_last(&mut self, config: &Arc<TourConfig>, change: &WorldEvent) -> Result<(), ScriptError> {
        let (checked, changes) = (&mut self.checked, &self.script.changes);
        if !checked.config.as_ref().is_some_and(|known| Arc::ptr_eq(known, config)) {
            *checked = CheckedChanges { config: Some(Arc::clone(config)), ..CheckedChanges::default() };
        }
        for (number, known) in changes.iter().enumerate().skip(checked.count) {
            checked.worlds.take(&config.worlds, known).map_err(|problem| problem.at("changes", number))?;
            checked.count += 1;
        }
        let before = changes.last().map_or(0, |last| last.tick);
        let fits = change.check(before).and_then(|()| checked.worlds.check(&config.worlds, change));
        fits.map_err(|problem| problem.at("changes", changes.len()))
    }

    /// Captures a live change of a world for its tick, which is the next to run. Later input is forgotten. Of several
    /// changes of one door within one tick the last wins.
    pub(crate) fn capture_change(&mut self, change: WorldEvent) {
        self.begin_capture(change.tick);
        if matches!(change.change, WorldChange::Close(_) | WorldChange::Open(_)) {
            let (world, name) = (change.world.clone(), change.change.name().to_owned());
            let is_same = |c: &WorldEvent| c.tick == change.tick && c.world == world && c.change.name() == name;
            let first = self.script.changes.iter().position(&is_same).unwrap_or(self.script.changes.len());
            self.check_again_from(first);
            self.script.changes.retain(|c| !is_same(c));
        }
        self.script.changes.push(change);
        self.script.version = Script::version_of(&self.script.changes);
    }

    /// Adds a change after those of its tick. What comes later stays.
    pub(crate) fn add_change(&mut self, change: WorldEvent) {
        let at = self.script.changes.partition_point(|c| c.tick <= change.tick);
        self.check_again_from(at);
        self.script.changes.insert(at, change);
        self.script.version = Script::version_of(&self.script.changes);
    }

    /// Puts an event in place of all that its robot gets from its tick on. What others get stays.
    pub(crate) fn instead(&mut self, event: Event) {
        self.script.events.retain(|e| e.robot != event.robot || e.tick < event.tick);
        self.add(event);
    }

    /// Adds an event after those of its tick. What comes later stays.
    pub(crate) fn add(&mut self, event: Event) {
        self.insert(event.tick, &event.robot, event.input);
    }

    /// Forgets what comes after `tick`, at the first input captured for it.
    fn begin_capture(&mut self, tick: u64) {
        if self.captured != Some(tick) {
            self.truncate_after(tick);
            self.captured = Some(tick);
        }
    }

    /// Captures a live input for the event's tick, which is the next to run. Later events are forgotten.
    ///
    /// - Only changes are recorded: channels that are already held, or a target set again in this tick, add no event.
    /// - Of several changes within one tick the last wins, and a drag keeps its last target.
    /// - A press shorter than a tick lasts one tick: channels pressed and let go within the tick are let go in the
    ///   next.
    pub fn capture(&mut self, event: Event) {
        let Event { tick, robot, input } = event;
        let robot = robot.as_str();
        self.begin_capture(tick);
        let last = self.script.events.iter().rposition(|e| e.robot == robot);
        let last_due = last.filter(|&i| self.script.events[i].tick >= tick);
        let stamp = last_due.map_or(tick, |i| self.script.events[i].tick);
        match (&input, last_due.map(|i| &self.script.events[i].input)) {
            (&RobotInput::Drive(a, b), Some(&RobotInput::Drive(pressed_a, pressed_b))) => {
                let (held_a, held_b) = self.held_before(stamp, robot).unwrap_or_default();
                let tapped = |held, pressed, now| pressed != held && now == held;
                if stamp == tick && (tapped(held_a, pressed_a, a) || tapped(held_b, pressed_b, b)) {
                    self.insert(tick + 1, robot, input);
                } else {
                    self.replace(last_due, input);
                }
            }
            (RobotInput::MoveTo(_), Some(RobotInput::MoveTo(_)))
            | (RobotInput::Teleport(_), Some(RobotInput::Teleport(_)))
            | (RobotInput::SetTrailer(_), Some(RobotInput::SetTrailer(_)))
            | (RobotInput::Release, Some(RobotInput::Release)) => self.replace(last_due, input),
            (&RobotInput::Drive(a, b), _) if self.held_before(stamp + 1, robot) == Some((a, b)) => {}
            _ => self.insert(stamp, robot, input),
        }
    }

    /// The channels that the robot's driver holds before the events of `tick`; `None` when the tour drives.
    fn held_before(&self, tick: u64, robot: &str) -> Option<(i16, i16)> {
        self.script.events.iter().filter(|e| e.robot == robot && e.tick < tick).fold(None, |held, e| match e.input {
            RobotInput::Drive(a, b) => Some((a, b)),
            RobotInput::Release => None,
            _ => held.or(Some((0, 0))),
        })
    }

    fn replace(&mut self, at: Option<usize>, input: RobotInput) {
        if let Some(e) = at.and_then(|i| self.script.events.get_mut(i)) {
            e.input = input;
        }
    }

    fn insert(&mut self, tick: u64, robot: &str, input: RobotInput) {
        let at = self.script.events.partition_point(|e| e.tick <= tick);
        self.script.events.insert(at, Event { tick, robot: robot.to_owned(), input });
    }
}

/// Begins the tick: counts it, and moves the frontier along.
pub(crate) fn advance_tick(mut transport: ResMut<Transport>) {
    transport.tick += 1;
    if transport.tick > transport.frontier {
        transport.frontier = transport.tick;
    }
}

/// Makes the tick's changes of worlds, then applies its inputs, each in the script's order. An input for an unknown
/// robot is dropped; `start_run` has already refused a script with one.
pub(crate) fn apply_inputs(world: &mut World) {
    let tick = world.resource::<Transport>().tick;
    let pending = world.resource::<PendingInput>();
    if pending.due(tick).is_empty() && pending.due_changes(tick).is_empty() {
        return;
    }
    world.resource_scope(|world, pending: Mut<PendingInput>| {
        let is_new = world.resource_mut::<Refusals>().begin(tick);
        let before = world.resource::<RefusedChanges>().0.len();
        change::make(world, pending.due_changes(tick));
        if is_new {
            world.resource_scope(|world, mut refusals: Mut<Refusals>| {
                for refused in world.resource::<RefusedChanges>().0.iter().skip(before) {
                    refusals.note(|| RefusedEvent::Change(refused.clone()));
                }
            });
        }
        for event in pending.due(tick) {
            let Some(robot) = world.resource::<Roster>().named(&event.robot) else { continue };
            let others = |world: &World| {
                let place = world.get::<ResidesIn>(robot).zip(world.get::<RobotId>(robot));
                place.map_or_else(Vec::new, |(inhabited, id)| others_now(world, inhabited.0, *id))
            };
            if let Some(RobotOps { apply, .. }) = world.get::<RobotOps>(robot).copied() {
                let refused = apply(world, robot, &event.input, &others);
                if let Some(reason) = refused.filter(|_| is_new) {
                    let (robot, input) = (event.robot.clone(), event.input.kind());
                    let refused = RefusedInput { tick, robot, input, reason };
                    world.resource_mut::<Refusals>().note(|| RefusedEvent::Input(refused));
                }
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Quantized;

    fn captured(inputs: &[(u64, RobotInput)]) -> Vec<(u64, RobotInput)> {
        let mut pending = PendingInput::default();
        for (tick, input) in inputs {
            pending.capture(Event { tick: *tick, robot: "r".into(), input: input.clone() });
        }
        pending.script().events.iter().map(|e| (e.tick, e.input.clone())).collect()
    }

    #[test]
    fn only_changes_are_recorded_and_the_last_of_a_tick_wins() {
        use RobotInput::{Drive, Release};
        assert_eq!(
            captured(&[(3, Drive(128, 0)), (4, Drive(128, 0)), (9, Drive(0, 0))]),
            [(3, Drive(128, 0)), (9, Drive(0, 0))]
        );
        assert_eq!(captured(&[(3, Drive(128, 0)), (3, Drive(128, 64))]), [(3, Drive(128, 64))]);
        assert_eq!(captured(&[(3, Drive(1, 0)), (4, Release), (5, Drive(1, 0))]).len(), 3);
        let to = |x| RobotInput::MoveTo(vec![Quantized(x), Quantized(0)]);
        assert_eq!(captured(&[(3, to(1)), (3, to(2)), (3, to(3)), (4, to(4))]), [(3, to(3)), (4, to(4))]);
    }

    #[test]
    fn a_press_shorter_than_a_tick_counts_for_one() {
        use RobotInput::Drive;
        let zero = (1, Drive(0, 0));
        // the first zero takes over from the tour; the press and its release come within tick 3
        assert_eq!(
            captured(&[zero.clone(), (3, Drive(128, 0)), (3, Drive(0, 0))]),
            [zero.clone(), (3, Drive(128, 0)), (4, Drive(0, 0))]
        );
        // a second press after it waits for the next tick, where the last wins
        assert_eq!(
            captured(&[zero.clone(), (3, Drive(128, 0)), (3, Drive(0, 0)), (3, Drive(0, 9))]),
            [zero, (3, Drive(128, 0)), (4, Drive(0, 9))]
        );
        // a press that takes over from the tour lasts one tick too: its release waits for the next
        assert_eq!(captured(&[(3, Drive(128, 0)), (3, Drive(0, 0))]), [(3, Drive(128, 0)), (4, Drive(0, 0))]);
    }

    #[test]
    fn the_events_of_a_tick_are_found() {
        let drive = |tick, x| Event { tick, robot: "r".into(), input: RobotInput::Drive(x, 0) };
        let script = Script { events: vec![drive(7, 1), drive(2, 2), drive(7, 3)], ..Script::empty() };
        let mut pending = PendingInput::new(script);
        assert_eq!(pending.due(7), [drive(7, 1), drive(7, 3)]);
        assert_eq!(pending.due(2).len(), 1);
        assert!(pending.due(3).is_empty());
        pending.truncate_after(6);
        assert!(pending.due(7).is_empty());
    }
}
