//! Images written as PNG and GIF.

use std::io::{self, Write};

use super::RasterError;
use super::few_colours::FewColours;
use super::painter::Image;
use motion_lab_core::picture::Palette;

/// Writes a PNG with these notes in its metadata, each a keyword and its text.
///
/// # Errors
/// [`RasterError::Write`] when it can't be written.
pub fn write_png(image: &Image, notes: &[(&str, String)], to: impl Write) -> Result<(), RasterError> {
    let failed = |error: png::EncodingError| match error {
        png::EncodingError::IoError(error) => RasterError::Write(error),
        error => RasterError::Fault(error.to_string()),
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
        self.write_for(image, self.hundredths)
    }

    /// Writes the next image, which is shown for `hundredths` of a second instead.
    ///
    /// # Errors
    /// [`io::Error`] when it can't be written.
    pub fn write_for(&mut self, image: &Image, hundredths: u16) -> io::Result<()> {
        let (width, height) = (image.width as u16, image.height as u16);
        let FewColours { palette, pixels } = FewColours::of(&image.rgb, self.palette);
        let mut frame = gif::Frame::from_palette_pixels(width, height, pixels, palette, None);
        frame.delay = hundredths;
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
    use crate::{Raster, Size};
    use motion_lab_core::picture::Rgb;

    const REDS: Palette = Palette::new([Rgb([255, 0, 0]); motion_lab_core::picture::Role::ALL.len()]);

    const SVG: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20">
        <rect x="0" y="0" width="10" height="20" fill="red"/></svg>"##;

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
