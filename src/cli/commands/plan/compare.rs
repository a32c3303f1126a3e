//! Several planners on one problem, or on those of a scenario, at several seeds.

use std::path::Path;

use motion_lab_sim::capture::{proven, unit};
use motion_lab_sim::plans::{PlannerName, Task};

use super::answer::PlanAnswer;
use super::args::PlanArgs;
use crate::batch::{ComparedAttempt, NoProblem, PlanCase, PlannerComparison, PlannerMedians};
use crate::cli::commands::record::SeedRange;
use crate::cli::support::interrupt;
use crate::cli::support::output::write_file;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// The seeds of a comparison without `--seeds`.
const SEEDS: SeedRange = SeedRange { first: 0, end: 100 };

/// The seeds for each of a scenario's problems without `--seeds`.
const SEEDS_OF_PROBLEMS: SeedRange = SeedRange { first: 0, end: 1 };

/// Compares planners: prints a table, and writes a row for each attempt where that is asked for.
pub fn compare(args: &PlanArgs, task: Task, cases: Vec<PlanCase>, data: &mut Data) -> Result<Outcome, Failure> {
    let is_of_problems = args.problems.is_some();
    let seeds = args.seeds.unwrap_or(if is_of_problems { SEEDS_OF_PROBLEMS } else { SEEDS });
    let table = args.csv.as_deref().map(Target::of).transpose()?;
    let costs = args.costs.as_deref().map(Target::of).transpose()?;
    // each once, whatever the command line repeats
    let is_first = |(i, planner): &(usize, &PlannerName)| !args.compare[..*i].contains(planner);
    let planners: Vec<_> = args.compare.iter().enumerate().filter(is_first).map(|(_, planner)| *planner).collect();
    planners.iter().try_for_each(|planner| super::task::fits(*planner, &task.robot))?;
    let comparison =
        PlannerComparison { task, cases, planners, seeds: seeds.first..seeds.end, iterations: args.iterations };
    let progress = CommandProgress::of(comparison.count(), "attempts");
    interrupt::listen();
    let made = comparison.run(|done| {
        progress.at(done);
        !interrupt::asked_to_stop()
    });
    drop(progress);
    let attempts = match made {
        Ok(attempts) => attempts,
        Err(none) => return no_problem(args, &comparison, &none, data),
    };
    let lines = comparison.medians(&attempts);
    if args.json {
        data.json(&lines)?;
    } else {
        print(&lines, unit(&comparison.task.robot), is_of_problems, data)?;
    }
    if let Some(target) = table {
        write_file(&target, &rows(&comparison, &attempts, target.path())?)?;
        target.finish(data)?;
    }
    if let Some(target) = costs {
        write_file(&target, comparison.costs_csv(&attempts).as_bytes())?;
        target.finish(data)?;
    }
    if (attempts.len() as u64) < comparison.count() {
        say(format!("stopped after {} of {} attempts, which are kept", attempts.len(), comparison.count()));
        return Ok(Outcome::Stopped);
    }
    Ok(if lines.iter().all(|line| line.solved == 0) { Outcome::NoPath } else { Outcome::Done })
}

/// Says that the problem is none: an end in contact is so for every planner and every seed.
fn no_problem(
    args: &PlanArgs,
    comparison: &PlannerComparison,
    none: &NoProblem,
    data: &mut Data,
) -> Result<Outcome, Failure> {
    let NoProblem { planner, seed, reason } = none;
    if args.json {
        data.json(&PlanAnswer::of_none(&comparison.task, *planner, seed.0, reason))?;
    } else {
        say(format!("{}\n{}", super::advice::in_words(&reason.to_string()), super::advice::next(reason)));
    }
    Ok(Outcome::NoPath)
}

/// The table of the attempts: as Parquet where the file's name ends so, else as CSV.
fn rows(comparison: &PlannerComparison, attempts: &[ComparedAttempt], path: &Path) -> Result<Vec<u8>, Failure> {
    if path.extension().is_some_and(|extension| extension == "parquet") {
        return comparison.parquet(attempts, Vec::new()).map_err(Failure::internal);
    }
    Ok(comparison.csv(attempts).into_bytes())
}

fn print(lines: &[PlannerMedians], unit: &str, is_of_problems: bool, data: &mut Data) -> Result<(), Failure> {
    let width = lines.iter().map(|line| line.planner.len()).max().unwrap_or(0).max(7);
    let length = format!("length {unit}");
    data.line(format!(
        "{:width$}  {:>11}  {:>9}  {:>8}  {length:>10}  {:>11}{}",
        "planner",
        "solved",
        "time ms",
        "edges",
        "clearance m",
        if is_of_problems { "  of optimal" } else { "" }
    ))?;
    let number = |x: Option<f64>, digits: usize| x.map_or("-".to_owned(), |x| format!("{x:.digits$}"));
    for line in lines {
        let solved = format!("{} of {}", line.solved, line.attempts);
        data.line(format!(
            "{:width$}  {solved:>11}  {:>9}  {:>8}  {:>10}  {:>11}{}",
            line.planner,
            number(line.milliseconds, 2),
            number(line.edges, 0),
            number(line.length.map(|length| length.0), 3),
            line.clearance.map_or("-".to_owned(), |clearance| proven(clearance.0)),
            if is_of_problems { format!("  {:>10}", number(line.of_optimal, 3)) } else { String::new() }
        ))?;
    }
    data.line("medians over the attempts that have a path")
}
