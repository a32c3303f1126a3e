//! The program without a command: what its features make of it.

use clap::Command;

use crate::cli::{Data, Failure, Outcome};

/// The 60 s tour, recorded and verified.
#[cfg(feature = "headless")]
pub fn bare(_program: Command, data: &mut Data) -> Result<Outcome, Failure> {
    super::tour::tour(data)
}

/// The lab in a window.
#[cfg(all(feature = "window", not(feature = "headless")))]
pub fn bare(_program: Command, _data: &mut Data) -> Result<Outcome, Failure> {
    super::open::tour()
}

/// The help.
#[cfg(not(any(feature = "headless", feature = "window")))]
pub fn bare(mut program: Command, data: &mut Data) -> Result<Outcome, Failure> {
    data.text(&program.render_help().to_string())?;
    Ok(Outcome::Done)
}
