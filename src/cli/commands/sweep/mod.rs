//! `sweep`: many runs by a study, here or in shards on many machines, and their rows as one table.

mod estimate;
mod journal;
mod keep;
mod list;
mod load;
mod merge;
mod one;
mod planned;
mod report;
mod reproduce;
mod shard;
mod shards;
mod verify;

pub use keep::Keep;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::cli::{Data, Failure, Outcome};
use merge::Merge;
use report::Report;
use reproduce::Reproduce;
use shards::ShardChoice;
use verify::VerifyTables;

/// Run a study's runs, a row for each: what was varied, where robots ended, contacts, clearance, path, digest.
///
/// A study names worlds, scripts, tours or a planner, and the axes to vary: seeds, starts, sizes, sensors, noise,
/// generated worlds, ticks. A row depends on the study and its number alone, so any number of jobs and shards gives the
/// same bytes. Rows are kept as they are made: after Ctrl-C or a crash the same command goes on. `sweep merge` makes
/// one table of them.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "\
Examples:
  motion-lab sweep study.ron --check
  motion-lab sweep study.ron --estimate
  motion-lab sweep study.ron --jobs 4 -o runs/noise
  motion-lab sweep study.ron --shard 3/8 -o runs/noise
  motion-lab sweep merge runs/noise -o noise.parquet -o noise.csv"
)]
pub struct SweepArgs {
    #[command(subcommand)]
    command: Option<SweepCommand>,
    /// The study.
    #[arg(required = true, value_name = "STUDY")]
    study: Option<PathBuf>,
    /// The folder of the parts. [default: the study's name with .sweep for its ending]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// How many runs at once, at most 256. It changes no bit. [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Run part K of N only, from 1; or the part that a cluster's engine asks for: `auto` in a Slurm array, `auto/N` in
    /// any of Slurm, HyperQueue and a Kubernetes Indexed Job. A part that is finished is skipped.
    #[arg(long, value_name = "K/N|auto|auto/N")]
    shard: Option<ShardChoice>,
    /// The runs whose full logs are kept, in the folder `logs` beside the parts.
    #[arg(long, value_enum, value_name = "WHICH", default_value_t = Keep::None)]
    keep: Keep,
    /// List what would be run, a line for each, and run nothing.
    #[arg(long, conflicts_with_all = ["estimate", "output", "keep"])]
    check: bool,
    /// Measure a few runs, say how long all take and how much room, and keep nothing.
    #[arg(long, conflicts_with = "output")]
    estimate: bool,
}

#[derive(Debug, Subcommand)]
enum SweepCommand {
    Merge(Merge),
    Report(Report),
    Reproduce(Reproduce),
    Verify(VerifyTables),
}

impl SweepArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        match (self.command, self.study) {
            (Some(SweepCommand::Merge(merge)), _) => merge.run(data),
            (Some(SweepCommand::Report(report)), _) => report.run(data),
            (Some(SweepCommand::Reproduce(reproduce)), _) => reproduce.run(data),
            (Some(SweepCommand::Verify(verify)), _) => verify.run(data),
            (None, None) => Err(Failure::usage("no study", "Name a study: motion-lab sweep STUDY.")),
            (None, Some(file)) => {
                let study = load::study(&file)?;
                let shard = ShardChoice::shard(self.shard)?;
                if self.check {
                    return list::list(&study, shard, data);
                }
                let jobs = self.jobs.map(usize::from);
                if self.estimate {
                    return estimate::estimate(&study, shard, jobs, self.keep, data);
                }
                let folder = self.output.unwrap_or_else(|| default_folder(&file));
                shard::run(&study, shard, &folder, jobs, self.keep, data)
            }
        }
    }
}

/// The folder of a study's parts where nobody names one.
fn default_folder(study: &Path) -> PathBuf {
    study.with_extension("sweep")
}
