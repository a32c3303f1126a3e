//! `AnatomyState`, the state of the query anatomy.

use std::sync::Arc;

use crate::anatomy::Anatomy;
use crate::picture::Picture;

/// The state of the query anatomy.
#[derive(Clone, Debug)]
pub struct AnatomyState {
    /// The scene, the robot, the question.
    pub anatomy: Anatomy,
    /// The picture of the world alone, made again when the world changes.
    pub(super) backdrop: Arc<Picture>,
    /// The guesses as typed, by prompt.
    pub(super) guesses: [String; 2],
    /// The answers to the guesses, by prompt.
    pub(super) answers: [Option<String>; 2],
}

impl Default for AnatomyState {
    fn default() -> Self {
        let anatomy = Anatomy::default();
        let backdrop = Arc::new(anatomy.backdrop());
        AnatomyState { anatomy, backdrop, guesses: Default::default(), answers: Default::default() }
    }
}

impl AnatomyState {
    /// The picture of the world alone.
    pub fn backdrop(&self) -> &Arc<Picture> {
        &self.backdrop
    }

    /// Puts another scene in front.
    pub fn set(&mut self, anatomy: Anatomy) {
        if anatomy.world() != self.anatomy.world() {
            self.backdrop = Arc::new(anatomy.backdrop());
        }
        self.anatomy = anatomy;
    }
}
