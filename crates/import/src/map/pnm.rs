//! Reads the portable bitmap, graymap and pixmap: P1 to P6.

use super::cells::check_size;
use super::gray_image::{GrayImage, shade, sixteen_bits};
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem};

/// What an image's head says of its samples.
#[derive(Clone, Copy)]
struct PnmSamples {
    /// The samples of a pixel: one gray, or red, green and blue.
    each: u64,
    /// The value of white.
    max: u16,
    /// The samples of all pixels.
    all: u64,
}

/// The words of a head or of a raster written in words, comments left out.
struct PnmWords<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> PnmWords<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.at)? {
                b'#' => self.at += self.bytes[self.at..].iter().take_while(|&&b| b != b'\n').count(),
                b if b.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        let rest = &self.bytes[self.at..];
        let length = rest.iter().take_while(|b| !b.is_ascii_whitespace() && **b != b'#').count();
        self.at += length;
        Some(&rest[..length])
    }

    /// The bytes after the one blank that ends the head.
    fn raster(&self) -> &'a [u8] {
        self.bytes.get(self.at + 1..).unwrap_or(&[])
    }

    fn line(&self) -> usize {
        1 + self.bytes[..self.at.min(self.bytes.len())].iter().filter(|&&b| b == b'\n').count()
    }

    fn number(&mut self, item: &'static str, most: u64, expected: &'static str) -> Result<u64, ImportError> {
        let Some(word) = self.next() else { return Err(ImportError::at(0, "", ImportProblem::Missing(item))) };
        let text = String::from_utf8_lossy(word);
        let number = text.parse::<u64>().ok().filter(|n| (1..=most).contains(n));
        number.ok_or_else(|| ImportError::at(self.line(), item, wrong_value(&text, expected)))
    }
}

/// Reads an image. Its first bytes must be `P1` to `P6`.
pub(crate) fn read(bytes: &[u8]) -> Result<GrayImage, ImportError> {
    let kind = bytes.get(1).copied().unwrap_or_default();
    let mut words = PnmWords { bytes, at: 2 };
    let columns = words.number("width", u64::MAX, "a whole number from 1 on")?;
    let rows = words.number("height", u64::MAX, "a whole number from 1 on")?;
    check_size(columns, rows).map_err(|problem| ImportError::at(0, "", problem))?;
    if matches!(kind, b'1' | b'4') {
        let bits = if kind == b'1' { plain_bits(&mut words, columns * rows)? } else { bits(&words, columns, rows)? };
        return GrayImage::of(columns, rows, bits.into_iter().map(|bit| if bit { 0 } else { 255 }).collect());
    }
    let max = words.number("the value of white", 65535, "a whole number from 1 to 65535")? as u16;
    let each = if matches!(kind, b'3' | b'6') { 3 } else { 1 };
    let samples = PnmSamples { each, max, all: each * columns * rows };
    let raster = if matches!(kind, b'2' | b'3') { plain_raster(&mut words, samples)? } else { raster(&words, samples) };
    if let Some(value) = raster.iter().find(|value| **value > max) {
        return Err(ImportError::at(0, "a pixel", wrong_value(value, "at most the value of white")));
    }
    if raster.len() as u64 != samples.all {
        let found = raster.len() as u64 / each;
        let problem = ImportProblem::Count { what: "pixels", found, expected: columns * rows };
        return Err(ImportError::at(0, "", problem));
    }
    GrayImage::of(columns, rows, raster.chunks_exact(each as usize).map(|pixel| gray(pixel, max)).collect())
}

/// The shade of a pixel's samples.
fn gray(samples: &[u16], max: u16) -> u8 {
    let colour = match *samples {
        [red, green, blue] => [red, green, blue],
        [gray, ..] => [gray; 3],
        [] => [0; 3],
    };
    shade(colour.map(|sample| sixteen_bits(sample, max)))
}

fn plain_raster(words: &mut PnmWords, samples: PnmSamples) -> Result<Vec<u16>, ImportError> {
    let mut raster = Vec::new();
    while let Some(word) = words.next() {
        let text = String::from_utf8_lossy(word);
        let sample = text.parse::<u16>().ok().filter(|sample| *sample <= samples.max).ok_or_else(|| {
            ImportError::at(words.line(), "a pixel", wrong_value(&text, "a whole number, at most the value of white"))
        })?;
        raster.push(sample);
        if raster.len() as u64 >= samples.all + samples.each {
            break;
        }
    }
    Ok(raster)
}

/// The samples after the one blank that ends the head. Blanks after the last one are left out: some editors add them.
fn raster(words: &PnmWords, samples: PnmSamples) -> Vec<u16> {
    let size = if samples.max < 256 { 1 } else { 2 };
    let rest = without_blanks_behind(words.raster(), samples.all * size);
    match size {
        1 => rest.iter().map(|&b| u16::from(b)).collect(),
        _ => rest.chunks(2).filter_map(|pair| Some(u16::from_be_bytes(pair.try_into().ok()?))).collect(),
    }
}

/// The pixels of a P1, a sign each; blanks between them may be missing.
fn plain_bits(words: &mut PnmWords, pixels: u64) -> Result<Vec<bool>, ImportError> {
    let mut bits = Vec::new();
    while let Some(word) = words.next() {
        for sign in word {
            match sign {
                b'0' | b'1' => bits.push(*sign == b'1'),
                _ => {
                    let found = wrong_value(String::from_utf8_lossy(word), "0 or 1");
                    return Err(ImportError::at(words.line(), "a pixel", found));
                }
            }
            if bits.len() as u64 > pixels {
                return Ok(bits);
            }
        }
    }
    Ok(bits)
}

