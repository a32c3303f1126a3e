//! What people see and touch. Colours are known to [`Theme`] alone; what needs a window stands behind the feature `window`.

mod blend;
mod readout;
mod theme;

pub use blend::{blend, heading};
pub use readout::{readout, readout_lines};
pub use theme::Theme;
