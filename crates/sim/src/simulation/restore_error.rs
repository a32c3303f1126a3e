//! `RestoreError`, why a frame cannot be restored.

/// Why a frame cannot be restored in this run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The frame has other robots than the run.
    #[error("the frame of tick {tick} has {found} robots, the run has {expected}")]
    Robots {
        /// The frame's tick.
        tick: u64,
        /// The robots in the frame.
        found: usize,
        /// The robots in the run.
        expected: usize,
    },
    /// A robot's state does not fit the robot with its id.
    #[error("the frame of tick {tick} has a state for robot {id} that does not fit it")]
    Robot {
        /// The frame's tick.
        tick: u64,
        /// The robot's id.
        id: u32,
    },
    /// An obstacle that the run does not have.
    #[error("the frame of tick {tick} has obstacle {obstacle} of world {world}, which the run does not have")]
    Obstacle {
        /// The frame's tick.
        tick: u64,
        /// The world's number.
        world: u32,
        /// The obstacle's number.
        obstacle: u32,
    },
}
