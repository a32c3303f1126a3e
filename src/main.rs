//! The program.

use std::process::ExitCode;

use motion_lab::cli::Program;

fn main() -> ExitCode {
    Program::default().run()
}
