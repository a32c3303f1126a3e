//! Query anatomy in the window.

pub(super) mod in_front;
mod loupe;
mod state;
pub(crate) mod view;

pub use state::AnatomyState;
