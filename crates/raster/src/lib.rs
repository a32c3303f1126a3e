//! Pictures as pixels: our own SVG painted without a display, with the lab's fonts, and written as PNG and GIF.
#![deny(missing_docs)]
#![forbid(unsafe_code)]

mod error;
mod few_colours;
mod files;
mod painter;

pub use error::RasterError;
pub use files::{GifWriter, write_png};
pub use painter::{Image, Raster, Size};
