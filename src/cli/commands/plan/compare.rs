//! Several planners on one problem, at several seeds.

use std::fmt::Write as _;
use std::time::Instant;

use motion_lab::capture::{proven, unit};
use motion_lab::configuration::{AnyConfiguration, Configuration as _};
use motion_lab::export::{JsonNumber, csv_cell};
use motion_lab::planning::{Effort, NoPath};
use motion_lab::plans::{PathLengths, PlannerName, Task};
use motion_lab::random::Seed;
use serde::Serialize;

use super::answer::PlanAnswer;
use super::args::PlanArgs;
use super::cases::{Case, KnownProblem};
use super::rounds::solve;
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

/// What came of one planner at one seed.
struct Row {
    case: Case,
    planner: PlannerName,
    seed: u64,
    effort: Effort,
    seconds: f64,
    /// Length and clearance of the path, or why there is none.
    path: Result<PathLengths, String>,
}

/// What came of one planner at all seeds: medians over the attempts that have a path.
#[derive(Debug, Serialize)]
struct PlannerMedians {
    planner: String,
    solved: usize,
    attempts: usize,
    milliseconds: Option<f64>,
    edges: Option<f64>,
    length: Option<JsonNumber>,
    clearance: Option<JsonNumber>,
    /// The length as a share of the shortest one that the scenario says.
    #[serde(skip_serializing_if = "Option::is_none")]
    of_optimal: Option<f64>,
}

/// Compares planners: prints a table, and writes a row for each attempt where that is asked for.
pub fn compare(args: &PlanArgs, mut task: Task, cases: &[Case], data: &mut Data) -> Result<Outcome, Failure> {
    let is_of_problems = args.problems.is_some();
    let seeds = args.seeds.unwrap_or(if is_of_problems { SEEDS_OF_PROBLEMS } else { SEEDS });
    let target = args.csv.as_deref().map(Target::of).transpose()?;
    // each once, whatever the command line repeats
    let is_first = |(i, planner): &(usize, &PlannerName)| !args.compare[..*i].contains(planner);
    let planners: Vec<_> = args.compare.iter().enumerate().filter(is_first).map(|(_, planner)| *planner).collect();
    let count = (seeds.end - seeds.first).saturating_mul(planners.len() as u64).saturating_mul(cases.len() as u64);
    let progress = CommandProgress::of(count, "attempts");
    interrupt::listen();
    let (mut rows, mut is_stopped) = (Vec::new(), false);
    let of_planner = |planner| cases.iter().map(move |case| (planner, case));
    'all: for (planner, case) in planners.iter().copied().flat_map(of_planner) {
        [task.start, task.goal] = case.ends;
        for seed in seeds.first..seeds.end {
            is_stopped = interrupt::asked_to_stop();
            if is_stopped {
                break 'all;
            }
            match row(args, &task, case, (planner, seed))? {
                Ok(Some(row)) => rows.push(row),
                Ok(None) => {
                    is_stopped = true;
                    break 'all;
                }
                // an end in contact is so for every planner and every seed
                Err(reason) => {
                    drop(progress);
                    if args.json {
                        data.json(&PlanAnswer::of_none(&task, planner, seed, &reason))?;
                        return Ok(Outcome::NoPath);
                    }
                    say(format!("{}\n{}", super::advice::in_words(&reason.to_string()), super::advice::next(&reason)));
                    return Ok(Outcome::NoPath);
                }
            }
            progress.at(rows.len() as u64);
        }
    }
    drop(progress);
    let lines: Vec<PlannerMedians> = planners.iter().map(|planner| line(*planner, &rows)).collect();
    if args.json {
        data.json(&lines)?;
    } else {
        print(&lines, unit(&task.robot), is_of_problems, data)?;
    }
    if let Some(target) = target {
        write_file(&target, csv(&task, &rows, is_of_problems).as_bytes())?;
        target.finish(data)?;
    }
    if is_stopped {
        say(format!("stopped after {} of {count} attempts, which are kept", rows.len()));
        return Ok(Outcome::Stopped);
    }
    Ok(if lines.iter().all(|line| line.solved == 0) { Outcome::NoPath } else { Outcome::Done })
}

