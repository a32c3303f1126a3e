//! `verify`: simulate recorded runs again and compare every bit.

use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab::recording::Verification;
use motion_lab::run::{Log, LogKind};
use serde::Serialize;

use crate::cli::support::input::{shown, title, worst_of_each};
use crate::cli::support::log_source::{LogSource, read_log, say_damage};
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::verify;
use crate::cli::{Data, Failure, Outcome};

/// Simulate recorded runs again, from their seeds and scripts alone, and compare every frame to the last bit.
///
/// Of a digest log the digest of every second is compared, and a difference is named by its second.
///
/// Of a damaged or unfinished file its sealed beginning is verified, and the exit code is 5. Where the run differs, the
/// first value that does is printed, and the exit code is 4. Of several files each has its turn, and the exit code is 4
/// if any differs, else 3 if any can't be read, else 5 if any is damaged.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab verify run.mcap
  motion-lab verify --json runs/*.mcap
  zstd -dc run.mcap.zst | motion-lab verify -")]
pub struct Verify {
    /// The logs; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// One line of JSON for each; with several, `file` is its name.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct VerifyReport {
    /// The file; left out where there is one alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    ticks: u64,
    sealed: u64,
    identical: u64,
    digest: String,
    divergence: Option<String>,
}

impl Verify {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let several = self.files.len() > 1;
        worst_of_each(&self.files, data, |file, data| self.one(file, several, data))
    }

    fn one(&self, file: &Path, several: bool, data: &mut Data) -> Result<Outcome, Failure> {
        let LogSource { log, damage, .. } = read_log(file)?;
        say_damage(damage.as_ref(), "verified");
        let verdict = VerifyReport { file: several.then(|| shown(file)), ..VerifyReport::of(&log)? };
        if self.json {
            data.json(&verdict)?;
        } else {
            title(file, several, data)?;
            verdict.print(damage.is_some(), data)?;
        }
        Ok(match (verdict.divergence, damage) {
            (Some(_), _) => Outcome::Differs,
            (None, Some(_)) => Outcome::Recovered,
            (None, None) => Outcome::Done,
        })
    }
}

impl VerifyReport {
    /// Simulates the run of a log again and compares it.
    fn of(log: &Log) -> Result<Self, Failure> {
        let progress = CommandProgress::of(log.ticks(), "ticks");
        let Verification { recorded: sealed, identical, digest: simulated, difference, .. } =
            verify(log, |run| progress.at(run.frame().tick))?;
        // a log of digests that ends early does not know the digest of what it has
        let digest = match log.kind() {
            LogKind::Frames => log.digest().unwrap_or(simulated),
            LogKind::Digests => simulated,
        };
        let divergence = difference.map(|difference| difference.to_string());
        let ticks = log.recipe.config.ticks;
        Ok(VerifyReport { file: None, ticks, sealed, identical, digest: digest.to_string(), divergence })
    }

    fn print(&self, damaged: bool, data: &mut Data) -> Result<(), Failure> {
        let VerifyReport { ticks, sealed, identical, digest, divergence, .. } = self;
        if let Some(divergence) = divergence {
            data.line(divergence)?;
        }
        if damaged {
            data.line(format!("{identical} of {sealed} sealed ticks bit-identical; the run has {ticks}"))
        } else {
            data.line(format!("{identical} of {ticks} ticks bit-identical"))?;
            data.line(format!("digest {digest}"))
        }
    }
}
