//! `Transport`, the tick and playback of a run, and the commands that move it.

use bevy::prelude::*;

use motion_lab_core::random::{Seed, Stream};

/// Whether ticks follow one another by themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Playback {
    /// The fixed loop runs the simulation.
    Playing,
    /// The fixed loop does not run the simulation.
    #[default]
    Paused,
}

/// The tick at which the run stands, and how it plays. Whoever shows the run may write how it plays; seed, tick and
/// frontier are the simulation's, and change by a [`TransportCommand`].
#[derive(Resource, Debug, PartialEq)]
pub struct Transport {
    pub(crate) seed: Seed,
    pub(crate) tick: u64,
    /// Whether it plays.
    pub playback: Playback,
    /// Simulated seconds per second of the clock, above 0; infinite for as fast as possible.
    pub speed: f64,
    /// Whether playing begins anew at tick 0 when it has come to the frontier.
    pub looping: bool,
    pub(crate) frontier: u64,
}

impl Transport {
    /// The run's seed.
    pub fn seed(&self) -> Seed {
        self.seed
    }

    /// The last tick done; 0 at the start.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// The last tick that this run has reached, even if it was taken back since.
    pub fn frontier(&self) -> u64 {
        self.frontier
    }

    /// The start of a run, paused, at normal speed.
    pub(crate) fn new(seed: Seed) -> Self {
        Transport { seed, tick: 0, playback: Playback::Paused, speed: 1.0, looping: false, frontier: 0 }
    }
}

/// A command of the transport. None of them is part of a run's script.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TransportCommand {
    /// Let ticks follow one another.
    Play,
    /// Stop after the tick under way.
    Pause,
    /// Pause, and run one tick.
    Step,
    /// Pause, and go back by one tick.
    StepBack,
    /// Go to any tick of this run; playback stays. Beyond the frontier the run is simulated up to there.
    Seek(u64),
    /// Forget all input after the present tick, and end looping: the run goes on from here.
    ContinueFromHere,
    /// Start a new run with the same seed and no input.
    Reset,
    /// Start a new run with a seed drawn from the present one.
    ReRoll,
    /// Start a new run with this seed and no input.
    SetSeed(Seed),
    /// Set the simulated seconds per second of the clock, from 1/64 to 64, or infinity for as fast as possible.
    /// Anything else is ignored.
    SetSpeed(f64),
    /// Set whether playing repeats the run up to its frontier. Input ends looping, and the run goes on.
    SetLooping(bool),
    /// Set a checkpoint before a change of the run's input: what follows, up to the next checkpoint, is undone as one.
    Checkpoint,
    /// Go back to the input and the tick of the last checkpoint that a change followed, and pause.
    Undo,
    /// Reverse the last undo.
    Redo,
}

/// The seed after a re-roll: at most six digits, so that it is easily typed.
pub fn re_rolled(seed: Seed) -> Seed {
    let drawn = Stream::new(seed, "re-roll").below(999_999);
    // leave the present seed out
    Seed(if drawn >= seed.0 { drawn + 1 } else { drawn })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_re_roll_is_another_short_seed() {
        for seed in (0..2000).chain([u64::MAX, 999_999]) {
            let next = re_rolled(Seed(seed));
            assert!(next != Seed(seed) && next.0 <= 999_999);
            assert_eq!(next, re_rolled(Seed(seed)));
            // what is drawn is its rank among the numbers of six digits but the present one
            let drawn = Stream::new(Seed(seed), "re-roll").below(999_999);
            assert_eq!(next.0 - u64::from(seed < next.0), drawn, "after {seed}");
        }
    }
}
