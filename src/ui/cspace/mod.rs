//! The configuration space in the window.

pub(crate) mod view;

pub use view::CspaceState;
