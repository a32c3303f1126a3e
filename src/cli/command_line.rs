//! `Cli`, the command line: what it says, and the command that it names.

use clap::{CommandFactory, Parser, Subcommand};

use super::commands::{
    bare, capture, completions, describe, diff, export, grade, info, link, plan, plot, problems, query, record, replay,
    script, shrink, stats, sweep, verify, why, world,
};

use super::support::console::be_quiet;
use super::support::end::{Failure, Outcome};
use super::support::{console::Data, gate, interrupt};

/// Examples and the exit codes, as `--help` and `docs/cli.md` list them.
const EXIT_CODES: &str = "\
Examples:
  motion-lab record --seed 7 --seconds 10 -o seven.mcap
  motion-lab verify seven.mcap
  motion-lab export seven.mcap -o seven.png
  motion-lab query distance --robot rusty 3,5.5

Exit codes:
   0  done
   1  internal error, or an output that could not be written
   2  the command line is wrong
   3  an input file is missing or wrong
   4  the replay differs from the recording or one log from the other, a graded submission does not pass, a planner has
      found no path, or a contact no way out
   5  the file is damaged or unfinished; its sealed beginning was used
   6  there is no display for the window
   7  a planner has proven that there is no path
  75  stopped early; `record --resume`, or the same `sweep` again, goes on; `plan --compare`, `shrink` and `why` keep
      what they found
 130  ended at once by Ctrl-C or a termination signal

Data goes to standard output, messages to standard error.";

/// A deterministic laboratory of robot motion: three robots, three worlds, one collision checker, one simulator.
///
/// Without a command it opens the lab in a window; built with the feature `headless` it records the 60 s tour into the
/// folder `runs`, replays it and compares every bit.
#[derive(Debug, Parser)]
#[command(version, after_help = EXIT_CODES, after_long_help = EXIT_CODES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    command: Option<CliCommand>,
    /// Say only what is wrong: no notes on what was written, no progress.
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Let an output that is no log replace a log. An input is never replaced.
    #[arg(long, global = true)]
    force: bool,
}

#[derive(Debug, Subcommand)]
enum CliCommand {
    Record(Box<record::RecordArgs>),
    Verify(verify::Verify),
    Replay(replay::ReplayArgs),
    Diff(diff::Diff),
    Export(export::Export),
    Stats(stats::StatsArgs),
    Why(Box<why::WhyArgs>),
    Shrink(Box<shrink::ShrinkArgs>),
    Plot(plot::PlotArgs),
    Info(info::Info),
    Link(link::LinkArgs),
    Query(query::Query),
    Plan(Box<plan::PlanArgs>),
    Problems(problems::Problems),
    Capture(Box<capture::Capture>),
    World(world::WorldArgs),
    Script(script::ScriptArgs),
    Grade(grade::GradeArgs),
    Sweep(Box<sweep::SweepArgs>),
    #[cfg(feature = "window")]
    Open(super::commands::open::OpenArgs),
    Describe(describe::Describe),
    Completions(completions::Completions),
    Man(completions::ManPages),
}

/// The program's command line. A number that begins with a minus sign is a value of every option, so that what is wrong
/// with it is said.
pub(crate) fn command_line() -> clap::Command {
    with_negative_numbers(Cli::command())
}

fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let command =
        command.mut_args(|arg| if arg.get_action().takes_values() { arg.allow_negative_numbers(true) } else { arg });
    let names: Vec<String> = command.get_subcommands().map(|below| below.get_name().to_owned()).collect();
    names.into_iter().fold(command, |command, name| command.mut_subcommand(name, with_negative_numbers))
}

impl Cli {
    /// Whether the command opens the window, which has signals of its own.
    fn opens_window(&self) -> bool {
        match &self.command {
            None => cfg!(all(feature = "window", not(feature = "headless"))),
            #[cfg(feature = "window")]
            Some(CliCommand::Open(_)) => true,
            Some(_) => false,
        }
    }

    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        if self.quiet {
            be_quiet();
        }
        if self.force {
            gate::force();
        }
        if !self.opens_window() {
            interrupt::install()?;
        }
        match self.command {
            Some(CliCommand::Record(record)) => record.run(data),
            Some(CliCommand::Verify(verify)) => verify.run(data),
            Some(CliCommand::Replay(replay)) => replay.run(data),
            Some(CliCommand::Diff(diff)) => diff.run(data),
            Some(CliCommand::Export(export)) => export.run(data),
            Some(CliCommand::Info(info)) => info.run(data),
            Some(CliCommand::Link(link)) => link.run(data),
            Some(CliCommand::Stats(stats)) => stats.run(data),
            Some(CliCommand::Why(why)) => why.run(data),
            Some(CliCommand::Shrink(shrink)) => shrink.run(data),
            Some(CliCommand::Plan(plan)) => plan.run(data),
            Some(CliCommand::Problems(problems)) => problems.run(data),
            Some(CliCommand::Plot(plot)) => plot.run(data),
            Some(CliCommand::Query(query)) => query.run(data),
            Some(CliCommand::Capture(capture)) => capture.run(data),
            Some(CliCommand::World(world)) => world.run(data),
            Some(CliCommand::Script(script)) => script.run(data),
            Some(CliCommand::Sweep(sweep)) => sweep.run(data),
            Some(CliCommand::Completions(completions)) => completions.run(command_line(), data),
            Some(CliCommand::Man(man)) => man.run(command_line(), data),
            Some(CliCommand::Grade(grade)) => grade.run(data),
            Some(CliCommand::Describe(describe)) => describe.run(data),
            #[cfg(feature = "window")]
            Some(CliCommand::Open(open)) => open.run(),
            None => bare::bare(command_line(), data),
        }
    }
}

#[cfg(test)]
mod tests {

    use super::*;

    /// The command lines of the examples in a command's help, each from the program's name on.
    fn examples(command: &clap::Command) -> Vec<String> {
        let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        let listed = help.split("\n\n").find_map(|part| part.strip_prefix("Examples:\n").map(str::to_owned));
        let lines: Vec<String> = listed.unwrap_or_default().lines().map(str::to_owned).collect();
        let own = |line: &String| {
            let from = line.find("motion-lab ").unwrap_or_else(|| panic!("{line} is of another program"));
            line[from..].split(['|', '<', '>']).next().unwrap_or_default().trim().to_owned()
        };
        lines.iter().map(own).collect()
    }

    fn walk(command: &clap::Command, seen: &mut usize) {
        for below in command.get_subcommands().filter(|c| c.get_name() != "help") {
            let about = below.get_about().map(ToString::to_string).unwrap_or_default();
            assert!(!about.is_empty() && !about.ends_with('.'), "{}: {about}", below.get_name());
            let examples = examples(below);
            assert!(!examples.is_empty(), "the help of `{}` has no example", below.get_name());
            for line in examples {
                *seen += 1;
                assert!(line.contains(below.get_name()), "{line} is no example of `{}`", below.get_name());
                let parsed = Cli::try_parse_from(line.split_whitespace());
                assert!(parsed.is_ok(), "{line}: {}", parsed.err().map_or(String::new(), |e| e.to_string()));
            }
            walk(below, seen);
        }
    }

    #[test]
    fn every_command_has_examples_that_it_accepts() {
        let (mut seen, mut program) = (0, Cli::command());
        program.build();
        assert_eq!(examples(&program).len(), 4);
        walk(&program, &mut seen);
        assert!(seen > 40, "{seen} examples");
    }
}
