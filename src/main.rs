//! The program: reads the command line, runs one command and maps its outcome to an exit code. No other file does.

mod cli;

use std::process::ExitCode;

use clap::FromArgMatches;

use cli::{Cli, Data, Failure, Outcome, exit, program, say};

fn main() -> ExitCode {
    let cli = program()
        .try_get_matches()
        .and_then(|given| Cli::from_arg_matches(&given))
        .unwrap_or_else(|error| exit(&error));
    let mut data = Data::stdout();
    let ended = cli.run(&mut data).and_then(|outcome| data.finish().map(|()| outcome));
    ExitCode::from(match ended {
        Ok(Outcome::Done) => 0,
        Ok(Outcome::BadInput) => 3,
        Ok(Outcome::Differs | Outcome::NotPassed | Outcome::NoPath) => 4,
        Ok(Outcome::Recovered) => 5,
        Ok(Outcome::Unreachable) => 7,
        Ok(Outcome::Stopped) => 75,
        Err(failure) => {
            say(&failure);
            match failure {
                Failure::Internal(_) | Failure::Output { .. } => 1,
                Failure::Usage { .. } => 2,
                Failure::Input { .. } => 3,
                Failure::NoDisplay(_) => 6,
            }
        }
    })
}
