//! `LatestFrame`, the frame of the last tick.

use bevy::prelude::*;

use crate::run::{Frame, ObstacleStates};

/// The frame of the last tick. It is the simulation's: nobody else makes one or writes one.
#[derive(Resource, Debug, PartialEq)]
pub struct LatestFrame(pub(crate) Frame);

impl LatestFrame {
    /// The frame.
    pub fn frame(&self) -> &Frame {
        &self.0
    }

    /// The frame of no run: tick 0 without robots.
    pub(crate) fn of_no_run() -> Self {
        LatestFrame(Frame { tick: 0, robots: Vec::new(), scans: Vec::new(), obstacles: ObstacleStates::new() })
    }
}
