//! The file that a capture goes to.

use std::path::{Path, PathBuf};

use motion_lab::picture::{Figure, Sheet};
use motion_lab::ui::Theme;

use crate::cli::Failure;
use crate::cli::output::{PendingFile, write_file};
use crate::cli::raster::{GifWriter, Image, Raster, Size, write_png};

/// What a file's name says of its form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Svg,
    Png,
    Gif,
}

/// A keyword and its text, as they stand in the file.
pub type Note = (&'static str, String);

/// Where a capture goes, and how large.
pub struct Paper {
    path: PathBuf,
    kind: Kind,
    theme: Theme,
    width: u32,
    raster: Raster,
}

impl Paper {
    /// The paper for this file.
    pub fn new(path: &Path, theme: Theme, width: u32, scale: f32) -> Result<Self, Failure> {
        let kind = match path.extension().and_then(|e| e.to_str()) {
            Some("svg") => Kind::Svg,
            Some("png") => Kind::Png,
            Some("gif") => Kind::Gif,
            _ => {
                let reason = format!("{}: its name does not tell the form", path.display());
                return Err(Failure::usage(reason, "Let it end in .svg, .png or .gif."));
            }
        };
        Ok(Paper { path: path.to_owned(), kind, theme, width, raster: Raster::new(Size::Times(scale)) })
    }

    /// The form.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The width of the sheet, pixels.
    pub fn width(&self) -> f64 {
        f64::from(self.width)
    }

    fn svg(&self, figure: &Figure, notes: &[Note]) -> String {
        figure.svg_on(&Sheet { palette: self.theme.palette(), width_px: self.width(), notes })
    }

    /// Writes one figure, as SVG or PNG.
    pub fn write(&self, figure: &Figure, notes: &[Note]) -> Result<(), Failure> {
        let all = with_program(notes);
        let svg = self.svg(figure, &all);
        if self.kind == Kind::Svg {
            return write_file(&self.path, svg.as_bytes());
        }
        let image = self.raster.paint(&svg, None)?;
        let mut pending = PendingFile::create(&self.path)?;
        write_png(&image, &all, &mut pending, &self.path)?;
        pending.commit()
    }

    /// Begins a GIF of figures shown for so many hundredths of a second each.
    pub fn film(&self, hundredths: u16, notes: &[Note]) -> Result<Film<'_>, Failure> {
        let comment =
            with_program(notes).iter().map(|(key, text)| format!("{key}: {text}")).collect::<Vec<_>>().join("; ");
        Ok(Film { paper: self, pending: Some(PendingFile::create(&self.path)?), writer: None, hundredths, comment })
    }
}

/// The notes, after the program that wrote them.
fn with_program(notes: &[Note]) -> Vec<Note> {
    let program = ("Software", format!("motion-lab {}", env!("CARGO_PKG_VERSION")));
    std::iter::once(program).chain(notes.iter().cloned()).collect()
}

/// A GIF under way.
pub struct Film<'a> {
    paper: &'a Paper,
    pending: Option<PendingFile>,
    writer: Option<(GifWriter<PendingFile>, u32)>,
    hundredths: u16,
    comment: String,
}

impl Film<'_> {
    /// Adds a figure.
    pub fn add(&mut self, figure: &Figure) -> Result<(), Failure> {
        let paper = self.paper;
        let svg = paper.svg(figure, &[]);
        let image = paper.raster.paint(&svg, self.writer.as_ref().map(|(_, height)| *height))?;
        let failed = |error| Failure::output(&paper.path, &error);
        if let Some(pending) = self.pending.take() {
            let size = gif_size(&image)?;
            let palette = paper.theme.palette();
            let writer = GifWriter::new(pending, size, self.hundredths, palette, &self.comment).map_err(failed)?;
            self.writer = Some((writer, image.height));
        }
        match &mut self.writer {
            Some((writer, _)) => writer.write(&image).map_err(failed),
            None => Ok(()),
        }
    }

    /// Puts the file in its place; nothing is there before.
    pub fn finish(self) -> Result<(), Failure> {
        match self.writer {
            Some((writer, _)) => writer.finish().map_err(|error| Failure::output(&self.paper.path, &error))?.commit(),
            None => Err(Failure::usage("no tick to draw", "Choose --from and --to within the run.")),
        }
    }
}

fn gif_size(image: &Image) -> Result<[u16; 2], Failure> {
    let fits = |pixels: u32| {
        u16::try_from(pixels)
            .map_err(|_| Failure::usage("the pictures are too large for a GIF", "Choose a smaller --width or --scale."))
    };
    Ok([fits(image.width)?, fits(image.height)?])
}
