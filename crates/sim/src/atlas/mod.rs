//! The atlas as values: labelled worlds, teleports of their robots, grids beside the exact distance, and an editor.

mod editor;
mod grid_layer;
mod labels;
mod overlay;
mod shown;
mod taken;
mod target;
mod teleport;

pub use editor::{EditError, EditShape, Editor, Handle, Number, Op, Template, snap};
pub use grid_layer::{GridLayer, Probe};
pub use labels::{LabelledThing, named, named_with, names};
pub use shown::{Atlas, AtlasRobot};
pub use teleport::{Teleport, TeleportRefusal};
