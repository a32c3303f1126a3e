//! `Feature`, what a generated run may have.

use motion_lab_core::random::{Seed, Stream};

/// Something that a generated run has or has not, by its seed: a swarm of runs, in which a feature is often met without
/// those that would hide its faults (Groce and others, Swarm Testing, 2012).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Feature {
    /// Rovers and cars are driven.
    Drives,
    /// Arms are moved to joint angles.
    Moves,
    /// Robots are put elsewhere.
    Teleports,
    /// Cars get and lose trailers.
    Trailers,
    /// Robots go back to their tours.
    Releases,
    /// Doors open and close.
    Doors,
    /// Obstacles are added.
    Additions,
    /// Obstacles are taken away.
    Removals,
    /// Obstacles are moved.
    Displacements,
    /// The run gives its rovers a range sensor.
    RunSensor,
    /// Robots have range sensors of their own.
    OwnSensors,
    /// Range sensors misread.
    Noise,
    /// Many robots share a world.
    Crowd,
    /// Robots have sizes of their own.
    Sizes,
    /// Cars have a jackknife limit.
    Jackknife,
    /// One of the worlds is a warehouse, with robots on routes.
    Routes,
}

impl Feature {
    /// All features.
    pub const ALL: [Feature; 16] = [
        Feature::Drives,
        Feature::Moves,
        Feature::Teleports,
        Feature::Trailers,
        Feature::Releases,
        Feature::Doors,
        Feature::Additions,
        Feature::Removals,
        Feature::Displacements,
        Feature::RunSensor,
        Feature::OwnSensors,
        Feature::Noise,
        Feature::Crowd,
        Feature::Sizes,
        Feature::Jackknife,
        Feature::Routes,
    ];

    /// The features of a seed's run: each with probability 1/2.
    pub fn of_seed(seed: Seed) -> Vec<Feature> {
        let mut draws = Stream::new(seed, "determinism/features");
        Feature::ALL.into_iter().filter(|_| draws.below(2) == 0).collect()
    }
}
