//! Writing captured files: SVG, PNG, and GIF over a span of ticks.

use std::path::Path;

use bevy::app::App;

use crate::output::{PendingFile, write_file};
use motion_lab_core::picture::Role;
use motion_lab_raster::{GifWriter, Image, Raster, RasterError, Size, write_png};
use motion_lab_sim::capture::{
    CaptureError, CaptureForm, CaptureSpan, Captured, Film, Paper, Subject, TICK_HUNDREDTHS,
};
use motion_lab_sim::run::Log;

/// An image that is none, as a capture's failure.
fn failed(error: RasterError) -> CaptureError {
    match error {
        RasterError::TooLarge(width) => CaptureError::TooLarge(width),
        RasterError::Write(error) => CaptureError::Write(error),
        error => CaptureError::Fault(error.to_string()),
    }
}

fn raster(paper: &Paper) -> Raster {
    Raster::new(Size::Times(paper.scale)).on(paper.palette.colour(Role::Paper))
}

/// Writes one figure as SVG or PNG, whole or not at all.
///
/// # Errors
/// [`CaptureError`] names what is too large or can't be written. A GIF is refused: [`film`] writes one.
pub fn write(captured: &Captured, paper: &Paper, form: CaptureForm, path: &Path) -> Result<(), CaptureError> {
    let svg = captured.svg(paper);
    match form {
        CaptureForm::Svg => Ok(write_file(path, svg.as_bytes())?),
        CaptureForm::Png => {
            let image = raster(paper).paint(&svg, None).map_err(failed)?;
            let mut pending = PendingFile::create(path)?;
            write_png(&image, &captured.file_notes(), &mut pending).map_err(failed)?;
            Ok(pending.commit()?)
        }
        CaptureForm::Gif => Err(CaptureError::Frozen),
    }
}

/// Paints one figure.
///
/// # Errors
/// [`CaptureError::TooLarge`]; [`CaptureError::Fault`] is a fault of the lab.
#[doc(hidden)]
pub fn paint(captured: &Captured, paper: &Paper) -> Result<Image, CaptureError> {
    raster(paper).paint(&captured.svg(paper), None).map_err(failed)
}

/// Writes a GIF of a run over a span of its ticks, which plays as fast as the run. Before each picture, `go_on` gets
/// the number of pictures done and the number of all, and returns whether to go on.
///
/// # Errors
/// [`CaptureError`] names what the run does not have, what is too large or can't be written. No file is left then.
pub fn film(
    log: &Log,
    subject: &Subject,
    span: CaptureSpan,
    paper: &Paper,
    path: &Path,
    go_on: impl FnMut(u64, u64) -> bool,
) -> Result<(), CaptureError> {
    film_with_robots(log, subject, span, paper, path, go_on, |_| {})
}

/// [`film`] of a run with kinds of robots that a program added: `add` adds them.
///
/// # Errors
/// As [`film`].
pub fn film_with_robots(
    log: &Log,
    subject: &Subject,
    span: CaptureSpan,
    paper: &Paper,
    path: &Path,
    mut go_on: impl FnMut(u64, u64) -> bool,
    add: impl Fn(&mut App),
) -> Result<(), CaptureError> {
    let film = Film::try_new(log, subject, span)?;
    let pending = PendingFile::create(path)?;
    let raster = raster(paper);
    let mut height = 0;
    // all pictures are as high as the highest
    film.layouts(paper.width_px(), &add, |captured| {
        height = std::cmp::max(height, raster.height(&captured.svg(paper)).map_err(failed)?);
        Ok(())
    })?;
    let (mut pending, mut writer, mut done) = (Some(pending), None, 0);
    film.pictures(paper.width_px(), &add, |captured| {
        if !go_on(done, span.pictures()) {
            return Err(CaptureError::Stopped);
        }
        done += 1;
        let image = raster.paint(&captured.svg(paper), Some(height)).map_err(failed)?;
        if let Some(pending) = pending.take() {
            let hundredths = (TICK_HUNDREDTHS * film.span().every) as u16;
            writer = Some(GifWriter::new(pending, gif_size(&image)?, hundredths, paper.palette, &comment(&captured))?);
        }
        match &mut writer {
            Some(writer) => Ok(writer.write(&image)?),
            None => Ok(()),
        }
    })?;
    match writer {
        Some(writer) => Ok(writer.finish()?.commit()?),
        None => Ok(()),
    }
}

/// The notes of a capture as a GIF's comment.
fn comment(captured: &Captured) -> String {
    let notes: Vec<String> = captured.file_notes().iter().map(|(key, text)| format!("{key}: {text}")).collect();
    notes.join("; ")
}

/// How long the last of [`slides`] is shown, hundredths of a second.
const LAST: u16 = 200;

/// Writes a GIF of these captures, each shown for `hundredths` of a second, at least one, and the last for two
/// seconds. Their notes are those of the last.
///
/// # Errors
/// [`CaptureError`] names what is too large or can't be written. No file is left then.
pub fn slides(captures: &[Captured], hundredths: u16, paper: &Paper, path: &Path) -> Result<(), CaptureError> {
    let Some(last) = captures.last() else { return Ok(()) };
    let hundredths = std::cmp::max(hundredths, 1);
    let pending = PendingFile::create(path)?;
    let raster = raster(paper);
    // all pictures are as high as the highest
    let heights: Result<Vec<u32>, _> =
        captures.iter().map(|captured| raster.height(&captured.svg(paper)).map_err(failed)).collect();
    let height = heights?.into_iter().max();
    let paint = |captured: &Captured| raster.paint(&captured.svg(paper), height).map_err(failed);
    let end = paint(last)?;
    let mut writer = GifWriter::new(pending, gif_size(&end)?, hundredths, paper.palette, &comment(last))?;
    for captured in &captures[..captures.len() - 1] {
        writer.write(&paint(captured)?)?;
    }
    writer.write_for(&end, std::cmp::max(LAST, hundredths))?;
    Ok(writer.finish()?.commit()?)
}

/// The width and height of a GIF's pictures, pixels.
pub fn gif_size(image: &Image) -> Result<[u16; 2], CaptureError> {
    let fits = |pixels: u32| u16::try_from(pixels).map_err(|_| CaptureError::TooLarge(image.width));
    Ok([fits(image.width)?, fits(image.height)?])
}
