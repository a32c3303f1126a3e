//! Several planners on one problem, or on those of a file, at several seeds.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use motion_lab_core::robots::AnyRobot;
use motion_lab_sim::capture::{CostFigure, costs, proven};
use motion_lab_sim::plans::PlannerName;

use super::answer::PlanAnswer;
use super::args::PlanArgs;
use crate::batch::{ComparedAttempt, NoProblem, PlannerComparison, PlannerMedians, ProblemSet};
use crate::capture::CaptureForm;
use crate::cli::commands::record::SeedRange;
use crate::cli::support::input::is_dash;
use crate::cli::support::interrupt;
use crate::cli::support::output::write_file;
use crate::cli::support::paper::write_picture;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::{Data, Failure, Outcome, say};

/// The seeds of a comparison without `--seeds`.
const SEEDS: SeedRange = SeedRange { first: 0, end: 100 };

/// The seeds for each of a file's problems without `--seeds`.
const SEEDS_OF_PROBLEMS: SeedRange = SeedRange { first: 0, end: 1 };

/// The most problems that get a log of OMPL's each.
const MAX_LOGS: u64 = 10_000;

/// Compares planners: prints a table, and writes a row for each attempt where that is asked for.
pub fn compare(args: &PlanArgs, problems: ProblemSet, data: &mut Data) -> Result<Outcome, Failure> {
    let is_of_problems = args.problems.is_some();
    let seeds = args.seeds.unwrap_or(if is_of_problems { SEEDS_OF_PROBLEMS } else { SEEDS });
    let table = args.csv.as_deref().map(Target::of).transpose()?;
    let costs = args.costs.as_deref().map(Target::of).transpose()?;
    let ompl = args.ompl.as_deref().map(|path| ompl_targets(path, &problems)).transpose()?;
    // each once, whatever the command line repeats
    let is_first = |(i, planner): &(usize, &PlannerName)| !args.compare[..*i].contains(planner);
    let planners: Vec<_> = args.compare.iter().enumerate().filter(is_first).map(|(_, planner)| *planner).collect();
    if let Some(robot) = problems.kinds().first().and_then(|kind| AnyRobot::model(kind.name, None)) {
        planners.iter().try_for_each(|planner| super::task::fits(*planner, &robot))?;
    }
    let mixed = |mixed| Failure::usage(mixed, "Compare by those of one robot: give --robot.");
    let mut comparison = PlannerComparison::of_problems(problems, planners, seeds.first..seeds.end).map_err(mixed)?;
    comparison.iterations = args.iterations;
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
        print(&lines, comparison.unit(), is_of_problems, data)?;
        asked_in_words(args, &attempts).map_or(Ok(()), |words| data.line(words))?;
    }
    if let Some(target) = table {
        write_file(&target, &rows(&comparison, &attempts, target.path())?)?;
        target.finish(data)?;
    }
    if let Some(target) = costs {
        write_costs(args, &comparison, &attempts, &target)?;
        target.finish(data)?;
    }
    if let Some(mut targets) = ompl {
        for (number, log) in comparison.ompl_logs(&attempts, env!("CARGO_PKG_VERSION")) {
            let Some(target) = targets.remove(&number) else { continue };
            write_file(&target, log.as_bytes())?;
            target.finish(data)?;
        }
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
    let task = comparison.problems().problem(0).and_then(|problem| problem.task.ok());
    if let (true, Some(task)) = (args.json, task) {
        data.json(&PlanAnswer::of_none(&task, *planner, seed.0, reason))?;
    } else {
        say(format!("{}\n{}", super::advice::in_words(&reason.to_string()), super::advice::next(reason)));
    }
    Ok(Outcome::NoPath)
}

/// The lengths as they fell: as a picture where the file's name ends so, else as CSV.
fn write_costs(
    args: &PlanArgs,
    comparison: &PlannerComparison,
    attempts: &[ComparedAttempt],
    target: &Target,
) -> Result<(), Failure> {
    let form = CaptureForm::of(target.path()).filter(|form| matches!(form, CaptureForm::Svg | CaptureForm::Png));
    let Some(form) = form else { return write_file(target, comparison.costs_csv(attempts).as_bytes()) };
    let asked = attempts.iter().filter(|attempt| attempt.case.asked.is_some()).count();
    let count = asked / comparison.planners.len().max(1);
    let problems = comparison.problems();
    let problem = match problems.problem(0).and_then(|problem| problem.task.ok()).filter(|_| problems.len() == 1) {
        Some(task) => format!("{} in {}", task.name, task.world.name),
        None => format!("{} problems", problems.len()),
    };
    let lines = comparison.median_costs(attempts);
    let sheet = CostFigure { lines, attempts: count, unit: comparison.unit(), problem };
    let paper = args.paper.paper();
    write_picture(&costs(&sheet, f64::from(paper.width)), &paper, form, target)
}

