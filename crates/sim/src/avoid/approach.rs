//! `Approach`, the run up to a contact and to its end.

use std::collections::VecDeque;

use super::simulated_again::{AddKinds, alone, recorder, without_sensors};
use super::{AvoidError, ContactEpisode};
use crate::recording::Recorder;
use crate::run::{Frame, Recipe};

/// The run up to a contact and to its end, tick by tick.
pub(super) struct Approach {
    /// What is run: the robot's world alone, without sensors.
    pub(super) recipe: Recipe,
    pub(super) add: Option<AddKinds>,
    /// The robot's number among those of the run.
    pub(super) id: usize,
    pub(super) run: Recorder,
    /// The frames before the contact that are kept, and its first.
    pub(super) frames: VecDeque<Frame>,
    /// The first tick that is kept.
    kept_from: u64,
    robot: String,
    first: u64,
    episode: Option<ContactEpisode>,
}

impl Approach {
    /// The run of a recipe up to a contact of a robot that begins at `first`; the last `back` ticks before it are kept.
    pub(super) fn new(
        recipe: &Recipe,
        (robot, first): (&str, u64),
        back: u64,
        add: Option<AddKinds>,
    ) -> Result<Self, AvoidError> {
        let none = || AvoidError::NoContact { robot: robot.to_owned(), tick: first };
        let lives_in = recipe.config.worlds.iter().find(|world| world.robots.iter().any(|r| r.name == robot));
        let world = lives_in.ok_or_else(none)?.name.clone();
        let recipe = alone(without_sensors(recipe), &world);
        let id = recipe.config.robot_names().position(|name| name == robot).ok_or_else(none)?;
        if first == 0 || first > recipe.config.ticks {
            return Err(none());
        }
        let run = recorder(&recipe, add.as_ref())?;
        // a branch from a tick begins after the frame before it; a robot's speed takes two frames
        let kept_from = first.saturating_sub(std::cmp::max(back + 1, 2));
        let frames = if kept_from == 0 { VecDeque::from([run.frame().clone()]) } else { VecDeque::new() };
        Ok(Approach { recipe, add, id, run, frames, kept_from, robot: robot.to_owned(), first, episode: None })
    }

    /// Runs the next tick. Returns the contact when it has ended, or the run.
    pub(super) fn step(&mut self) -> Result<Option<ContactEpisode>, AvoidError> {
        let frame = self.run.step();
        let (tick, touches) = (frame.tick, frame.robots[self.id].in_contact);
        if (self.kept_from..=self.first).contains(&tick) {
            self.frames.push_back(frame.clone());
        }
        if tick < self.first {
            return Ok(None);
        }
        if tick == self.first {
            self.episode = Some(self.begun()?);
        }
        let is_last = tick >= self.recipe.config.ticks;
        if touches && !is_last {
            return Ok(None);
        }
        Ok(self.episode.take().map(|episode| ContactEpisode { ended: (!touches).then_some(tick), ..episode }))
    }

    /// The contact that begins in the tick at which the run stands.
    fn begun(&self) -> Result<ContactEpisode, AvoidError> {
        let before = self.frames.iter().rev().nth(1);
        let touches = |frame: &Frame| frame.robots[self.id].in_contact;
        if !touches(self.run.frame()) || before.is_none_or(touches) {
            return Err(AvoidError::NoContact { robot: self.robot.clone(), tick: self.first });
        }
        Ok(ContactEpisode::begun(&self.run, self.id))
    }
}
