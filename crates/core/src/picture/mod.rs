//! Pictures: drawings in metres and roles, drawn once and shown by every medium.
//!
//! A [`Picture`] says what is where and what it stands for; it knows neither pixels nor colours. A [`Fit`] places it
//! on a sheet, [`resolve()`] turns its items into lines and areas in pixels, still by [`Role`], and a medium gives the
//! roles their colours: the SVG writer ([`Figure::svg`]) from a [`Palette`], the window from its theme. Both draw the
//! same strokes.

mod drawn;
mod faces;
mod figure;
mod fit;
mod hatch;
mod item;
mod outline;
mod pick;
mod readout;
mod resolve;
mod robot;
mod role;
mod svg;
mod theme;
mod world;

pub use drawn::Picture;
pub use faces::FACES;
pub use figure::{Figure, Panel, Sheet};
pub use fit::{Fit, ScaleBar, ScreenPoint, ScreenRect};
pub use item::{Anchor, Dash, Drawing, Face, Fill, Glyph, Item, Line};
pub use outline::{chains, outline, polygon_of};
pub use pick::pick;
#[doc(hidden)]
pub use readout::true_minus;
pub use readout::{in_signs, readout, readout_lines};
pub use resolve::{Primitive, resolve};
pub use robot::{Gait, RobotDrawing, ScanDrawing, fan_scan, footprint, robot, scan, scan_id, trace};
#[doc(hidden)]
pub use robot::{chevron, nose};
pub use role::{Palette, Rgb, Role};
pub use theme::Theme;
pub use world::{Thing, places, world};
