//! What a sweep will take, from a few of its runs.

use std::fs;
use std::time::Instant;

use crate::batch::{Shard, Study};
use crate::output::PassingFolder;

use super::keep::Keep;
use super::one;
use crate::cli::support::interrupt;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome, say};

/// Most runs that are measured.
const MAX_MEASURED: u64 = 32;
/// No further run is measured after this time, seconds.
const ENOUGH: f64 = 5.0;
/// The time of one shard, seconds.
const SHARD: f64 = 600.0;

/// Measures a few runs, evenly spread over a shard, one after the other, and says what all of its runs take.
pub fn estimate(
    study: &Study,
    shard: Shard,
    jobs: Option<usize>,
    keep: Keep,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    interrupt::listen();
    let folder = PassingFolder::new().map_err(|error| Failure::output(&std::env::temp_dir(), &error))?;
    let (rows, jobs) = (shard.rows(study.runs()), super::shard::pool(jobs)?.current_num_threads());
    let runs = rows.end - rows.start;
    if runs == 0 {
        data.line(format!("0 runs: the sweep has {} in all", study.runs()))?;
        return Ok(Outcome::Done);
    }
    let samples = runs.min(MAX_MEASURED);
    let progress = CommandProgress::of(samples, "runs");
    let (mut measured, mut bytes, mut logs) = (0_u64, 0_u64, 0_u64);
    let begin = Instant::now();
    for i in 0..samples {
        // the first, then further and further apart, so that an early end leaves no part of the sweep out
        let row = rows.start + (i * 2_654_435_761) % samples * runs / samples;
        let Some(row) = one::run(study, row, keep, folder.path())? else {
            drop(progress);
            say(format!(
                "stopped with {measured} of {} measured\nNothing is kept; start again.",
                counted(samples, "run")
            ));
            return Ok(Outcome::Stopped);
        };
        let log = one::log_name(folder.path(), row.row);
        logs += fs::metadata(&log).map_or(0, |about| about.len());
        let _ = fs::remove_file(log);
        bytes += row.to_line().len() as u64 + 1;
        measured += 1;
        progress.step();
        if begin.elapsed().as_secs_f64() > ENOUGH {
            break;
        }
    }
    drop(progress);
    let one = begin.elapsed().as_secs_f64() / measured as f64;
    let all = one * runs as f64;
    let of_all = |bytes: u64| bytes as f64 / measured as f64 * runs as f64;
    data.line(format!("{}, {measured} of them measured: {:.2} ms each", counted(runs, "run"), 1e3 * one))?;
    data.line(format!("{all:.0} s of one processor, {:.0} s with {jobs} jobs", all / jobs as f64))?;
    let logs = if keep == Keep::None { String::new() } else { format!(", and {:.0} bytes of logs", of_all(logs)) };
    data.line(format!("{:.0} bytes of rows{logs}", of_all(bytes)))?;
    let shards = (one * study.runs() as f64 / SHARD).ceil();
    let name = if shards == 1.0 { "shard" } else { "shards" };
    let of = if shard == Shard::WHOLE { String::new() } else { format!(" of all {}", counted(study.runs(), "run")) };
    data.line(format!("{shards:.0} {name}{of} of ten minutes with one job each"))?;
    Ok(Outcome::Done)
}
