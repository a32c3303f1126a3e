//! `RasterError`, why there is no image.

use std::io;

/// Why an image is not painted or not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// An image of this width, pixels, is too large.
    #[error("an image {0} pixels wide is too large")]
    TooLarge(u32),
    /// Text that is no SVG, or what an encoder refuses.
    #[error("{0}")]
    Fault(String),
    /// It can't be written.
    #[error(transparent)]
    Write(#[from] io::Error),
}
