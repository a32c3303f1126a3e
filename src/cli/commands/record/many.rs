//! Many seeds at once, their lines in order.

use rayon::prelude::*;

use super::args::RecordArgs;
use super::log_names::LogNames;
use super::one::{Ended, StopRule, refused_in_words, run, write_run};
use super::seeds::SeedRange;
use super::written::RecordedLogs;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::summary::RunSummary;
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome, say};
use motion_lab_core::random::Seed;
use motion_lab_sim::run::Recipe;

/// Number of runs per thread in a batch. The lines of a batch are printed when all its runs have ended.
const AHEAD: u64 = 4;

/// Records a run for each seed: the recipe with this seed in place of its own.
pub fn record(options: &RecordArgs, seeds: SeedRange, recipe: &Recipe, data: &mut Data) -> Result<Outcome, Failure> {
    let mut written = RecordedLogs::default();
    let outcome = record_each(options, seeds, recipe, &mut written, data);
    written.say();
    outcome
}

fn record_each(
    options: &RecordArgs,
    seeds: SeedRange,
    recipe: &Recipe,
    written: &mut RecordedLogs,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    let output = options.output.as_deref().map(LogNames::of).transpose()?;
    let mut are_apart = false;
    if let Some(names) = &output {
        names.check(seeds)?;
        are_apart = names.are_apart(seeds);
    }
    let kind = options.kind(&recipe.config);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(options.threads.unwrap_or(0))).build();
    let pool = pool.map_err(Failure::internal)?;
    let mut refused: Option<(u64, u64, String)> = None;
    let batch = AHEAD * pool.current_num_threads() as u64;
    let progress = CommandProgress::of(seeds.end - seeds.first, "seeds");
    let stop = StopRule { unwatched: true, at_refusal: options.strict, ..StopRule::default() };
    let mut first = seeds.first;
    while first < seeds.end && !data.is_closed() {
        let end = seeds.end.min(first.saturating_add(batch));
        let one = |seed: u64| {
            let recipe = Recipe { seed: Seed(seed), ..recipe.clone() };
            let ended = match output.as_ref().map(|names| names.log(seed)) {
                Some(log) => Target::log(&log).and_then(|target| {
                    let (ended, older) = (write_run(&recipe, kind, None, stop, &target), target.older());
                    if are_apart {
                        target.release();
                    }
                    ended.map(|ended| (ended, Some(older)))
                }),
                None => run(&recipe, stop, |_| {}).map(|ended| (ended, None)),
            };
            progress.step();
            ended
        };
        let ended: Vec<_> = pool.install(|| (first..end).into_par_iter().map(one).collect());
        let mut failure = None;
        for (seed, ended) in (first..end).zip(ended) {
            let (ended, log) = match ended {
                Ok(ended) => ended,
                // the others of these runs are whole, and their logs are written
                Err(error) => {
                    failure = failure.or(Some(error));
                    continue;
                }
            };
            if let Ended::Whole { refusals, .. } = &ended
                && let Some(event) = refusals.first()
            {
                let (runs, count, _) = refused.get_or_insert_with(|| (0, 0, format!("{event} (seed {seed})")));
                (*runs, *count) = (*runs + 1, *count + refusals.count());
            }
            if let (Ended::Whole { .. }, Some(older)) = (&ended, log) {
                written.add(seed, older);
            }
            match ended {
                Ended::Whole { last, digest, .. } if options.json => {
                    let recipe = Recipe { seed: Seed(seed), ..recipe.clone() };
                    data.json(&RunSummary::new(&recipe, &last, digest))?;
                }
                Ended::Whole { digest, .. } => data.line(format!("{seed} {digest}"))?,
                Ended::Stopped(_) | Ended::Differs(_) => {
                    say(format!("stopped before seed {seed}\nGo on with: --seeds {seed}..{}", seeds.end));
                    return Ok(Outcome::Stopped);
                }
            }
        }
        data.flush()?;
        if let Some(failure) = failure {
            return Err(failure);
        }
        first = end;
    }
    if let Some((runs, count, event)) = refused {
        say(format!("in {} {}", counted(runs, "run"), refused_in_words(count, &event)));
    }
    Ok(Outcome::Done)
}
