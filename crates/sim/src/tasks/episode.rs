//! One episode, and what follows its end.

use super::EpisodeEnd;
use crate::run::RobotInput;
use motion_lab_core::random::{Seed, Stream};

/// What follows the end of an episode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Autoreset {
    /// The next step begins a new one, whatever its action: it observes the start and earns nothing.
    #[default]
    NextStep,
    /// The same step begins a new one: it observes its start, and what was observed at the end is handed out apart.
    SameStep,
    /// Nothing: it has to be begun anew.
    Disabled,
}

/// An episode under way.
#[derive(Clone, Debug)]
pub(super) struct Episode<G, C> {
    /// The seed of all its episodes.
    pub(super) own: Seed,
    /// Its number, from 0.
    pub(super) number: u64,
    /// The seed of its run.
    pub(super) seed: Seed,
    pub(super) goal: G,
    /// The robot's inputs with their ticks: the script of its run.
    pub(super) inputs: Vec<(u64, RobotInput)>,
    /// The configuration one tick before.
    pub(super) before: C,
    pub(super) end: Option<EpisodeEnd>,
}

impl<G, C> Episode<G, C> {
    /// Adds an input that applies at a tick. Returns false, and adds none, where the robot holds these channels
    /// already.
    pub(super) fn add_input(&mut self, tick: u64, input: &RobotInput) -> bool {
        let is_held =
            matches!(input, RobotInput::Drive(..)) && self.inputs.last().is_some_and(|(_, last)| last == input);
        if !is_held {
            self.inputs.push((tick, input.clone()));
        }
        !is_held
    }
}

/// The seed of an episode's run: number `number` of those of a seed.
pub(super) fn seed_of(own: Seed, number: u64) -> Seed {
    Seed(Stream::new(own, "episodes").at(number).bits())
}
