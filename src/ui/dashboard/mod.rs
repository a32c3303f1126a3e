//! The dashboard: its values, and the parts that it is painted of.

pub mod arm;
pub(crate) mod blend;
#[cfg(feature = "screen")]
pub(crate) mod drive;
pub(crate) mod goal;
#[cfg(feature = "screen")]
pub(crate) mod handles;
#[cfg(feature = "screen")]
pub(crate) mod pad;
#[cfg(feature = "screen")]
pub(crate) mod pane;
#[cfg(feature = "screen")]
pub(crate) mod plots;
#[cfg(all(test, feature = "screen"))]
mod tests;
#[cfg(feature = "screen")]
pub(crate) mod time_line;
#[cfg(feature = "screen")]
pub(crate) mod transport_bar;
pub(crate) mod values;
#[cfg(feature = "screen")]
pub(crate) mod view;
