//! `LatestFrame`, the frame of the last tick.

use bevy::prelude::*;

use crate::run::Frame;

/// The frame of the last tick.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct LatestFrame(pub Frame);

impl Default for LatestFrame {
    fn default() -> Self {
        LatestFrame(Frame { tick: 0, robots: Vec::new(), scans: Vec::new(), obstacles: Vec::new() })
    }
}
