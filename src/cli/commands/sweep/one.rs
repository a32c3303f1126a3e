//! One run of a sweep, and its row.

use std::fs;
use std::path::{Path, PathBuf};

use crate::batch::{RowGatherer, RunRow, Study};
use motion_lab_sim::run::{Frame, LogKind};

use super::keep::Keep;
use super::planned::{PlannedInputs, made};
use crate::cli::Failure;
use crate::cli::commands::record::{self, Ended, StopRule, write_run_watched};
use crate::cli::support::target::{Target, partial_name};

/// Nobody watches the ticks of one run among many.
const STOP: StopRule = StopRule { after: None, unwatched: true, at_refusal: false };

/// The log of a row in a folder.
pub fn log_name(logs: &Path, row: u64) -> PathBuf {
    logs.join(format!("{row}.mcap"))
}

/// Runs a row. Its full log goes into the folder `logs` if it is one of those to keep. `None` where somebody asked to
/// stop.
pub fn run(study: &Study, row: u64, keep: Keep, logs: &Path) -> Result<Option<RunRow>, Failure> {
    if keep == Keep::All {
        return run_logged(study, row, logs);
    }
    let Some(made) = ran(study, row, STOP, None)? else { return Ok(None) };
    // few runs are kept, and only their rows say which: these are run once more
    let is_whole = !lacks_log(study, &made, keep, logs) || log_again(study, row, logs)?;
    Ok(is_whole.then_some(made))
}

/// Writes the full log of a row that was run before. `false` where somebody asked to stop.
pub fn log_again(study: &Study, row: u64, logs: &Path) -> Result<bool, Failure> {
    Ok(run_logged(study, row, logs)?.is_some())
}

/// Runs a row, and writes its full log into the folder `logs`. `None` where somebody asked to stop.
fn run_logged(study: &Study, row: u64, logs: &Path) -> Result<Option<RunRow>, Failure> {
    let log = log_name(logs, row);
    if log.is_symlink() {
        return Err(Failure::usage(
            format!("{}: it is a link, which may be another row's log", log.display()),
            "Take it away; the folder of the logs may be a link.",
        ));
    }
    let target = Target::log(&log)?;
    let made = ran(study, row, STOP, Some(&target));
    target.release();
    made
}

/// Runs a row once more and writes its full log to a file, if there is a run at all. Returns the row as this run makes
/// it; `None` where somebody asked to stop.
pub fn again(study: &Study, row: u64, log: &Target) -> Result<Option<RunRow>, Failure> {
    ran(study, row, StopRule::default(), Some(log))
}

/// Runs a row, and writes its full log if it has a target and there is a run at all. `None` where somebody asked to
/// stop: nothing is kept of the log then, and the row begins anew when the same command is run again.
fn ran(study: &Study, row: u64, stop: StopRule, log: Option<&Target>) -> Result<Option<RunRow>, Failure> {
    let (run, planned) = match study.setup(row).map(made) {
        Err(reason) => return Ok(Some(study.failed(row, &reason))),
        Ok(PlannedInputs::Path(planned)) => return Ok(Some(study.planned(row, &planned))),
        Ok(PlannedInputs::None(failure, planned)) => {
            return Ok(Some(study.with_planned(study.failed_by(row, &failure), &planned)));
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
    let ended = match log {
        Some(log) => write_run_watched(&run, LogKind::Frames, None, stop, log, see),
        None => record::run(&run, stop, see),
    };
    match ended {
        Ok(Ended::Whole { last, digest, refusals }) => Ok(Some(with_planned(gatherer.row(&last, digest, &refusals)))),
        Ok(Ended::Stopped(_) | Ended::Differs(_)) => {
            if let Some(log) = log {
                // the row begins anew
                let _ = fs::remove_file(partial_name(log.path()));
            }
            Ok(None)
        }
        // a script or a start that the run does not take
        Err(Failure::Input { reason, .. }) => Ok(Some(with_planned(study.failed(row, &reason)))),
        Err(failure) => Err(failure),
    }
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
