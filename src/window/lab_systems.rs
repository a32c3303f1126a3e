//! `LabSystems`, the moments of a frame.

use bevy::prelude::*;

/// The lab's systems of a frame, for a program that adds its own.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LabSystems {
    /// Reads the run for the widgets, in [`Update`].
    Read,
    /// Lays out the widgets, in [`EguiPrimaryContextPass`](bevy_egui::EguiPrimaryContextPass).
    LayOut,
}
