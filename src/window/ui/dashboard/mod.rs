//! The dashboard: the values that it shows, and the views that paint them.

pub(crate) mod blend;
pub(crate) mod doors;
pub(crate) mod goal;
pub(crate) mod hand;
pub(crate) mod in_hand;
pub(crate) mod pane;
pub(crate) mod plots;
pub(crate) mod stage;
#[cfg(test)]
mod tests;
pub(crate) mod twin_state;
pub(crate) mod twins;
pub(crate) mod values;
pub(crate) mod view;
pub(crate) mod words;
