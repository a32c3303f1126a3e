//! `Clipboard`, which takes pictures.
//!
//! The clipboard of the window's library takes no pictures under Wayland and reports no failure, so this one asks the
//! system itself.

use std::sync::{Arc, Mutex, PoisonError};

use arboard::ImageData;
use bevy::prelude::*;

use motion_lab_raster::Image;

/// What takes a picture, or says why it can't.
type Take = dyn FnMut(&Image) -> Result<(), String> + Send;

/// The system's clipboard for pictures. It lives as long as the program, because on some systems the program itself
/// hands the picture out.
#[derive(Resource, Clone)]
pub struct Clipboard(Arc<Mutex<Take>>);

impl Clipboard {
    /// A clipboard that takes pictures so.
    pub fn by(take: impl FnMut(&Image) -> Result<(), String> + Send + 'static) -> Self {
        Clipboard(Arc::new(Mutex::new(take)))
    }

    /// Puts a picture on it. It may take long.
    ///
    /// # Errors
    /// The reason in words, where the system takes none.
    pub fn put(&self, image: &Image) -> Result<(), String> {
        let mut take = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        take(image)
    }
}

impl Default for Clipboard {
    fn default() -> Self {
        let mut system: Option<arboard::Clipboard> = None;
        Clipboard::by(move |image| {
            let words = |error: arboard::Error| error.to_string();
            let clipboard = match &mut system {
                Some(clipboard) => clipboard,
                None => system.insert(arboard::Clipboard::new().map_err(words)?),
            };
            let (width, height) = (image.width as usize, image.height as usize);
            clipboard.set_image(ImageData { width, height, bytes: with_alpha(&image.rgb).into() }).map_err(words)
        })
    }
}

/// The pixels with a fourth byte each, which says that they are opaque.
fn with_alpha(rgb: &[u8]) -> Vec<u8> {
    rgb.as_chunks::<3>().0.iter().flat_map(|[r, g, b]| [*r, *g, *b, u8::MAX]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_becomes_opaque() {
        assert_eq!(with_alpha(&[1, 2, 3, 4, 5, 6]), [1, 2, 3, 255, 4, 5, 6, 255]);
    }
}
