//! `Editor`, which changes a world step by step, with undo.

mod edit;
mod error;
mod numbers;
mod op;
mod order;
mod outline;
mod residents;
mod template;
mod thing;

pub use edit::{Editor, snap};
pub use error::EditError;
pub use numbers::Number;
pub use op::Op;
pub use outline::{EditShape, Handle};
pub use template::Template;
