//! Reads PNG images.

use std::io::Cursor;

use super::cells::check_size;
use super::gray_image::{GrayImage, shade, sixteen_bits};
use crate::{ImportError, ImportProblem};
use png::{BitDepth, ColorType, Decoder, InterlaceInfo, Limits, Transformations, expand_interlaced_row};

/// Largest size of what the decoder makes room for besides a row, bytes.
const MAX_BYTES: usize = 64 << 20;

/// Reads an image of any colour type, depth and order of its rows. Of an animation the first picture counts.
pub(crate) fn read(bytes: &[u8]) -> Result<GrayImage, ImportError> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: MAX_BYTES });
    // palettes and few bits become samples of eight bits; a transparent colour becomes alpha
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let head = decoder.read_header_info().map_err(broken)?;
    let (columns, rows) = (u64::from(head.width), u64::from(head.height));
    check_size(columns, rows).map_err(|problem| ImportError::at(0, "", problem))?;
    let mut reader = decoder.read_info().map_err(broken)?;
    let (colour, depth) = reader.output_color_type();
    let has_alpha = matches!(colour, ColorType::GrayscaleAlpha | ColorType::Rgba);
    let (width, size) = (columns as usize, (columns * rows) as usize);
    let mut shades = vec![0; size];
    let mut opaque = if has_alpha { vec![0; size] } else { vec![] };
    let mut row_of = 0;
    while let Some(row) = reader.next_interlaced_row().map_err(broken)? {
        let pixels = row.data().chunks_exact(colour.samples() * if depth == BitDepth::Sixteen { 2 } else { 1 });
        let (row_shades, row_opaque): (Vec<u8>, Vec<u8>) = pixels.map(|pixel| gray(pixel, depth)).unzip();
        let put = |image: &mut [u8], found: &[u8]| match row.interlace() {
            InterlaceInfo::Adam7(pass) => expand_interlaced_row(image, width, found, pass, 8),
            InterlaceInfo::Null(_) => {
                image.chunks_exact_mut(width).nth(row_of).into_iter().for_each(|row| row.copy_from_slice(found));
            }
        };
        put(&mut shades, &row_shades);
        if has_alpha {
            put(&mut opaque, &row_opaque);
        }
        row_of += 1;
    }
    Ok(GrayImage { columns, rows, shades, opaque })
}

/// A pixel's shade, and 1 if it is opaque.
fn gray(pixel: &[u8], depth: BitDepth) -> (u8, u8) {
    let sample = |i: usize| match (depth, pixel) {
        (BitDepth::Sixteen, bytes) => {
            bytes.get(2 * i..2 * i + 2).and_then(|pair| Some(u16::from_be_bytes(pair.try_into().ok()?)))
        }
        (_, bytes) => bytes.get(i).map(|byte| sixteen_bits(u16::from(*byte), 255)),
    };
    let samples = [0, 1, 2, 3].map(sample);
    let (colour, alpha) = match samples {
        [Some(red), Some(green), Some(blue), alpha] => ([red, green, blue], alpha),
        [gray, alpha, ..] => ([gray.unwrap_or(0); 3], alpha),
    };
    // Nav2 compares alpha in eight bits
    (shade(colour), u8::from(alpha.is_none_or(|alpha| alpha / 257 == 255)))
}

fn broken(reason: impl std::fmt::Display) -> ImportError {
    ImportError::at(0, "", ImportProblem::Syntax(format!("this is no whole PNG image: {reason}")))
}
