//! `AnatomyState`, what the anatomy remembers.

use std::sync::Arc;

use crate::anatomy::Anatomy;
use crate::picture::Picture;

/// What the widget remembers.
#[derive(Clone, Debug)]
pub struct AnatomyState {
    /// The scene, the robot, the question.
    pub anatomy: Anatomy,
    /// The scene as it is drawn; made anew when the world changes.
    pub(super) backdrop: Arc<Picture>,
    /// What was guessed, by prompt.
    pub(super) guesses: [String; 2],
    /// What the guesses came to.
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
    /// The world alone, as it is drawn.
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
