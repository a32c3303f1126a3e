//! `GrayImage`, the image of a ROS map in the 8 bits in which Nav2 sees it.

use crate::{ImportError, ImportProblem};

/// An image of gray pixels, its rows from the top.
#[derive(Debug, PartialEq)]
pub(crate) struct GrayImage {
    pub columns: u64,
    pub rows: u64,
    /// The shade of each pixel, 0 black to 255 white.
    pub shades: Vec<u8>,
    /// Of each pixel 1 if it is opaque, 0 if it is transparent, wholly or in part. Empty if all are opaque.
    pub opaque: Vec<u8>,
}

impl GrayImage {
    /// The opaque image of this size. Refuses another number of pixels.
    pub fn of(columns: u64, rows: u64, shades: Vec<u8>) -> Result<GrayImage, ImportError> {
        let (found, expected) = (shades.len() as u64, columns * rows);
        if found == expected {
            return Ok(GrayImage { columns, rows, shades, opaque: vec![] });
        }
        Err(ImportError::at(0, "", ImportProblem::Count { what: "pixels", found, expected }))
    }

    /// The shade of each pixel, and whether it is opaque.
    pub fn pixels(&self) -> impl Iterator<Item = (u8, bool)> {
        let opaque = |i: usize| self.opaque.get(i).is_none_or(|opaque| *opaque == 1);
        self.shades.iter().enumerate().map(move |(i, shade)| (*shade, opaque(i)))
    }
}

/// The 16 bits of a sample of which `max` is white, rounded.
pub(crate) fn sixteen_bits(sample: u16, max: u16) -> u16 {
    let (sample, max) = (u64::from(sample), u64::from(max.max(1)));
    ((2 * sample * 65535 + max) / (2 * max)).min(65535) as u16
}

/// The shade of samples of 16 bits, as GraphicsMagick computes it for Nav2: Rec. 601's weights over 1024, then 8 bits,
/// both rounded down.
pub(crate) fn shade([red, green, blue]: [u16; 3]) -> u8 {
    let intensity = (306 * u64::from(red) + 601 * u64::from(green) + 117 * u64::from(blue)) >> 10;
    (intensity / 257) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_of_eight_bits_keep_their_shade() {
        for gray in 0..=255_u16 {
            let sample = sixteen_bits(gray, 255);
            assert_eq!((sample, u16::from(shade([sample; 3]))), (257 * gray, gray));
        }
        // 5/9 of 65535 is 36408.33, and 141 * 257 = 36237, 142 * 257 = 36494
        assert_eq!((sixteen_bits(5, 9), shade([sixteen_bits(5, 9); 3])), (36408, 141));
        // 4/9 of it is 29126.67
        assert_eq!(sixteen_bits(4, 9), 29127);
        assert_eq!((sixteen_bits(9, 9), sixteen_bits(1, 65535)), (65535, 1));
    }

    #[test]
    fn colours_are_weighed() {
        // 306 * 255 / 1024 = 76.2, 601 * 255 / 1024 = 149.7, 117 * 255 / 1024 = 29.1
        let full = 65535;
        assert_eq!([[full, 0, 0], [0, full, 0], [0, 0, full], [full; 3]].map(shade), [76, 149, 29, 255]);
    }
}
