//! `Branches`, the run from any of its ticks on with other inputs of one robot.

use std::collections::VecDeque;

use super::approach::Approach;
use super::simulated_again::recorder;
use super::{AvoidError, ContactEpisode};
use crate::recording::{Recorder, RunError};
use crate::run::{Event, Frame, Recipe, RobotInput, RobotState, Script};

/// The run up to a contact, and a second one that branches from its ticks.
pub(super) struct Branches {
    pub(super) episode: ContactEpisode,
    /// The robot's number among those of the run.
    id: usize,
    /// The run as it was, at the contact's end.
    pub(super) run: Recorder,
    /// Its frames before the contact, and the first in contact.
    frames: VecDeque<Frame>,
    /// The run that branches. Its script has nothing for the robot.
    branch: Recorder,
    /// The number of ticks of all branches.
    pub(super) ticks: u64,
}

impl Branches {
    /// The branches from the ticks before a contact, up to this many ticks after it.
    pub(super) fn new(approach: Approach, episode: ContactEpisode, horizon: u64) -> Result<Self, AvoidError> {
        let Approach { recipe, add, id, run, frames, .. } = approach;
        let earliest = frames.front().map_or(0, |frame| frame.tick);
        // a branch needs the events of others in its own ticks alone, and all changes
        let Script { mut events, changes, .. } = recipe.script;
        let ticks = earliest..=episode.first + horizon;
        events.retain(|event: &Event| event.robot != episode.robot && ticks.contains(&event.tick));
        let recipe = Recipe { script: Script::new(events, changes), ..recipe };
        let branch = recorder(&recipe, add.as_ref())?.without_keyframes();
        Ok(Branches { episode, id, run, frames, branch, ticks: 0 })
    }

    /// The frame of a tick before the contact, or of its first.
    pub(super) fn frame(&self, tick: u64) -> Option<&Frame> {
        let first = self.frames.front()?.tick;
        self.frames.get(usize::try_from(tick.checked_sub(first)?).ok()?)
    }

    /// The robot's state in a frame.
    pub(super) fn state<'a>(&self, frame: &'a Frame) -> &'a RobotState {
        &frame.robots[self.id]
    }

    /// The ticks from which a way out is sought, the last first, at most this many before the contact's: those before
    /// which the robot is free, up to the contact.
    pub(super) fn ticks_back(&self, back: u64) -> VecDeque<u64> {
        let is_free = |tick: &u64| {
            let before = tick.checked_sub(1).and_then(|before| self.frame(before));
            before.is_some_and(|frame| !self.state(frame).in_contact)
        };
        (0..=back).map_while(|ago| self.episode.first.checked_sub(ago)).take_while(is_free).collect()
    }

    /// Begins a branch after a frame of the run, or of another branch.
    pub(super) fn begin(&mut self, frame: &Frame) -> Result<(), RunError> {
        self.branch.restore(frame)
    }

    /// Gives the robot an input at the branch's next tick, in place of those that it got in branches before.
    pub(super) fn input(&mut self, input: RobotInput) {
        self.branch.input_instead(&self.episode.robot, input);
    }

    /// Runs a tick of the branch, and returns its frame and the robot's state in it.
    pub(super) fn step(&mut self) -> (&Frame, &RobotState) {
        self.ticks += 1;
        let frame = self.branch.step();
        (frame, &frame.robots[self.id])
    }

    /// Whether the robot takes an input at the contact's tick that its configuration before gives.
    pub(super) fn takes(&mut self, input: impl Fn(&[f64]) -> Option<RobotInput>) -> Result<bool, AvoidError> {
        let Some(frame) = self.frame(self.episode.first - 1).cloned() else { return Ok(false) };
        let state = self.state(&frame);
        let (before, Some(input)) = (state.refusals, input(&state.configuration)) else { return Ok(false) };
        self.begin(&frame)?;
        self.input(input);
        Ok(self.step().1.refusals == before)
    }
}
