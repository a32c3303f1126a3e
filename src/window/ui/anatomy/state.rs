//! `AnatomyState`, the state of the query anatomy.

use std::sync::Arc;

use motion_lab_core::picture::Picture;
use motion_lab_sim::anatomy::Anatomy;

/// How far a series of prompts has come.
#[derive(Clone, Debug, Default)]
pub struct Guesses {
    /// The number of the prompt that is shown, from 0.
    pub(super) number: usize,
    pub(super) typed: String,
    /// What came of the last guess, in words.
    pub(super) said: Option<String>,
    /// Whether the answer is known.
    pub(super) is_answered: bool,
}

/// The state of the query anatomy.
#[derive(Clone, Debug)]
pub struct AnatomyState {
    /// The scene, the robot, the question.
    pub anatomy: Anatomy,
    /// The picture of the world alone, made again when the world changes.
    pub(super) backdrop: Arc<Picture>,
    /// How far each series of prompts has come.
    pub(super) guesses: [Guesses; 2],
    /// The scene at the press of a pointer that is still down.
    pub(in crate::window::ui) pressed: Option<Anatomy>,
}

impl Default for AnatomyState {
    fn default() -> Self {
        let anatomy = Anatomy::default();
        let backdrop = Arc::new(anatomy.backdrop());
        AnatomyState { anatomy, backdrop, guesses: Default::default(), pressed: None }
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
