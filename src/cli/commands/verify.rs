//! `verify`: simulate a recorded run again and compare every bit.

use std::path::PathBuf;

use clap::Args;
use motion_lab::recording::{DigestVerification, Verification};
use motion_lab::run::Divergence;
use serde::Serialize;

use crate::cli::support::log_kind::AnyLog;
use crate::cli::support::log_source::{AnySource, read_any_log};
use crate::cli::support::simulate::{verify, verify_digests};
use crate::cli::{Data, Failure, Outcome, say};

/// Simulate a recorded run again, from its seed and script alone, and compare every frame to the last bit.
///
/// Of a digest log the digest of every second is compared, and a difference is named by its second.
///
/// Of a damaged or unfinished file its sealed beginning is verified, and the exit code is 5. Where the run differs, the
/// first value that does is printed, and the exit code is 4.
#[derive(Debug, Args)]
pub struct Verify {
    /// The log.
    file: PathBuf,
    /// One line of JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Verdict {
    ticks: u64,
    sealed: u64,
    identical: u64,
    digest: String,
    divergence: Option<String>,
}

impl Verify {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let AnySource { log, damage, .. } = read_any_log(&self.file)?;
        if let Some(damage) = &damage {
            say(format!("{damage}\nThis much is verified; `motion-lab record --resume` makes it whole."));
        }
        let verdict = Verdict::of(&log)?;
        if self.json {
            data.json(&verdict)?;
        } else {
            verdict.print(damage.is_some(), data)?;
        }
        Ok(match (verdict.divergence, damage) {
            (Some(_), _) => Outcome::Differs,
            (None, Some(_)) => Outcome::Recovered,
            (None, None) => Outcome::Done,
        })
    }
}

impl Verdict {
    /// Simulates the run of a log again and compares it.
    fn of(log: &AnyLog) -> Result<Self, Failure> {
        let ticks = log.parts().1.ticks;
        Ok(match log {
            AnyLog::Full(log) => {
                let Verification { recorded: sealed, identical, divergence, .. } = verify(log, |_| {})?;
                let divergence = divergence.as_ref().map(Divergence::to_string);
                Verdict { ticks, sealed, identical, digest: log.digest().to_string(), divergence }
            }
            AnyLog::Digest(log) => {
                let DigestVerification { recorded: sealed, identical, digest, difference, .. } = verify_digests(log)?;
                let divergence = difference.map(|difference| difference.to_string());
                Verdict { ticks, sealed, identical, digest: digest.to_string(), divergence }
            }
        })
    }

    fn print(&self, damaged: bool, data: &mut Data) -> Result<(), Failure> {
        let Verdict { ticks, sealed, identical, digest, divergence } = self;
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
