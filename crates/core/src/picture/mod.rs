//! Pictures: drawings in metres and roles, drawn once and shown by every medium.
//!
//! A [`Picture`] says what is where and what it stands for; it knows neither pixels nor colours. A [`Fit`] places it
//! on a sheet, [`resolve()`] turns its items into lines and areas in pixels, still by [`Role`], and a medium gives the
//! roles their colours: the SVG writer ([`Figure::svg`]) from a [`Palette`], the window from its theme. Both draw the
//! same strokes.

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
pub use world::{door_id, places, world};

use crate::geometry::Aabb;

/// A drawing in metres: items in painting order, the first below all others.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// What it shows, in a few words.
    pub name: String,
    /// The part of the plane it shows, metres.
    pub bounds: Aabb,
    /// Whether its plane is in metres, so that a scale bar applies. Otherwise its axes give the units.
    pub in_metres: bool,
    /// The items, lowest first. Their ids are unique.
    pub items: Vec<Item>,
}

impl Picture {
    /// Creates a picture without items, in metres.
    pub fn new(name: impl Into<String>, bounds: Aabb) -> Self {
        Picture { name: name.into(), bounds, in_metres: true, items: Vec::new() }
    }

    /// Returns the picture with these items painted over those already there.
    #[must_use]
    pub fn with(mut self, items: impl IntoIterator<Item = Item>) -> Self {
        self.items.extend(items);
        self
    }
}
