//! What the lab says and asks beside its widgets.

use motion_lab_core::random::Seed;

/// A message to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// The words.
    pub text: String,
    /// Whether it reports an error.
    pub is_error: bool,
}

/// Work in the background.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Working {
    /// Its progress, in words.
    pub text: String,
    /// Whether it was asked to stop.
    pub stop: bool,
}

/// How far closing the window has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closing {
    /// The window is to close, and edits would be lost: the question is shown.
    Asking,
    Agreed,
}

/// A run that a window before left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// Which run it is, in words.
    pub text: String,
    /// Whether the reader wants it back; `None` before they say.
    pub answer: Option<bool>,
}

/// Text typed into the seed's field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SeedDraft {
    /// The text.
    pub text: String,
    /// The run's seed while it was typed. A draft for another seed is dropped.
    pub of: Seed,
    /// The ticks that the run had while it was typed. For a run of fewer, which began since, it is dropped.
    pub frontier: u64,
    /// Whether it was entered and is no seed.
    pub is_refused: bool,
}

/// A robot's contact flash, as shown on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flash {
    /// Whether the robot is shown red.
    pub red: bool,
    /// Time of the last change, seconds of the window's clock.
    pub since: f64,
}
