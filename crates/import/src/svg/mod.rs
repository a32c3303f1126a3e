//! SVG drawings: counted, checked, reduced to what their obstacles depend on, then read.

pub(crate) mod check;
pub(crate) mod clean;
pub(crate) mod css;
pub(crate) mod curves;
pub(crate) mod read;
pub(crate) mod scan;
