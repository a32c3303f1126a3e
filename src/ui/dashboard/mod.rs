//! The dashboard: the values that it shows, and the views that paint them.

pub mod arm;
pub(crate) mod blend;
#[cfg(feature = "screen")]
pub(crate) mod doors;
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
// two attributes, because the lints recognise only a bare `cfg(test)`
#[cfg(test)]
#[cfg(feature = "screen")]
mod tests;
#[cfg(feature = "screen")]
pub(crate) mod time_line;
#[cfg(feature = "screen")]
pub(crate) mod transport_bar;
pub(crate) mod values;
#[cfg(feature = "screen")]
pub(crate) mod view;
