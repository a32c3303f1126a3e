//! The program without a command: what its features make of it.

use crate::cli::{Data, Failure, Outcome};

/// The 60 s tour, recorded and verified.
#[cfg(feature = "headless")]
pub fn bare(data: &mut Data) -> Result<Outcome, Failure> {
    super::tour::tour(data)
}

/// The lab in a window.
#[cfg(all(feature = "window", not(feature = "headless")))]
pub fn bare(_data: &mut Data) -> Result<Outcome, Failure> {
    ended(motion_lab::app::run_window())
}

/// The code with which Ctrl-C or a termination signal closes the window.
#[cfg(feature = "window")]
const CTRL_C: u8 = 130;

/// What came of the window.
#[cfg(feature = "window")]
pub fn ended(window: Result<(), motion_lab::app::WindowError>) -> Result<Outcome, Failure> {
    use motion_lab::app::WindowError;
    match window {
        Ok(()) => Ok(Outcome::Done),
        // whoever ends it from the terminal has closed it
        Err(WindowError::Closed(CTRL_C)) => Ok(Outcome::Done),
        Err(error @ WindowError::Closed(_)) => Err(Failure::internal(error)),
        Err(error) => Err(Failure::NoDisplay(error.to_string())),
    }
}

/// The help.
#[cfg(not(any(feature = "headless", feature = "window")))]
pub fn bare(data: &mut Data) -> Result<Outcome, Failure> {
    use clap::CommandFactory;
    data.text(&crate::cli::Cli::command().render_help().to_string())?;
    Ok(Outcome::Done)
}

#[cfg(all(test, feature = "window"))]
mod tests {
    use motion_lab::app::WindowError;

    use super::*;

    #[test]
    fn ctrl_c_closes_the_window_and_an_error_is_a_fault() {
        assert_eq!(ended(Err(WindowError::Closed(130))).unwrap(), Outcome::Done);
        assert!(matches!(ended(Err(WindowError::Closed(1))), Err(Failure::Internal(_))));
        assert!(matches!(ended(Err(WindowError::NoDisplay)), Err(Failure::NoDisplay(_))));
    }
}
