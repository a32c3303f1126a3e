//! Going on with a recording that stopped early.

use std::fs;
use std::path::Path;

use crate::output::{is_left, is_temporary, unfinished, whole_name};
use motion_lab_sim::run::{Log, LogError};

use super::one::{Printed, StopRule, record};
use crate::cli::support::input::read_bytes_if;
use crate::cli::support::log_source::{begins_as_one, read_log};
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// Largest number of files left by killed processes that are named.
const MAX_NAMED: usize = 10;

/// Runs the recording in `file` again from its seed and script, compares with what is sealed in it, and goes on to the
/// end.
pub fn resume(
    file: &Path,
    output: Option<&Path>,
    stop: StopRule,
    form: Printed,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    if is_temporary(file) && !is_left(file).unwrap_or(true) {
        return Err(Failure::input(
            format!("{}: another process is writing it", file.display()),
            "Wait until it ends, or stop it with Ctrl-C.",
        ));
    }
    if is_page(file) {
        return Err(Failure::usage(
            format!("{}: it is a page, and a log alone goes on where it ends", file.display()),
            "Make a log of a saved page: motion-lab replay PAGE --log full -o FULL.mcap",
        ));
    }
    let source = read_log(file)?;
    let log = source.log;
    // FILE.partial, or an unfinished file of FILE, becomes FILE
    let whole_name = whole_name(file);
    let output = output.or(whole_name.as_deref()).unwrap_or(file);
    if is_temporary(file) && output.exists() {
        return Err(Failure::usage(
            format!("{}: there is a file of this name, which may be newer", output.display()),
            "Name another with -o.",
        ));
    }
    if source.damage.is_none() {
        say(format!("{} is whole already; it is run again all the same", file.display()));
    }
    let target = Target::resumed(output, file)?;
    let outcome = record(&log.recipe, log.kind(), Some(&log), Some(&target), stop, form, data)?;
    if outcome == Outcome::Done && Some(output) == whole_name.as_deref() {
        // all of it is in the output now
        let _ = fs::remove_file(file);
    }
    Ok(outcome)
}

/// Names the files beside `output` that killed processes left, and says what to do with them.
pub fn name_unfinished(output: &Path) {
    // a folder that can't be read is an error when the output is begun
    let left = unfinished(output).unwrap_or_default();
    for file in left.iter().take(MAX_NAMED) {
        let next = if is_log(file) { "go on with: motion-lab record --resume " } else { "it is no recording; delete " };
        say(format!("{} was left by a process that was killed: {next}{}", file.display(), file.display()));
    }
    if left.len() > MAX_NAMED {
        say(format!("and {} more such files", left.len() - MAX_NAMED));
    }
}

fn is_log(file: &Path) -> bool {
    read_bytes_if(file, 0, |_| false).is_ok_and(|begin| begin.len() == 8 && begins_as_one(&begin)) && !is_page(file)
}

fn is_page(file: &Path) -> bool {
    read_bytes_if(file, 0, |_| false).is_ok_and(|begin| matches!(Log::read_mcap(&begin), Err(LogError::Page(_))))
}
