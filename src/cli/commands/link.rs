//! `link`: the address that opens a recorded run.

use std::path::PathBuf;

use crate::web::Link;
use clap::Args;

use crate::cli::support::choices::Site;
use crate::cli::support::input::shown;
use crate::cli::support::log_source::{LogSource, read_log};
use crate::cli::{Data, Failure, Outcome, say};

/// Print the address that shows a recorded run in a browser, at its last tick
///
/// The address holds seed, worlds and script, and the page simulates the run again: it compares the digest, which is in
/// the address too, and says whether it is the same run. Worlds and a range sensor of one's own are in the address, in
/// which names have at most 32 characters. A run of more than an hour, or with a very large world or a very long
/// script, fits in none.
#[derive(Debug, Args)]
#[command(
    verbatim_doc_comment,
    after_help = "\
Examples:
  motion-lab link run.mcap
  motion-lab link run.mcap --site https://example.org/lab/"
)]
pub struct LinkArgs {
    /// The log; `-` is standard input.
    file: PathBuf,
    #[command(flatten)]
    site: Site,
}

impl LinkArgs {
    /// Runs the command.
    pub fn run(self, data: &mut Data) -> Result<Outcome, Failure> {
        let LogSource { log, damage, .. } = read_log(&self.file)?;
        // of a file that is not whole the seed and the script are, or it could not be read at all
        let digest = if damage.is_none() { log.digest().map(|digest| digest.to_string()) } else { None };
        let address = Link::of(&log.recipe).and_then(|link| Link { digest, ..link }.address(&self.site.site));
        let refused = |error| {
            Failure::input(format!("{}: {error}", shown(&self.file)), "The page opens the file itself, as `open` does.")
        };
        data.line(address.map_err(refused)?)?;
        let Some(damage) = damage else { return Ok(Outcome::Done) };
        say(format!("{damage}\nThe address is that of the whole run, without a digest to compare."));
        Ok(Outcome::Recovered)
    }
}
