//! The configuration space in the window.

pub(crate) mod chart;
pub(crate) mod linked;
mod linked_state;
pub(crate) mod put_at;
mod state;
mod torus;
mod trail;
pub(crate) mod view;

pub use linked_state::LinkedState;
pub use state::CspaceState;
pub use trail::TRAIL;
