//! A crowd: a world of many robots. Its robots are drawn as one mesh, and one of them is picked at a time.

pub(crate) mod heat;
pub(crate) mod list;
pub(crate) mod members;
pub(crate) mod pane;
pub(crate) mod robots;
pub(crate) mod state;
#[cfg(test)]
mod tests;
pub(crate) mod values;
