//! The program without a command, with the feature `headless`: the book's tour, recorded, replayed and compared.

use std::fs;
use std::path::Path;

use motion_lab::capture::RunFigure;
use motion_lab::picture::Theme;
use motion_lab::recording::Verification;
use motion_lab::run::Script;
use motion_lab::tour::{BOOK_SEED, TourConfig};

use super::record::{Ended, Plan, Stop, write_run};
use crate::cli::support::console::note;
use crate::cli::support::interrupt;
use crate::cli::support::log_kind::LogKind;
use crate::cli::support::log_source::read_log;
use crate::cli::support::output::write_file;
use crate::cli::support::progress::Progress;
use crate::cli::support::simulate::verify;
use crate::cli::support::summary::RunSummary;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// The folder of the recording and its figure.
const FOLDER: &str = "runs";

/// Records the 60 s tour at the book's seed, reads the recording back, replays it from its seed and script alone,
/// compares every bit, and draws it.
pub fn tour(data: &mut Data) -> Result<Outcome, Failure> {
    let folder = Path::new(FOLDER);
    fs::create_dir_all(folder).map_err(|error| Failure::output(folder, &error))?;
    let file = folder.join(format!("tour-{BOOK_SEED}.mcap"));
    let plan = Plan { seed: BOOK_SEED, config: TourConfig::default(), script: Script::empty(), kind: LogKind::Full };
    let recorded = Target::of(&file)?;
    interrupt::listen()?;
    if let Ended::Stopped(tick) = write_run(&plan, None, Stop::default(), &file)? {
        say(format!("stopped after tick {tick}; run it again"));
        return Ok(Outcome::Stopped);
    }

    let log = read_log(&file)?.read.log;
    let mut figure = RunFigure::default();
    let Verification { identical, divergence, .. } = {
        let progress = Progress::of(log.config.ticks, "ticks replayed");
        verify(&log, |run| {
            figure.watch(run.view());
            progress.at(run.frame().tick);
        })?
    };
    let digest = log.digest();
    let last = log.frames.last().unwrap_or(&log.initial);
    RunSummary::new(log.seed, &log.config, last, digest).print_robots(false, data)?;
    data.line(format!("digest {digest}"))?;
    let ticks = log.config.ticks;
    data.line(format!("{identical} of {ticks} ticks bit-identical"))?;
    if let Some(divergence) = divergence {
        say(format!("the replay differs: {divergence}"));
        return Ok(Outcome::Differs);
    }

    let drawing = folder.join(format!("tour-{BOOK_SEED}.svg"));
    let drawn = Target::of(&drawing)?;
    write_file(&drawing, figure.svg(log.seed, &log.config, ticks, digest, Theme::Light).as_bytes())?;
    recorded.wrote();
    drawn.wrote();
    note(
        "`motion-lab --help` lists what else there is: record other runs, verify, export, draw and ask; \
          `cargo run` without `headless` opens the window",
    );
    Ok(Outcome::Done)
}
