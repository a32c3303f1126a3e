//! `FocusState`, who has the keys.

/// Who has the keys: a handle, a field, a paper, a dialog.
#[derive(Clone, Debug, Default)]
pub struct FocusState {
    /// The arm whose handle had the focus in the last frame. Such a handle keeps the arrow keys and no others.
    pub nudged: Option<String>,
    /// Whether text was typed in the last frame: a field had the focus as it ended.
    pub typing: bool,
    /// Whether the atlas's paper had the focus in the last frame. It leaves the keys to the atlas.
    pub paper: bool,
    /// A change of which handle has the focus, for this frame.
    pub grasp: Option<Grasp>,
    /// The same, for the next frame.
    pub next_grasp: Option<Grasp>,
    /// Whether a dialog for a file is open: all keys are the dialog's.
    pub dialog: bool,
}

/// A change of which handle has the focus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Grasp {
    /// The first handle of the arm with this name takes it.
    Take(String),
    Leave,
}
