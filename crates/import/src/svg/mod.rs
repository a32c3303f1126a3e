//! SVG drawings: counted, checked, then read.

pub(crate) mod check;
pub(crate) mod clip_paths;
pub(crate) mod clips;
pub(crate) mod css;
pub(crate) mod lengths;
pub(crate) mod obstacles;
pub(crate) mod paint;
pub(crate) mod read;
pub(crate) mod scan;
pub(crate) mod shapes;
pub(crate) mod style;
pub(crate) mod transforms;
pub(crate) mod uses;
pub(crate) mod viewport;
pub(crate) mod walk;
