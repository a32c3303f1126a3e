//! `Raster`, which paints our own SVG without a display.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::RasterError;
use motion_lab_core::picture::{FACES, Rgb};

/// Paints SVG at a fixed size, with the window's fonts.
pub struct Raster {
    options: Options<'static>,
    size: Size,
    paper: Rgb,
}

/// The size of an image.
#[derive(Clone, Copy, Debug)]
pub enum Size {
    /// A width, pixels.
    Wide(u32),
    /// A scale: pixels of the image per pixel of the sheet.
    Times(f32),
}

/// An opaque image, row by row from the top, three bytes per pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// Red, green and blue of every pixel.
    pub rgb: Vec<u8>,
}

impl Raster {
    /// A painter of images of this size.
    pub fn new(size: Size) -> Self {
        let mut options = Options::default();
        let fonts = options.fontdb_mut();
        for (_, letters) in FACES {
            fonts.load_font_data(letters.to_vec());
        }
        // the family names are those of assets/fonts/build
        fonts.set_sans_serif_family("Ubuntu derivative Motion Lab");
        fonts.set_monospace_family("Motion Lab Mono");
        Raster { options, size, paper: Rgb([255; 3]) }
    }

    /// The same on paper of this colour.
    #[must_use]
    pub fn on(self, paper: Rgb) -> Self {
        Raster { paper, ..self }
    }

    fn tree(&self, svg: &str) -> Result<Tree, RasterError> {
        Tree::from_str(svg, &self.options).map_err(|error| RasterError::Fault(error.to_string()))
    }

    /// The width of the image of an SVG tree, pixels, and its scale.
    fn width(&self, tree: &Tree) -> (u32, f32) {
        match self.size {
            Size::Wide(width) => (width, width as f32 / tree.size().width()),
            Size::Times(scale) => ((tree.size().width() * scale).ceil() as u32, scale),
        }
    }

    /// The height of the image of the sheet, pixels.
    ///
    /// # Errors
    /// [`RasterError::Fault`] for text that is no SVG.
    pub fn height(&self, svg: &str) -> Result<u32, RasterError> {
        let tree = self.tree(svg)?;
        Ok((tree.size().height() * self.width(&tree).1).ceil() as u32)
    }

    /// Paints the sheet. With a `height` the image is cut off below it or filled up with bare paper, so that all images
    /// of a sequence have one size.
    ///
    /// # Errors
    /// [`RasterError::TooLarge`]; [`RasterError::Fault`] for text that is no SVG.
    pub fn paint(&self, svg: &str, height: Option<u32>) -> Result<Image, RasterError> {
        let tree = self.tree(svg)?;
        let (width, scale) = self.width(&tree);
        let height = height.unwrap_or((tree.size().height() * scale).ceil() as u32);
        let mut pixels = Pixmap::new(width, height).ok_or(RasterError::TooLarge(width))?;
        let Rgb([r, g, b]) = self.paper;
        pixels.data_mut().as_chunks_mut::<4>().0.fill([r, g, b, u8::MAX]);
        resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
        let rgb = pixels.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
        Ok(Image { width, height, rgb })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20">
        <rect x="0" y="0" width="10" height="20" fill="red"/>
        <text x="12" y="15" font-size="12" style="font-family:'No Such Face',monospace">Wm</text></svg>"##;

    fn pixel(image: &Image, x: u32, y: u32) -> [u8; 3] {
        let at = 3 * (y * image.width + x) as usize;
        [image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]]
    }

    #[test]
    fn shapes_and_letters_are_painted_to_scale_on_white() {
        let image = Raster::new(Size::Wide(80)).paint(SVG, None).unwrap();
        assert_eq!((image.width, image.height), (80, 40));
        assert_eq!((pixel(&image, 10, 20), pixel(&image, 78, 2)), ([255, 0, 0], [255; 3]));
        let dark = (24..80).flat_map(|x| (0..40).map(move |y| (x, y))).filter(|&(x, y)| pixel(&image, x, y)[0] < 100);
        assert!(dark.count() > 60, "the letters are there without any font of the system's");
        let padded = Raster::new(Size::Wide(80)).paint(SVG, Some(60)).unwrap();
        assert_eq!((padded.height, pixel(&padded, 10, 50)), (60, [255; 3]));
        let dark = Raster::new(Size::Wide(80)).on(Rgb([9, 8, 7]));
        assert_eq!(pixel(&dark.paint(SVG, Some(60)).unwrap(), 10, 50), [9, 8, 7], "what is missing is paper too");
        assert_eq!(dark.height(SVG).unwrap(), 40);
    }
}
