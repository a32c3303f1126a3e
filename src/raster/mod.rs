//! Captures as files: SVG, PNG and GIF. Pixels are painted out of our own SVG, without a display.

mod few_colours;
mod painter;
mod write;

pub use painter::{GifWriter, Image, Raster, Size, write_png};
pub use write::{film, film_with_robots, paint, slides, write};
