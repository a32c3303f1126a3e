//! `InputKind`, the kinds of inputs that a script gives to robots.

use std::fmt;

/// A kind of input that a script gives to a robot. [`RobotKind::takes`](super::RobotKind::takes) says which robots of a
/// kind take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum InputKind {
    /// Hold control channels.
    Drive,
    /// Go to coordinates by the end of the tick.
    MoveTo,
    /// Be put at coordinates.
    Teleport,
    /// Attach or detach the trailer.
    SetTrailer,
    /// Back to the tour.
    Release,
}

impl InputKind {
    /// Every kind, in the order of their declaration.
    pub const ALL: [InputKind; 5] =
        [InputKind::Drive, InputKind::MoveTo, InputKind::Teleport, InputKind::SetTrailer, InputKind::Release];

    /// Its name, as scripts write it.
    pub const fn name(self) -> &'static str {
        match self {
            InputKind::Drive => "Drive",
            InputKind::MoveTo => "MoveTo",
            InputKind::Teleport => "Teleport",
            InputKind::SetTrailer => "SetTrailer",
            InputKind::Release => "Release",
        }
    }

    /// Some kinds as a sentence names them.
    ///
    /// ```
    /// use motion_lab_core::configuration::{InputKind, RobotKind};
    /// assert_eq!(InputKind::listed(RobotKind::REACH.takes), "MoveTo, Teleport and Release");
    /// assert_eq!(InputKind::listed(&[InputKind::Drive]), "Drive");
    /// assert_eq!(InputKind::listed(&[]), "nothing");
    /// ```
    pub fn listed(kinds: &[InputKind]) -> String {
        let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
        match &names[..] {
            [] => "nothing".into(),
            [one] => (*one).into(),
            [first @ .., last] => format!("{} and {last}", first.join(", ")),
        }
    }
}

impl fmt::Display for InputKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
