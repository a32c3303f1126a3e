//! One run of a sweep, and its row.

use std::fs;
use std::path::{Path, PathBuf};

use motion_lab::batch::{RowGatherer, RunRow, Study};
use motion_lab::run::{Frame, LogKind};

use super::keep::Keep;
use super::planned::{PlannedInputs, made};
use crate::cli::Failure;
use crate::cli::commands::record::{self, Ended, StopRule, write_run, write_run_watched};
use crate::cli::support::target::{Target, partial_name};

/// How a run of a sweep ended.
pub enum Ran {
    /// With this row.
    Row(RunRow),
    /// Early, because somebody asked for that.
    Stopped,
}

/// Nobody watches the ticks of one run among many.
const STOP: StopRule = StopRule { after: None, unwatched: true, at_refusal: false };

/// The log of a row in a folder.
pub fn log_name(logs: &Path, row: u64) -> PathBuf {
    logs.join(format!("{row}.mcap"))
}

/// Runs a row. Its full log goes into the folder `logs` if it is one of those to keep.
pub fn run(study: &Study, row: u64, keep: Keep, logs: &Path) -> Result<Ran, Failure> {
    let made = match study.setup(row) {
        Ok(setup) => made(setup),
        Err(reason) => return Ok(Ran::Row(study.failed(row, &reason))),
    };
    let (run, planned) = match made {
        PlannedInputs::Run(run, planned) => (run, planned),
        PlannedInputs::None(reason, planned) => {
            return Ok(Ran::Row(study.with_planned(study.failed(row, &reason), &planned)));
        }
        PlannedInputs::Stopped => return Ok(Ran::Stopped),
    };
    let with_planned = |row| match &planned {
        Some(planned) => study.with_planned(row, planned),
        None => row,
    };
    let log = log_name(logs, row);
    let mut gatherer = RowGatherer::new(study, row, &run.config, &run.script);
    let ended = match keep {
        Keep::All => Target::log(&log).and_then(|target| {
            write_run_watched(&run, LogKind::Frames, None, STOP, &target, |frame| gatherer.see(frame))
        }),
        _ => record::run(&run, STOP, |frame| gatherer.see(frame)),
    };
    let row = match ended {
        Ok(Ended::Whole { last, digest, refusals }) => with_planned(gatherer.row(&last, digest, &refusals)),
        Ok(Ended::Stopped(_) | Ended::Differs(_)) => return Ok(stopped(&log)),
        // a script or a start that the run does not take
        Err(Failure::Input { reason, .. }) => return Ok(Ran::Row(with_planned(study.failed(row, &reason)))),
        Err(failure) => return Err(failure),
    };
    // few runs are kept, and only their rows say which: these are run once more
    if lacks_log(study, &row, keep, logs) && !log_again(study, row.row, logs)? {
        return Ok(Ran::Stopped);
    }
    Ok(Ran::Row(row))
}

/// Runs a row once more and writes its full log to a file, if there is a run at all. Returns the row as this run makes
/// it; `None` where somebody asked to stop.
pub fn again(study: &Study, row: u64, log: &Target) -> Result<Option<RunRow>, Failure> {
    let (run, planned) = match study.setup(row).map(made) {
        Err(reason) => return Ok(Some(study.failed(row, &reason))),
        Ok(PlannedInputs::None(reason, planned)) => {
            return Ok(Some(study.with_planned(study.failed(row, &reason), &planned)));
        }
        Ok(PlannedInputs::Stopped) => return Ok(None),
        Ok(PlannedInputs::Run(run, planned)) => (run, planned),
    };
    let with_planned = |row| match &planned {
        Some(planned) => study.with_planned(row, planned),
        None => row,
    };
    let mut gatherer = RowGatherer::new(study, row, &run.config, &run.script);
    let see = |frame: &Frame| gatherer.see(frame);
    match write_run_watched(&run, LogKind::Frames, None, StopRule::default(), log, see) {
        Ok(Ended::Whole { last, digest, refusals }) => Ok(Some(with_planned(gatherer.row(&last, digest, &refusals)))),
        Ok(Ended::Stopped(_) | Ended::Differs(_)) => {
            remove_partial(log.path());
            Ok(None)
        }
        // a script or a start that the run does not take
        Err(Failure::Input { reason, .. }) => Ok(Some(with_planned(study.failed(row, &reason)))),
        Err(failure) => Err(failure),
    }
}

/// Writes the full log of a row that was run before, if it is one of those to keep and not there yet. `false` where
/// somebody asked to stop.
pub fn log_again(study: &Study, row: u64, logs: &Path) -> Result<bool, Failure> {
    let log = log_name(logs, row);
    // a row that could be run once can be again
    let Ok(setup) = study.setup(row) else { return Ok(true) };
    let run = match made(setup) {
        PlannedInputs::Run(run, _) => run,
        PlannedInputs::None(..) => return Ok(true),
        PlannedInputs::Stopped => return Ok(false),
    };
    let is_whole = matches!(write_run(&run, LogKind::Frames, None, STOP, &Target::log(&log)?)?, Ended::Whole { .. });
    if !is_whole {
        remove_partial(&log);
    }
    Ok(is_whole)
}

/// Whether the full log of this row is to be kept and is not there.
pub fn lacks_log(study: &Study, row: &RunRow, keep: Keep, logs: &Path) -> bool {
    let is_kept = match keep {
        Keep::None => false,
        Keep::Contacts => row.has_contacts(study.columns()),
        Keep::Failures => row.is_failure(study.columns()),
        Keep::All => true,
    };
    row.could_run(study.columns()) && is_kept && !log_name(logs, row.row).exists()
}

/// Removes what was written of a stopped run's log, and returns [`Ran::Stopped`]. When the same command is run again,
/// the row begins anew.
fn stopped(log: &Path) -> Ran {
    remove_partial(log);
    Ran::Stopped
}

/// Removes the beginning of a log, if there is one.
pub fn remove_partial(log: &Path) {
    let _ = fs::remove_file(partial_name(log));
}
