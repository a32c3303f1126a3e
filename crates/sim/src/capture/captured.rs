//! `Captured`, a figure and the metadata of its file, and the forms that files have.

use motion_lab_core::picture::{Figure, Palette, Sheet};
use std::path::Path;

/// Hundredths of a second in a tick.
#[doc(hidden)]
pub const TICK_HUNDREDTHS: u64 = 5;

/// A keyword and its text in the file's metadata.
pub type Note = (&'static str, String);

/// The form of a captured file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CaptureForm {
    /// Vector graphics.
    Svg,
    /// Pixels.
    #[default]
    Png,
    /// Pixels over a span of ticks, played in a loop.
    Gif,
}

impl CaptureForm {
    /// Every form.
    pub const ALL: [CaptureForm; 3] = [CaptureForm::Png, CaptureForm::Svg, CaptureForm::Gif];

    /// The form by a file's extension; `None` for any other.
    pub fn of(path: &Path) -> Option<CaptureForm> {
        let extension = path.extension()?.to_str()?;
        CaptureForm::ALL.into_iter().find(|form| form.extension() == extension)
    }

    /// The extension of such files, without the dot.
    pub const fn extension(self) -> &'static str {
        match self {
            CaptureForm::Svg => "svg",
            CaptureForm::Png => "png",
            CaptureForm::Gif => "gif",
        }
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            CaptureForm::Svg => "SVG",
            CaptureForm::Png => "PNG",
            CaptureForm::Gif => "GIF",
        }
    }
}

/// A figure, and the metadata of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Captured {
    /// The figure.
    pub figure: Figure,
    /// The notes, without the program's own.
    pub notes: Vec<Note>,
}

/// The colours and the size of a figure.
#[derive(Clone, Copy, Debug)]
pub struct Paper {
    /// Its colours: a theme's.
    pub palette: &'static Palette,
    /// The sheet's largest width, pixels: 420 to 640 for a column, 1280 for a page. Letters keep their size.
    pub width: u32,
    /// The scale of PNG and GIF: pixels of the image per pixel of the sheet.
    pub scale: f32,
}

impl Paper {
    /// The width of the sheet, pixels.
    pub fn width_px(&self) -> f64 {
        f64::from(self.width)
    }
}

impl Captured {
    /// The figure as an SVG file with its notes. The same figure gives the same bytes.
    pub fn svg(&self, paper: &Paper) -> String {
        let notes = self.file_notes();
        self.figure.svg_on(&Sheet { palette: paper.palette, width_px: paper.width_px(), notes: &notes })
    }

    /// The notes of its file, after the program that wrote it.
    pub fn file_notes(&self) -> Vec<Note> {
        let program = ("Software", format!("motion-lab {}", env!("CARGO_PKG_VERSION")));
        std::iter::once(program).chain(self.notes.iter().cloned()).collect()
    }
}
