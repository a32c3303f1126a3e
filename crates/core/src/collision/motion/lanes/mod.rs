//! Eight intervals of a motion at once, in single precision: sure answers, which the ladder would give too.

pub(crate) mod angles;
pub(crate) mod gaps;
pub(crate) mod outlines;
pub(crate) mod rung;
pub(crate) mod swept_part;
#[cfg(test)]
mod tests;
