//! Reads BMP images without compression.

use super::cells::check_size;
use super::gray_image::{GrayImage, shade, sixteen_bits};
use crate::error::wrong_value;
use crate::{ImportError, ImportProblem};

/// Length of the file's own head, bytes: the mark, the length and where the pixels begin.
const FILE_HEAD: usize = 14;

/// Length of the head of OS/2, bytes, with sizes of 16 bits and palettes of three bytes a colour.
const OS2_HEAD: u32 = 12;

/// Lengths of the heads of Windows, bytes: of versions 3, 4 and 5, and version 3 with masks.
const WINDOWS_HEADS: [u32; 5] = [40, 52, 56, 108, 124];

/// Number of the compression that has none.
const PLAIN: u32 = 0;

/// Number of the compression that has none either, but masks that say where the colours of a pixel are.
const MASKED: u32 = 3;

/// What an image's head says.
struct BmpHead {
    columns: u64,
    rows: u64,
    /// Whether the top row comes first.
    is_top_down: bool,
    bits: u16,
    /// Where the pixels begin, bytes from the file's start.
    pixels: usize,
    /// The bytes of the palette, and those of a colour of it.
    palette: (usize, usize),
    /// The number of the palette's colours.
    colours: usize,
    channels: BmpChannels,
}

/// Which byte of a pixel or a palette's colour holds what.
#[derive(Clone, Copy)]
struct BmpChannels {
    /// Red, green and blue.
    colour: [usize; 3],
    alpha: Option<usize>,
}

/// Blue first, as everywhere but where masks say otherwise. The fourth byte says nothing then.
const USUAL: BmpChannels = BmpChannels { colour: [2, 1, 0], alpha: None };

/// Reads an image of 1, 4, 8, 24 or 32 bits a pixel. Its first bytes must be `BM`.
pub(crate) fn read(bytes: &[u8]) -> Result<GrayImage, ImportError> {
    let head = head(bytes)?;
    check_size(head.columns, head.rows).map_err(|problem| ImportError::at(0, "", problem))?;
    // a row begins at a multiple of four bytes
    let row = 4 * (head.columns * u64::from(head.bits)).div_ceil(32);
    let rest = bytes.get(head.pixels..).unwrap_or(&[]);
    let (found, expected) = (rest.len() as u64, row * head.rows);
    if found < expected {
        return Err(ImportError::at(0, "", ImportProblem::Count { what: "bytes of pixels", found, expected }));
    }
    let columns = head.columns as usize;
    let rows = rest.chunks_exact(row as usize).take(head.rows as usize);
    let palette = palette(bytes, &head)?;
    let (mut shades, mut opaque) = (Vec::new(), Vec::new());
    let mut add = |row: &[u8]| match head.bits {
        24 | 32 => {
            let pixels = row.chunks_exact(usize::from(head.bits / 8)).take(columns);
            let grays = pixels.map(|pixel| (gray(pixel, head.channels), is_opaque(pixel, head.channels)));
            let (row_shades, row_opaque): (Vec<u8>, Vec<u8>) = grays.unzip();
            shades.extend(row_shades);
            if head.channels.alpha.is_some() {
                opaque.extend(row_opaque);
            }
            Ok(())
        }
        bits => {
            let indices = row.iter().flat_map(|byte| indices(*byte, bits)).take(columns);
            indices.map(|index| colour(&palette, index)).try_for_each(|shade| shade.map(|shade| shades.push(shade)))
        }
    };
    if head.is_top_down {
        { rows }.try_for_each(&mut add)?
    } else {
        rows.rev().try_for_each(&mut add)?
    }
    Ok(GrayImage { columns: head.columns, rows: head.rows, shades, opaque })
}

/// The indices that a byte holds, the highest bits first.
fn indices(byte: u8, bits: u16) -> impl Iterator<Item = u8> {
    (1..=8 / bits).map(move |i| ((u16::from(byte) >> (8 - i * bits)) & ((1 << bits) - 1)) as u8)
}

/// The shade of a colour of the palette.
fn colour(palette: &[u8], index: u8) -> Result<u8, ImportError> {
    palette.get(usize::from(index)).copied().ok_or_else(|| {
        ImportError::at(0, "a pixel", wrong_value(format!("colour {index}"), "one of the image's palette, from 0 on"))
    })
}

/// The shades of the palette's colours; none of an image without a palette.
fn palette(bytes: &[u8], head: &BmpHead) -> Result<Vec<u8>, ImportError> {
    if head.bits > 8 {
        return Ok(Vec::new());
    }
    let (start, each) = head.palette;
    let colours = bytes.get(start..start + each * head.colours);
    let colours = colours.ok_or_else(|| ImportError::from(ImportProblem::Missing("the whole palette")))?;
    Ok(colours.chunks_exact(each).map(|colour| gray(colour, USUAL)).collect())
}

