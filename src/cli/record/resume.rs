//! Going on with a recording that stopped early.

use std::fs;
use std::path::Path;

use super::Plan;
use super::one::{Stop, record};
use crate::cli::log_source::read_log;
use crate::cli::{Data, Failure, Outcome, say};

/// Runs the recording in `file` again from its seed and script, compares with what is sealed in it, and goes on to the end.
pub fn resume(file: &Path, output: Option<&Path>, stop: Stop, json: bool, data: &mut Data) -> Result<Outcome, Failure> {
    let source = read_log(file)?;
    let log = source.read.log;
    // a name that says it is partial gives way to the whole
    let whole_name = (file.extension().is_some_and(|e| e == "partial")).then(|| file.with_extension(""));
    let output = output.or(whole_name.as_deref()).unwrap_or(file);
    if source.damage.is_none() {
        say(format!("{} is whole already; it is run again all the same", file.display()));
    }
    let plan = Plan { seed: log.seed, config: log.config, script: log.script };
    let outcome = record(&plan, &log.frames, Some(output), stop, json, data)?;
    if outcome == Outcome::Done && Some(output) == whole_name.as_deref() {
        // all of it is in the output now
        let _ = fs::remove_file(file);
    }
    Ok(outcome)
}
