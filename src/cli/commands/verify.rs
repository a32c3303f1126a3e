//! `verify`: simulate recorded runs again and compare every bit.

use std::path::{Path, PathBuf};

use clap::Args;
use motion_lab_sim::recording::Verification;
use motion_lab_sim::run::{Digest, LogKind};
use serde::Serialize;

use crate::cli::support::console::note;
use crate::cli::support::input::{shown, title, worst_of_each};
use crate::cli::support::log_source::{ExpectedDigests, LogSource, read_claimed_log, say_damage};
use crate::cli::support::progress::CommandProgress;
use crate::cli::support::simulate::verify;
use crate::cli::{Data, Failure, Outcome};

/// Simulate recorded runs again, from their seeds and scripts alone, and compare every frame to the last bit.
///
/// Of a digest log the digest of every second is compared, and a difference is named by its second.
///
/// The digest that a log's end seals is compared, too: it also covers what changes no frame, such as a range that no
/// ray has reached. A log of before, whose end seals none, is identical as far as its frames tell. Whoever changes a
/// log can seal it again with a new digest; --expect settles it.
///
/// Of a damaged or unfinished file its sealed beginning is verified, and the exit code is 5. Where the run differs, the
/// first value that does is printed, and the exit code is 4. Of several files each has its turn, and the exit code is 4
/// if any differs, else 3 if any can't be read, else 5 if any is damaged.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  motion-lab verify run.mcap
  motion-lab verify --json runs/*.mcap
  motion-lab verify --expect f745674b9949ddd86153036592511806 run.mcap
  zstd -dc run.mcap.zst | motion-lab verify -")]
pub struct Verify {
    /// The logs; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// One line of JSON for each; with several, `file` is its name.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    expected: ExpectedDigests,
}

#[derive(Serialize)]
struct VerifyReport {
    /// The file; left out where there is one alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    ticks: u64,
    sealed: u64,
    identical: u64,
    /// The digest of the run in the log.
    digest: String,
    /// The digest that the log's end seals; null where it seals none.
    sealed_digest: Option<String>,
    /// The first difference: of a frame, of the sealed digest, or of the expected one.
    divergence: Option<String>,
}

impl Verify {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let several = self.files.len() > 1;
        worst_of_each(&self.files, data, |file, data| self.one(file, several, data))
    }

    fn one(&self, file: &Path, several: bool, data: &mut Data) -> Result<Outcome, Failure> {
        let source = read_claimed_log(file)?;
        say_damage(source.damage.as_ref(), "verified");
        let verdict = VerifyReport { file: several.then(|| shown(file)), ..VerifyReport::of(&source, &self.expected)? };
        if self.json {
            data.json(&verdict)?;
        } else {
            title(file, several, data)?;
            verdict.print(&source, &self.expected, data)?;
        }
        Ok(match (verdict.divergence, source.damage) {
            (Some(_), _) => Outcome::Differs,
            (None, Some(_)) => Outcome::Recovered,
            (None, None) => Outcome::Done,
        })
    }
}

impl VerifyReport {
    /// Simulates the run of a log again and compares it.
    fn of(source: &LogSource, expected: &ExpectedDigests) -> Result<Self, Failure> {
        let LogSource { log, sealed: sealed_digest, .. } = source;
        let progress = CommandProgress::of(log.ticks(), "ticks");
        let Verification { recorded: sealed, identical, digest: simulated, difference, .. } =
            verify(log, |run| progress.at(run.frame().tick))?;
        // a log of digests that ends early does not know the digest of what it has
        let digest = match log.kind() {
            LogKind::Frames => log.digest().unwrap_or(simulated),
            LogKind::Digests => simulated,
        };
        let divergence = difference.map(|difference| difference.to_string());
        let divergence = divergence.or_else(|| unsealed(digest, *sealed_digest));
        let divergence = divergence.or_else(|| match source.damage {
            Some(_) if expected.is_any() => Some("the log is not whole: its digest cannot be the expected one".into()),
            _ => expected.refusal(digest),
        });
        let (ticks, sealed_digest) = (log.recipe.config.ticks, sealed_digest.map(|digest| digest.to_string()));
        Ok(VerifyReport { file: None, ticks, sealed, identical, digest: digest.to_string(), sealed_digest, divergence })
    }

    fn print(&self, source: &LogSource, expected: &ExpectedDigests, data: &mut Data) -> Result<(), Failure> {
        let VerifyReport { ticks, sealed, identical, digest, sealed_digest, divergence, .. } = self;
        if let Some(divergence) = divergence {
            data.line(divergence)?;
        }
        if source.damage.is_some() {
            return data.line(format!("{identical} of {sealed} sealed ticks bit-identical; the run has {ticks}"));
        }
        let by_frames_alone = sealed_digest.is_none() && divergence.is_none() && !expected.is_any();
        let how = if by_frames_alone { ", as far as its frames tell" } else { "" };
        data.line(format!("{identical} of {ticks} ticks bit-identical{how}"))?;
        data.line(format!("digest {digest}"))?;
        if by_frames_alone {
            note("the log's end seals no run digest, so settings that change no frame may be others than recorded");
            note("--expect compares the digest with the one that `record` printed");
        }
        Ok(())
    }
}

/// Why a log is not the run whose digest its end seals; `None` where it is, or where the end seals none.
fn unsealed(held: Digest, sealed: Option<Digest>) -> Option<String> {
    let sealed = sealed.filter(|sealed| *sealed != held)?;
    Some(format!(
        "the run digest is {held}, and the log's end seals {sealed}: no frame differs from its run, so seed, settings, \
         worlds or script were changed after it was recorded"
    ))
}
