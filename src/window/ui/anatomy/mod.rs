//! Query anatomy in the window.

mod state;
pub(crate) mod view;

pub use state::AnatomyState;
