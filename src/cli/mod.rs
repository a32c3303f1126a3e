//! The command line: one command a file. Data goes to standard output, messages to standard error.

mod commands;
mod support;

pub use support::console::{Data, say};
pub use support::end::{Failure, Outcome};

use clap::{Parser, Subcommand};

use commands::{
    bare, capture, completions, describe, diff, export, grade, info, plot, query, record, replay, script, stats,
    verify, world,
};

/// The exit codes, as `--help` and `docs/cli.md` list them.
const EXIT_CODES: &str = "\
Exit codes:
   0  done
   1  internal error, or an output that could not be written
   2  the command line is wrong
   3  an input file is missing or wrong
   4  the replay differs from the recording or one log from the other, or a graded submission does not pass
   5  the file is damaged or unfinished; its sealed beginning was used
   6  there is no display for the window
  75  stopped early; `record --resume` goes on

Data goes to standard output, messages to standard error.";

/// A deterministic laboratory of robot motion: three robots, three worlds, one collision checker, one simulator.
///
/// Without a command it opens the lab in a window; built with the feature `headless` it records the 60 s tour, replays
/// it and compares every bit.
#[derive(Debug, Parser)]
#[command(version, after_help = EXIT_CODES, after_long_help = EXIT_CODES)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Record(Box<record::Record>),
    Verify(verify::Verify),
    Replay(replay::Replay),
    Diff(diff::Diff),
    Export(export::Export),
    Info(info::Info),
    Stats(stats::StatsArgs),
    Plot(plot::PlotArgs),
    Query(query::Query),
    Capture(Box<capture::Capture>),
    World(world::WorldArgs),
    Script(script::ScriptArgs),
    Completions(completions::Completions),
    Man(completions::ManPages),
    Grade(grade::GradeArgs),
    Describe(describe::Describe),
}

impl Cli {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        match self.command {
            Some(Command::Record(record)) => record.run(data),
            Some(Command::Verify(verify)) => verify.run(data),
            Some(Command::Replay(replay)) => replay.run(data),
            Some(Command::Diff(diff)) => diff.run(data),
            Some(Command::Export(export)) => export.run(data),
            Some(Command::Info(info)) => info.run(data),
            Some(Command::Stats(stats)) => stats.run(data),
            Some(Command::Plot(plot)) => plot.run(),
            Some(Command::Query(query)) => query.run(data),
            Some(Command::Capture(capture)) => capture.run(),
            Some(Command::World(world)) => world.run(data),
            Some(Command::Script(script)) => script.run(data),
            Some(Command::Completions(completions)) => completions.run(data),
            Some(Command::Man(man)) => man.run(data),
            Some(Command::Grade(grade)) => grade.run(data),
            Some(Command::Describe(describe)) => describe.run(data),
            None => bare::bare(data),
        }
    }
}
