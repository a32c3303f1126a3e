//! The state of the user interface.

mod focus;
mod hand;
mod pointer;
mod screen;
mod ui_state;
mod words;

pub use focus::Grasp;
pub use ui_state::{Interface, UiState};
pub use words::{Closing, Notice, Offer, SeedDraft, Working};
