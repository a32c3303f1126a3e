//! The figure of a run at one of its ticks, and at many: PNG and GIF.

use std::path::Path;

use clap::Args;

use crate::capture::{RunFigure, TICK_HUNDREDTHS, with_names};
use crate::cli::Failure;
use crate::cli::support::choices;
use crate::cli::support::log_source::digest_of;
use crate::cli::support::output::ReportedFile;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::show;
use crate::cli::support::target::Target;
use motion_lab_core::picture::{Role, Sheet, Theme};
use motion_lab_raster::{GifWriter, Image, Raster, RasterError, Size, write_png};
use motion_lab_sim::run::Log;

/// Which ticks are drawn, and how large.
#[derive(Debug, Args)]
pub struct StillArgs {
    /// SVG and PNG: draw the run as it is after this tick. [default: the last]
    #[arg(long, value_name = "TICK")]
    pub tick: Option<u64>,
    /// GIF: the first tick.
    #[arg(long, value_name = "TICK", default_value_t = 0)]
    from: u64,
    /// GIF: the last tick. [default: the last]
    #[arg(long, value_name = "TICK")]
    to: Option<u64>,
    /// GIF: a picture for every N ticks.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u64).range(1..=1000))]
    every: u64,
    /// PNG and GIF: pixels from left to right. SVG: the sheet's greatest width, pixels; letters keep their size.
    #[arg(long, value_name = "PIXELS", default_value_t = 1280, value_parser = clap::value_parser!(u32).range(64..=8192))]
    width: u32,
    /// SVG, PNG and GIF: the paper's colours.
    #[arg(long, value_parser = choices::theme(), default_value = "light")]
    theme: Theme,
    /// SVG, PNG and GIF: the names of obstacles, places and marks.
    #[arg(long)]
    names: bool,
}

/// The greatest width of a sheet that is painted, pixels of the sheet.
const SHEET: u32 = 1280;

/// The SVG of the run after `tick`.
pub fn svg_at(args: &StillArgs, file: &Path, log: &Log, tick: u64) -> Result<String, Failure> {
    sheet_at(args, args.width, file, log, tick)
}

/// The SVG of the run after `tick`, on a sheet of this width.
fn sheet_at(args: &StillArgs, width: u32, file: &Path, log: &Log, tick: u64) -> Result<String, Failure> {
    let mut drawn = None;
    let progress = CommandProgress::of(tick, "ticks");
    each_svg(
        (args, width),
        file,
        log,
        |at| {
            progress.at(at);
            at == tick
        },
        |svg| {
            drawn = Some(svg);
            Ok(())
        },
    )?;
    drawn.ok_or_else(|| beyond(log, tick))
}

/// Writes a PNG of the run at one tick.
pub fn png(args: &StillArgs, file: &Path, log: &Log, target: &Target) -> Result<(), Failure> {
    let output = target.path();
    let tick = args.tick.unwrap_or(log.ticks());
    let image = paint(&args.raster(), &sheet_at(args, SHEET, file, log, tick)?, None)?;
    let mut pending = ReportedFile::create(target)?;
    let notes = [
        ("Software", format!("motion-lab {}", env!("CARGO_PKG_VERSION"))),
        ("Seed", log.recipe.seed.0.to_string()),
        ("Digest", digest_of(log)?.to_string()),
        ("Tick", tick.to_string()),
    ];
    write_png(&image, &notes, &mut pending).map_err(|error| match error {
        RasterError::Write(error) => Failure::output(output, &error),
        error => Failure::internal(error),
    })?;
    pending.commit()
}

/// Writes a GIF of the run that plays at the speed of the run.
pub fn gif(args: &StillArgs, file: &Path, log: &Log, target: &Target) -> Result<(), Failure> {
    let output = target.path();
    let last = log.ticks();
    let (from, to) = (args.from, args.to.unwrap_or(last));
    if from > to || to > last {
        return Err(beyond(log, if from > to { from } else { to }));
    }
    let failed = |error| Failure::output(output, &error);
    let raster = args.raster();
    let comment = format!("motion-lab, seed {}, digest {}, ticks {from} to {to}", log.recipe.seed.0, digest_of(log)?);
    let hundredths = (TICK_HUNDREDTHS * args.every) as u16;
    let mut pending = Some(ReportedFile::create(target)?);
    let mut writer: Option<(GifWriter<ReportedFile>, u32)> = None;
    let wanted = |tick: u64| (from..=to).contains(&tick) && (tick - from).is_multiple_of(args.every);
    let progress = CommandProgress::of((to - from) / args.every + 1, "pictures");
    each_svg((args, SHEET), file, log, wanted, |svg| {
        progress.step();
        let image = paint(&raster, &svg, writer.as_ref().map(|(_, height)| *height))?;
        if let Some(pending) = pending.take() {
            let too_large = |_| Failure::usage("the pictures are too large for a GIF", "Choose a smaller --width.");
            let size = [image.width.try_into().map_err(too_large)?, image.height.try_into().map_err(too_large)?];
            writer = Some((
                GifWriter::new(pending, size, hundredths, args.theme.palette(), &comment).map_err(failed)?,
                image.height,
            ));
        }
        match &mut writer {
            Some((writer, _)) => writer.write(&image).map_err(failed),
            None => Ok(()),
        }
    })?;
    match writer {
        Some((writer, _)) => writer.finish().map_err(failed)?.commit(),
        None => Err(beyond(log, from)),
    }
}

impl StillArgs {
    fn raster(&self) -> Raster {
        Raster::new(Size::Wide(self.width)).on(self.theme.palette().colour(Role::Paper))
    }
}

fn paint(raster: &Raster, svg: &str, height: Option<u32>) -> Result<Image, Failure> {
    raster.paint(svg, height).map_err(|error| match error {
        error @ RasterError::TooLarge(_) => Failure::usage(error, "Choose a smaller --width."),
        error => Failure::internal(error),
    })
}

/// Gives `take` the SVG of the run after each tick that is wanted.
fn each_svg(
    (args, width): (&StillArgs, u32),
    file: &Path,
    log: &Log,
    wanted: impl Fn(u64) -> bool,
    mut take: impl FnMut(String) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let (mut figure, digest) = (RunFigure::default(), digest_of(log)?);
    show(file, log, |run, frame| {
        figure.watch(run.view());
        if wanted(frame.tick) {
            let figure = figure.figure(&log.recipe, frame.tick, digest);
            let width_px = f64::from(width);
            let figure = if args.names { with_names(figure, &log.recipe.config.worlds, width_px) } else { figure };
            let palette = args.theme.palette();
            take(figure.svg_on(&Sheet { palette, width_px, notes: &[] }))?;
        }
        Ok(())
    })
}

fn beyond(log: &Log, tick: u64) -> Failure {
    let last = log.ticks();
    Failure::usage(format!("there is no tick {tick}: the log's are 0 to {last}"), "Choose one of them.")
}
