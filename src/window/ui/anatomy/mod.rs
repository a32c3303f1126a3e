//! Query anatomy in the window.

pub(super) mod in_front;
mod state;
pub(crate) mod view;

pub use state::AnatomyState;
