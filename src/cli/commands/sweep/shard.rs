//! Running a shard: its missing rows into the journal, then the part.

use std::io::BufReader;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::batch::{PartHead, PartReader, RunRow, Shard, Study};
use rayon::prelude::*;

use super::journal::Journal;
use super::keep::Keep;
use super::merge;
use super::one;
use crate::cli::support::console::note;
use crate::cli::support::input::open;
use crate::cli::support::interrupt;
use crate::cli::support::output::make_folder;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::{Target, numbers_in};
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome, say};

/// A thread for each of the jobs; one for each processor where nobody says.
pub fn pool(jobs: Option<usize>) -> Result<rayon::ThreadPool, Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(jobs.unwrap_or(0)).build().map_err(Failure::internal)
}

/// Runs the rows of a shard that are not there yet.
pub fn run(
    study: &Study,
    shard: Shard,
    folder: &Path,
    jobs: Option<usize>,
    keep: Keep,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    interrupt::listen();
    let logs = folder.join("logs");
    if keep != Keep::None {
        check_logs(&logs, shard.rows(study.runs()))?;
    }
    let needed = if keep == Keep::None { folder } else { &logs };
    make_folder(folder)?;
    make_folder(needed)?;
    let part = folder.join(format!("part-{shard}.sweep"));
    if part.exists() {
        return finished(study, &part, jobs, (keep, &logs), data);
    }
    let head = PartHead::new(study, shard.rows(study.runs()));
    let count = head.rows.end - head.rows.start;
    let journal = Target::of(&folder.join(format!("part-{shard}.journal")))?;
    let (journal, part) = (Journal::open(journal.path(), head, study.columns())?, Target::of(&part)?);
    let missing = journal.missing();
    let before = count - missing.len() as u64;
    let pool = pool(jobs)?;
    if before > 0 {
        note(format!("{before} of {} are there already", counted(count, "row")));
    }
    let mut without = Vec::new();
    if keep != Keep::None {
        journal.each(|line| {
            let row = RunRow::of_line(line, study.columns());
            without.extend(row.filter(|row| one::lacks_log(study, row, keep, &logs)).map(|row| row.row));
        })?;
    }
    if !make_logs(study, &without, &logs, &pool)? {
        say(format!("stopped with {before} of {} done\nThe same command goes on.", counted(count, "row")));
        return Ok(Outcome::Stopped);
    }
    let progress = CommandProgress::of_runs(count, before);
    let (journal, failures, without_run) = (Mutex::new(journal), AtomicU64::new(0), AtomicU64::new(0));
    let one = |&row: &u64| {
        if interrupt::asked_to_stop() {
            return Ok(());
        }
        let Some(row) = one::run(study, row, keep, &logs)? else { return Ok(()) };
        let line = row.to_line();
        journal.lock().unwrap_or_else(PoisonError::into_inner).add(row.row, &line)?;
        if row.is_failure(study.columns()) {
            progress.failed(failures.fetch_add(1, Ordering::Relaxed) + 1);
            without_run.fetch_add(u64::from(!row.could_run(study.columns())), Ordering::Relaxed);
        }
        progress.step();
        Ok(())
    };
    let ran: Result<(), Failure> = pool.install(|| missing.par_iter().with_max_len(1).try_for_each(one));
    drop(progress);
    let journal = journal.into_inner().unwrap_or_else(PoisonError::into_inner);
    journal.sync()?;
    ran?;
    let left = journal.missing().len() as u64;
    if left > 0 {
        say(format!("stopped with {} of {} done\nThe same command goes on.", count - left, counted(count, "row")));
        return Ok(Outcome::Stopped);
    }
    journal.finish(&part, study.columns())?;
    part.wrote();
    let (failures, without_run) = (failures.into_inner(), without_run.into_inner());
    let made = count - before;
    let failed = match failures {
        0 => "none failed".to_owned(),
        _ => format!("{failures} failed, of which {without_run} without a run"),
    };
    data.line(format!("{}, {made} of them made now; {failed}", counted(count, "run")))?;
    if shard == Shard::WHOLE {
        note(format!("For one table: motion-lab sweep merge {} -o table.parquet", folder.display()));
    }
    Ok(Outcome::Done)
}

/// Refuses these rows if the log of one, whole or unfinished, would be an input.
fn check_logs(logs: &Path, rows: Range<u64>) -> Result<(), Failure> {
    numbers_in(logs, "").range(rows).try_for_each(|row| Target::check_log(&one::log_name(logs, *row)))
}

/// Writes the full logs of rows that were run before. `false` where somebody asked to stop.
fn make_logs(study: &Study, rows: &[u64], logs: &Path, pool: &rayon::ThreadPool) -> Result<bool, Failure> {
    if rows.is_empty() {
        return Ok(true);
    }
    let progress = CommandProgress::of(rows.len() as u64, "logs");
    let one = |&row: &u64| {
        if !interrupt::asked_to_stop() && one::log_again(study, row, logs)? {
            progress.step();
        }
        Ok(())
    };
    let made: Result<(), Failure> = pool.install(|| rows.par_iter().with_max_len(1).try_for_each(one));
    drop(progress);
    made?;
    if interrupt::asked_to_stop() {
        return Ok(false);
    }
    note(format!("wrote the full logs of {} made before", counted(rows.len(), "run")));
    Ok(true)
}

/// A part that is there: it must be whole and of this study. Full logs to keep that are not there are written.
fn finished(
    study: &Study,
    part: &Path,
    jobs: Option<usize>,
    (keep, logs): (Keep, &Path),
    data: &mut Data,
) -> Result<Outcome, Failure> {
    let refused = |error| merge::refused(part, &error);
    let mut reader = PartReader::new(BufReader::new(open(part)?)).map_err(refused)?;
    let is_ours = reader.head().study == study.line();
    let (mut count, mut without) = (0_u64, Vec::new());
    // to the end, where the seal proves the rows and the study
    while let Some((row, _)) = reader.row().map_err(refused)? {
        count += 1;
        if is_ours && one::lacks_log(study, &row, keep, logs) {
            without.push(row.row);
        }
    }
    if !is_ours {
        return Err(Failure::input(
            format!("{}: it is of another study", part.display()),
            "Name another folder with -o, or take the part away.",
        ));
    }
    if !make_logs(study, &without, logs, &pool(jobs)?)? {
        say("stopped; the same command goes on");
        return Ok(Outcome::Stopped);
    }
    data.line(format!("{}, finished before", counted(count, "run")))?;
    Ok(Outcome::Done)
}
