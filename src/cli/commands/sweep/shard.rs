//! Running a shard: its missing rows into the journal, then the part.

use std::fs;
use std::io::BufReader;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use motion_lab::sweep::{PartHead, PartReader, Shard, SweepPlan};
use rayon::prelude::*;

use super::journal::Journal;
use super::one::{self, Ran};
use super::{Keep, merge};
use crate::cli::support::console::note;
use crate::cli::support::input::open;
use crate::cli::support::interrupt;
use crate::cli::support::progress::Progress;
use crate::cli::{Data, Failure, Outcome, say};

/// A thread for each of the jobs; one for each processor where nobody says.
pub fn pool(jobs: Option<usize>) -> Result<rayon::ThreadPool, Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(jobs.unwrap_or(0)).build().map_err(Failure::internal)
}

/// Runs the rows of a shard that are not there yet.
pub fn run(
    plan: &SweepPlan,
    shard: Shard,
    folder: &Path,
    jobs: Option<usize>,
    keep: Keep,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    interrupt::listen()?;
    let logs = folder.join("logs");
    let needed = if keep == Keep::None { folder } else { &logs };
    fs::create_dir_all(needed).map_err(|error| Failure::output(needed, &error))?;
    let part = folder.join(format!("part-{shard}.sweep"));
    if part.exists() {
        return finished(plan, &part, data);
    }
    let head = PartHead::new(plan, shard.rows(plan.runs()));
    let count = head.rows.end - head.rows.start;
    let journal = Journal::open(&folder.join(format!("part-{shard}.journal")), head, plan.columns())?;
    let missing = journal.missing();
    let before = count - missing.len() as u64;
    if before > 0 {
        let logs = if keep == Keep::None { "" } else { "; their logs are not made again: `sweep reproduce` does" };
        note(format!("{before} of {count} rows are there already{logs}"));
    }
    let pool = pool(jobs)?;
    let progress = Progress::of_runs(count, before);
    let (journal, failures) = (Mutex::new(journal), AtomicU64::new(0));
    let one = |&row: &u64| {
        if interrupt::asked_to_stop() {
            return Ok(());
        }
        let Ran::Row(row) = one::run(plan, row, keep, &logs)? else { return Ok(()) };
        let line = row.to_line();
        journal.lock().unwrap_or_else(PoisonError::into_inner).add(row.row, &line)?;
        if row.is_failure(plan.columns()) {
            progress.failed(failures.fetch_add(1, Ordering::Relaxed) + 1);
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
        say(format!("stopped with {} of {count} rows done\nThe same command goes on.", count - left));
        return Ok(Outcome::Stopped);
    }
    journal.finish(&part, plan.columns())?;
    note(format!("wrote {}", part.display()));
    let failures = failures.into_inner();
    data.line(format!("{count} runs; of the {} made now {failures} failed", count - before))?;
    if shard == Shard::WHOLE {
        note(format!("For one table: motion-lab sweep merge {} -o table.parquet", folder.display()));
    }
    Ok(Outcome::Done)
}

/// A part that is there: it must be whole and of this plan.
fn finished(plan: &SweepPlan, part: &Path, data: &mut Data) -> Result<Outcome, Failure> {
    let mut reader = PartReader::new(BufReader::new(open(part)?)).map_err(|error| merge::refused(part, &error))?;
    if reader.head().plan != plan.line() {
        return Err(Failure::input(
            format!("{}: it is of another plan", part.display()),
            "Name another folder with -o, or take the part away.",
        ));
    }
    let mut count = 0_u64;
    while reader.row().map_err(|error| merge::refused(part, &error))?.is_some() {
        count += 1;
    }
    data.line(format!("{count} runs, finished before"))?;
    Ok(Outcome::Done)
}
