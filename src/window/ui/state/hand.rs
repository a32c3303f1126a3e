//! `HandState`, the robot in hand.

use bevy_egui::egui::Rect;

use crate::window::ui::HeldTow;

/// The robot in hand, and what drives it.
#[derive(Clone, Debug, Default)]
pub struct HandState {
    /// The name of the robot that the arrow keys drive.
    pub armed: Option<String>,
    /// The name of the robot that was taken in hand last.
    pub last_held: Option<String>,
    /// The channels last sent to the robot in hand, from -128 to 128, the maximum.
    pub held: (i16, i16),
    /// The channels of the pad on the screen, from -128 to 128, the maximum.
    pub pad: (i16, i16),
    /// The robot that the pointer tows.
    pub tow: Option<HeldTow>,
    /// Where the pad is in this frame, if it has a place off the paper.
    pub pad_place: Option<Rect>,
    /// The channels of a gamepad's stick, from -128 to 128, the maximum.
    pub stick: (i16, i16),
}
