//! The atlas as values: labelled worlds, teleports of their robots, grids beside the exact distance, and an editor.

mod edit;
mod edit_error;
mod grid_layer;
mod labels;
mod numbers;
mod op;
mod order;
mod outline;
mod overlay;
mod residents;
mod shown;
mod taken;
mod target;
mod teleport;
mod template;

pub use edit::{Editor, snap};
pub use edit_error::EditError;
pub use grid_layer::{GridLayer, Probe};
pub use labels::{LabelledThing, named, named_with, names};
pub use numbers::Number;
pub use op::Op;
pub use outline::{EditShape, Handle};
pub use shown::{Atlas, AtlasRobot};
pub use teleport::{Teleport, TeleportRefusal};
pub use template::Template;
