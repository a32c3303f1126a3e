//! What cuts what a drawing paints: clip paths, shapes of style sheets and masks, and the regions they leave.

pub(crate) mod basic_shapes;
pub(crate) mod clip_paths;
pub(crate) mod clips;
pub(crate) mod masks;
