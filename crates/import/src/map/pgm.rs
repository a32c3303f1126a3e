//! Reads the portable graymap, P2 and P5.

use super::cells::check_size;
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem};

/// A gray image, its rows from the top.
#[derive(Debug, PartialEq)]
pub(crate) struct Pgm {
    pub columns: u64,
    pub rows: u64,
    /// The value of white.
    pub max: u16,
    pub pixels: Vec<u16>,
}

/// The words of a head or of a P2 raster, comments left out.
struct PgmWords<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> PgmWords<'a> {
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

impl Pgm {
    pub fn read(bytes: &[u8]) -> Result<Pgm, ImportError> {
        let plain = match bytes.get(..2) {
            Some(b"P2") => true,
            Some(b"P5") => false,
            _ => {
                let problem = "this is no PGM image: it must begin with P2 or P5. Convert it, for example: \
                               magick map.png map.pgm";
                return Err(ImportError::at(0, "", ImportProblem::Syntax(problem.into())));
            }
        };
        let mut words = PgmWords { bytes, at: 2 };
        let columns = words.number("width", u64::MAX, "a whole number from 1 on")?;
        let rows = words.number("height", u64::MAX, "a whole number from 1 on")?;
        let max = words.number("the value of white", 65535, "a whole number from 1 to 65535")? as u16;
        check_size(columns, rows).map_err(|problem| ImportError::at(0, "", problem))?;
        let expected = columns * rows;
        let pixels =
            if plain { plain_raster(&mut words, expected, max)? } else { raster(bytes, words.at, expected, max) };
        if pixels.len() as u64 != expected {
            let problem = ImportProblem::Count { what: "pixels", found: pixels.len() as u64, expected };
            return Err(ImportError::at(0, "", problem));
        }
        if let Some(value) = pixels.iter().find(|value| **value > max) {
            return Err(ImportError::at(0, "a pixel", wrong_value(value, "at most the value of white")));
        }
        Ok(Pgm { columns, rows, max, pixels })
    }
}

fn plain_raster(words: &mut PgmWords, expected: u64, max: u16) -> Result<Vec<u16>, ImportError> {
    let mut pixels = Vec::new();
    while let Some(word) = words.next() {
        let text = String::from_utf8_lossy(word);
        let pixel = text.parse::<u16>().ok().filter(|pixel| *pixel <= max).ok_or_else(|| {
            ImportError::at(words.line(), "a pixel", wrong_value(&text, "a whole number, at most the value of white"))
        })?;
        pixels.push(pixel);
        if pixels.len() as u64 > expected {
            break;
        }
    }
    Ok(pixels)
}

/// The pixels after the one blank that ends the head. Blanks after the last pixel are left out: some editors add them.
fn raster(bytes: &[u8], head: usize, expected: u64, max: u16) -> Vec<u16> {
    let mut rest = bytes.get(head + 1..).unwrap_or(&[]);
    let size = if max < 256 { 1 } else { 2 };
    if let Some((raster, behind)) = rest.split_at_checked(expected as usize * size)
        && behind.iter().all(u8::is_ascii_whitespace)
    {
        rest = raster;
    }
    match size {
        1 => rest.iter().map(|&b| u16::from(b)).collect(),
        _ => rest.chunks(2).filter_map(|pair| Some(u16::from_be_bytes(pair.try_into().ok()?))).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(bytes: &[u8]) -> String {
        Pgm::read(bytes).unwrap_err().to_string()
    }

    #[test]
    fn both_forms_with_comments_give_the_same_pixels() {
        let plain = Pgm::read(b"P2 # drawn by hand\n# 2 x 3\n2 3\n9\n0 9\n1 2 # row\n3 4").unwrap();
        assert_eq!(plain, Pgm { columns: 2, rows: 3, max: 9, pixels: vec![0, 9, 1, 2, 3, 4] });
        // the byte after the head's one blank may itself look like a blank or a comment
        assert_eq!(Pgm::read(b"P5\n# c\n2 3\n9\n\0\x09\x01\x02\x03\x04").unwrap(), plain);
        assert_eq!(Pgm::read(b"P5 2 1 35 \n#").unwrap().pixels, [10, 35]);
        assert_eq!(Pgm::read(b"P5 2 1 35 \n#\r\n").unwrap().pixels, [10, 35], "an editor's newline at the end");
        assert_eq!(
            Pgm::read(b"P5 1 2 1000\n\x03\xe8\0\x01").unwrap().pixels,
            [1000, 1],
            "two bytes, the high one first"
        );
    }

    #[test]
    fn what_is_no_graymap_is_refused() {
        assert!(refusal(b"\x89PNG").contains("P2 or P5"));
        assert!(refusal(b"").contains("P2 or P5"));
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