fn gray(pixel: &[u8], channels: BmpChannels) -> u8 {
    let sample = |i: usize| sixteen_bits(u16::from(pixel.get(i).copied().unwrap_or(0)), 255);
    shade(channels.colour.map(sample))
}

/// 1 if the pixel is opaque.
fn is_opaque(pixel: &[u8], channels: BmpChannels) -> u8 {
    u8::from(channels.alpha.is_none_or(|i| pixel.get(i) == Some(&255)))
}

/// Little-endian numbers of a head.
struct BmpBytes<'a>(&'a [u8]);

impl BmpBytes<'_> {
    fn array<const N: usize>(&self, at: usize) -> Result<[u8; N], ImportError> {
        let found = self.0.get(at..at + N).and_then(|bytes| bytes.try_into().ok());
        found.ok_or_else(|| ImportProblem::Missing("the whole head of the BMP image").into())
    }

    fn u16(&self, at: usize) -> Result<u16, ImportError> {
        self.array(at).map(u16::from_le_bytes)
    }

    fn u32(&self, at: usize) -> Result<u32, ImportError> {
        self.array(at).map(u32::from_le_bytes)
    }

    fn i32(&self, at: usize) -> Result<i32, ImportError> {
        self.array(at).map(i32::from_le_bytes)
    }
}

fn unsupported(what: String) -> ImportError {
    ImportProblem::Unsupported(what).into()
}

fn head(bytes: &[u8]) -> Result<BmpHead, ImportError> {
    let head = BmpBytes(bytes);
    let (pixels, size) = (head.u32(10)? as usize, head.u32(FILE_HEAD)?);
    let (mut width, mut height) = (i64::from(head.u16(18)?), i64::from(head.u16(20)?));
    let (mut bits, mut compression, mut colours) = (head.u16(24)?, PLAIN, 0);
    let is_os2 = size == OS2_HEAD;
    if !is_os2 {
        if !WINDOWS_HEADS.contains(&size) {
            return Err(unsupported(format!("a BMP image whose head is {size} bytes long")));
        }
        (width, height) = (i64::from(head.i32(18)?), i64::from(head.i32(22)?));
        (bits, compression, colours) = (head.u16(28)?, head.u32(30)?, head.u32(46)?);
    }
    for (item, found) in [("width", width), ("height", height.abs())] {
        if found < 1 {
            return Err(ImportError::at(0, item, wrong_value(found, "a whole number from 1 on")));
        }
    }
    let channels = match (bits, compression) {
        (1 | 4 | 8 | 24 | 32, PLAIN) => USUAL,
        (32, MASKED) => masks(&head, size)?,
        (_, PLAIN | MASKED) => {
            return Err(unsupported(format!("a BMP image of {bits} bits a pixel; 1, 4, 8, 24 and 32 are")));
        }
        _ => return Err(unsupported("a compressed BMP image".into())),
    };
    let all = if bits > 8 { 0 } else { 1 << bits };
    let colours = if colours == 0 { all } else { (colours as usize).min(all) };
    let palette = (FILE_HEAD + size as usize, if is_os2 { 3 } else { 4 });
    let (columns, rows) = (width.unsigned_abs(), height.unsigned_abs());
    Ok(BmpHead { columns, rows, is_top_down: height < 0, bits, pixels, palette, colours, channels })
}

