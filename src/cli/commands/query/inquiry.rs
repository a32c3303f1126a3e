//! `Inquiry`, a question that can be asked about any robot in a scene.

use motion_lab::collision::Checker;

use super::Question;
use super::answer::{Answer, ask};
use super::dimensions::Measured;

/// A question that can be asked about any robot in a scene.
pub trait Inquiry {
    /// The type of its answer.
    type Answer;

    /// The answer about the robot at `q`, moving to `to` where the inquiry is about a motion. The error says what is
    /// wrong with `q` or `to`.
    fn ask<R: Measured>(
        &self,
        checker: &Checker<R>,
        q: &R::Configuration,
        to: Option<&R::Configuration>,
    ) -> Result<Self::Answer, String>;
}

impl Inquiry for Question {
    type Answer = Answer;

    fn ask<R: Measured>(
        &self,
        checker: &Checker<R>,
        q: &R::Configuration,
        to: Option<&R::Configuration>,
    ) -> Result<Answer, String> {
        ask(checker, *self, q, to)
    }
}
