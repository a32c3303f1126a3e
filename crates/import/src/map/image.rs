//! Reads the image of a ROS map, of whatever kind.

use super::gray_image::GrayImage;
use super::{bmp_image, png_image, pnm};
use crate::{ImportError, ImportProblem};

/// Reads an image. Its first bytes say what it is, whatever its name.
pub(crate) fn read(bytes: &[u8]) -> Result<GrayImage, ImportError> {
    match bytes {
        [b'P', b'1'..=b'6', ..] => pnm::read(bytes),
        [0x89, b'P', b'N', b'G', ..] => png_image::read(bytes),
        [b'B', b'M', ..] => bmp_image::read(bytes),
        _ => {
            let problem = "this is no image that is read: a PGM, PPM or PBM begins with P1 to P6, a BMP with BM, a \
                           PNG with its own mark. Convert it, for example: magick map.jpg map.pgm";
            Err(ImportError::at(0, "", ImportProblem::Syntax(problem.into())))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_image_is_refused_by_its_first_bytes() {
        for bytes in [&b""[..], b"P", b"P7 2 2", b"\x89PN", b"GIF89a", b"\xff\xd8\xff"] {
            assert!(read(bytes).unwrap_err().to_string().contains("this is no image that is read"));
        }
        assert!(read(b"BM..").unwrap_err().to_string().contains("head of the BMP image"));
        assert!(read(b"\x89PNG\r\n\x1a\n").unwrap_err().to_string().contains("no whole PNG image"));
    }
}