/// Which bytes of a pixel of 32 bits its masks name. The mask of alpha counts in heads that have room for it.
fn masks(head: &BmpBytes, size: u32) -> Result<BmpChannels, ImportError> {
    const MASKS: usize = 54;
    let byte = |i: usize| {
        let mask = head.u32(MASKS + 4 * i)?;
        let byte = (0..4).find(|byte| mask == 0xff << (8 * byte));
        byte.ok_or_else(|| unsupported(format!("a BMP image with the mask {mask:#010x}, which is no whole byte")))
    };
    let alpha = if size >= 56 && head.u32(MASKS + 12)? != 0 { Some(byte(3)?) } else { None };
    Ok(BmpChannels { colour: [byte(0)?, byte(1)?, byte(2)?], alpha })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A head of Windows, version 3, for pixels that follow it and this many bytes more.
    fn head(width: i32, height: i32, bits: u16, compression: u32, more: u32) -> Vec<u8> {
        let mut bytes = b"BM\0\0\0\0\0\0\0\0".to_vec();
        for number in [54 + more, 40] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend([width.to_le_bytes(), height.to_le_bytes()].concat());
        bytes.extend([1, 0]);
        bytes.extend(bits.to_le_bytes());
        for number in [compression, 0, 0, 0, more / 4, 0] {
            bytes.extend(number.to_le_bytes());
        }
        bytes
    }

    fn image(head: Vec<u8>, rest: &[u8]) -> Vec<u8> {
        [head, rest.to_vec()].concat()
    }

    fn refusal(bytes: &[u8]) -> String {
        read(bytes).unwrap_err().to_string()
    }

    #[test]
    fn colours_of_24_and_32_bits_come_blue_first_from_the_bottom_row_on() {
        // 76, 149 and 29 are the shades of red, green and blue; a row of three pixels takes twelve bytes
        let pixels = [[0, 0, 255, 0, 255, 0, 255, 0, 0, 9, 9, 9], [255, 255, 255, 205, 205, 205, 0, 0, 0, 9, 9, 9]];
        let (lower, upper) = ([76, 149, 29], [255, 205, 0]);
        assert_eq!(read(&image(head(3, 2, 24, 0, 0), &pixels.concat())).unwrap().shades, [upper, lower].concat());
        assert_eq!(read(&image(head(3, -2, 24, 0, 0), &pixels.concat())).unwrap().shades, [lower, upper].concat());
        let four = [[0, 0, 255, 0], [205, 205, 205, 7]].concat();
        let plain = read(&image(head(2, 1, 32, 0, 0), &four)).unwrap();
        assert_eq!((plain.shades, plain.opaque), (vec![76, 205], vec![]), "the fourth byte says nothing");
    }

    #[test]
    fn palettes_of_1_4_and_8_bits_are_followed() {
        let palette = [[0, 0, 0, 0], [255, 255, 255, 0], [205, 205, 205, 0]].concat();
        let of = |bits: u16, rest: &[u8]| {
            let head = head(3, 1, bits, 0, 12);
            read(&image(head, &[&palette, rest].concat())).unwrap().shades
        };
        assert_eq!(of(8, &[2, 0, 1, 9]), [205, 0, 255]);
        assert_eq!(of(4, &[0x20, 0x1f, 0, 0]), [205, 0, 255]);
        assert_eq!(of(1, &[0b1010_1111, 0, 0, 0]), [255, 0, 255]);
        let beyond = image(head(1, 1, 8, 0, 12), &[&palette[..], &[3, 0, 0, 0]].concat());
        assert_eq!(refusal(&beyond), ": a pixel: colour 3: it must be one of the image's palette, from 0 on");
        // OS/2: sizes of 16 bits, three bytes a colour
        let os2 = [
            &b"BM\0\0\0\0\0\0\0\0\x20\0\0\0\x0c\0\0\0\x02\0\x01\0\x01\0\x01\0"[..],
            &[0, 0, 0, 9, 9, 9, 0x40, 0, 0, 0],
        ];
        assert_eq!(read(&os2.concat()).unwrap().shades, [0, 9]);
    }

    #[test]
    fn masks_say_where_the_colours_are_and_alpha_counts_where_it_has_one() {
        // a head of version 4: red in the lowest byte, alpha in the highest
        let mut bytes = head(2, 1, 32, 3, 68);
        bytes[14] = 108;
        for mask in [0xff_u32, 0xff00, 0xff_0000, 0xff00_0000] {
            bytes.extend(mask.to_le_bytes());
        }
        let bytes = image(bytes, &[vec![0; 52], vec![255, 0, 0, 255, 0, 0, 0, 254]].concat());
        let found = read(&bytes).unwrap();
        assert_eq!((found.shades, found.opaque), (vec![76, 0], vec![1, 0]));
        let mut odd = bytes.clone();
        odd[55] = 1;
        assert!(refusal(&odd).contains("not supported: a BMP image with the mask 0x000001ff, which is no whole byte"));
    }

    #[test]
    fn what_is_cut_short_compressed_or_absurd_is_refused() {
        let whole = image(head(1, 2, 24, 0, 0), &[0; 8]);
        assert!(read(&whole).is_ok());
        for length in 2..whole.len() {
            let error = refusal(&whole[..length]);
            let is_head = error.ends_with("`the whole head of the BMP image` is missing");
            assert!(is_head || error.contains("bytes of pixels: the head of the file tells 8"), "{length}: {error}");
        }
        assert!(refusal(&image(head(1, 1, 8, 0, 1024), &[0; 9])).contains("bytes of pixels"));
        let mut early = image(head(1, 1, 8, 0, 1024), &[0; 9]);
        early[10..14].copy_from_slice(&54_u32.to_le_bytes());
        assert!(refusal(&early).contains("`the whole palette` is missing"));
        assert!(refusal(&head(1, 1, 8, 1, 0)).contains("not supported: a compressed BMP image"));
        assert!(refusal(&head(1, 1, 16, 0, 0)).contains("a BMP image of 16 bits a pixel"));
        assert!(refusal(&head(0, 1, 24, 0, 0)).contains("width: 0: it must be a whole number from 1 on"));
        assert!(refusal(&head(-3, 1, 24, 0, 0)).contains("width: -3"));
        for (width, height) in [(i32::MAX, i32::MAX), (i32::MAX, i32::MIN), (1, i32::MIN)] {
            assert!(refusal(&head(width, height, 24, 0, 0)).contains("cells: at most 16777216"));
        }
        let mut long = head(1, 1, 24, 0, 0);
        long[14] = 41;
        assert!(refusal(&long).contains("a BMP image whose head is 41 bytes long"));
    }
}
