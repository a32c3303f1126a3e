//! SVG drawings: counted, checked, then read.

pub(crate) mod boxes;
pub(crate) mod check;
pub(crate) mod css;
pub(crate) mod cuts;
pub(crate) mod lengths;
pub(crate) mod measured;
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
