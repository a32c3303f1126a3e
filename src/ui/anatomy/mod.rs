//! Query anatomy in the window.

pub(crate) mod view;

pub use view::AnatomyState;
