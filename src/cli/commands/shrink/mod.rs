//! `shrink`: the smallest run that still shows something.

mod exec;
mod report;
mod shown;
mod written;

use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab_sim::run::{Log, LogKind, Recipe};
use motion_lab_sim::shrink::{ShrinkEnd, ShrinkOptions, shrink};

use crate::cli::support::choices::{Site, log_kind};
use crate::cli::support::input::is_dash;
use crate::cli::support::interrupt;
use crate::cli::support::log_source::{LogSource, read_log};
use crate::cli::support::output::write_file;
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::target::Target;
use crate::cli::support::words::counted;
use crate::cli::{Data, Failure, Outcome, say};
use exec::ExitCheck;
use report::ShrinkReport;
use shown::Shown;
use written::{WrittenCondition, quoted};

/// Shrink a run to the smallest one that still shows something: fewer worlds, robots, obstacles and inputs, less time,
/// numbers with fewer digits.
///
/// A condition compares the numbers of robots that `stats --json` lists, ROBOT.COLUMN, such as Hitch.contacts and
/// Rusty.path_m, or the digest, by == or !=. Comparisons are joined by && and ||, of which && binds closer. A name with
/// one of the characters <>=!&|" stands between quotes; a quote or a backslash in it has a backslash before it.
///
/// What is left is 1-minimal: without any single thing of it, or a tick shorter, it no longer shows it. It is the same
/// for any number of jobs. After Ctrl-C or the last try allowed, the best so far is kept, and the exit code is 75.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab shrink run.mcap --while Hitch.contacts!=0
  motion-lab shrink run.mcap --while Rusty.refusals==2 -o small.mcap
  motion-lab shrink run.mcap --exec ./check --exit 4
  motion-lab shrink run.mcap --while Hitch.contacts!=0 --keep-worlds --json")]
pub struct ShrinkArgs {
    /// The log of the run; `-` is standard input.
    #[arg(value_name = "RUN")]
    file: PathBuf,
    /// What the run shows: `Hitch.contacts > 0`.
    #[arg(long = "while", value_name = "CONDITION", required_unless_present = "exec")]
    condition: Option<WrittenCondition>,
    /// A command that tells by its exit code whether a run shows it. `sh` runs it for each candidate, with the path of
    /// the candidate's log in place of {}, or behind it: 'other-lab verify {}'. With --while too, both have to hold.
    #[arg(long, value_name = "COMMAND")]
    exec: Option<String>,
    /// The exit code of that command where a run shows it. [default: 0]
    #[arg(long, value_name = "N", requires = "exec")]
    exit: Option<u8>,
    /// The log of the shrunk run. [default: RUN's name with .shrunk.mcap for its ending]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What that log keeps, and those for --exec: `full`, every frame, or `digest`, a digest of each second.
    /// [default: as RUN does]
    #[arg(long, value_name = "KIND", value_parser = log_kind(), hide_possible_values = true)]
    log: Option<LogKind>,
    /// How many runs at once, at most 256. It changes nothing of what is left. [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// How many runs are tried at most.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    tries: u64,
    /// Leave each world as it is, or out, so that a run in the lab's own worlds keeps a short link.
    #[arg(long)]
    keep_worlds: bool,
    #[command(flatten)]
    site: Site,
    /// One line of JSON.
    #[arg(long)]
    json: bool,
}

impl ShrinkArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let LogSource { log, damage, .. } = read_log(&self.file)?;
        if let Some(damage) = &damage {
            say(format!("{damage}\nIts run is simulated again: seed, worlds and script are whole."));
        }
        let output = self.output.clone().unwrap_or_else(|| default_output(&self.file));
        let target = Target::log(&output)?;
        let kind = self.log.unwrap_or(log.kind());
        let command =
            self.exec.as_deref().map(|text| ExitCheck::new(text, self.exit.unwrap_or(0), kind)).transpose()?;
        let shown = Shown::new(self.condition.as_ref().map(|written| &written.condition), command);
        interrupt::listen();
        if !shown.check(&self.file, &log.recipe)? {
            say("stopped before the run itself was tried; nothing was written");
            return Ok(Outcome::Stopped);
        }
        let options = ShrinkOptions { jobs: self.jobs(), max_tries: self.tries, keeps_worlds: self.keep_worlds };
        let progress = CommandProgress::uncounted("runs");
        let holds = |recipe: &Recipe| {
            let holds = shown.holds(recipe);
            progress.step();
            holds
        };
        let shrunk = shrink(&log.recipe, &options, holds, || shown.goes_on());
        drop(progress);
        shown.failure()?;
        let small = recorded(&shrunk.recipe, kind)?;
        let mut bytes = Vec::new();
        small.write_mcap(&mut bytes).map_err(Failure::internal)?;
        write_file(&target, &bytes)?;
        let report = ShrinkReport::new(&shrunk, &small, self.keep_worlds, &self.site.site);
        if self.json {
            data.json(&report)?
        } else {
            report.print(data)?
        }
        target.wrote();
        let tries = counted(shrunk.tries, "run");
        let most = match shrunk.end {
            ShrinkEnd::Minimal if damage.is_some() => return Ok(Outcome::Recovered),
            ShrinkEnd::Minimal => return Ok(Outcome::Done),
            ShrinkEnd::TriesSpent => ", the most allowed",
            ShrinkEnd::Stopped => "",
        };
        let again = self.again(&output);
        say(format!("stopped after {tries}{most}; less may show it too\nShrink what is left: {again}"));
        Ok(Outcome::Stopped)
    }

    /// The command line, for `sh`, that shrinks the run in `left` further, by the same condition and command.
    fn again(&self, left: &Path) -> String {
        let left = left.display().to_string();
        // a name that begins as options do is none behind its folder
        let left = if left.starts_with('-') { format!("./{left}") } else { left };
        let mut line = format!("motion-lab shrink {}", quoted(&left));
        let mut option = |name: &str, value: &str| {
            let joint = if value.starts_with('-') { "=" } else { " " };
            line.push_str(&format!(" {name}{joint}{}", quoted(value)));
        };
        if let Some(condition) = &self.condition {
            option("--while", &condition.text);
        }
        if let Some(command) = &self.exec {
            option("--exec", command);
        }
        if let Some(code) = self.exit {
            option("--exit", &code.to_string());
        }
        if self.keep_worlds {
            line.push_str(" --keep-worlds");
        }
        line
    }

    fn jobs(&self) -> usize {
        let processors = || std::thread::available_parallelism().map_or(1, usize::from);
        self.jobs.map_or_else(processors, usize::from)
    }
}

/// The log of a shrunk run. It is made even after Ctrl-C.
fn recorded(recipe: &Recipe, kind: LogKind) -> Result<Log, Failure> {
    motion_lab_sim::recording::Run::record_recipe(recipe.clone(), kind, |_| {}).map_err(Failure::internal)
}

/// The log of the shrunk run where nobody names one.
fn default_output(run: &Path) -> PathBuf {
    if is_dash(run) { "shrunk.mcap".into() } else { run.with_extension("shrunk.mcap") }
}