/// The pixels of a P4: each row begins with a byte of its own, its first pixel in the highest bit.
fn bits(words: &PnmWords, columns: u64, rows: u64) -> Result<Vec<bool>, ImportError> {
    let row_bytes = columns.div_ceil(8);
    let rest = without_blanks_behind(words.raster(), row_bytes * rows);
    let (found, expected) = (rest.len() as u64, row_bytes * rows);
    if found != expected {
        return Err(ImportError::at(0, "", ImportProblem::Count { what: "bytes of pixels", found, expected }));
    }
    let row = |bytes: &[u8]| {
        let bits = bytes.iter().flat_map(|byte| (0..8).map(move |bit| byte & (0x80 >> bit) != 0));
        bits.take(columns as usize).collect::<Vec<_>>()
    };
    Ok(rest.chunks(row_bytes as usize).flat_map(row).collect())
}

/// The first `size` bytes if only blanks follow, else all bytes.
fn without_blanks_behind(bytes: &[u8], size: u64) -> &[u8] {
    match bytes.split_at_checked(usize::try_from(size).unwrap_or(usize::MAX)) {
        Some((raster, behind)) if behind.iter().all(u8::is_ascii_whitespace) => raster,
        _ => bytes,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(bytes: &[u8]) -> String {
        read(bytes).unwrap_err().to_string()
    }

    fn shades(bytes: &[u8]) -> Vec<u8> {
        read(bytes).unwrap().shades
    }

    #[test]
    fn both_forms_with_comments_give_the_same_pixels() {
        let plain = read(b"P2 # drawn by hand\n# 2 x 3\n2 3\n255\n0 255\n1 2 # row\n3 4").unwrap();
        let shades_of_it = vec![0, 255, 1, 2, 3, 4];
        assert_eq!(plain, GrayImage { columns: 2, rows: 3, shades: shades_of_it, opaque: vec![] });
        // the byte after the head's one blank may itself look like a blank or a comment
        assert_eq!(read(b"P5\n# c\n2 3\n255\n\0\xff\x01\x02\x03\x04").unwrap(), plain);
        assert_eq!(shades(b"P5 2 1 255 \n#"), [10, 35]);
        assert_eq!(shades(b"P5 2 1 255 \n#\r\n"), [10, 35], "an editor's newline at the end");
    }

    #[test]
    fn other_whites_are_brought_to_eight_bits() {
        // two bytes, the high one first: 1000 of 1000 is white, 1 of 1000 is 66 of 65535, below one of 255
        assert_eq!(shades(b"P5 1 2 1000\n\x03\xe8\0\x01"), [255, 0]);
        // 50 of 100 is 32768 of 65535, and 127 * 257 = 32639, 128 * 257 = 32896
        assert_eq!(shades(b"P2 3 1 100 0 50 100"), [0, 127, 255]);
    }

    #[test]
    fn colours_become_shades() {
        // 255 times 306, 601 and 117, each over 1024 and rounded down
        let colours = [76, 149, 29, 255, 205];
        assert_eq!(shades(b"P3 5 1 255 255 0 0  0 255 0  0 0 255  255 255 255  205 205 205"), colours);
        assert_eq!(shades(b"P6 5 1 255\n\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff\xcd\xcd\xcd"), colours);
        assert!(refusal(b"P6 2 1 255\nabcde").contains("1 pixels: the head of the file tells 2"));
        assert!(refusal(b"P3 1 1 255 1 2 3 4 5 6").contains("2 pixels: the head of the file tells 1"));
    }

    #[test]
    fn bitmaps_are_black_where_their_bits_are_set() {
        let drawn = [255, 0, 0, 255, 255, 255, 255, 255, 0, 0, 255, 255, 255, 255, 255, 255, 255, 0];
        assert_eq!(shades(b"P1 # two rows of nine\n9 2\n0 1 1 0 0 0 0 0 1\n100000001"), drawn);
        // a row of nine bits takes two bytes
        assert_eq!(shades(b"P4 9 2\n\x60\x80\x80\x80"), drawn);
        assert!(refusal(b"P4 9 2\n\x60\x80\x80").contains("3 bytes of pixels: the head of the file tells 4"));
        assert!(refusal(b"P1 2 1\n02").contains("02: it must be 0 or 1"));
        assert!(refusal(b"P1 2 1\n0 1 1").contains("3 pixels: the head of the file tells 2"));
    }

    #[test]
    fn what_is_no_graymap_is_refused() {
        assert!(refusal(b"P5").contains("`width` is missing"));
        assert!(refusal(b"P5 2 -3 255 ").contains("height: -3: it must be a whole number"));
        assert!(refusal(b"P5 2 3\n65536 ").contains(":2: the value of white: 65536"));
        assert!(refusal(b"P5 2 3 255 abc").contains("3 pixels: the head of the file tells 6"));
        assert!(refusal(b"P5 2 1 255 abc").contains("3 pixels: the head of the file tells 2"));
        assert!(refusal(b"P5 2 1 9 a\x01").contains("a pixel: 97: it must be at most the value of white"));
        assert!(refusal(b"P2 2 2 9 1 2 3").contains("3 pixels: the head of the file tells 4"));
        assert!(refusal(b"P2 2 2 9 1 2\n3 10").contains(":2: a pixel: 10"));
        // absurd sizes are refused before any room is made for them
        assert!(refusal(b"P5 4294967296 4294967296 255 ").contains("cells: at most"));
        assert!(refusal(b"P5 18446744073709551615 2 255 ").contains("cells: at most"));
        assert!(refusal(b"P5 99999999999999999999 2 255 ").contains("width"));
    }
}
