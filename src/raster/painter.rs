//! Painting our own SVG without a display, and writing it as PNG and GIF.

use std::io::{self, Write};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::few_colours::FewColours;
use motion_lab_core::picture::{FACES, Palette, Rgb};
use motion_lab_sim::capture::CaptureError;

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

    fn tree(&self, svg: &str) -> Result<Tree, CaptureError> {
        Tree::from_str(svg, &self.options).map_err(|error| CaptureError::Fault(error.to_string()))
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
    /// [`CaptureError::Fault`] for text that is no SVG.
    pub fn height(&self, svg: &str) -> Result<u32, CaptureError> {
        let tree = self.tree(svg)?;
        Ok((tree.size().height() * self.width(&tree).1).ceil() as u32)
    }

    /// Paints the sheet. With a `height` the image is cut off below it or filled up with bare paper, so that all images
    /// of a sequence have one size.
    ///
    /// # Errors
    /// [`CaptureError::TooLarge`]; [`CaptureError::Fault`] for text that is no SVG.
    pub fn paint(&self, svg: &str, height: Option<u32>) -> Result<Image, CaptureError> {
        let tree = self.tree(svg)?;
        let (width, scale) = self.width(&tree);
        let height = height.unwrap_or((tree.size().height() * scale).ceil() as u32);
        let mut pixels = Pixmap::new(width, height).ok_or(CaptureError::TooLarge(width))?;
        let Rgb([r, g, b]) = self.paper;
        pixels.data_mut().as_chunks_mut::<4>().0.fill([r, g, b, u8::MAX]);
        resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
        let rgb = pixels.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
        Ok(Image { width, height, rgb })
    }
}

/// Writes a PNG with these notes in its metadata, each a keyword and its text.
///
/// # Errors
/// [`CaptureError::Write`] when it can't be written.
pub fn write_png(image: &Image, notes: &[(&str, String)], to: impl Write) -> Result<(), CaptureError> {
    let failed = |error: png::EncodingError| match error {
        png::EncodingError::IoError(error) => CaptureError::Write(error),
        error => CaptureError::Fault(error.to_string()),
    };
    let mut encoder = png::Encoder::new(to, image.width, image.height);
    encoder.set_color(png::ColorType::Rgb);
    for (keyword, text) in notes {
        encoder.add_text_chunk((*keyword).to_owned(), text.clone()).map_err(failed)?;
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&image.rgb).map_err(failed)?;
    writer.finish().map_err(failed)
}

/// A GIF that is written image by image and played in a loop.
pub struct GifWriter<W: Write> {
    encoder: gif::Encoder<W>,
    hundredths: u16,
    palette: &'static Palette,
}

impl<W: Write> GifWriter<W> {
    /// Begins a GIF of images of this size, each shown for `hundredths` of a second. The palette's colours are kept,
    /// however rare.
    ///
    /// # Errors
    /// [`io::Error`] when it can't be written.
    pub fn new(
        to: W,
        [width, height]: [u16; 2],
        hundredths: u16,
        palette: &'static Palette,
        comment: &str,
    ) -> io::Result<Self> {
        let mut encoder = gif::Encoder::new(to, width, height, &[]).map_err(io::Error::other)?;
        encoder.set_repeat(gif::Repeat::Infinite).map_err(io::Error::other)?;
        // a comment is a chain of blocks of at most 255 bytes
        let blocks: Vec<&[u8]> = comment.as_bytes().chunks(255).collect();
        encoder.write_raw_extension(gif::AnyExtension(0xFE), &blocks).map_err(io::Error::other)?;
        Ok(GifWriter { encoder, hundredths, palette })
    }

    /// Writes the next image.
    ///
    /// # Errors
    /// [`io::Error`] when it can't be written.
    pub fn write(&mut self, image: &Image) -> io::Result<()> {
        let (width, height) = (image.width as u16, image.height as u16);
        let FewColours { palette, pixels } = FewColours::of(&image.rgb, self.palette);
        let mut frame = gif::Frame::from_palette_pixels(width, height, pixels, palette, None);
        frame.delay = self.hundredths;
        self.encoder.write_frame(&frame).map_err(|error| match error {
            gif::EncodingError::Io(error) => error,
            error => io::Error::other(error),
        })
    }

    /// Ends the GIF and returns its writer.
    ///
    /// # Errors
    /// [`io::Error`] when it can't be written.
    pub fn finish(self) -> io::Result<W> {
        self.encoder.into_inner().map_err(io::Error::other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REDS: Palette = Palette::new([Rgb([255, 0, 0]); motion_lab_core::picture::Role::ALL.len()]);

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

    #[test]
    fn a_png_reads_back_with_its_notes() {
        let image = Raster::new(Size::Wide(40)).paint(SVG, None).unwrap();
        let mut bytes = Vec::new();
        write_png(&image, &[("Seed", "2005".into())], &mut bytes).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(&bytes)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut rgb).unwrap();
        assert_eq!(rgb, image.rgb);
        let notes = &reader.info().uncompressed_latin1_text;
        assert_eq!((notes[0].keyword.as_str(), notes[0].text.as_str()), ("Seed", "2005"));
    }

    #[test]
    fn a_gif_holds_every_frame_and_its_comment() {
        let image = Raster::new(Size::Wide(40)).paint(SVG, None).unwrap();
        let comment = "seed 2005 ".repeat(30);
        let mut writer = GifWriter::new(Vec::new(), [40, 20], 5, &REDS, &comment).unwrap();
        for _ in 0..3 {
            writer.write(&image).unwrap();
        }
        let bytes = writer.finish().unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(&bytes[..]).unwrap();
        let mut frames = 0;
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            assert_eq!((frame.delay, frame.width, frame.height), (5, 40, 20));
            let red = &frame.buffer[4 * (5 * 40 + 5)..][..3];
            assert_eq!(red, [255, 0, 0]);
            frames += 1;
        }
        assert_eq!(frames, 3);
        let text: Vec<u8> = comment.bytes().take(255).collect();
        assert!(bytes.windows(255).any(|w| w == text), "the comment's first block");
    }
}
