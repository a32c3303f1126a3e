//! The configuration space in the window.

mod cells;
pub(crate) mod linked;
mod state;
pub(crate) mod view;

pub use linked::LinkedState;
pub use state::CspaceState;