/// The table of the attempts: as Parquet where the file's name ends so, else as CSV.
fn rows(comparison: &PlannerComparison, attempts: &[ComparedAttempt], path: &Path) -> Result<Vec<u8>, Failure> {
    if path.extension().is_some_and(|extension| extension == "parquet") {
        return comparison.parquet(attempts, Vec::new()).map_err(Failure::internal);
    }
    Ok(comparison.csv(attempts).into_bytes())
}

/// A log for each problem: for a single one the file itself.
fn ompl_targets(path: &Path, problems: &ProblemSet) -> Result<BTreeMap<u64, Target>, Failure> {
    if problems.len() == 1 {
        return problems.numbers().map(|number| Ok((number, Target::of(path)?))).collect();
    }
    if is_dash(path) {
        return Err(Failure::usage("--ompl -: standard output can't take a log for each problem", "Name a file."));
    }
    if problems.len() > MAX_LOGS {
        let reason = format!("--ompl: {} problems have a log each, and {MAX_LOGS} are the most", problems.len());
        return Err(Failure::usage(reason, "Use --csv, which has a row for each attempt."));
    }
    problems.numbers().map(|number| Ok((number, Target::file(&numbered(path, number))?))).collect()
}

/// A path with a number before its ending: `all.log`, `all.3.log`.
fn numbered(path: &Path, number: u64) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{number}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

/// What clearance was asked of the paths, where somebody says one, and where it is not the same for all planners.
fn asked_in_words(args: &PlanArgs, attempts: &[ComparedAttempt]) -> Option<String> {
    if let Some(kept) = args.clearance {
        return Some(format!("all were asked to keep {kept} m from obstacles"));
    }
    let mut by_clearance: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for attempt in attempts {
        let Some(kept) = attempt.clearance_asked else { continue };
        let planners = by_clearance.entry(kept.to_string()).or_default();
        if !planners.contains(&attempt.planner.id()) {
            planners.push(attempt.planner.id());
        }
    }
    let kept: Vec<String> =
        by_clearance.iter().map(|(kept, planners)| format!("{kept} m by {}", planners.join(", "))).collect();
    (kept.len() > 1).then(|| {
        let kept = kept.join("; ");
        format!("not all were asked to keep the same from obstacles: {kept}; --clearance is one for all")
    })
}

fn print(lines: &[PlannerMedians], unit: &str, is_of_problems: bool, data: &mut Data) -> Result<(), Failure> {
    let widest = |head: &str, of: fn(&PlannerMedians) -> usize| lines.iter().map(of).fold(head.len(), usize::max);
    let (width, set_width) = (
        widest("planner", |line| line.planner.len()),
        widest("set", |line| line.set.as_ref().map_or(0, |set| set.chars().count())),
    );
    let is_of_sets = lines.iter().any(|line| line.set.is_some());
    let set = |name: &str| if is_of_sets { format!("{name:set_width$}  ") } else { String::new() };
    let is_of_optimal = is_of_problems && lines.iter().any(|line| line.of_optimal.is_some());
    let length = format!("length {unit}");
    data.line(format!(
        "{}{:width$}  {:>11}  {:>9}  {:>8}  {length:>10}  {:>11}{}",
        set("set"),
        "planner",
        "solved",
        "time ms",
        "edges",
        "clearance m",
        if is_of_optimal { "  of optimal" } else { "" }
    ))?;
    let number = |x: Option<f64>, digits: usize| x.map_or("-".to_owned(), |x| format!("{x:.digits$}"));
    for line in lines {
        let solved = format!("{} of {}", line.solved, line.attempts);
        data.line(format!(
            "{}{:width$}  {solved:>11}  {:>9}  {:>8}  {:>10}  {:>11}{}",
            set(line.set.as_deref().unwrap_or("")),
            line.planner,
            number(line.milliseconds, 2),
            number(line.edges, 0),
            number(line.length.map(|length| length.0), 3),
            line.clearance.map_or("-".to_owned(), |clearance| proven(clearance.0)),
            if is_of_optimal { format!("  {:>10}", number(line.of_optimal, 3)) } else { String::new() }
        ))?;
    }
    data.line("medians over the attempts that have a path")
}
