//! The program without a command, with the feature `headless`: the book's tour, recorded, replayed and compared.

use std::fs;
use std::path::Path;

use crate::capture::RunFigure;
use motion_lab_core::picture::Theme;
use motion_lab_sim::recording::Verification;
use motion_lab_sim::run::{LogKind, Recipe};
use motion_lab_sim::tour::{BOOK_SEED, TourConfig};

use super::record::{Ended, StopRule, write_run};
use crate::cli::support::console::note;
use crate::cli::support::interrupt;
use crate::cli::support::log_source::{digest_of, read_full_log};
use crate::cli::support::output::write_file;
use crate::cli::support::progress::CommandProgress;
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
    let recipe = Recipe::new(TourConfig::default(), BOOK_SEED);
    let drawing = folder.join(format!("tour-{BOOK_SEED}.svg"));
    let (recorded, drawn) = (Target::log(&file)?, Target::of(&drawing)?);
    interrupt::listen();
    if let Ended::Stopped(tick) = write_run(&recipe, LogKind::Frames, None, StopRule::default(), &recorded)? {
        say(format!("stopped after tick {tick}; run it again"));
        return Ok(Outcome::Stopped);
    }

    let log = read_full_log(&file)?.log;
    let mut figure = RunFigure::default();
    let Verification { identical, digest, difference, .. } = {
        let progress = CommandProgress::of(log.ticks(), "ticks replayed");
        verify(&log, |run| {
            figure.watch(run.view());
            progress.at(run.frame().tick);
        })?
    };
    RunSummary::of(&log).print_robots(false, data)?;
    data.line(format!("digest {}", digest_of(&log)?))?;
    let ticks = log.ticks();
    data.line(format!("{identical} of {ticks} ticks bit-identical"))?;
    if let Some(difference) = difference {
        say(format!("the replay differs: {difference}"));
        return Ok(Outcome::Differs);
    }

    write_file(&drawn, figure.svg(&log.recipe, ticks, digest, Theme::Light).as_bytes())?;
    recorded.wrote();
    drawn.wrote();
    note(
        "`motion-lab --help` lists what else there is: record other runs, verify, export, draw and ask; \
          `cargo run` without `headless` opens the window",
    );
    Ok(Outcome::Done)
}
