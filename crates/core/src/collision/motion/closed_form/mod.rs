//! Closed forms: discs on lines and arcs, and parts that move without turning.

pub(crate) mod disc_line;
pub(crate) mod first_contact;
pub(crate) mod time_of_impact;
pub(crate) mod verdicts;