/// A row, or why there is no problem. `None` where somebody asked to stop.
fn row(
    args: &PlanArgs,
    task: &Task,
    case: &Case,
    (planner, seed): (PlannerName, u64),
) -> Result<Result<Option<Row>, NoPath>, Failure> {
    let case = *case;
    let begun = Instant::now();
    let mut attempt = match super::task::attempt(task, planner, Seed(seed))? {
        Ok(attempt) => attempt,
        Err(reason @ NoPath::Problem(_)) if case.problem.is_none() => return Ok(Err(reason)),
        Err(reason) => {
            let (effort, path) = (Effort::default(), Err(reason.to_string()));
            return Ok(Ok(Some(Row { case, planner, seed, effort, seconds: 0.0, path })));
        }
    };
    let Some(solved) = solve(attempt.as_mut(), planner, args.iterations, |_| {}) else { return Ok(Ok(None)) };
    let seconds = begun.elapsed().as_secs_f64();
    let path = solved.map(|()| attempt.lengths()).map_err(|reason| reason.to_string());
    Ok(Ok(Some(Row { case, planner, seed, effort: attempt.effort(), seconds, path })))
}

/// The middle of some numbers; the mean of the two middle ones of an even count. `None` without any.
fn median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    let n = numbers.len();
    (n > 0).then(|| 0.5 * (numbers[(n - 1) / 2] + numbers[n / 2]))
}

fn line(planner: PlannerName, rows: &[Row]) -> PlannerMedians {
    let own: Vec<&Row> = rows.iter().filter(|row| row.planner == planner).collect();
    let solved: Vec<(&Row, PathLengths)> =
        own.iter().filter_map(|row| Some((*row, *row.path.as_ref().ok()?))).collect();
    let of =
        |number: fn(&Row, PathLengths) -> f64| median(solved.iter().map(|(row, path)| number(row, *path)).collect());
    PlannerMedians {
        planner: planner.id().to_owned(),
        solved: solved.len(),
        attempts: own.len(),
        milliseconds: of(|row, _| 1000.0 * row.seconds),
        edges: of(|row, _| row.effort.edges as f64),
        length: of(|_, path| path.length).map(JsonNumber),
        clearance: of(|_, path| path.clearance).map(JsonNumber),
        of_optimal: median(solved.iter().filter_map(|(row, path)| row.case.of_optimal(path.length)).collect()),
    }
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

/// A row for each attempt; a path's columns are empty where there is none. A scenario's problems have three more.
fn csv(task: &Task, rows: &[Row], is_of_problems: bool) -> String {
    let head = "planner,seed,solved,time_s,iterations,samples,edges,free";
    let mut text = format!("{head},length_{},clearance_m,reason,robot,world,start,goal", unit(&task.robot));
    text.push_str(if is_of_problems { ",problem,bucket,optimal_m\n" } else { "\n" });
    let numbers = |q: &AnyConfiguration| {
        let numbers: Vec<String> = q.coordinates().iter().map(f64::to_string).collect();
        format!("\"{}\"", numbers.join(","))
    };
    let (robot, world) = (csv_cell(&task.name), csv_cell(&task.world.name));
    for Row { case, planner, seed, effort, seconds, path } in rows {
        let [start, goal] = &case.ends;
        let mut problem = format!("{robot},{world},{},{}", numbers(start), numbers(goal));
        if let Some(KnownProblem { number, bucket, optimal }) = case.problem {
            _ = write!(problem, ",{number},{bucket},{optimal}");
        }
        let Effort { iterations, samples, edges, free } = effort;
        let name = planner.id();
        let (solved, length, clearance, reason) = match path {
            Ok(PathLengths { length, clearance }) => (true, length.to_string(), clearance.to_string(), String::new()),
            Err(reason) => (false, String::new(), String::new(), csv_cell(reason)),
        };
        let counts = format!("{iterations},{samples},{edges},{free}");
        _ = writeln!(text, "{name},{seed},{solved},{seconds},{counts},{length},{clearance},{reason},{problem}");
    }
    text
}
