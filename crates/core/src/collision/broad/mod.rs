//! The broad phase: which pieces of a scene can matter to a query. It prunes and decides nothing.

pub(crate) mod frames;
pub(crate) mod grid;
pub(crate) mod index;
pub(crate) mod linear;
