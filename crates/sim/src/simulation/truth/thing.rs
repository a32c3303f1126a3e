//! `RunThing`, what an entity is in the run.

use bevy::prelude::*;

/// What an entity is in the run, by its numbers. Only the simulation can name it, so an entity that has it, and that
/// the run's rosters name under the same number, is the run's own.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[component(immutable, clone_behavior = Ignore)]
pub(crate) enum RunThing {
    World(usize),
    Robot(usize),
    /// By its world's number and its own.
    Obstacle(usize, usize),
    Sensor(usize),
}
